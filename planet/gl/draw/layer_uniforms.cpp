#include "planet/gl/draw/layer_uniforms.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

#include "planet/gl/device/shader_inputs.h"
#include "planet/surface/layer_noise.h"

namespace planet::gl {

namespace {

LineUniforms linesOf(const SoftRange& range, const SoftRange& all) {
    const RangeLines lines = rangeLines(range, all);
    return {toFloat(lines.lowest), toFloat(lines.rise), toFloat(lines.highest), toFloat(lines.fall)};
}

glm::vec3 linearFromSrgb(const glm::vec3& colour) {
    const auto channel = [](float value) {
        return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
    };
    return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

NoiseOctave noiseOctave(const View& view, double cellsPerM) {
    const glm::dvec3 place = view.eyeM * cellsPerM;
    const glm::dvec3 cell = glm::floor(place);
    return {glm::ivec3(latticeCell(cell)), toFloat(cellsPerM), place - cell};
}

// Returns the index of the noise field for a size; layers of one noise size share a field.
int fieldOf(double sizeM, const View& view, std::vector<double>& sizes, LayersUniforms& uniforms) {
    const auto found = std::find(sizes.begin(), sizes.end(), sizeM);
    const auto field = static_cast<std::size_t>(found - sizes.begin());
    if (found != sizes.end()) return static_cast<int>(field);
    sizes.push_back(sizeM);
    double cellsPerM = 1 / sizeM;
    for (std::size_t octave = 0; octave < layerNoiseShares.size(); ++octave, cellsPerM *= layerNoiseOctave)
        uniforms.noise[layerNoiseShares.size() * field + octave] = noiseOctave(view, cellsPerM);
    return static_cast<int>(field);
}

int sliceOf(const LayerDrawing& drawing, std::size_t layer, std::size_t slices) {
    const int picture = layer < drawing.pictures.size() ? drawing.pictures[layer] : -1;
    const bool there = picture >= 0 && static_cast<std::size_t>(picture) + 1 < slices;
    return there && layerProblem(drawing.set.layers[layer]).empty() ? picture + 1 : 0;
}

// Keeps the fraction of the eye's position, computed in doubles: floats are too coarse for the planet's
// radius.
void setRepeats(const View& view, double scaleM, std::size_t at, LayersUniforms& uniforms) {
    double repeatM = scaleM;
    for (std::size_t level = 0; level < layerRepeatLevels; ++level, repeatM *= layerRepeatLevelStep) {
        const glm::dvec3 place = view.eyeM / repeatM;
        uniforms.repeats[at * layerRepeatLevels + level] = {place - glm::floor(place), toFloat(1 / repeatM)};
    }
}

}  // namespace

Switches layerSwitches(const LayerDrawing& drawing, bool software, double nearestGroundM) {
    if (drawing.set.layers.empty()) return 0;
    const bool wanted = isUsed(drawing.use, software);
    const bool seen = wanted && drawing.opacity > 0 && nearestGroundM < drawing.endM;
    return (seen ? switchLayers : Switches{0}) |
           (drawing.preview != LayerPreview::Off ? switchLayerPreview : Switches{0});
}

LayersUniforms layersUniforms(const LayerDrawing& drawing, const View& view, double reliefBoost,
                              double exaggeration, std::span<const glm::vec3> means) {
    assert(drawing.set.layers.size() <= maxLayers && exaggeration > 0);
    LayersUniforms uniforms{};
    std::vector<double> noiseSizes;
    int drawn = 0;
    int previewed = -1;
    for (std::size_t i = 0; i < drawing.set.layers.size(); ++i) {
        if (!isDrawn(drawing.set, i)) continue;
        const TextureLayer& layer = drawing.set.layers[i];
        const auto at = static_cast<std::size_t>(drawn);
        LayerUniforms& uniform = uniforms.layers[at];
        const int slice = sliceOf(drawing, i, means.size());
        const glm::vec3 tint = slice == 0 ? glm::vec3(1) : linearFromSrgb(layer.tint);
        const bool noisy = layer.noiseAmount > 0 && layer.noiseSizeM > 0;
        const int field = noisy ? fieldOf(layer.noiseSizeM, view, noiseSizes, uniforms) : 0;
        uniform.heightLines = linesOf(layer.heightM, allHeightsM);
        uniform.slopeLines = linesOf(layer.slopeDeg, allSlopesDeg);
        uniform.latitudeLines = linesOf(layer.latitudeDeg, allLatitudesDeg);
        uniform.tint = tint;
        uniform.opacity = toFloat(std::clamp(layer.opacity, 0.0, 1.0));
        uniform.noiseAmount = noisy ? toFloat(layer.noiseAmount) : 0;
        uniform.noiseField = field;
        uniform.noiseComponent = static_cast<int>(i % 4);
        uniform.slice = slice;
        const double scaleM = std::max(layer.scaleM, 0.01);
        const glm::vec3 mean = static_cast<std::size_t>(slice) < means.size()
                                   ? means[static_cast<std::size_t>(slice)]
                                   : glm::vec3(1);
        uniform.mean = mean * tint;
        uniform.repeatM = toFloat(scaleM);
        setRepeats(view, scaleM, at, uniforms);
        if (static_cast<int>(i) == drawing.previewed) previewed = drawn;
        ++drawn;
    }
    const double sharpness = drawing.set.blend == LayerBlend::Height ? blendSharpness(drawing.set) : 0;
    uniforms.count = drawn;
    uniforms.noiseFieldCount = static_cast<int>(noiseSizes.size());
    uniforms.previewed = previewed;
    uniforms.previewsMask = drawing.preview == LayerPreview::Mask ? 1 : 0;
    uniforms.fadeBeginM = toFloat(drawing.beginM);
    uniforms.perFadeM = toFloat(1 / std::max(drawing.endM - drawing.beginM, 1e-3));
    uniforms.opacity = toFloat(std::clamp(drawing.opacity, 0.0, 1.0));
    uniforms.sharpness = toFloat(sharpness);
    uniforms.trueHeight = toFloat(1 / exaggeration);
    uniforms.trueSlope = toFloat(1 / (reliefBoost * exaggeration));
    uniforms.colourBelow = toFloat(std::clamp(drawing.colourBelow, 0.0, 1.0));
    uniforms.repeatRad = toFloat(layerRepeatPx / screenScalePx(view));
    return uniforms;
}

}  // namespace planet::gl
