// Runs a sweep, for the command and for the window: bakes missing chunk sizes, flies each setting offscreen,
// and reports points as they come.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "app/measure/sweep.h"
#include "app/measure/sweep_files.h"
#include "app/measure/sweep_table.h"
#include "app/settings/camera_text.h"
#include "planet/bake/bake.h"
#include "planet/source/height_source.h"

namespace worldy {

struct SweepPlan {
    std::filesystem::path source;  // source of the bakes; unused if none is needed
    planet::HeightSourceSettings sourceSettings;
    std::vector<SweptFile> files;  // at least one; with a goal only the first is flown
    std::filesystem::path flight;  // .toml or .flight
    std::vector<double> tausPx;
    std::vector<planet::ErrorMetric> metrics;
    int frames = 12;        // sample frames of the flight, >= 1
    double frameStepS = 0;  // seconds between sample frames; 0: evenly spread over the flight
    std::optional<TauGoal> goal;
    PictureSize size;
    ViewSettings view;  // tau, metric, overlays and fault injection are replaced
};

// One flight with one setting over one chunk file.
struct SweepLeg {
    int chunkSize = 33;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double tauPx = 2;
};

// Called by the thread that sweeps. flying and baking must be set and are called several times per second;
// returning false ends the sweep with an Error of kind Cancelled. The others may be empty.
struct SweepWatcher {
    std::function<bool(const SweepLeg& leg, int frame)> flying;  // frame: index of the sample frame
    std::function<bool(int chunkSize, const planet::BakeProgress&)> baking;
    std::function<void(const SweepLeg& leg)> begun{};  // before each flight
    std::function<void(const SweepLeg& leg)> ended{};  // after each flight
    std::function<void(const SweepPoint&)> flown{};
    std::function<void(const SweepSuggestion&)> suggested{};
};

// Creates a GL context on the calling thread for each file, and leaves none current. Finished bakes are kept,
// unfinished ones are removed.
planet::Result<void> runSweepPlan(const SweepPlan& wanted, const SweepWatcher& watcher);

}  // namespace worldy
