#include "planet/gl/draw/frame_uniforms.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "planet/gl/device/shader_inputs.h"
#include "planet/sphere/vertex_position.h"

namespace planet::gl {

namespace {

// Returns the factor by which lighting steepens slopes. Relief is too flat to see from high up: slopes are
// lit as they are near the ground, and up to four times as steep from orbit.
double reliefBoost(const PlanetShape& shape, const View& view) {
    const double altitude = (glm::length(view.eyeM) - shape.radiusM) / shape.radiusM;
    const double t = std::clamp((std::log10(std::max(altitude, 1e-9)) + 4) / 3, 0.0, 1.0);
    return 1 + 3 * t * t * (3 - 2 * t);
}

// Returns 1 up to an altitude of a hundredth of the radius, 0 from a tenth: 64 km and 640 km on Earth.
double nearness(const PlanetShape& shape, double eyeRadiusM) {
    const double altitude = eyeRadiusM / shape.radiusM - 1;
    const double t = std::clamp(-1 - std::log10(std::max(altitude, 1e-9)), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

std::array<FaceUniforms, faceCount> faceUniforms(const VertexFrame& frame, const View& view,
                                                 double cubeHalfM) {
    std::array<FaceUniforms, faceCount> all{};
    for (const Face face : allFaces) {
        const FaceReference& reference = frame.faces[static_cast<std::size_t>(face)];
        FaceUniforms& uniforms = all[static_cast<std::size_t>(face)];
        uniforms.grid = {reference.gridU, reference.gridV};
        uniforms.coordinates = {reference.u0, reference.v0};
        uniforms.roots = reference.roots;
        uniforms.direction = reference.direction;
        uniforms.originM = reference.originM;
        uniforms.cubeOriginM = cubeHalfM * cubePoint(face, reference.u0, reference.v0) - view.eyeM;
    }
    return all;
}

// The periods of the octaves of the detail noise, metres, for height samples 1 m apart. The longest waves are
// about as long as the shortest waves of the heights.
constexpr std::array<double, 3> detailSizes = {8, 1.3, 0.22};

double samplesApartM(const PlanetShape& shape) {
    return 1.5 * shape.radiusM / faceCells(shape);
}

// Computes the eye's position in the noise in doubles, because the planet's centre is too far away for
// floats, and keeps its fraction, because the noise repeats.
void setDetail(const PlanetShape& shape, const View& view, const ColoursDrawn& colours,
               FrameUniforms& uniforms) {
    const double apartM = samplesApartM(shape);
    const auto octaveAt = [&](int octave) {
        const double sizeM = detailSizes[static_cast<std::size_t>(octave)] * apartM;
        const glm::dvec3 eye = detailTurn(octave) * view.eyeM / sizeM;
        return glm::vec4(eye - glm::floor(eye), toFloat(sizeM));
    };
    ShadingFrame& shading = uniforms.shading;
    shading.coarseDetail = octaveAt(0);
    shading.middleDetail = octaveAt(1);
    shading.fineDetail = octaveAt(2);
    const double imageStep = colours.exist() ? 1.0 / colours.faceSizePx : 0;
    shading.heightStepPxM = toFloat(apartM * screenScalePx(view));
    shading.imageStepPxM = toFloat(1.5 * shape.radiusM * imageStep * screenScalePx(view));
    shading.imageStep = toFloat(imageStep);
}

double linearFromSrgb(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

// Mixes colours as square roots of linear light, which is close to mixing in sRGB and cheap to undo.
void setRamp(const RenderSettings& settings, FrameUniforms& uniforms) {
    const std::vector<RampStop>& ramp = settings.ramp;
    assert(ramp.size() <= maxRampStops);
    const bool coloursSea = !ramp.empty() && ramp.front().heightM < 0;
    uniforms.imageOpacity = toFloat(std::clamp(settings.imageOpacity, 0.0, 1.0));
    uniforms.rampColoursSea = coloursSea ? 1 : 0;
    uniforms.shading.perRampTopM = toFloat(1 / settings.rampTopM);
    const std::size_t count = std::min(ramp.size(), maxRampStops);
    uniforms.rampStopCount = static_cast<int>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double startM = ramp[i > 0 ? i - 1 : 0].heightM;
        assert(startM <= ramp[i].heightM);
        for (int channel = 0; channel < 3; ++channel) {
            const double value = std::clamp(static_cast<double>(ramp[i].colour[channel]), 0.0, 1.0);
            uniforms.ramp[i].root[channel] = toFloat(std::sqrt(linearFromSrgb(value)));
        }
        uniforms.ramp[i].startM = toFloat(startM);
        // Two stops at one height make a sharp step.
        uniforms.ramp[i].perM = toFloat(1 / std::max(ramp[i].heightM - startM, 1e-3));
    }
}

TileSampling tileSampling(int leafLevel, double anisotropy, double texelsPerPixel) {
    return {leafLevel, toFloat(anisotropy), toFloat(std::log2(texelsPerPixel))};
}

ShadingFrame shadingFrame(const PlanetShape& shape, const View& view, const RenderSettings& settings) {
    const double eyeRadiusM = glm::length(view.eyeM);
    constexpr double radius = radiusScaleHeights;
    const double eyeScaleHeights = std::max(eyeRadiusM / shape.radiusM - 1, 0.0) * radius;
    ShadingFrame shading{};
    shading.sun = glm::normalize(settings.sunDirection);
    shading.nearGround = toFloat(nearness(shape, eyeRadiusM));
    shading.eyeUp = eyeRadiusM > 0 ? view.eyeM / eyeRadiusM : glm::dvec3(1, 0, 0);
    shading.eyeScaleHeights = toFloat(eyeScaleHeights);
    shading.eyeM = view.eyeM;
    shading.scaleHeightsPerM = toFloat(radius / shape.radiusM);
    shading.eyeGrazing = toFloat(std::sqrt(std::numbers::pi / 2 * (radius + eyeScaleHeights)));
    shading.eyeAir = toFloat(std::exp(-eyeScaleHeights));
    shading.seaLevelM = toFloat(settings.seaLevelM);
    shading.earthRadii = toFloat(6.371e6 / shape.radiusM);
    return shading;
}

}  // namespace

glm::dmat3 detailTurn(int octave) {
    const double a = 0.7 + 1.1 * octave;
    const double b = 0.5 + 0.4 * octave;
    const glm::dmat3 aroundZ({std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1});
    const glm::dmat3 aroundX({1, 0, 0}, {0, std::cos(b), std::sin(b)}, {0, -std::sin(b), std::cos(b)});
    return aroundZ * aroundX;
}

void setNormals(const PlanetShape& shape, const NormalsDrawn& normals, FrameUniforms& uniforms) {
    uniforms.normals = tileSampling(normals.leafLevel, normals.anisotropy, normals.texelsPerPixel);
    uniforms.normalRiseM = toFloat(shape.radiusM * shape.quantumM / normals.quantumM);
}

bool isSeaSurfaceDrawn(const RenderSettings& settings, bool software) {
    return settings.lighting && !settings.cube && settings.sea && isUsed(settings.light.sea.use, software);
}

Switches switchesFor(const PlanetShape& shape, const View& view, const RenderSettings& settings,
                     const ColoursDrawn& colours, bool tinted, double nearestGroundM, bool software) {
    const bool withImage =
        colours.exist() && settings.surface == SurfaceColour::Image && settings.imageOpacity > 0;
    const bool rampSeen = !withImage || settings.imageOpacity < 1;
    const double coarsestM =
        std::max(samplesApartM(shape), withImage ? 1.5 * shape.radiusM / colours.faceSizePx : 0.0);
    const double stepPx = coarsestM * screenScalePx(view) / nearestGroundM;
    const bool detail =
        isUsed(settings.detail, software) && settings.lighting && !settings.cube && !tinted && stepPx > 2;
    const bool fineDetail = detail && stepPx > 200;
    const bool air = settings.atmosphere && settings.lighting && !settings.cube;
    const bool tiles = withImage && colours.streamed;
    const auto when = [](bool isOn, Switches bit) { return isOn ? bit : Switches{0}; };
    return when(settings.lighting, switchLighting) |
           when(settings.lighting && settings.light.fill > 0, switchFill) | when(air, switchAir) |
           when(settings.cube, switchCube) | when(detail, switchDetail) | when(fineDetail, switchFineDetail) |
           when(withImage, switchImage) | when(tiles, switchTiles) |
           when(tiles && colours.fromClipmap, switchClipmap) |
           when(tiles && colours.mipmapsInTiles, switchMipmapsInTiles) |
           when(rampSeen && !settings.ramp.empty(), switchRamp) |
           when(withImage && rampSeen, switchImageOverRamp) | when(settings.sea, switchSea) |
           when(withImage && settings.sea && settings.seaLevelM > 0, switchFlooded) |
           when(isSeaSurfaceDrawn(settings, software), switchSeaSurface) | when(tinted, switchTint) |
           when(settings.wireframe, switchWireframe) | when(settings.outlines, switchOutlines) |
           when(settings.skirtPaint != SkirtPaint::AsGround, switchLoudSkirts) |
           when(software, switchHeldFrame);
}

FrameUniforms frameUniforms(const PlanetShape& shape, const View& view, const Projection& projection,
                            const RenderSettings& settings, const ColoursDrawn& colours) {
    assert(glm::length(settings.sunDirection) > 0 && settings.rampTopM > 0);
    const VertexFrame frame = vertexFrame(shape, view.eyeM);
    const double cubeHalfM = shape.radiusM / std::sqrt(3.0);
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;

    FrameUniforms uniforms{};
    uniforms.faces = faceUniforms(frame, view, cubeHalfM);
    uniforms.clipFromWorld = projection.clipFromCamera * glm::dmat4(cameraFromWorldRotation(view));
    uniforms.rayForward = -view.back;
    uniforms.rayRight = tanX * view.right;
    uniforms.rayUp = tanY * view.up;
    uniforms.pixelRad = toFloat(2 * tanX / view.widthPx);
    uniforms.skyDepth = projection.reversedZ ? 0 : 1;

    uniforms.radiusM = toFloat(shape.radiusM);
    uniforms.referenceRadiusM = toFloat(frame.referenceRadiusM);
    uniforms.cubeHalfM = toFloat(cubeHalfM);
    uniforms.quantumM = toFloat(shape.quantumM);
    uniforms.referenceStep = frame.referenceStep;
    uniforms.baseHeightM = toFloat(shape.baseHeightM);
    uniforms.seaRiseM =
        toFloat(settings.seaLevelM - (shape.baseHeightM + frame.referenceStep * shape.quantumM));
    uniforms.chunkCellsLog2 = shape.chunkCellsLog2;
    uniforms.reliefBoost = toFloat(reliefBoost(shape, view));
    uniforms.fill = toFloat(settings.light.fill);

    uniforms.shading = shadingFrame(shape, view, settings);
    setDetail(shape, view, colours, uniforms);
    setRamp(settings, uniforms);
    uniforms.shading.colours = tileSampling(colours.leafLevel, colours.anisotropy, colours.texelsPerPixel);
    return uniforms;
}

}  // namespace planet::gl
