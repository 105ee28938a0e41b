#include "app/measure/sweep_job.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace worldy {

namespace {

double secondsSince(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
}

// Returns all taus in the order of the flights. For a search it returns zeros, as many as there are flights
// at most.
std::vector<double> allTaus(const SweepPlan& plan) {
    if (plan.goal)
        return std::vector(plan.metrics.size() * static_cast<std::size_t>(mostSuggestFlights()), 0.0);
    std::vector<double> taus;
    for (std::size_t i = 0; i < plan.files.size() * plan.metrics.size(); ++i)
        taus.insert(taus.end(), plan.tausPx.begin(), plan.tausPx.end());
    return taus;
}

}  // namespace

std::optional<double> secondsLeft(std::span<const LegTime> flown, const LegTime& now, double share,
                                  std::span<const double> ahead) {
    if (flown.empty() && share <= 0) return std::nullopt;
    const double total = std::accumulate(flown.begin(), flown.end(), 0.0,
                                         [](double sum, const LegTime& leg) { return sum + leg.seconds; });
    const double meanS = flown.empty() ? now.seconds / share : total / static_cast<double>(flown.size());
    const auto usualS = [&](double tauPx) {
        const auto last = std::find_if(flown.rbegin(), flown.rend(),
                                       [&](const LegTime& leg) { return leg.tauPx == tauPx; });
        return last == flown.rend() ? meanS : last->seconds;
    };
    double leftS =
        share > 0 ? now.seconds / share * (1 - share) : std::max(usualS(now.tauPx) - now.seconds, 0.0);
    for (const double tauPx : ahead) leftS += usualS(tauPx);
    return leftS;
}

SweepJob::SweepJob(SweepPlan plan) : ahead_(allTaus(plan)) {
    progress_.flights = ahead_.size();
    progress_.frames = plan.frames;
    progress_.chunkSize = plan.files.front().chunkSize;
    job_.emplace([this, plan = std::move(plan)](const std::stop_token& stop) { return run(stop, plan); });
}

void SweepJob::begin(const SweepLeg& leg) {
    const std::lock_guard lock(mutex_);
    progress_.bake.reset();
    progress_.frame = 0;
    progress_.chunkSize = leg.chunkSize;
    progress_.metric = leg.metric;
    progress_.tauPx = leg.tauPx;
    legBegan_ = Clock::now();
    ahead_.erase(ahead_.begin());
}

void SweepJob::end(const SweepLeg& leg) {
    const std::lock_guard lock(mutex_);
    flown_.push_back({leg.tauPx, secondsSince(legBegan_)});
    progress_.frame = 0;
    progress_.tauPx = 0;
    ++progress_.flown;
}

SweepWatcher SweepJob::watcherOf(const std::stop_token& stop, const SweepPlan& plan) {
    SweepWatcher watcher;
    watcher.begun = [this](const SweepLeg& leg) { begin(leg); };
    watcher.ended = [this](const SweepLeg& leg) { end(leg); };
    watcher.flying = [this, &stop](const SweepLeg&, int frame) {
        const std::lock_guard lock(mutex_);
        progress_.frame = frame;
        return !stop.stop_requested();
    };
    watcher.baking = [this, &stop](int chunkSize, const planet::BakeProgress& progress) {
        const std::lock_guard lock(mutex_);
        progress_.chunkSize = chunkSize;
        progress_.bake = progress;
        return !stop.stop_requested();
    };
    watcher.flown = [this](const SweepPoint& point) {
        const std::lock_guard lock(mutex_);
        points_.push_back(point);
    };
    watcher.suggested = [this, &plan](const SweepSuggestion& suggestion) {
        const std::lock_guard lock(mutex_);
        suggestions_.push_back(suggestion);
        // The search may have taken fewer flights than planned.
        const auto searches = static_cast<std::size_t>(
            std::find(plan.metrics.rbegin(), plan.metrics.rend(), suggestion.metric) - plan.metrics.rbegin());
        ahead_.assign(searches * static_cast<std::size_t>(mostSuggestFlights()), 0.0);
        progress_.flights = progress_.flown + ahead_.size();
    };
    return watcher;
}

planet::Result<void> SweepJob::run(const std::stop_token& stop, const SweepPlan& plan) {
    planet::Result<void> result = planet::cancelled();
    // This thread takes part in the arena, so the GL calls stay on this thread.
    tbb::task_arena(backgroundThreads()).execute([&] { result = runSweepPlan(plan, watcherOf(stop, plan)); });
    return result;
}

SweepProgress SweepJob::progress() const {
    const std::lock_guard lock(mutex_);
    SweepProgress progress = progress_;
    const bool flies = progress.tauPx > 0;
    const double share = flies ? static_cast<double>(progress.frame) / progress.frames : 1;
    if (flies || !flown_.empty())
        progress.leftS =
            secondsLeft(flown_, {progress.tauPx, flies ? secondsSince(legBegan_) : 0}, share, ahead_);
    return progress;
}

std::vector<SweepPoint> SweepJob::takePoints() {
    const std::lock_guard lock(mutex_);
    return std::exchange(points_, {});
}

std::vector<SweepSuggestion> SweepJob::takeSuggestions() {
    const std::lock_guard lock(mutex_);
    return std::exchange(suggestions_, {});
}

}  // namespace worldy
