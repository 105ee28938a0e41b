// The properties of a planet's normals that a renderer needs. It contains no GL, since embedding programs
// include it.
#pragma once

#include <cstdint>

namespace planet::gl {

struct NormalPoolConfig {
    int leafLevel = 0;
    std::uint32_t tileCapacity = 0;  // BlockCounters::tileCapacity
    double quantumM = 1;             // of the stored shape: the tiles' slopes are those of true heights

    bool operator==(const NormalPoolConfig&) const = default;
};

}  // namespace planet::gl
