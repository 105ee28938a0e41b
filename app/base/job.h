// Runs one function on a thread of its own and keeps its result.
#pragma once

#include <algorithm>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace worldy {

// All calls come from one thread. The destructor cancels and waits for the function to return.
template <class T>
class Job {
public:
    // work(const std::stop_token&) returns a T; it should return soon after a stop is requested.
    template <class Work>
    explicit Job(Work work)
        : thread_([this, work = std::move(work)](const std::stop_token& stop) {
              T result = work(stop);
              const std::lock_guard lock(mutex_);
              result_ = std::move(result);
          }) {}

    void cancel() { thread_.request_stop(); }
    bool cancelling() const { return thread_.get_stop_token().stop_requested(); }
    // Returns the result once, when the function has returned; otherwise nothing.
    std::optional<T> takeResult() {
        const std::lock_guard lock(mutex_);
        return std::exchange(result_, std::nullopt);
    }

private:
    std::mutex mutex_;
    std::optional<T> result_;  // guarded by mutex_
    std::jthread thread_;      // last: it uses the other members
};

// Returns the number of threads for work in the background, which leaves one core to the window.
inline int backgroundThreads() {
    return std::max(static_cast<int>(std::thread::hardware_concurrency()) - 1, 1);
}

}  // namespace worldy
