// The measured true error of the chunks that one frame drew.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "planet/measure/true_error.h"
#include "planet/planet.h"
#include "planet/select/lod_select.h"

namespace worldy {

// One measurement and the frame that it belongs to.
struct ErrorMeasurement {
    planet::TrueErrorReport report;
    std::unordered_map<planet::ChunkId, std::size_t> indexOf;  // in the report's chunks
    std::vector<std::size_t> worstFirst;                       // violations, then by facing pixels
    std::uint64_t frame = 0;                                   // since the window opened
    planet::View lodView;                                      // the view that chose the measured chunks
    double tauPx = 2;
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    bool stitched = false;
    double exaggeration = 1;
    std::vector<planet::DrawItem> drawn;
    double tookS = 0;
};

// Returns the measurement of a frame, with the index and the order of its report.
ErrorMeasurement measurementOf(planet::TrueErrorReport&& report, ErrorMeasurement frame = {});

// Returns whether two selections draw the same: the same chunks with the same morph, whatever their slots.
bool drawnAlike(std::span<const planet::DrawItem> a, std::span<const planet::DrawItem> b);

// Returns a snapshot of the planet's first selection, as its LOD view sees it.
planet::DrawnSnapshot drawnSnapshotOf(const planet::Planet& planet);

}  // namespace worldy
