// How light is drawn: what a renderer is told of the air, the sea, shadows and normals, frame by frame.
#pragma once

#include <cstddef>

#include "planet/surface/atmosphere.h"
#include "planet/surface/feature_use.h"

namespace planet::gl {

// The physical atmosphere. Not used: the thin one in closed form (shaders/atmosphere.glsl).
struct AirDrawing {
    FeatureUse use = FeatureUse::Automatic;
    AirSettings settings;
    double exposure = 1;  // of all light, over that with which ground by day is as bright as in the thin air;
                          // [0.1, 10]
    int steps = 32;       // along a ray through all of the air; fewer: cheaper, and rough at dusk; [8, 64]

    bool operator==(const AirDrawing&) const = default;
};

// The sea's surface: mirrored sky and sun on waves, and the water's colour by the depth below it.
// Not used: flat colours by depth.
struct SeaDrawing {
    FeatureUse use = FeatureUse::Automatic;
    double windMps = 4;    // rougher waves spread the sun's glint; [0, 30]
    double clarityM = 12;  // depth that takes away all but 1 / e of green light, metres; [0.5, 100]
    double waves = 1;      // strength of the waves that are seen one by one; [0, 2]

    bool operator==(const SeaDrawing&) const = default;
};

// The ground's shadows on itself.
struct ShadowDrawing {
    FeatureUse use = FeatureUse::Automatic;
    int mapSizePx = 2048;    // of each cascade's square map; larger: sharper; [256, 8192]
    double reachM = 200000;  // from the eye, metres; larger: farther, and coarser everywhere; [1000, 1e7]
    double softness = 1.5;   // radius of the filter, texels; [0, 4]

    bool operator==(const ShadowDrawing&) const = default;
};

// Normals finer than the mesh.
struct NormalDrawing {
    FeatureUse use = FeatureUse::Automatic;
    double texelsPerPixel = 1;  // as of streamed colours; [0.1, 4]

    bool operator==(const NormalDrawing&) const = default;
};

// What the physical atmosphere's tables cost.
struct AirFigures {
    double tablesMs = 0;         // that those in use took to make; 0: there are none yet
    std::size_t tableBytes = 0;  // on the GPU
    bool working = false;        // others are being made
};

struct LightDrawing {
    AirDrawing air;
    SeaDrawing sea;
    ShadowDrawing shadows;
    NormalDrawing normals;
    // Strength of a debug light on ground where the sun is down, from the upper left of the view; 0: none, 1:
    // about as bright as day; [0, 1].
    double fill = 0;

    bool operator==(const LightDrawing&) const = default;
};

}  // namespace planet::gl
