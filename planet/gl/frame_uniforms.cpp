#include "planet/gl/frame_uniforms.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "planet/gl/chunk_renderer.h"
#include "planet/gl/colour_image.h"
#include "planet/vertex_position.h"

namespace planet::gl {

namespace {

// As in shaders/frame.glsl.
constexpr int switchLighting = 1;
constexpr int switchWireframe = 2;
constexpr int switchCube = 4;
constexpr int switchImage = 8;
constexpr int switchSea = 16;
constexpr int switchDetail = 32;

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

int switchBits(const RenderSettings& settings, bool hasImage) {
    const bool image = hasImage && settings.surface == SurfaceColour::Image;
    return (settings.lighting ? switchLighting : 0) | (settings.wireframe ? switchWireframe : 0) |
           (settings.cube ? switchCube : 0) | (image ? switchImage : 0) | (settings.sea ? switchSea : 0) |
           (settings.detail && settings.lighting && settings.colourBy == ColourBy::None ? switchDetail : 0);
}

}  // namespace

FrameUniforms frameUniforms(const PlanetShape& shape, const View& view, const Projection& projection,
                            const RenderSettings& settings, const ColourImage& image) {
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
    uniforms.heights = glm::dvec4(shape.baseHeightM, 1 / settings.rampTopM, reliefBoost(shape, view),
                                  2 * image.anisotropy());
    uniforms.atmosphere =
        glm::dvec4(radiusInScaleHeights, radiusInScaleHeights / shape.radiusM, atmosphere, 0);
    uniforms.screen = glm::dvec4(2 * tanX / view.widthPx, projection.reversedZ ? 0 : 1, 0, 0);
    uniforms.grid = {frame.referenceStep, shape.chunkCellsLog2, fineGridLog2 - shape.faceCellsLog2, 0};
    uniforms.switches = {switchBits(settings, image.exists()), 0, 0, 0};
    return uniforms;
}

}  // namespace planet::gl
