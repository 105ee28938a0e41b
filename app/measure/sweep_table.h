// The results and the progress of a sweep.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/measure/sweep_points.h"
#include "planet/bake/bake.h"

namespace worldy {

// The points of the last or the running sweep.
struct SweepTable {
    SweepRequest request;
    std::string flight;              // name of the flight
    std::filesystem::path source;    // the opened source
    std::vector<SweepPoint> points;  // in order of completion; onFront is not set
    bool whole = false;              // true once every requested point is there
};

// The suggested tau for one chunk size and metric.
struct SweepSuggestion {
    int chunkSize = 33;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    TauGoal goal;
    TauSuggestion found;
};

// The progress of a running sweep or search.
struct SweepProgress {
    std::size_t flown = 0;    // completed flights
    std::size_t flights = 0;  // planned flights; for a suggestion the upper limit
    int frame = 0;            // completed sample frames of the current flight
    int frames = 1;
    int chunkSize = 33;  // current chunk size
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double tauPx = 0;                          // 0 before the first flight
    std::optional<planet::BakeProgress> bake;  // set while a bake is running
    std::optional<double> leftS;  // estimate in seconds; empty before the first sample frame is done
};

}  // namespace worldy
