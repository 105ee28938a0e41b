// Texture layers: materials painted over the ground one after the other, by height, slope and latitude.
// layerWeights is the reference, in doubles, for shaders/layers.glsl, which computes it per pixel. Pure
// functions, any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

namespace planet {

inline constexpr std::size_t maxLayers = 8;

// A layer's range of one measure: coverage is 1 inside, 1/2 at an end, and 0 half a soft edge beyond it, with
// a linear ramp in between.
struct SoftRange {
    double lowest = 0;
    double highest = 0;   // >= lowest
    double softEdge = 0;  // width of the ramp at either end, in the measure's unit, >= 0; 0: a sharp border

    bool operator==(const SoftRange&) const = default;
};

// The whole ranges. An end that lies here is open: it has no edge.
inline constexpr SoftRange allHeightsM{-20000, 20000, 0};
inline constexpr SoftRange allSlopesDeg{0, 90, 0};
inline constexpr SoftRange allLatitudesDeg{-90, 90, 0};

struct TextureLayer {
    std::string name = "layer";
    // Image files, relative to the set's folder; square, with a power of two texels per side.
    std::string albedo;               // sRGB, and the relief in alpha, if any
    std::string normal;               // red along columns, green up rows; empty: flat
    std::string roughness;            // grey, [0, 1]; empty: 0.9
    double scaleM = 10;               // size of one texture repeat, metres, [0.01, 100000]
    glm::vec3 tint{1, 1, 1};          // factor on the albedo, sRGB, [0, 1]
    double opacity = 1;               // [0, 1]
    bool muted = false;               // not drawn
    bool solo = false;                // if any layer is solo, only solo layers are drawn
    SoftRange heightM = allHeightsM;  // above the sea level
    SoftRange slopeDeg = allSlopesDeg;
    SoftRange latitudeDeg = allLatitudesDeg;
    double noiseAmount = 0;    // distance by which noise moves the borders, in falloffs, [0, 4]
    double noiseSizeM = 1000;  // size of the noise's coarsest cells, metres, [0.1, 1000000]

    bool operator==(const TextureLayer&) const = default;
};

// The blending of layers at one place: by weight alone, or with the higher relief on top.
enum class LayerBlend : std::uint8_t { Weight, Height };

struct LayerSet {
    LayerBlend blend = LayerBlend::Height;
    // For Height: a layer that is lower by this much, in relief plus weight, keeps 1 / e^4 of its share;
    // [0.05, 2].
    double blendDepth = 0.3;
    std::vector<TextureLayer> layers;  // from bottom to top; at most maxLayers

    bool operator==(const LayerSet&) const = default;
};

// Returns layers for an Earth-like planet: sea bed, rock, grass, sand, forest and snow, and ice at the poles;
// as in data/layers/earth.toml.
LayerSet earthLayers();
// Returns two layers with weight = height / 255, grass below and rock above; as in
// data/layers/two_layer_height_blend.toml.
LayerSet twoLayerHeightBlend();

// Returns the error in a layer's ranges and numbers and the valid values, such as "heights from 900 to 300 m:
// the lowest must not be above the highest"; empty if there is none.
std::string layerProblem(const TextureLayer& layer);

// Returns whether a layer is drawn: it is not muted, and it is solo if any layer is.
bool isDrawn(const LayerSet& set, std::size_t layer);

// A place on the ground.
struct LayerPlace {
    glm::dvec3 positionM{0, 0, 0};  // from the planet's centre
    double heightM = 0;             // above the sea level
    double slopeDeg = 0;            // [0, 90]
    double latitudeDeg = 0;         // [-90, 90]
};

using LayerValues = std::array<double, maxLayers>;

// Returns the coverage of each layer, [0, 1]: opacity x height x slope x latitude; 0 if it is not drawn.
LayerValues layerCoverage(const LayerSet& set, const LayerPlace& place);

// Returns the visible share of each layer: its coverage, less what the layers above it cover. The ground
// below has the rest to 1.
LayerValues layerWeights(const LayerSet& set, const LayerPlace& place);

// A range as two linear functions for the shader: (value - lowest) x rise and (highest - value) x fall, both
// clamped to [0, 1]. At an open end the function is far above 1.
struct RangeLines {
    double lowest = 0;   // value where the lower edge begins
    double rise = 0;     // 1 / width of the lower edge
    double highest = 0;  // value where the upper edge ends
    double fall = 0;
};
RangeLines rangeLines(const SoftRange& range, const SoftRange& all);

// Returns the sharpness for Height: shares are proportional to weight x exp(sharpness x (relief + weight -
// 1)).
double blendSharpness(const LayerSet& set);

}  // namespace planet
