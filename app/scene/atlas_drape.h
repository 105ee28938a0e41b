// The values of one measure of an atlas, spread over the planet for tints. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <unordered_map>

#include "planet/measure/atlas.h"
#include "planet/measure/atlas_sampling.h"
#include "planet/sphere/chunk_id.h"

namespace worldy {

// Holds the cells of one measure at one altitude, to be drawn.
struct AtlasDrape {
    planet::AtlasMeasure measure = planet::AtlasMeasure::EpsPx;
    bool isChange = false;  // the values are changes since an earlier survey (planet/measure/atlas_diff.h)
    // The values of cells that are not split, and of all coarser squares the largest below, or the worse change. They are
    // infinite where there is no bound.
    std::unordered_map<planet::ChunkId, double> values{};
    // The ends of the colour scale: the smallest value, and the 99th percentile, or the largest value if that is no
    // larger. The scale of changes reaches as far below 0 as above, to the 99th percentile of their sizes.
    double least = 0;
    double most = 0;
    bool isClamped = false;        // some values are larger than most, or also smaller than least for changes
    std::size_t cellsOnScale = 0;  // with a finite value
    bool hasUnbounded = false;     // some have no bound, or have lost it
    bool hasGained = false;        // some changes are of a bound that was gained
};

AtlasDrape drapeOf(std::span<const planet::AtlasCell> cells, planet::AtlasMeasure measure, int altitude);
// Does the same for the cells of planet::changedCellsOf.
AtlasDrape changeDrapeOf(std::span<const planet::AtlasCell> cells, planet::AtlasMeasure measure,
                         int altitude);

// Returns the value at a square of any size; nothing where nothing was measured.
std::optional<double> valueAt(const AtlasDrape& drape, const planet::ChunkId& square);
// Returns whether several cells cover a square.
bool isCoarserThanCells(const AtlasDrape& drape, const planet::ChunkId& square);
// Return the place of a value on the scale, [0, 1], and the value of a place.
double shareOf(const AtlasDrape& drape, double value);
double valueOf(const AtlasDrape& drape, double share);

}  // namespace worldy
