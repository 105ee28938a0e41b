// Settings for drawing the atmosphere, the sea, shadows and normals, which a renderer gets per frame.
#pragma once

#include <cstddef>

#include "planet/surface/atmosphere.h"
#include "planet/surface/feature_use.h"

namespace planet::gl {

// The physical atmosphere. Off: the analytic atmosphere (shaders/atmosphere.glsl).
struct AirDrawing {
    FeatureUse use = FeatureUse::Automatic;
    AirSettings settings;
    double exposure = 1;  // factor on all light; at 1, daylit ground is as bright as in the
                          // analytic atmosphere; [0.1, 10]
    int steps = 32;       // along a ray through all the air; fewer: faster, rough at dusk; [8, 64]

    bool operator==(const AirDrawing&) const = default;
};

// The sea's surface: sky and sun reflected on waves, and the water's colour by depth. Off: flat colours by
// depth.
struct SeaDrawing {
    FeatureUse use = FeatureUse::Automatic;
    double windMps = 4;    // wind speed; rougher waves spread the sun's glint; [0, 30]
    double clarityM = 12;  // depth that absorbs all but 1/e of green light, metres; [0.5, 100]
    double waves = 1;      // strength of the individually visible waves; [0, 2]

    bool operator==(const SeaDrawing&) const = default;
};

// The shadows of the ground on itself.
struct ShadowDrawing {
    FeatureUse use = FeatureUse::Automatic;
    int mapSizePx = 2048;    // side of each cascade's square map; larger: sharper; [256, 8192]
    double reachM = 200000;  // from the eye, metres; larger: farther, and coarser everywhere; [1000, 1e7]
    double softness = 1.5;   // radius of the filter, texels; [0, 4]

    bool operator==(const ShadowDrawing&) const = default;
};

// Normals finer than the mesh.
struct NormalDrawing {
    FeatureUse use = FeatureUse::Automatic;
    double texelsPerPixel = 1;  // as for streamed colours; [0.1, 4]

    bool operator==(const NormalDrawing&) const = default;
};

// The cost of the physical atmosphere's tables.
struct AirFigures {
    double tablesMs = 0;         // time to make the current ones; 0: none yet
    std::size_t tableBytes = 0;  // on the GPU
    bool working = false;        // new ones are being made
};

struct LightDrawing {
    AirDrawing air;
    SeaDrawing sea;
    ShadowDrawing shadows;
    NormalDrawing normals;
    // Strength of a debug light from the view's upper left on ground where the sun is down: 0 is none, 1 is
    // about as bright as day; [0, 1].
    double fill = 0;

    bool operator==(const LightDrawing&) const = default;
};

}  // namespace planet::gl
