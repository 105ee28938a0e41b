// The uniform blocks and samplers of all shaders: the only place in C++ that has their GLSL names. A block's
// binding point and a sampler's texture unit are its index in the table. Requires a current context.
#pragma once

#include <epoxy/gl.h>

#include <array>

#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

// clang-format off
#define PLANET_UNIFORM_BLOCKS(BLOCK)                                                    \
    BLOCK(Frame) BLOCK(Layers) BLOCK(Air) BLOCK(Sea) BLOCK(Shadows) BLOCK(Clipmap)
#define PLANET_SAMPLERS(SAMPLER)                                                        \
    SAMPLER(heightPool) SAMPLER(detailNoise) SAMPLER(shadowMaps)                        \
    SAMPLER(colourImage) SAMPLER(colourTiles) SAMPLER(colourPages) SAMPLER(colourRoots) \
    SAMPLER(clipmapStack) SAMPLER(clipmapBase)                                          \
    SAMPLER(normalTiles) SAMPLER(normalPages) SAMPLER(normalRoots)                      \
    SAMPLER(layerAlbedo) SAMPLER(layerSurface)                                          \
    SAMPLER(airTransmittance) SAMPLER(airGlow) SAMPLER(airSky)                          \
    SAMPLER(sphereImage) SAMPLER(pictureA) SAMPLER(pictureB)
// clang-format on

#define PLANET_ENUMERATOR(name) name,
enum class UniformBlock : GLuint { PLANET_UNIFORM_BLOCKS(PLANET_ENUMERATOR) Count };
enum class Sampler : GLuint { PLANET_SAMPLERS(PLANET_ENUMERATOR) Count };
#undef PLANET_ENUMERATOR

inline constexpr GLuint uniformBlockCount = static_cast<GLuint>(UniformBlock::Count);
inline constexpr GLuint samplerCount = static_cast<GLuint>(Sampler::Count);
static_assert(samplerCount <= 48 && uniformBlockCount <= 36, "the least that OpenGL 3.3 has");

#define PLANET_NAME(name) #name,
inline constexpr std::array<const char*, uniformBlockCount> uniformBlockNames = {
    PLANET_UNIFORM_BLOCKS(PLANET_NAME)};
inline constexpr std::array<const char*, samplerCount> samplerNames = {PLANET_SAMPLERS(PLANET_NAME)};
#undef PLANET_NAME

// Connects the program's blocks and samplers with their binding points and texture units.
void connectInputs(const Program& program);

void bindUniforms(UniformBlock block, const Buffer& buffer);

// Leaves texture unit 0 active.
void bindTexture(Sampler sampler, GLenum target, GLuint texture);

// Converts to a uniform's type; uniforms are computed in doubles.
constexpr float toFloat(double value) {
    return static_cast<float>(value);
}

// Gives the buffer a new store each time, because the GPU may still read the old one.
template <class Uniforms>
void fillUniforms(const Buffer& buffer, const Uniforms& uniforms) {
    glBindBuffer(GL_UNIFORM_BUFFER, buffer.name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof(uniforms), &uniforms, GL_STREAM_DRAW);
}

}  // namespace planet::gl
