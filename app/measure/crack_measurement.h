// The results of the cracks instrument.
#pragma once

#include <cstddef>
#include <vector>

#include "planet/gl/measure/crack_meter.h"
#include "planet/measure/crack_spots.h"
#include "planet/measure/edge_gaps.h"
#include "planet/sphere/view.h"

namespace worldy {

// The smallest skirts that leave no pixel uncovered, found by bisection. Each value is the upper end of an
// interval 0.5 % wide.
struct SmallestSkirts {
    double depthM = 0;  // the same depth for all chunks
    double factor = 0;  // multiplies the automatic depth; infinity: no factor up to 1000 suffices
};

// The cracks of one view. Chunks are identified by id, so the measurement stays valid after they are evicted.
struct CrackMeasurement {
    planet::View view;
    planet::View lodView;  // the view that chose the drawn chunks; differs from view while LOD is frozen
    planet::SeamMode seams = planet::SeamMode::Skirts;
    std::vector<planet::ChunkId> items;    // drawn chunks
    std::vector<planet::DrawnPair> pairs;  // indices are those of items
    std::size_t levelPairs = 0;            // pairs of two different levels
    std::vector<planet::EdgeGap> gaps;     // gaps over 0, worst first
    planet::RequiredSkirts required;       // computed from the gaps alone
    planet::gl::CrackMap map;
    std::vector<planet::CrackSpot> spots;  // largest first
    double tookMs = 0;
};

// Returns an explanation of crack pixels where all gaps are below 0.5 mm; otherwise an empty text.
inline const char* roundingNote(std::size_t crackPixels, double worstGapM) {
    return crackPixels > 0 && worstGapM < 0.0005
               ? "All gaps are below 0.5 mm: cracks at T-junctions come from rounding."
               : "";
}

}  // namespace worldy
