// The uniform block of shaders/shadows.glsl, which describes its members. Pure functions, any thread.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>

#include "planet/select/shadow_cascades.h"

namespace planet::gl {

struct alignas(16) CascadeUniforms {
    glm::mat4 place;
    float texelM, endM;
};

struct ShadowUniforms {
    std::array<CascadeUniforms, shadowCascadeCount> cascades;
    float softness, texelSize;
};

// Returns the uniform block. softness: radius of the filter, texels, >= 0.
ShadowUniforms shadowUniforms(const ShadowCascades& cascades, double softness, int mapSizePx);

}  // namespace planet::gl
