// The sun's views of the ground in front of a camera, for shadow maps: cascades after Zhang, Sun, Xu and Lun,
// "Parallel-split shadow maps for large-scale virtual environments" (VRCIA 2006). Each map covers the
// bounding sphere of its part of the view and moves in whole texels, so that shadows are stable while the
// camera moves and turns (Valient, "Stable rendering of cascaded shadow maps", ShaderX6, 2008).
//
// Compared with baked horizons, shadow maps take the drawn mesh of any level as the caster, let the sun move
// freely, and add nothing to the file. They cost another draw of the ground per cascade, and texels are
// visible when the sun is low.
//
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

inline constexpr std::size_t shadowCascadeCount = 3;

struct ShadowCascade {
    double endM = 0;  // along the view direction; the next one begins there
    // Transforms metres relative to the eye in world axes to [-1, 1]; z = -1 is nearest to the sun. Clamp
    // casters nearer to the sun to it.
    glm::dmat4 clipFromEye{1};
    double texelM = 0;  // side of a texel
};
using ShadowCascades = std::array<ShadowCascade, shadowCascadeCount>;

// Computes the cascades. sun: the direction towards it, any length but 0. groundM: the distance from the eye
// to the nearest ground in view, > 0. reachM: the distance along the view direction at which shadows end, >
// 0. mapSizePx: the side of a square map, > 1.
ShadowCascades shadowCascades(const View& view, const glm::dvec3& sun, double groundM, double reachM,
                              int mapSizePx);

// Returns the resident chunks outside the view, within a distance from the eye, that cast shadows into it, as
// selectChunks would choose them without culling. Returns none if the settings do not cull by frustum,
// because such chunks are drawn then. Requests nothing and marks nothing as used.
std::vector<DrawItem> shadowCasters(const ChunkTree& tree, const View& lodView, const LodSettings& settings,
                                    double reachM);

}  // namespace planet
