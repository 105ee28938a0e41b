// Attaches to a running engine that traces itself with lod_trace.h at "tcp:127.0.0.1:PORT", and writes what comes into
// files that can be read while they grow.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planet/base/file_calls.h"
#include "planet/base/result.h"

namespace planet {

struct TraceLinkSettings {
    int port = 0;                  // at 127.0.0.1 that the engine listens at, [1, 65535]
    std::filesystem::path folder;  // of the files; it exists; empty: the current one
    std::string name = "live";     // of the files, without ".lodtrace" and "/"
    bool isOnce = false;           // ends after the first connection that brought a trace

    std::chrono::milliseconds retry{500};         // from one try to connect to the next one, > 0
    std::chrono::milliseconds slowRetry{5000};    // the same after bytes that were refused, > 0
    std::chrono::milliseconds silentAfter{2000};  // without a byte, an engine counts as silent
    FileCalls calls = systemFileCalls();          // that write the files
};

enum class TraceLinkState {
    Waiting,     // nothing listens at the port, or the engine left; tries again
    Connected,   // something took the connection, and its first block is not whole yet
    Receiving,   // a trace comes
    Silent,      // connected, and nothing comes for a while: the engine is paused, or this is no engine
    TurnedAway,  // the connection was closed before a byte came, as if another tool is attached; tries again
    Refused,     // what came is no trace, of another version, or damaged; tries again at the slow pace
    Failed,      // a file cannot be written; nothing more is received
    Ended,       // stopped, or the only connection is over
};

// The file of one connection, and its contents. The file holds the blocks that are counted here, and for a moment one that was
// just written. At the end of the connection, events of an unfinished block count too.
struct TraceLinkFile {
    std::filesystem::path path;  // empty if there was no connection yet
    std::uint64_t bytes = 0;     // in the file
    std::uint64_t frames = 0;    // that began
    std::uint64_t nodes = 0;     // that are known
    std::uint64_t dropped = 0;   // events that the engine had no room for
};

struct TraceLinkStatus {
    TraceLinkState state = TraceLinkState::Waiting;
    std::string message;  // a sentence with the address: what happens, what is wrong and what would be right
    TraceLinkFile file;   // of this connection, or of the last one that brought a trace
    std::uint64_t files = 0;   // connections that brought a trace; each has a file
    std::uint64_t bytes = 0;   // in all files
    std::uint64_t frames = 0;  // in all files
    std::optional<std::string>
        problem;  // why the last trace ended, unless the engine left between two blocks
    // When the last byte came, of a trace or not; nothing before the first one.
    std::optional<std::chrono::steady_clock::time_point> lastByte;
};

// Connects, waits while nothing listens, and connects again after the engine left, all on a thread of its own. Each
// connection gets a new file, NAME.lodtrace, NAME-2.lodtrace, and so on. No file is ever replaced, and bytes that are no trace
// leave none. Blocks are checked as a TraceReader does, and a block is written as soon as it is whole and valid: TraceFile
// can open the file and refresh while it grows, and whatever ends this process leaves a valid file. If the engine
// leaves or the link is stopped inside a block, the file ends there too, and TraceFile::nextCut() reads its events. If a stream is damaged, what came
// before stays. The engine takes one tool at a time, so two links to one port cannot both receive.
class TraceLink {
public:
    // Starts the thread. The Error says which setting is wrong. Nothing needs to listen yet.
    static Result<std::unique_ptr<TraceLink>> start(TraceLinkSettings settings);
    TraceLink(const TraceLink&) = delete;
    TraceLink& operator=(const TraceLink&) = delete;
    ~TraceLink();  // stops

    // Closes the connection and ends the thread. What has arrived goes to the file, also the events of an unfinished block.
    // It waits for nothing but the file. Any thread.
    void stop();

    // Return how it stands at this moment. Any thread.
    TraceLinkStatus status() const;
    std::vector<TraceLinkFile> files() const;  // of all connections that brought a trace, the first one first

private:
    struct State;
    explicit TraceLink(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Returns the path of file `number`, >= 1, of a link: NAME.lodtrace, NAME-2.lodtrace, and so on. Pure.
std::filesystem::path traceLinkFile(const TraceLinkSettings& settings, std::uint64_t number);

}  // namespace planet
