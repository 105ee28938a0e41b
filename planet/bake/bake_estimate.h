// Estimates the cost of a bake by baking a few of its blocks in memory, in about a second. Any thread. The
// estimate omits the search for the tight metric of levels whose cells are wider than a tile, which reads few
// blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "planet/bake/bake.h"
#include "planet/bake/colour_estimate.h"

namespace planet {

struct BakeEstimate {
    PlanetShape shape;
    std::uint64_t samples = 0;  // distinct finest-level samples
    std::uint64_t chunks = 0;
    double fileBytes = 0;                    // including colours
    double seconds = 0;                      // on this machine with the settings' threads, including colours
    std::optional<ColourEstimate> colour{};  // for a bake with colours
};

// Chooses blocks by a fixed seed, evenly over the sphere. Calls goOn between blocks; returning false cancels.
Result<BakeEstimate> estimateBake(const HeightSource& source, const BakeSettings& settings,
                                  const std::function<bool()>& goOn = {},
                                  const ColourSource* colour = nullptr);

}  // namespace planet
