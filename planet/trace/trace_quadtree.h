// Ids of nodes that say where the nodes lie, as lod_trace_quadtree_id() packs them. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <optional>

#include "planet/sphere/chunk_id.h"

namespace planet {

// Read from an id of any engine, so it need not lie in its face.
struct TraceQuadtreePlace {
    std::uint32_t face = 0;   // [0, 7]
    std::uint32_t level = 0;  // [0, 31]
    std::uint32_t x = 0;      // [0, 2^28)
    std::uint32_t y = 0;      // [0, 2^28)
};
TraceQuadtreePlace traceQuadtreePlace(std::uint64_t id);
std::uint64_t traceQuadtreeId(const TraceQuadtreePlace& place);

// Returns the place of the same level beyond an edge; nothing where the face ends, unless it is one of a cube, whose faces lie as
// those of cube_sphere.h, or if the place does not lie in its face.
std::optional<TraceQuadtreePlace> tracePlaceBeyond(const TraceQuadtreePlace& place, Edge edge, bool isCube);

}  // namespace planet
