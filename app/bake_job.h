// A bake on a thread of its own.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>
#include <thread>

#include "planet/bake.h"

namespace worldy {

// All calls from one thread.
class BakeJob {
public:
    BakeJob(std::filesystem::path source, planet::BakeSettings settings, std::filesystem::path output);
    ~BakeJob();  // cancels, and waits for the bake's end
    BakeJob(const BakeJob&) = delete;
    BakeJob& operator=(const BakeJob&) = delete;

    planet::BakeProgress progress() const;
    void cancel();
    bool cancelling() const;
    // What came of it, once it has ended; nothing until then and nothing again after.
    std::optional<planet::Result<planet::BakeReport>> takeResult();

private:
    void run(const std::filesystem::path& source, const planet::BakeSettings& settings,
             const std::filesystem::path& output);

    mutable std::mutex mutex_;
    planet::BakeProgress progress_;                             // guarded
    std::optional<planet::Result<planet::BakeReport>> result_;  // guarded
    std::atomic<bool> cancelled_{false};
    std::thread thread_;
};

}  // namespace worldy
