// The properties of a planet's colours that a renderer needs. It contains no GL, since embedding programs
// include it.
#pragma once

#include <cstdint>

#include "planet/format/colour_tile.h"

namespace planet::gl {

struct ColourPoolConfig {
    ColourFormat format = ColourFormat::Bc1;
    int leafLevel = 0;
    std::uint32_t tileCapacity = 0;  // BlockCounters::capacity
    bool unpacked = false;           // BlockCounters::unpacked

    bool operator==(const ColourPoolConfig&) const = default;
};

}  // namespace planet::gl
