#include "planet/measure/atlas_run.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "planet/base/result.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"
#include "planet/measure/atlas.h"
#include "planet/measure/atlas_sampling.h"
#include "planet/measure/atlas_viewpoint.h"
#include "planet/paging/finest_heights.h"
#include "planet/planet.h"
#include "planet/planet_types.h"

namespace planet {

namespace {

// A viewpoint that a round has still to measure.
struct AtlasTask {
    AtlasPlace place;
    std::optional<double> eyeM;
};

// Returns a list whose first entries are the places of the viewpoints that a round has already.
Result<std::vector<AtlasTask>> tasksOf(const AtlasSurvey& survey, std::span<const AtlasViewpoint> revisited,
                                       std::span<const AtlasViewpoint> rounds) {
    std::vector<AtlasTask> tasks;
    if (survey.isRevisit) {
        if (!rounds.empty()) return tasks;
        for (const AtlasViewpoint& viewpoint : revisited) tasks.push_back({viewpoint.place, viewpoint.eyeM});
        return tasks;
    }
    for (const AtlasPlace& place : nextPlaces(survey.grid, survey.radiusM, rounds))
        tasks.push_back({place, std::nullopt});
    return tasks;
}

// The threads of a survey, each with a planet of its own. They work on one round after the other.
class AtlasWorkers {
public:
    AtlasWorkers(std::vector<std::unique_ptr<Planet>> planets, FinestHeights& heights,
                 const AtlasSurvey& survey, const AtlasSettings& settings)
        : planets_(std::move(planets)) {
        meters_.reserve(planets_.size());
        for (const std::unique_ptr<Planet>& planet : planets_)
            meters_.emplace_back(*planet, heights, survey, settings);
        for (AtlasMeter& meter : meters_) threads_.emplace_back([this, &meter] { work(meter); });
    }
    ~AtlasWorkers() {
        stop();
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        begins_.notify_all();
    }
    AtlasWorkers(const AtlasWorkers&) = delete;
    AtlasWorkers& operator=(const AtlasWorkers&) = delete;

    void stop() { stopped_ = true; }

    // Gives the threads their next round; call it after the last one has ended.
    void begin(std::vector<AtlasTask> tasks) {
        const std::lock_guard lock(mutex_);
        tasks_ = std::move(tasks);
        next_ = 0;
        results_.assign(tasks_.size(), std::nullopt);
        begins_.notify_all();
    }

    // Waits until tasks [from, from + count) are done, and calls goOn every now and then; returns them.
    template <class GoOn>
    Result<std::vector<AtlasViewpoint>> wait(std::size_t from, std::size_t count, const GoOn& goOn) {
        std::unique_lock lock(mutex_);
        const auto areDone = [&] {
            return std::all_of(results_.begin() + static_cast<std::ptrdiff_t>(from),
                               results_.begin() + static_cast<std::ptrdiff_t>(from + count),
                               [](const auto& result) { return result.has_value(); });
        };
        while (!ended_.wait_for(lock, std::chrono::milliseconds(100), areDone)) {
            if (!goOn(doneSince(from))) return cancelled();
        }
        std::vector<AtlasViewpoint> done;
        for (std::size_t i = from; i < from + count; ++i) {
            TRY_ASSIGN(const AtlasViewpoint viewpoint, *results_[i]);
            done.push_back(viewpoint);
        }
        return done;
    }

    AtlasCosts costs() const {
        AtlasCosts costs;
        for (const AtlasMeter& meter : meters_) costs += meter.costs();
        return costs;
    }

private:
    std::size_t doneSince(std::size_t from) const {
        return static_cast<std::size_t>(std::count_if(results_.begin() + static_cast<std::ptrdiff_t>(from),
                                                      results_.end(),
                                                      [](const auto& result) { return result.has_value(); }));
    }

