#include "planet/surface/layer_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

#include "planet/surface/layer_noise.h"

namespace planet {

namespace {

// In floats, a sharper edge is the same as a step.
constexpr double leastSoftEdge = 0.01;
constexpr double openEnd = 1e9;

TextureLayer material(std::string name, double scaleM) {
    TextureLayer layer;
    layer.name = name;
    std::replace(name.begin(), name.end(), ' ', '_');
    layer.albedo = name + "_albedo.png";
    layer.normal = name + "_normal.png";
    layer.roughness = name + "_roughness.png";
    layer.scaleM = scaleM;
    return layer;
}

double along(const RangeLines& lines, double value, double shift) {
    const double rise = std::clamp((value - lines.lowest) * lines.rise + shift, 0.0, 1.0);
    const double fall = std::clamp((lines.highest - value) * lines.fall + shift, 0.0, 1.0);
    return rise * fall;
}

std::string rangeProblem(std::string_view what, std::string_view unit, const SoftRange& range,
                         const SoftRange& all) {
    if (!(range.lowest <= range.highest)) {
        return fmt::format("{}: [{}, {}]{} is inverted; expected the lowest value first", what, range.lowest,
                           range.highest, unit);
    }
    if (!(range.lowest >= all.lowest && range.highest <= all.highest)) {
        return fmt::format("{}: [{}, {}]{} is out of range; expected values in [{}, {}]", what, range.lowest,
                           range.highest, unit, all.lowest, all.highest);
    }
    const double widest = all.highest - all.lowest;
    if (!(range.softEdge >= 0 && range.softEdge <= widest)) {
        return fmt::format("{}: falloff {}{} is out of range; expected [0, {}]", what, range.softEdge, unit,
                           widest);
    }
    return {};
}

std::string numberProblem(std::string_view what, double value, double least, double most) {
    if (value >= least && value <= most) return {};
    return fmt::format("{}: {} is out of range; expected [{}, {}]", what, value, least, most);
}

}  // namespace

LayerSet earthLayers() {
    TextureLayer seaBed = material("sea bed", 14);
    seaBed.heightM = {allHeightsM.lowest, 0, 6};
    seaBed.noiseAmount = 1;
    seaBed.noiseSizeM = 900;

    // Rock lies under all land; grass, forest and snow leave steep or high places uncovered.
    TextureLayer rock = material("rock", 40);
    rock.heightM = {0, allHeightsM.highest, 4};

    TextureLayer grass = material("grass", 5);
    grass.heightM = {2, 3700, 900};
    grass.slopeDeg = {0, 27, 12};
    grass.latitudeDeg = {-58, 71, 6};
    grass.noiseAmount = 1.2;
    grass.noiseSizeM = 4000;

    TextureLayer sand = material("sand", 9);
    sand.heightM = {-4, 12, 12};
    sand.slopeDeg = {0, 12, 8};
    sand.latitudeDeg = {-58, 58, 10};
    sand.noiseAmount = 1.2;
    sand.noiseSizeM = 900;

    TextureLayer forest = material("forest", 70);
    forest.heightM = {60, 2700, 900};
    forest.slopeDeg = {3, 32, 14};
    forest.latitudeDeg = {-55, 66, 6};
    forest.opacity = 0.95;
    forest.noiseAmount = 1.5;
    forest.noiseSizeM = 4000;

    TextureLayer snow = material("snow", 30);
    snow.heightM = {5300, allHeightsM.highest, 900};
    snow.slopeDeg = {0, 40, 18};
    snow.noiseAmount = 0.9;
    snow.noiseSizeM = 4000;

    TextureLayer northernIce = snow;
    northernIce.name = "northern ice";
    northernIce.heightM = {700, allHeightsM.highest, 400};
    northernIce.latitudeDeg = {70, allLatitudesDeg.highest, 6};

    TextureLayer southernIce = snow;
    southernIce.name = "southern ice";
    southernIce.heightM = {0, allHeightsM.highest, 4};
    southernIce.latitudeDeg = {allLatitudesDeg.lowest, -66, 4};

    LayerSet set;
    set.layers = {seaBed, rock, grass, sand, forest, snow, northernIce, southernIce};
    return set;
}

LayerSet twoLayerHeightBlend() {
    LayerSet set;
    set.blend = LayerBlend::Weight;
    TextureLayer grass = material("grass", 5);
    TextureLayer rock = material("rock", 40);
    rock.heightM = {127.5, allHeightsM.highest, 255};
    set.layers = {grass, rock};
    return set;
}

std::string layerProblem(const TextureLayer& layer) {
    const std::array<std::string, 7> problems = {
        rangeProblem("heights", " m", layer.heightM, allHeightsM),
        rangeProblem("slopes", "°", layer.slopeDeg, allSlopesDeg),
        rangeProblem("latitudes", "°", layer.latitudeDeg, allLatitudesDeg),
        numberProblem("scale, m", layer.scaleM, 0.01, 1e5),
        numberProblem("opacity", layer.opacity, 0, 1),
        numberProblem("noise amount", layer.noiseAmount, 0, 4),
        numberProblem("noise size, m", layer.noiseSizeM, 0.1, 1e6)};
    const auto found = std::find_if(problems.begin(), problems.end(),
                                    [](const std::string& problem) { return !problem.empty(); });
    return found == problems.end() ? std::string() : *found;
}

bool isDrawn(const LayerSet& set, std::size_t layer) {
    assert(layer < set.layers.size());
    const bool anySolo = std::any_of(set.layers.begin(), set.layers.end(),
                                     [](const TextureLayer& other) { return other.solo; });
    return !set.layers[layer].muted && (!anySolo || set.layers[layer].solo);
}

RangeLines rangeLines(const SoftRange& range, const SoftRange& all) {
    RangeLines lines{-openEnd, 1, openEnd, 1};
    if (!(range.lowest <= range.highest)) return lines;
    const double width = std::max(range.softEdge, leastSoftEdge);
    if (range.lowest > all.lowest) {
        lines.lowest = range.lowest - width / 2;
        lines.rise = 1 / width;
    }
    if (range.highest < all.highest) {
        lines.highest = range.highest + width / 2;
        lines.fall = 1 / width;
    }
    return lines;
}

double blendSharpness(const LayerSet& set) {
    return 4 / std::clamp(set.blendDepth, 0.05, 2.0);
}

LayerValues layerCoverage(const LayerSet& set, const LayerPlace& place) {
    assert(set.layers.size() <= maxLayers);
    LayerValues coverage{};
    for (std::size_t i = 0; i < set.layers.size(); ++i) {
        if (!isDrawn(set, i)) continue;
        const TextureLayer& layer = set.layers[i];
        const double shift =
            layer.noiseAmount > 0
                ? layer.noiseAmount * layerNoise(place.positionM, layer.noiseSizeM)[static_cast<int>(i % 4)]
                : 0;
        coverage[i] = layer.opacity * along(rangeLines(layer.heightM, allHeightsM), place.heightM, shift) *
                      along(rangeLines(layer.slopeDeg, allSlopesDeg), place.slopeDeg, shift) *
                      along(rangeLines(layer.latitudeDeg, allLatitudesDeg), place.latitudeDeg, shift);
    }
    return coverage;
}

LayerValues layerWeights(const LayerSet& set, const LayerPlace& place) {
    LayerValues weights = layerCoverage(set, place);
    double uncovered = 1;
    for (std::size_t i = maxLayers; i-- > 0;) {
        const double covers = weights[i];
        weights[i] = covers * uncovered;
        uncovered *= 1 - covers;
    }
    return weights;
}

}  // namespace planet
