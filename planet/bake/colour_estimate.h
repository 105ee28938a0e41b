// Estimates the cost of baking a colour source by packing a few of its tiles. Any thread.
#pragma once

#include <cstdint>
#include <functional>

#include "planet/bake/bake_settings.h"
#include "planet/base/result.h"
#include "planet/source/colour_source.h"

namespace planet {

// The cost of the tiles of colour alone.
struct ColourEstimate {
    int faceSize = 0;                 // texels a side
    int levels = 0;                   // of tiles
    std::uint64_t tiles = 0;          // of all levels
    double fileBytes = 0;             // that they add to the file
    double seconds = 0;               // that they add to the bake, on this machine with so many threads
    std::uint64_t bakeBytes = 0;      // memory, while they are baked: what the source may keep, and tiles
    std::uint64_t residentBytes = 0;  // memory, were all of them resident on the GPU
};

// cacheBytes: that of openColourSource. Calls goOn between tiles; false cancels.
Result<ColourEstimate> estimateColours(const ColourSource& source, const ColourBakeSettings& settings,
                                       int threads, std::size_t cacheBytes = defaultColourCacheBytes,
                                       const std::function<bool()>& goOn = {});

}  // namespace planet
