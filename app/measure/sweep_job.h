// A sweep on a thread of its own, with a GL context of its own there.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <thread>
#include <vector>

#include "app/measure/sweep_run.h"

namespace worldy {

// How long a tau took to fly.
struct LegTime {
    double tauPx = 0;
    double seconds = 0;
};
// Seconds that a sweep is likely to take still: of each flight as long as the last one at its tau took, else
// as the mean of those flown. now: the flight under way and its time so far, of which a share in [0, 1] is
// done (1 between flights); ahead: the taus of those after it. Nothing while nothing is known.
std::optional<double> secondsLeft(std::span<const LegTime> flown, const LegTime& now, double share,
                                  std::span<const double> ahead);

// All calls from one thread.
class SweepJob {
public:
    explicit SweepJob(SweepPlan plan);
    ~SweepJob();  // cancels, and waits for its end: a fraction of a second
    SweepJob(const SweepJob&) = delete;
    SweepJob& operator=(const SweepJob&) = delete;

    void cancel() { thread_.request_stop(); }
    bool cancelling() const { return thread_.get_stop_token().stop_requested(); }
    SweepProgress progress() const;
    // Those that have come since the last call.
    std::vector<SweepPoint> takePoints();
    std::vector<SweepSuggestion> takeSuggestions();
    // Once it has ended; nothing until then and nothing again after. Points and suggestions come first: take
    // them after this too.
    std::optional<planet::Result<void>> takeResult();

private:
    void run(const std::stop_token& stop, const SweepPlan& plan);
    SweepWatcher watcherOf(const std::stop_token& stop, const SweepPlan& plan);
    void begin(const SweepLeg& leg);
    void end(const SweepLeg& leg);

    using Clock = std::chrono::steady_clock;

    mutable std::mutex mutex_;
    // All guarded.
    SweepProgress progress_;
    Clock::time_point legBegan_;
    std::vector<LegTime> flown_;
    std::vector<double> ahead_;  // taus to be flown after the one under way; 0: not known yet
    std::vector<SweepPoint> points_;
    std::vector<SweepSuggestion> suggestions_;
    std::optional<planet::Result<void>> result_;

    std::jthread thread_;  // last: it uses all the others
};

}  // namespace worldy
