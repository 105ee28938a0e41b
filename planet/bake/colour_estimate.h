// Estimates the cost of baking a colour source by packing a few of its tiles. Any thread.
#pragma once

#include <cstdint>
#include <functional>

#include "planet/bake/bake_settings.h"
#include "planet/base/result.h"
#include "planet/source/colour_source.h"

namespace planet {

// The cost of only the colour tiles.
struct ColourEstimate {
    int faceSize = 0;                 // texels per side
    int levels = 0;                   // of tiles
    std::uint64_t tiles = 0;          // of all levels
    double fileBytes = 0;             // added to the file
    double seconds = 0;               // added to the bake, on this machine with the given threads
    std::uint64_t bakeBytes = 0;      // memory during the bake: the source's cache, and tiles
    std::uint64_t residentBytes = 0;  // memory on the GPU if all tiles were resident
};

// Estimates the cost. cacheBytes: as for openColourSource. Calls goOn between tiles; returning false cancels.
Result<ColourEstimate> estimateColours(const ColourSource& source, const ColourBakeSettings& settings,
                                       int threads, std::size_t cacheBytes = defaultColourCacheBytes,
                                       const std::function<bool()>& goOn = {});

}  // namespace planet
