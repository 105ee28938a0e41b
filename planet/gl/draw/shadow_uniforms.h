// What shaders/shadows.glsl is told once a frame, in the layout of its uniform block. Pure functions, any
// thread.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "planet/select/shadow_cascades.h"

namespace planet::gl {

// std140: only members of 16 bytes.
struct ShadowUniforms {
    std::array<glm::mat4, shadowCascadeCount> places;
    std::array<glm::vec4, shadowCascadeCount> texels;
    glm::vec4 filter;
};
static_assert(sizeof(ShadowUniforms) == (4 + 1) * 16 * shadowCascadeCount + 16);

// softness: radius of the filter, texels, >= 0.
ShadowUniforms shadowUniforms(const ShadowCascades& cascades, double softness, int mapSizePx);

}  // namespace planet::gl
