// What the True error panel shows: the measured error of what is drawn.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "planet/measure/true_error.h"
#include "planet/select/lod_select.h"

namespace ui {

// One measurement, and the frame that it belongs to.
struct ErrorMeasurement {
    planet::TrueErrorReport report;
    std::unordered_map<planet::ChunkId, std::size_t> indexOf;  // in the report's chunks
    std::vector<std::size_t> worstFirst;                       // violations, then by facing pixels
    std::uint64_t frame = 0;                                   // since the window opened
    double atS = 0;                                            // the same, seconds
    planet::View lodView;                                      // that chose what is measured
    double tauPx = 2;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    bool stitched = false;
    double exaggeration = 1;
    std::vector<planet::DrawItem> drawn;
    double tookS = 0;
};

// Fills in the index and the order of a report.
ErrorMeasurement measurementOf(planet::TrueErrorReport&& report);

struct ErrorsView {
    const ErrorMeasurement* last = nullptr;  // null while there is none of this planet
    bool current = false;                    // the view and what is drawn are still those of last
    std::uint64_t frame = 0;                 // now
    bool running = false;
    double progress = 0;  // of the one that runs, [0, 1]
    bool keepMeasuring = false;
    std::string problem;  // why the last one came to nothing
};

}  // namespace ui
