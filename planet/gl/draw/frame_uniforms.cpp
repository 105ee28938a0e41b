#include "planet/gl/draw/frame_uniforms.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "planet/sphere/vertex_position.h"

namespace planet::gl {

namespace {

// Scale heights in the planet's radius: 10 km on Earth, a little over the real 8.4, so that the rim shows.
constexpr double radiusInScaleHeights = 640;

glm::vec4 padded(const glm::vec3& v) {
    return {v, 0};
}

// Relief is too flat to see from high up: slopes are lit as they are near the ground, and up to four times as
// steep from orbit.
double reliefBoost(const PlanetShape& shape, const View& view) {
    const double altitude = (glm::length(view.eyeM) - shape.radiusM) / shape.radiusM;
    const double t = std::clamp((std::log10(std::max(altitude, 1e-9)) + 4) / 3, 0.0, 1.0);
    return 1 + 3 * t * t * (3 - 2 * t);
}

// 1 up to a hundredth of the radius above it, 0 from a tenth: 64 and 640 km on Earth.
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
        const FaceAxes& axes = faceAxes(face);
        FaceUniforms& uniforms = all[static_cast<std::size_t>(face)];
        uniforms.grid = {reference.gridU, reference.gridV, 0, 0};
        uniforms.coordinates = {reference.u0, reference.v0, 0, 0};
        uniforms.roots = padded(reference.roots);
        uniforms.direction = padded(reference.direction);
        uniforms.origin = padded(reference.originM);
        uniforms.cubeOrigin =
            padded(glm::dvec3(cubeHalfM * cubePoint(face, reference.u0, reference.v0) - view.eyeM));
        uniforms.normal = padded(axes.normal);
        uniforms.u = padded(axes.u);
        uniforms.v = padded(axes.v);
    }
    return all;
}

// Metres that each octave of the detail's noise covers once, where the heights' samples lie one metre apart:
// its coarsest waves are about as long as the shortest of the heights.
constexpr std::array<double, 3> detailSizes = {8, 1.3, 0.22};

// Turned out of the axes, each octave its own way, so that the ground cuts the noise at odd angles and does
// not repeat.
glm::dmat3 detailTurn(int octave) {
    const double a = 0.7 + 1.1 * octave;
    const double b = 0.5 + 0.4 * octave;
    const glm::dmat3 aroundZ({std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1});
    const glm::dmat3 aroundX({1, 0, 0}, {0, std::cos(b), std::sin(b)}, {0, -std::sin(b), std::cos(b)});
    return aroundZ * aroundX;
}

double samplesApartM(const PlanetShape& shape) {
    return 1.5 * shape.radiusM / faceCells(shape);
}

// The eye's place in the noise is worked out in doubles, and only what is behind the point sent on: noise
// that repeats needs no more, and the planet's centre is too far away for floats.
void setDetail(const PlanetShape& shape, const View& view, const ColoursDrawn& colours,
               FrameUniforms& uniforms) {
    const double apartM = samplesApartM(shape);
    for (int octave = 0; octave < 3; ++octave) {
        const double sizeM = detailSizes[static_cast<std::size_t>(octave)] * apartM;
        const glm::dmat3 rows = glm::transpose(detailTurn(octave));
        for (int row = 0; row < 3; ++row) {
            const double eyeAt = glm::dot(rows[row], view.eyeM) / sizeM;
            uniforms.detailRows[static_cast<std::size_t>(3 * octave + row)] =
                glm::dvec4(rows[row] / sizeM, eyeAt - std::floor(eyeAt));
        }
        uniforms.detailSizes[octave] = static_cast<float>(sizeM);
    }
    const double imageStep = colours.exist() ? 1.0 / colours.faceSizePx : 0;
    uniforms.detailPixels = glm::dvec4(apartM * screenScalePx(view),
                                       1.5 * shape.radiusM * imageStep * screenScalePx(view), imageStep, 0);
}

double linearFromSrgb(double value) {
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

// Colours mix as the roots of their light, which is near to how sRGB mixes and cheap to undo.
void setRamp(const RenderSettings& settings, FrameUniforms& uniforms) {
    const std::vector<RampStop>& ramp = settings.ramp;
    assert(ramp.size() <= maxRampStops);
    const bool coloursSea = !ramp.empty() && ramp.front().heightM < 0;
    uniforms.surfacing.x = static_cast<float>(std::clamp(settings.imageOpacity, 0.0, 1.0));
    uniforms.surfacing.y = coloursSea ? 1 : 0;
    const std::size_t count = std::min(ramp.size(), maxRampStops);
    uniforms.grid.z = static_cast<int>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double startM = ramp[i > 0 ? i - 1 : 0].heightM;
        assert(startM <= ramp[i].heightM);
        for (int channel = 0; channel < 3; ++channel) {
            const double value = std::clamp(static_cast<double>(ramp[i].colour[channel]), 0.0, 1.0);
            uniforms.rampColours[i][channel] = static_cast<float>(std::sqrt(linearFromSrgb(value)));
        }
        // Two stops at one height are a sharp step.
        uniforms.rampRises[i] = glm::dvec4(startM, 1 / std::max(ramp[i].heightM - startM, 1e-3), 0, 0);
    }
}

}  // namespace

