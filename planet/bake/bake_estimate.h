// What a bake would cost, before it is done: by baking a few blocks of it in memory. Any thread; takes about
// a second. Leaves out the search for the tight metric of the coarsest levels of a planet too large for a
// tile to hold their cells: it reads few blocks.
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
    double fileBytes = 0;                    // colours included
    double seconds = 0;                      // on this machine with the settings' threads; colours included
    std::optional<ColourEstimate> colour{};  // of a bake with colours
};

// Blocks are chosen by a fixed seed, evenly over the sphere. The callback is asked between blocks; false
// cancels.
Result<BakeEstimate> estimateBake(const HeightSource& source, const BakeSettings& settings,
                                  const std::function<bool()>& goOn = {},
                                  const ColourSource* colour = nullptr);

}  // namespace planet
