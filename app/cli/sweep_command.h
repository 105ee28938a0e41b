// worldy sweep: flies the same flight at many settings, without a display, and tells which are worth
// choosing.
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
    std::filesystem::path file;  // a chunk file, or what one is baked from
    planet::HeightSourceSettings sourceSettings;
    std::filesystem::path flight;  // .toml or .flight
    std::vector<double> tausPx = {0.5, 1, 2, 4, 8};
    std::vector<int> chunkSizes;  // none: 33, or the chunk file's own
    std::vector<planet::ErrorMetric> metrics = {planet::ErrorMetric::Additive, planet::ErrorMetric::Tight};
    FlightSampling sampling;
    SweepCost cost = SweepCost::Triangles;
    std::optional<TauGoal> goal;       // a tau is looked for instead
    ReportTo report;                   // as JSON, or as CSV where the file's name ends in .csv
    std::filesystem::path plotOutput;  // .png
    PictureSize size;
    ViewSettings view;  // all but tau and metric
};

planet::Result<void> runSweep(const SweepOptions& options);

}  // namespace worldy
