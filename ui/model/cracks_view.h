// What the cracks instrument has measured, for its panel and for the marks in the viewport.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planet/gl/measure/crack_meter.h"
#include "planet/measure/crack_spots.h"
#include "planet/measure/edge_gaps.h"
#include "planet/sphere/view.h"

namespace ui {

// The smallest that leaks nothing, found by trying; each is the larger end of an interval 0.5% wide.
struct SmallestSkirts {
    double depthM = 0;  // the same for all chunks
    double factor = 0;  // of the automatic depth; infinity: none up to 1000 does
};

// Of one view. Chunks by name, so that it holds after they have gone.
struct CrackMeasurement {
    planet::View view;
    planet::View lodView;  // that chose what was drawn; differs from view while LOD is frozen
    planet::SeamMode seams = planet::SeamMode::Skirts;
    std::vector<planet::ChunkId> items;    // what was drawn
    std::vector<planet::DrawnPair> pairs;  // indices are those of items
    std::size_t levelPairs = 0;            // of them: of two levels
    std::vector<planet::EdgeGap> gaps;     // those over 0, worst first
    planet::RequiredSkirts required;       // by the gaps alone
    planet::gl::CrackMap map;
    std::vector<planet::CrackSpot> spots;  // largest first
    double tookMs = 0;
};

// Returns why there are crack pixels although no gap is 0.5 mm wide; empty where there are none or a gap is.
inline const char* roundingNote(std::size_t crackPixels, double worstGapM) {
    return crackPixels > 0 && worstGapM < 0.0005
               ? "All gaps are below 0.5 mm: cracks at T-junctions come from rounding."
               : "";
}

struct CracksView {
    const CrackMeasurement* measured = nullptr;  // null: nothing yet
    bool current = false;  // the view and what is drawn are still those that were measured
    const SmallestSkirts* smallest = nullptr;  // of the view measured; null: not asked for
};

}  // namespace ui
