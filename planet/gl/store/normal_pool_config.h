// What a renderer has to know of a planet's normals to draw them: no GL in it, as in all that embedding
// programs include.
#pragma once

#include <cstdint>

namespace planet::gl {

struct NormalPoolConfig {
    int leafLevel = 0;
    std::uint32_t tileCapacity = 0;  // BlockCounters::tileCapacity
    double quantumM = 1;             // of the shape as stored: the tiles' slopes are of true heights

    bool operator==(const NormalPoolConfig&) const = default;
};

}  // namespace planet::gl
