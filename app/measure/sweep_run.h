// What a sweep does, for the command and for the window alike: bakes chunk sizes that are not there yet,
// flies each setting without a window, and hands over the points as they come.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "app/measure/sweep.h"
#include "app/measure/sweep_table.h"
#include "app/settings/camera_text.h"
#include "planet/bake/bake.h"
#include "planet/source/height_source.h"

namespace worldy {

// What sweeps measure has nothing to do with colours: files that they bake have none, and none are drawn or
// paged of a file that has.
inline const std::filesystem::path sweptColour{};

// Chunks of one size.
struct SweptFile {
    int chunkSize = 33;
    std::filesystem::path chunkFile;
    bool needsBake = false;  // it is not there yet
    planet::BakeSettings bake{};
};

struct SweepPlan {
    std::filesystem::path source;  // of bakes; unused where none is needed
    planet::HeightSourceSettings sourceSettings;
    std::vector<SweptFile> files;  // at least one; of a goal the first alone is flown
    std::filesystem::path flight;  // .toml or .flight
    std::vector<double> tausPx;
    std::vector<planet::ErrorMetric> metrics;
    int frames = 12;        // moments of the flight, >= 1
    double frameStepS = 0;  // seconds of the flight from one to the next; 0: evenly spread
    std::optional<TauGoal> goal;
    PictureSize size;
    ViewSettings view;  // all but tau, metric, overlays and bad disks
};

// What is flown: one setting over one chunk file.
struct SweepLeg {
    int chunkSize = 33;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double tauPx = 2;
};

// Called by the thread that sweeps. flying and baking are called several times a second; false ends the sweep
// with an Error of kind Cancelled. Both must be given; the others may be empty.
struct SweepWatcher {
    std::function<bool(const SweepLeg& leg, int frame)> flying;  // frame: the moment's number from 0
    std::function<bool(int chunkSize, const planet::BakeProgress&)> baking;
    std::function<void(const SweepLeg& leg)> begun{};  // before each flight,
    std::function<void(const SweepLeg& leg)> ended{};  // and after it
    std::function<void(const SweepPoint&)> flown{};
    std::function<void(const SweepSuggestion&)> suggested{};
};

// Makes a GL context of its own on the calling thread for each file, and leaves none current. The Error names
// the file that could not be read or baked; no unfinished bake is left behind. Bakes that were finished stay.
planet::Result<void> runSweepPlan(const SweepPlan& wanted, const SweepWatcher& watcher);

}  // namespace worldy
