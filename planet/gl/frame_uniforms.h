// What the shaders are told once a frame, in the layout of the uniform block in shaders/frame.glsl.
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "planet/gl/projection.h"
#include "planet/planet_shape.h"
#include "planet/view.h"

namespace planet::gl {

class ColourImage;
struct RenderSettings;

// std140: only members of 16 bytes, so that C++ and GLSL agree without padding.
struct FaceUniforms {
    glm::ivec4 grid;
    glm::vec4 coordinates, roots, direction, origin, cubeOrigin, normal, u, v;
};

struct FrameUniforms {
    std::array<FaceUniforms, faceCount> faces;
    glm::mat4 clipFromWorld;
    glm::vec4 eye, sun, rayForward, rayRight, rayUp, planet, heights, atmosphere, screen;
    glm::ivec4 grid, switches;
};
static_assert(sizeof(FaceUniforms) == 9 * 16 && sizeof(FrameUniforms) == (6 * 9 + 4 + 9 + 2) * 16);

FrameUniforms frameUniforms(const PlanetShape& shape, const View& view, const Projection& projection,
                            const RenderSettings& settings, const ColourImage& image);

}  // namespace planet::gl
