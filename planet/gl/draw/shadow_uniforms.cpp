#include "planet/gl/draw/shadow_uniforms.h"

#include <glm/gtc/matrix_transform.hpp>

#include "planet/gl/device/shader_inputs.h"

namespace planet::gl {

ShadowUniforms shadowUniforms(const ShadowCascades& cascades, double softness, int mapSizePx) {
    ShadowUniforms uniforms{};
    const glm::dmat4 textureFromClip =
        glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.5)), glm::dvec3(0.5));
    for (std::size_t i = 0; i < shadowCascadeCount; ++i) {
        uniforms.cascades[i] = {textureFromClip * cascades[i].clipFromEye, toFloat(cascades[i].texelM),
                                toFloat(cascades[i].endM)};
    }
    uniforms.softness = toFloat(softness);
    uniforms.texelSize = toFloat(1.0 / mapSizePx);
    return uniforms;
}

}  // namespace planet::gl
