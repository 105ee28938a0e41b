// The sun's views of the ground before a camera, from which its shadows are drawn: cascades after Zhang, Sun,
// Xu and Lun, "Parallel-split shadow maps for large-scale virtual environments" (VRCIA 2006). Each map lies
// around the sphere that holds its piece of the view and moves in whole texels, so that shadows stand still
// while the camera moves and turns (Valient, "Stable rendering of cascaded shadow maps", ShaderX6, 2008).
//
// Maps rather than horizons baked for each place: what casts a shadow is the very mesh that is drawn,
// whatever its level; the sun goes anywhere at once; and nothing is added to the file. The price is drawing
// the ground once more for each cascade, and texels that are seen near by when the sun is low.
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
    // From metres relative to the eye in world axes to [-1, 1]; z = -1 is nearest to the sun. What lies
    // nearer to it still casts a shadow: it has to be clamped there.
    glm::dmat4 clipFromEye{1};
    double texelM = 0;  // side of a texel
    double depthM = 0;  // that z goes over
};
using ShadowCascades = std::array<ShadowCascade, shadowCascadeCount>;

// sun: towards it, any length but 0. groundM: from the eye to the nearest ground in view, > 0; reachM: where
// shadows end, along the view direction, > 0. mapSizePx: of a square map, > 1.
ShadowCascades shadowCascades(const View& view, const glm::dvec3& sun, double groundM, double reachM,
                              int mapSizePx);

// Resident chunks beside and behind the view, no farther from the eye than a reach, which throw shadows into
// it: as selectChunks would choose them without culling. None where the settings do not cull by frustum,
// since then they are drawn. Asks for nothing and marks nothing as used.
std::vector<DrawItem> shadowCasters(const ChunkTree& tree, const View& lodView, const LodSettings& settings,
                                    double reachM);

}  // namespace planet
