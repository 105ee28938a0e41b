// What a renderer has to know of a planet's colours to draw them: no GL in it, as in all that embedding
// programs include.
#pragma once

#include <cstdint>

#include "planet/format/colour_tile.h"

namespace planet::gl {

struct ColourPoolConfig {
    ColourFormat format = ColourFormat::Bc1;
    int leafLevel = 0;
    std::uint32_t tileCapacity = 0;  // BlockCounters::tileCapacity

    bool operator==(const ColourPoolConfig&) const = default;
};

}  // namespace planet::gl
