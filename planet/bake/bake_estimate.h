// Estimates the cost of a bake by baking a few of its blocks in memory, in about a second; for a sparse tree,
// also in the time that it takes to visit the tree twice. Any thread. The estimate omits the search for the
// tight metric of levels whose cells are wider than a tile, which reads few blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "planet/bake/bake.h"
#include "planet/bake/colour_estimate.h"

namespace planet {

struct BakeEstimate {
    PlanetShape shape;
    std::uint64_t samples = 0;  // of all leaves, each distinct
    std::uint64_t chunks = 0;
    int coarsestLeafLevel = 0;  // the deepest level if the tree is dense
    double fileBytes = 0;       // including colours
    double seconds = 0;         // on this machine with the settings' threads, including colours
    // Memory of the bake besides the program's own, within a factor of two: the source's caches, the threads' work and
    // colours.
    std::uint64_t bakeBytes = 0;
    std::optional<ColourEstimate> colour{};  // for a bake with colours
};

// Chooses blocks by a fixed seed, evenly over the sphere. Calls goOn between blocks; returning false cancels.
Result<BakeEstimate> estimateBake(const HeightSource& source, const BakeSettings& settings,
                                  const std::function<bool()>& goOn = {},
                                  const ColourSource* colour = nullptr);

}  // namespace planet
