// Finds the exact first hit of a ray on the drawn triangles. Pure functions, any thread.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "planet/select/lod_types.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

struct SurfaceHit {
    ChunkId id;  // the drawn chunk
    NodeIndex node = noNode;
    glm::dvec3 positionM{0, 0, 0};  // from the planet's centre
    double distanceM = 0;           // from the eye
};

// Returns the first hit; nothing if the ray misses. The chunks may come in any order; their nodes must be in
// the tree. Ignores skirts, morph and stitched edges. Hits front faces only, as drawn, so a ray from below
// the ground passes out through it. The direction may have any length but 0.
std::optional<SurfaceHit> pickSurface(const ChunkTree& tree, std::span<const DrawItem> items,
                                      const glm::dvec3& eyeM, const glm::dvec3& direction);

}  // namespace planet
