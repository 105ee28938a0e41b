// What the shaders are told once a frame, in the layout of the uniform block in shaders/frame.glsl.
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "planet/gl/draw/projection.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/view.h"

namespace planet::gl {

// What a program is compiled for, as in shaders/frame.glsl.
enum Switch : int {
    switchLighting = 1,
    switchWireframe = 2,
    switchCube = 4,
    switchImage = 8,
    switchSea = 16,
    switchAir = 32,
    switchTint = 64,
    switchLightByVertex = 128,
    switchDetail = 256,
    switchFineDetail = 512,
    switchRamp = 1024,
    switchImageOverRamp = 2048,
    switchOutlines = 4096,
    switchLoudSkirts = 8192,
    switchSlide = 16384,
    switchMorph = 32768,
    switchGather = 65536,
    switchTiles = 131072,
    switchPhysicalAir = 262144,
    switchSeaSurface = 524288,
    switchShadows = 1048576,
    switchNormalTiles = 2097152,
    switchLayers = 16777216,
    switchLayerPreview = 33554432,
    switchClipmap = 1073741824
};

// std140: only members of 16 bytes, so that C++ and GLSL agree without padding.
struct FaceUniforms {
    glm::ivec4 grid;
    glm::vec4 coordinates, roots, direction, origin, cubeOrigin, normal, u, v;
};

struct FrameUniforms {
    std::array<FaceUniforms, faceCount> faces;
    glm::mat4 clipFromWorld;
    glm::vec4 eye, sun, rayForward, rayRight, rayUp, planet, heights, atmosphere, eyeUp, screen;
    std::array<glm::vec4, 9> detailRows;
    glm::vec4 detailSizes, detailPixels;
    glm::ivec4 grid;
    glm::vec4 surfacing;
    std::array<glm::vec4, maxRampStops> rampColours, rampRises;
    glm::ivec4 colouring;
    glm::vec4 colourFilter;
    glm::ivec4 normalLevels;
    glm::vec4 normalFilter;
};
static_assert(sizeof(FaceUniforms) == 9 * 16 &&
              sizeof(FrameUniforms) == (6 * 9 + 4 + 10 + 9 + 2 + 1 + 1 + 64 + 2 + 2) * 16);

// The colours that lie over the planet: an image, or streamed tiles.
struct ColoursDrawn {
    int faceSizePx = 0;     // texels along a face, at the finest; 0: there are none
    bool streamed = false;  // what follows is of streamed ones
    int leafLevel = 0;
    double anisotropy = 1;      // of the sampler, >= 1
    double texelsPerPixel = 1;  // TileSettings
    bool fromClipmap = false;   // instead of the tiles themselves

    bool exist() const { return faceSizePx > 0; }
};

// Tiles of normals that there are.
struct NormalsDrawn {
    int leafLevel = 0;
    double anisotropy = 1;      // of the sampler, >= 1
    double texelsPerPixel = 1;  // TileSettings
    double quantumM = 1;        // of the heights that they are of
};

void setNormals(const PlanetShape& shape, const NormalsDrawn& normals, FrameUniforms& uniforms);

// Water with waves, not the bed's ground in its colour. software: what is Automatic is left off.
bool isSeaSurfaceDrawn(const RenderSettings& settings, bool software);

// The switches that follow from the settings and how near the ground is, metres. LightByVertex, Slide
// and Morph follow from the chunks, and are left off. software: what is Automatic is left off too.
int switchesFor(const PlanetShape& shape, const View& view, const RenderSettings& settings,
                const ColoursDrawn& colours, bool tinted, double nearestGroundM, bool software);

FrameUniforms frameUniforms(const PlanetShape& shape, const View& view, const Projection& projection,
                            const RenderSettings& settings, const ColoursDrawn& colours);

}  // namespace planet::gl
