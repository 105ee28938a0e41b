// An open trace file: reads the frame to show and the history of the whole trace on two threads of its own, so that no
// frame of the window waits for the file.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "app/trace/trace_history.h"
#include "app/trace/traced_frame.h"
#include "planet/base/result.h"
#include "planet/trace/trace_index.h"

namespace worldy {

// Returns whether a file begins as a trace does, whatever its name is. False if it cannot be read.
bool isTraceFile(const std::filesystem::path& file);

// All calls come from one thread. The destructor stops the threads; it waits at most for the decoding of a block.
class TraceDocument {
public:
    // Begins to read. grows: an engine is still writing the file, so new frames are looked for until setGrows(false).
    TraceDocument(std::filesystem::path file, bool grows);

    const std::filesystem::path& file() const { return file_; }
    // After false, the threads read up to the end of the file once more, so that no frame is missed.
    void setGrows(bool grows);

    // Asks for a frame by number. The nearest one that the trace has at or after it is read; if there is none, the last one.
    void show(std::uint64_t frame);
    // Asks for the newest frame, and each one that follows while the file grows.
    void showNewest();

    // Returns what was read last; null: nothing yet.
    std::shared_ptr<const TracedFrame> frame() const;
    std::shared_ptr<const TraceHistory> history() const;
    // Returns whether the frame that was asked for is not read yet.
    bool isBusy() const;
    // Returns why the file cannot be read, or where it is damaged or cut off; empty: nothing is wrong.
    std::string problem() const;

private:
    struct Wanted {
        std::uint64_t frame = 0;
        bool newest = false;
        std::uint64_t request = 0;  // increases with each call of show and showNewest
    };

    void readFrames(const std::stop_token& stop);
    void readHistory(const std::stop_token& stop);
    Wanted wanted() const;
    bool grows() const;
    bool pause(const std::stop_token& stop, std::uint64_t request);
    void publish(std::shared_ptr<const TracedFrame> frame, std::uint64_t request);
    void publish(std::shared_ptr<const TraceHistory> history);
    void fail(const std::string& problem);

    std::filesystem::path file_;
    mutable std::mutex mutex_;
    std::condition_variable_any changed_;
    // mutex_ guards these.
    bool grows_;
    Wanted wanted_;
    std::uint64_t answered_ = 0;  // the request that frame_ answers
    std::shared_ptr<const TracedFrame> frame_;
    std::shared_ptr<const TraceHistory> history_;
    std::string problem_;

    // Last: they use the other members.
    std::jthread historyThread_;
    std::jthread frameThread_;
};

}  // namespace worldy
