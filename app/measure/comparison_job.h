// A comparison over a flight on a thread of its own, beside the window.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include "app/measure/comparison.h"

namespace worldy {

// All calls from one thread.
class ComparisonJob {
public:
    explicit ComparisonJob(ComparisonPlan plan);
    ~ComparisonJob();  // cancels, and waits for its end: a moment's work at most
    ComparisonJob(const ComparisonJob&) = delete;
    ComparisonJob& operator=(const ComparisonJob&) = delete;

    double progress() const { return progress_; }  // [0, 1]
    void cancel() { cancelled_ = true; }
    bool cancelling() const { return cancelled_; }
    // Once it has ended; nothing until then and nothing again after.
    std::optional<planet::Result<ComparedPair>> takeResult();

private:
    void run(const ComparisonPlan& plan);

    std::mutex mutex_;
    std::optional<planet::Result<ComparedPair>> result_;  // guarded
    std::atomic<double> progress_{0};
    std::atomic<bool> cancelled_{false};
    std::thread thread_;
};

}  // namespace worldy