void setNormals(const PlanetShape& shape, const NormalsDrawn& normals, FrameUniforms& uniforms) {
    uniforms.normalLevels = {normals.leafLevel, 0, 0, 0};
    uniforms.normalFilter = glm::dvec4(normals.anisotropy, std::log2(normals.texelsPerPixel),
                                       shape.radiusM * shape.quantumM / normals.quantumM, 0);
}

bool isSeaSurfaceDrawn(const RenderSettings& settings, bool software) {
    return settings.lighting && !settings.cube && settings.sea && isUsed(settings.light.sea.use, software);
}

int switchesFor(const PlanetShape& shape, const View& view, const RenderSettings& settings,
                const ColoursDrawn& colours, bool tinted, double nearestGroundM, bool software) {
    const bool withImage =
        colours.exist() && settings.surface == SurfaceColour::Image && settings.imageOpacity > 0;
    const bool rampSeen = !withImage || settings.imageOpacity < 1;
    const double coarsestM =
        std::max(samplesApartM(shape), withImage ? 1.5 * shape.radiusM / colours.faceSizePx : 0.0);
    const double stepPx = coarsestM * screenScalePx(view) / nearestGroundM;
    const bool detail = settings.detail && settings.lighting && !settings.cube && !tinted && stepPx > 2;
    const bool fineDetail = detail && stepPx > 200;
    const bool air = settings.atmosphere && settings.lighting && !settings.cube;
    const bool tiles = withImage && colours.streamed;
    return (settings.lighting ? switchLighting : 0) |
           (isSeaSurfaceDrawn(settings, software) ? switchSeaSurface : 0) |
           (settings.wireframe ? switchWireframe : 0) | (settings.cube ? switchCube : 0) |
           (withImage ? switchImage : 0) | (tiles ? switchTiles : 0) |
           (tiles && colours.fromClipmap ? switchClipmap : 0) | (settings.sea ? switchSea : 0) |
           (air ? switchAir : 0) | (tinted ? switchTint : 0) |
           (rampSeen && !settings.ramp.empty() ? switchRamp : 0) |
           (withImage && rampSeen ? switchImageOverRamp : 0) | (settings.outlines ? switchOutlines : 0) |
           (settings.skirtPaint != SkirtPaint::AsGround ? switchLoudSkirts : 0) |
           (detail ? switchDetail : 0) | (fineDetail ? switchFineDetail : 0);
}

FrameUniforms frameUniforms(const PlanetShape& shape, const View& view, const Projection& projection,
                            const RenderSettings& settings, const ColoursDrawn& colours) {
    assert(glm::length(settings.sunDirection) > 0 && settings.rampTopM > 0);
    const VertexFrame frame = vertexFrame(shape, view.eyeM);
    const double cubeHalfM = shape.radiusM / std::sqrt(3.0);
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    const bool atmosphere = settings.atmosphere && !settings.cube;

    FrameUniforms uniforms{};
    uniforms.faces = faceUniforms(frame, view, cubeHalfM);
    uniforms.clipFromWorld = projection.clipFromCamera * glm::dmat4(cameraFromWorldRotation(view));
    uniforms.eye = padded(view.eyeM);
    uniforms.sun = padded(glm::normalize(settings.sunDirection));
    uniforms.rayForward = padded(-view.back);
    uniforms.rayRight = padded(tanX * view.right);
    uniforms.rayUp = padded(tanY * view.up);
    uniforms.planet = glm::dvec4(shape.radiusM, shape.quantumM, frame.referenceRadiusM, cubeHalfM);
    uniforms.heights =
        glm::dvec4(shape.baseHeightM, 1 / settings.rampTopM, reliefBoost(shape, view), settings.seaLevelM);
    const double eyeRadiusM = glm::length(view.eyeM);
    uniforms.atmosphere = glm::dvec4(radiusInScaleHeights, radiusInScaleHeights / shape.radiusM, atmosphere,
                                     nearness(shape, eyeRadiusM));
    const double eyeHeight = std::max(eyeRadiusM / shape.radiusM - 1, 0.0) * radiusInScaleHeights;
    uniforms.eyeUp = glm::dvec4(eyeRadiusM > 0 ? view.eyeM / eyeRadiusM : glm::dvec3(1, 0, 0), eyeHeight);
    uniforms.screen = glm::dvec4(2 * tanX / view.widthPx, projection.reversedZ ? 0 : 1, 0, 0);
    uniforms.grid = {frame.referenceStep, shape.chunkCellsLog2, 0, 0};
    setDetail(shape, view, colours, uniforms);
    setRamp(settings, uniforms);
    uniforms.surfacing.z =
        static_cast<float>(settings.seaLevelM - (shape.baseHeightM + frame.referenceStep * shape.quantumM));
    uniforms.surfacing.w = static_cast<float>(settings.light.fill);
    uniforms.colouring = {colours.leafLevel, 0, 0, 0};
    uniforms.colourFilter = glm::dvec4(colours.anisotropy, std::log2(colours.texelsPerPixel), 0, 0);
    return uniforms;
}

}  // namespace planet::gl
