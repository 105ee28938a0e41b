// The uniform block of shaders/frame.glsl, which describes its members. Pure functions, any thread.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "planet/gl/draw/projection.h"
#include "planet/gl/draw/render_settings.h"
#include "planet/gl/draw/shader_switches.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/view.h"

namespace planet::gl {

// Members have std140 offsets, because every vec3 is aligned to 16 bytes.
struct FaceUniforms {
    glm::ivec2 grid;
    glm::vec2 coordinates;
    alignas(16) glm::vec3 roots, direction, originM, cubeOriginM;
};

struct RampUniforms {
    alignas(16) glm::vec3 root;
    float startM, perM;
};

struct alignas(16) TileSampling {
    int leafLevel;
    float anisotropy, extraLevels;
};

// The planet's radius in scale heights of the analytic atmosphere. On Earth a scale height is then 10 km, slightly
// more than the real 8.4 km, so that the rim is visible.
inline constexpr float radiusScaleHeights = 640;

struct ShadingFrame {
    glm::vec3 sun;
    float nearGround;
    glm::vec3 eyeUp;
    float eyeScaleHeights;
    glm::vec3 eyeM;
    float scaleHeightsPerM;
    float eyeGrazing, eyeAir, seaLevelM, earthRadii, perRampTopM, imageStep;
    alignas(16) glm::vec4 coarseDetail, middleDetail, fineDetail;
    float heightStepPxM, imageStepPxM;
    TileSampling colours;
};

struct FrameUniforms {
    std::array<FaceUniforms, faceCount> faces;
    glm::mat4 clipFromWorld;
    ShadingFrame shading;
    alignas(16) glm::vec3 rayForward, rayRight, rayUp;
    float pixelRad, skyDepth;

    float radiusM, referenceRadiusM, cubeHalfM, quantumM;
    int referenceStep;
    float baseHeightM, seaRiseM;
    int chunkCellsLog2;
    float reliefBoost, fill;

    float imageOpacity;

    std::array<RampUniforms, maxRampStops> ramp;
    int rampStopCount;
    float rampColoursSea;

    TileSampling normals;
    float normalRiseM;
};

// The colours of the planet: an image, or streamed tiles.
struct ColoursDrawn {
    int faceSizePx = 0;     // texels along a face at the finest level; 0: no colours
    bool streamed = false;  // the members below describe streamed colours
    int leafLevel = 0;
    double anisotropy = 1;        // of the sampler, >= 1
    double texelsPerPixel = 1;    // TileSettings
    bool fromClipmap = false;     // drawn from the clipmap instead of the tiles
    bool mipmapsInTiles = false;  // TilePool::hasMipmapsInTiles

    bool exist() const { return faceSizePx > 0; }
};

// The tiles of normals.
struct NormalsDrawn {
    int leafLevel = 0;
    double anisotropy = 1;      // of the sampler, >= 1
    double texelsPerPixel = 1;  // TileSettings
    double quantumM = 1;        // of the heights that they were made from
};

// Returns the rotation from world axes to those of an octave of the detail noise, [0, 2]. Each has another, so that the
// ground cuts the noise at odd angles and shows no repeats.
glm::dmat3 detailTurn(int octave);

void setNormals(const PlanetShape& shape, const NormalsDrawn& normals, FrameUniforms& uniforms);

// Returns whether the sea is drawn as water with waves. software: features set to Automatic are off.
bool isSeaSurfaceDrawn(const RenderSettings& settings, bool software);

// Returns the switches that follow from the settings and the distance to the ground, metres. LightByVertex,
// Slide and Morph depend on the chunks and are left out. software: features set to Automatic are off.
Switches switchesFor(const PlanetShape& shape, const View& view, const RenderSettings& settings,
                     const ColoursDrawn& colours, bool tinted, double nearestGroundM, bool software);

FrameUniforms frameUniforms(const PlanetShape& shape, const View& view, const Projection& projection,
                            const RenderSettings& settings, const ColoursDrawn& colours);

}  // namespace planet::gl
