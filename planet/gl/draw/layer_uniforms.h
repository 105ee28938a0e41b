// The uniform block of shaders/layers.glsl, which describes its members. Pure functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "planet/gl/draw/shader_switches.h"
#include "planet/sphere/view.h"
#include "planet/surface/layer_drawing.h"

namespace planet::gl {

inline constexpr std::size_t layerRepeatLevels = 10;
inline constexpr double layerRepeatLevelStep = 3.2360680;  // irrational: repeats never align
// The least number of pixels that a repeat of the textures covers, as long as there are larger repeats.
inline constexpr double layerRepeatPx = 320;

// Members have std140 offsets, because every vec3 is aligned to 16 bytes.
struct alignas(16) LineUniforms {
    float lowest, rise, highest, fall;
};

struct LayerUniforms {
    LineUniforms heightLines, slopeLines, latitudeLines;
    alignas(16) glm::vec3 tint;
    float opacity;
    alignas(16) glm::vec3 mean;
    float repeatM, noiseAmount;
    int noiseField, noiseComponent, slice;
};

struct NoiseOctave {
    alignas(16) glm::ivec3 cell;
    float cellsPerM;
    alignas(16) glm::vec3 inside;
};

struct RepeatUniforms {
    alignas(16) glm::vec3 eye;
    float perM;
};

struct LayersUniforms {
    int count, noiseFieldCount, previewed, previewsMask;
    float fadeBeginM, perFadeM, opacity, sharpness, trueHeight, trueSlope, colourBelow, repeatRad;
    std::array<LayerUniforms, maxLayers> layers;
    std::array<NoiseOctave, 3 * maxLayers> noise;
    std::array<RepeatUniforms, maxLayers * layerRepeatLevels> repeats;
};

// Returns the switches for layers. software: features set to Automatic are off.
Switches layerSwitches(const LayerDrawing& drawing, bool software, double nearestGroundM);

// Returns the uniform block. reliefBoost: factor by which lighting exaggerates slopes, >= 1. exaggeration: of
// the drawn heights, > 0; the ranges of layers are true heights and slopes. means: mean linear albedo of each
// slice of the textures, the checker's first.
LayersUniforms layersUniforms(const LayerDrawing& drawing, const View& view, double reliefBoost,
                              double exaggeration, std::span<const glm::vec3> means);

}  // namespace planet::gl
