#include "app/measure/sweep_run.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

#include "app/flight/flight_path.h"
#include "app/flight/flight_path_file.h"
#include "app/measure/sweep_files.h"
#include "app/scene/offscreen.h"
#include "planet/format/chunk_file.h"

namespace worldy {

namespace {

using planet::Result;

// Returns the settings without overlays, which cost time, and without I/O fault injection, because flights
// wait for loads.
ViewSettings sweptSettings(ViewSettings settings) {
    settings.overlay = {};
    settings.surface.streamed = false;
    settings.surface.light.fill = 0;
    settings.paging.badDisk = {};
    settings.paging.simulated = false;
    return settings;
}

// The open planet of one chunk size.
struct SweptPlanet {
    Offscreen offscreen;
    std::unique_ptr<planet::FinestHeights> heights;
};

Result<SweptPlanet> openSwept(const SweepPlan& plan, const SweptFile& swept) {
    Result<planet::ChunkFile> file = planet::ChunkFile::open(swept.chunkFile);
    if (!file) return tl::unexpected(file.error());
    const int size = planet::chunkSize(file->info().shape);
    if (size != swept.chunkSize) {
        return planet::badInput(
            fmt::format("{}: chunk size is {}, not {}; expected a bake source instead of a chunk file",
                        swept.chunkFile.string(), size, swept.chunkSize));
    }
    Result<Offscreen> offscreen = openOffscreen({.chunkFile = swept.chunkFile}, plan.view, plan.size, 1);
    if (!offscreen) return tl::unexpected(offscreen.error());
    return SweptPlanet{
        std::move(*offscreen),
        std::make_unique<planet::FinestHeights>(std::make_shared<const planet::ChunkFile>(std::move(*file)))};
}

Result<FlightFigures> fly(SweptPlanet& planet, const SweepPlan& plan, const FlightPath& path,
                          const SweepLeg& leg, FigureSet wanted, const SweepWatcher& watcher) {
    ViewSettings settings = plan.view;
    settings.lod.metric = leg.metric;
    settings.lod.tauPx = leg.tauPx;
    const FlightFrames frames = framesOf(path, plan.frames, plan.frameStepS);
    if (watcher.begun) watcher.begun(leg);
    Result<FlightFigures> figures =
        measureFlight(planet.offscreen, path, settings, frames, wanted, *planet.heights,
                      [&](int frame) { return watcher.flying(leg, frame); });
    if (watcher.ended) watcher.ended(leg);
    return figures;
}

Result<void> flyAll(SweptPlanet& planet, int chunkSize, const SweepPlan& plan, const FlightPath& path,
                    const SweepWatcher& watcher) {
    for (const planet::ErrorMetric metric : plan.metrics) {
        for (const double tauPx : plan.tausPx) {
            const SweepLeg leg{chunkSize, metric, tauPx};
            const Result<FlightFigures> figures =
                fly(planet, plan, path, leg, FigureSet::CostAndError, watcher);
            if (!figures) return tl::unexpected(figures.error());
            if (watcher.flown) watcher.flown({chunkSize, metric, tauPx, *figures});
        }
    }
    return {};
}

Result<void> suggest(SweptPlanet& planet, int chunkSize, const SweepPlan& plan, const FlightPath& path,
                     const SweepWatcher& watcher) {
    const TauGoal& goal = *plan.goal;
    const FigureSet wanted = goal.limitsError ? FigureSet::CostAndError : FigureSet::Cost;
    for (const planet::ErrorMetric metric : plan.metrics) {
        const Result<TauSuggestion> found = suggestTau(goal, [&](double tauPx) {
            return fly(planet, plan, path, {chunkSize, metric, tauPx}, wanted, watcher)
                .map([&](const FlightFigures& figures) {
                    return goal.limitsError ? figures.worstMeasuredPx : costOf(figures, goal.cost);
                });
        });
        if (!found) return tl::unexpected(found.error());
        if (watcher.suggested) watcher.suggested({chunkSize, metric, goal, *found});
    }
    return {};
}

}  // namespace

Result<void> runSweepPlan(const SweepPlan& wanted, const SweepWatcher& watcher) {
    SweepPlan plan = wanted;
    plan.view = sweptSettings(wanted.view);
    const Result<FlightPath> path = loadFlightPath(plan.flight);
    if (!path) return tl::unexpected(path.error());
    for (const SweptFile& file : plan.files) {
        const auto baking = [&](const planet::BakeProgress& progress) {
            return watcher.baking(file.chunkSize, progress);
        };
        if (Result<void> baked = bakeSwept({plan.source, {}}, file, plan.sourceSettings, baking); !baked)
            return baked;
        Result<SweptPlanet> planet = openSwept(plan, file);
        if (!planet) return tl::unexpected(planet.error());
        if (plan.goal) return suggest(*planet, file.chunkSize, plan, *path, watcher);
        if (Result<void> flown = flyAll(*planet, file.chunkSize, plan, *path, watcher); !flown) return flown;
    }
    return {};
}

}  // namespace worldy
