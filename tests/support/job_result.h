// Waits for what runs on a thread of its own.
#pragma once

#include <chrono>
#include <thread>
#include <utility>

namespace tests {

// Returns the result of a job when it has ended.
template <class Job>
auto resultOf(Job& job) {
    for (;;) {
        if (auto result = job.takeResult()) return *std::move(result);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

}  // namespace tests
