// A comparison over a flight on a thread of its own.
#pragma once

#include <atomic>
#include <optional>
#include <stop_token>
#include <utility>

#include "app/base/job.h"
#include "app/measure/comparison.h"

namespace worldy {

// All calls come from one thread. The destructor cancels and waits for the current sample frame.
class ComparisonJob {
public:
    explicit ComparisonJob(ComparisonPlan plan)
        : job_([this, plan = std::move(plan)](const std::stop_token& stop) {
              return compareOverFlight(plan, [&](double share) {
                  progress_ = share;
                  return !stop.stop_requested();
              });
          }) {}

    double progress() const { return progress_; }  // [0, 1]
    void cancel() { job_.cancel(); }
    bool cancelling() const { return job_.cancelling(); }
    std::optional<planet::Result<ComparedPair>> takeResult() { return job_.takeResult(); }

private:
    std::atomic<double> progress_{0};
    Job<planet::Result<ComparedPair>> job_;  // last: it uses progress_
};

}  // namespace worldy
