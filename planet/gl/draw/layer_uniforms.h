// What shaders/layers.glsl is told once a frame, in the layout of its uniform block. Pure functions, any
// thread.
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>

#include "planet/sphere/planet_shape.h"
#include "planet/sphere/view.h"
#include "planet/surface/layer_drawing.h"

namespace planet::gl {

inline constexpr std::size_t layerRepeatLevels = 10;
inline constexpr double layerRepeatLevelStep = 3.2360680;  // as the shader's
// A repeat of the textures covers at least so many pixels, as long as larger repeats are left.
inline constexpr double layerRepeatPx = 320;

// std140: only members of 16 bytes.
struct LayerUniform {
    glm::vec4 heightLines, slopeLines, latitudeLines, tint, noise, mean;
};
struct LayersUniforms {
    glm::ivec4 counts;
    glm::vec4 mix, truth;
    std::array<LayerUniform, maxLayers> layers;
    std::array<glm::ivec4, 3 * maxLayers> noiseCells;  // an octave each
    std::array<glm::vec4, 3 * maxLayers> noiseInside;
    std::array<glm::vec4, maxLayers * layerRepeatLevels> repeatPlaces;
};
static_assert(sizeof(LayerUniform) == 6 * 16 &&
              sizeof(LayersUniforms) == (3 + 6 * 8 + 2 * 24 + 8 * layerRepeatLevels) * 16);

// The switches of shaders/frame.glsl for layers. software: Automatic leaves them off.
int layerSwitches(const LayerDrawing& drawing, bool software, double nearestGroundM);

// reliefBoost: by how much slopes are lit steeper than they are drawn, >= 1. exaggeration: of the heights
// drawn, > 0; layers' ranges mean true heights and slopes. means: linear albedo of each
// slice of the textures, the checker's first.
LayersUniforms layersUniforms(const LayerDrawing& drawing, const View& view, double reliefBoost,
                              double exaggeration, std::span<const glm::vec3> means);

}  // namespace planet::gl
