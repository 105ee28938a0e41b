// The command worldy sweep: flies the same flight with many settings, without a display, and reports the best
// choices.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/base/report.h"
#include "app/flight/flight_path.h"
#include "app/measure/sweep.h"
#include "app/settings/camera_text.h"
#include "planet/source/height_source.h"

namespace worldy {

struct SweepOptions {
    std::filesystem::path file;  // a chunk file, or a source
    planet::HeightSourceSettings sourceSettings;
    std::filesystem::path flight;  // .toml or .flight
    std::vector<double> tausPx = {0.5, 1, 2, 4, 8};
    std::vector<int> chunkSizes;  // empty: the chunk file's own, or 33
    std::vector<planet::ErrorMetric> metrics = {planet::ErrorMetric::Additive, planet::ErrorMetric::Tight};
    FlightSampling sampling;
    SweepCost cost = SweepCost::Triangles;
    std::optional<TauGoal> goal;       // if set, a tau is searched instead
    ReportTo report;                   // JSON, or CSV if the file ends in .csv
    std::filesystem::path plotOutput;  // .png
    PictureSize size;
    ViewSettings view;  // all except tau and metric
};

planet::Result<void> runSweep(const SweepOptions& options);

}  // namespace worldy