    void work(AtlasMeter& meter) {
        // Without an arena of its own, a meter would share the work of the others.
        tbb::task_arena alone(1);
        std::unique_lock lock(mutex_);
        while (true) {
            begins_.wait(lock, [&] { return ends_ || next_ < tasks_.size(); });
            if (ends_) return;
            const std::size_t index = next_++;
            const AtlasTask task = tasks_[index];
            lock.unlock();
            Result<AtlasViewpoint> result = alone.execute(
                [&] { return meter.measure(task.place, task.eyeM, [this] { return !stopped_; }); });
            lock.lock();
            results_[index] = std::move(result);
            ended_.notify_all();
        }
    }

    std::vector<std::unique_ptr<Planet>> planets_;
    std::vector<AtlasMeter> meters_;
    std::atomic<bool> stopped_ = false;
    mutable std::mutex mutex_;  // guards the members below
    std::condition_variable begins_;
    std::condition_variable ended_;
    bool ends_ = false;
    std::vector<AtlasTask> tasks_;
    std::size_t next_ = 0;
    std::vector<std::optional<Result<AtlasViewpoint>>> results_;
    std::vector<std::jthread> threads_;  // last: they use the other members
};

Result<std::vector<std::unique_ptr<Planet>>> planetsFor(const OpenAtlasPlanet& open,
                                                        const AtlasSettings& settings, std::size_t threads) {
    std::vector<std::unique_ptr<Planet>> planets;
    for (std::size_t i = 0; i < threads; ++i) {
        TRY_ASSIGN(PlanetSource source, open());
        TRY_ASSIGN(std::unique_ptr<Planet> planet, Planet::open(std::move(source), settings.paging));
        planet->setExaggeration(settings.exaggeration);
        TRY(planet->setRegions(settings.regions));
        planets.push_back(std::move(planet));
    }
    return planets;
}

}  // namespace

Result<AtlasRun> runAtlas(const OpenAtlasPlanet& open, const AtlasSurvey& survey,
                          const AtlasSettings& settings, std::span<const AtlasViewpoint> revisited,
                          std::size_t threads, std::vector<AtlasViewpoint>& viewpoints,
                          const AtlasWatch& watch) {
    const Stopwatch stopwatch;
    TRY_ASSIGN(PlanetSource source, open());
    FinestHeights heights(source.loadChildren);
    TRY_ASSIGN(auto planets, planetsFor(open, settings, threads));
    AtlasWorkers workers(std::move(planets), heights, survey, settings);

    const std::uint64_t before = viewpoints.size();
    const std::uint64_t total = survey.isRevisit ? revisited.size() : survey.grid.most;
    const auto goOn = [&](std::size_t waiting) {
        const std::uint64_t done = viewpoints.size() + waiting;
        return watch.goOn({done, std::max(done, total), done - before, stopwatch.elapsedS()});
    };
    std::size_t rounds = 0;  // viewpoints of all rounds that have ended
    while (true) {
        TRY_ASSIGN(const std::vector<AtlasTask> tasks,
                   tasksOf(survey, revisited, std::span(viewpoints).first(rounds)));
        if (tasks.empty()) break;
        const std::size_t known = std::min(viewpoints.size() - rounds, tasks.size());
        for (std::size_t i = 0; i < known; ++i) {
            if (viewpoints[rounds + i].place != tasks[i].place)
                return badInput(
                    "the viewpoints of the unfinished survey are not those that its settings give");
        }
        const std::size_t left = tasks.size() - known;
        workers.begin({tasks.begin() + static_cast<std::ptrdiff_t>(known), tasks.end()});
        for (std::size_t at = 0; at < left;) {
            // Batches begin at multiples within the round, also after a cancelled call.
            const std::size_t count = std::min(atlasBatch - (known + at) % atlasBatch, left - at);
            if (!goOn(0)) return cancelled();
            TRY_ASSIGN(const std::vector<AtlasViewpoint> done, workers.wait(at, count, goOn));
            TRY(watch.take(done));
            viewpoints.insert(viewpoints.end(), done.begin(), done.end());
            at += count;
        }
        rounds += tasks.size();
    }
    return AtlasRun{workers.costs(), stopwatch.elapsedS(), viewpoints.size() - before, threads};
}

}  // namespace planet
