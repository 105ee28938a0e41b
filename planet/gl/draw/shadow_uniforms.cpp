#include "planet/gl/draw/shadow_uniforms.h"

#include <glm/gtc/matrix_transform.hpp>

namespace planet::gl {

ShadowUniforms shadowUniforms(const ShadowCascades& cascades, double softness, int mapSizePx) {
    ShadowUniforms uniforms{};
    const glm::dmat4 textureFromClip =
        glm::scale(glm::translate(glm::dmat4(1), glm::dvec3(0.5)), glm::dvec3(0.5));
    for (std::size_t i = 0; i < shadowCascadeCount; ++i) {
        uniforms.places[i] = textureFromClip * cascades[i].clipFromEye;
        uniforms.texels[i] = glm::dvec4(cascades[i].texelM, cascades[i].endM, 0, 0);
    }
    uniforms.filter = glm::dvec4(softness, 1.0 / mapSizePx, 0, 0);
    return uniforms;
}

}  // namespace planet::gl
