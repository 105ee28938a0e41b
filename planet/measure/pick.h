// What a ray hits first: exact, on the triangles that are drawn. Pure functions, any thread.
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

// Of chunks in any order; their nodes must be in the tree. Skirts are not hit; morph and stitched edges are
// left out of account. Triangles are hit from above only, as they are drawn: from under the ground one sees
// out. The direction has any length but 0.
std::optional<SurfaceHit> pickSurface(const ChunkTree& tree, std::span<const DrawItem> items,
                                      const glm::dvec3& eyeM, const glm::dvec3& direction);

}  // namespace planet
