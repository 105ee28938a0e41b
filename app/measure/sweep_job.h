// A sweep on a thread of its own with its own GL context.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "app/base/job.h"
#include "app/measure/sweep_run.h"

namespace worldy {

// The time of a flight.
struct LegTime {
    double tauPx = 0;
    double seconds = 0;
};
// Estimates the remaining seconds of a sweep. Each flight counts as long as the last one with its tau, or
// else as the mean of all. now: the current flight and its time so far, of which a share in [0, 1] is done (1
// between flights). ahead: the taus of the flights after it. Returns nothing before the first progress.
std::optional<double> secondsLeft(std::span<const LegTime> flown, const LegTime& now, double share,
                                  std::span<const double> ahead);

// All calls come from one thread. The destructor cancels and waits for the end, which takes a fraction of a
// second.
class SweepJob {
public:
    explicit SweepJob(SweepPlan plan);

    void cancel() { job_->cancel(); }
    bool cancelling() const { return job_->cancelling(); }
    SweepProgress progress() const;
    // Return the new points and suggestions since the last call.
    std::vector<SweepPoint> takePoints();
    std::vector<SweepSuggestion> takeSuggestions();
    // Returns the result once. Take points and suggestions after it once more.
    std::optional<planet::Result<void>> takeResult() { return job_->takeResult(); }

private:
    planet::Result<void> run(const std::stop_token& stop, const SweepPlan& plan);
    SweepWatcher watcherOf(const std::stop_token& stop, const SweepPlan& plan);
    void begin(const SweepLeg& leg);
    void end(const SweepLeg& leg);

    using Clock = std::chrono::steady_clock;

    mutable std::mutex mutex_;
    // mutex_ guards all of these.
    SweepProgress progress_;
    Clock::time_point legBegan_;
    std::vector<LegTime> flown_;
    std::vector<double> ahead_;  // taus after the current one; 0: not known yet
    std::vector<SweepPoint> points_;
    std::vector<SweepSuggestion> suggestions_;

    std::optional<Job<planet::Result<void>>> job_;  // always set; last: it uses the other members
};

}  // namespace worldy
