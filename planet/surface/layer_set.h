// Texture layers: materials painted over the ground one after the other, each where height, slope and
// latitude say. layerWeights is the reference, in doubles, of what shaders/layers.glsl does for each pixel.
// Pure functions, any thread.
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

// Where a layer lies, by one measure: fully between the ends, half at an end, and gone half a soft edge
// beyond it. In between it rises in a straight line.
struct SoftRange {
    double lowest = 0;
    double highest = 0;   // >= lowest
    double softEdge = 0;  // width of either edge, in the measure's unit, >= 0; 0: a sharp border

    bool operator==(const SoftRange&) const = default;
};

// An end that lies here is open: it has no edge.
inline constexpr SoftRange allHeightsM{-20000, 20000, 0};
inline constexpr SoftRange allSlopesDeg{0, 90, 0};
inline constexpr SoftRange allLatitudesDeg{-90, 90, 0};

struct TextureLayer {
    std::string name = "layer";
    // Pictures, relative to the set's folder; square, a power of two a side.
    std::string albedo;               // sRGB, and the relief in its alpha where it has one
    std::string normal;               // red along columns, green up rows; empty: even
    std::string roughness;            // [0, 1] of grey; empty: 0.9
    double scaleM = 10;               // size of one texture repeat, metres, [0.01, 100000]
    glm::vec3 tint{1, 1, 1};          // over the albedo, sRGB, [0, 1]
    double opacity = 1;               // [0, 1]
    bool muted = false;               // left out
    bool solo = false;                // where any is solo, those alone are drawn
    SoftRange heightM = allHeightsM;  // above the sea level
    SoftRange slopeDeg = allSlopesDeg;
    SoftRange latitudeDeg = allLatitudesDeg;
    double noiseAmount = 0;    // how far noise moves the borders, in falloffs, [0, 4]
    double noiseSizeM = 1000;  // of its coarse lumps, metres, [0.1, 1000000]

    bool operator==(const TextureLayer&) const = default;
};

// How layers share a place: by their weights alone, or so that the one whose relief stands higher wins.
enum class LayerBlend : std::uint8_t { Weight, Height };

struct LayerSet {
    LayerBlend blend = LayerBlend::Height;
    // Of Height: what lies lower by this, in relief and weight together, keeps 1 / e^4 of its share, [0.05,
    // 2].
    double blendDepth = 0.3;
    std::vector<TextureLayer> layers;  // the first lies lowest; at most maxLayers

    bool operator==(const LayerSet&) const = default;
};

// Sea bed, rock, grass, sand, forest and snow, ice at the poles too, for a planet like the Earth;
// data/layers/earth.toml.
LayerSet earthLayers();
// weight = height / 255: grass below, rock above; data/layers/two_layer_height_blend.toml.
LayerSet twoLayerHeightBlend();

// What is wrong with a layer's ranges and numbers, and what would be right; empty: nothing. "heights from 900
// to 300 m: the lowest must not be above the highest".
std::string layerProblem(const TextureLayer& layer);

// Whether a layer is drawn: not muted, and solo where any is.
bool isDrawn(const LayerSet& set, std::size_t layer);

// A place on the ground.
struct LayerPlace {
    glm::dvec3 positionM{0, 0, 0};  // from the planet's centre
    double heightM = 0;             // above the sea level
    double slopeDeg = 0;            // [0, 90]
    double latitudeDeg = 0;         // [-90, 90]
};

using LayerValues = std::array<double, maxLayers>;

// How far each layer covers what lies below it, [0, 1]: opacity x height x slope x latitude; 0 where it is
// not drawn.
LayerValues layerCoverage(const LayerSet& set, const LayerPlace& place);

// What is seen of each layer: its coverage, less what those above it cover. The rest to 1 is the ground that
// they are painted on.
LayerValues layerWeights(const LayerSet& set, const LayerPlace& place);

// The same, shared out anew by the layers' relief, [0, 1] each; their sum stays. Where the set blends by
// weight nothing changes.
LayerValues weightsByRelief(const LayerSet& set, const LayerValues& weights, const LayerValues& relief);

// A range as the two straight lines that the shader is told: (value - lowest) x rise and (highest - value) x
// fall, both within [0, 1]. An open end's line is far above 1.
struct RangeLines {
    double lowest = 0;   // value where the lower edge begins
    double rise = 0;     // 1 / width of the lower edge
    double highest = 0;  // value where the upper edge ends
    double fall = 0;
};
RangeLines rangeLines(const SoftRange& range, const SoftRange& all);

// Of Height: shares go by weight x exp(sharpness x (relief + weight - 1)).
double blendSharpness(const LayerSet& set);

}  // namespace planet
