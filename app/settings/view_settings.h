// What the panels edit, in the user's units. Plain values: presets, undo and the settings file copy them
// whole. Ranges are those of the table in app/settings/settings_table.cpp.
#pragma once

#include <string>
#include <vector>

#include "planet/gl/draw/render_settings.h"
#include "planet/paging/disk_simulator.h"
#include "planet/select/lod_select.h"
#include "planet/sphere/sun.h"
#include "planet/surface/layer_set.h"

namespace worldy {

// The range of tau, pixels.
inline constexpr double smallestTauPx = 0.1;
inline constexpr double largestTauPx = 64;

struct LodKnobs {
    double tauPx = 2;            // tolerance on screen, pixels, [0.1, 64]
    double hysteresis = 0.1;     // share of tau by which a merge comes later than the split, [0, 0.9]
    int maxLevel = 20;           // deepest level drawn, [0, 20]
    bool morph = true;           // slides chunks onto their parents before they merge
    double morphRange = 0.3;     // share of tau over which they do, [0.01, 4]
    bool frustumCulling = true;  // leaves out what lies beside and behind the view
    bool horizonCulling = true;  // leaves out what the planet itself hides
    planet::ErrorMetric metric = planet::ErrorMetric::Additive;
    double fadeS = 0.25;  // seconds in which a chunk slides all the way at most, [0, 10]; 0: pops

    bool operator==(const LodKnobs&) const = default;
};

struct SeamKnobs {
    planet::SeamMode mode = planet::SeamMode::Skirts;
    planet::SkirtDepth depth = planet::SkirtDepth::Automatic;
    double skirtFactor = 1;     // of Automatic: depth in units of the errors it has to hide, [0, 10]
    double skirtDepthM = 1000;  // of Fixed, metres, [0, 100000]
    bool showPairs = false;     // marks the edges between chunks of different levels in the viewport

    bool operator==(const SeamKnobs&) const = default;
};

struct PagingKnobs {
    int budgetMB = 256;         // memory for resident chunks, CPU and GPU together, MiB, [16, 65536]
    int loaderThreads = 1;      // threads that read chunks, [1, 64]
    double uploadLimitMs = 4;   // time a frame spent on loaded chunks, ms, [0.1, 100]
    double colourShare = 0.25;  // of the budget, for streamed colours where there are any, [0.01, 0.9]
    double normalShare = 0.2;   // of what they leave of it, for tiles of normals where drawn, [0.01, 0.9]
    int retries = 4;            // of a read that failed, [0, 10]
    double retryDelayS = 0.25;  // before the first of them, s, [0, 60]; twice as long before each further
    planet::BadDiskSettings badDisk;
    bool simulated = false;  // reads end by the bad disk and its seed in the time of frames, not by the clock

    bool operator==(const PagingKnobs&) const = default;
};

// What streamed colours are drawn from.
enum class ColourMode : std::uint8_t { Tiles, Clipmap };

enum class ColourBy : std::uint8_t { None, Level, Error, DeltaC, Morph, Age, LoadOrder, Measured };
enum class ChunkLabels : std::uint8_t { None, Level, Error, LevelAndError };

// Over the planet's picture.
struct OverlaySettings {
    ColourBy colourBy = ColourBy::None;
    double opacity = 0.85;    // of the tint, [0, 1]
    double errorScale = 1;    // eps / tau that is drawn yellow, [0.01, 100]
    double deltaTopM = 1000;  // the scale's top for delta_c, metres, [0.01, 100000]; logarithmic
    double ageTopS = 10;      // for the age, seconds, [0.1, 3600]
    bool outlines = false;    // of the chunks
    bool bounds = false;      // bounding volumes
    bool wireframe = false;   // the mesh
    planet::gl::SkirtPaint skirtPaint = planet::gl::SkirtPaint::AsGround;
    ChunkLabels labels = ChunkLabels::None;
    bool cube = false;     // draws the cube before it is blown up
    bool clipmap = false;  // windows of the clipmap of colours, and what was filled of them lately

    bool operator==(const OverlaySettings&) const = default;
};

// Materials painted on near ground.
struct LayerSettings {
    planet::gl::FeatureUse use = planet::gl::FeatureUse::Automatic;
    double opacity = 1;        // over the image or ramp, [0, 1]
    double beginM = 3000;      // metres from the eye where they begin to give way to it, [0, 1e7]
    double endM = 60000;       // and where nothing is left of them, [1, 1e7]
    double colourBelow = 0.4;  // how much of its colour goes through them, [0, 1]
    planet::gl::LayerPreview preview = planet::gl::LayerPreview::Off;
    int previewed = 1;  // whose weight, counted from the lowest, [1, 8]
    std::string file;   // of the set, beside which its textures lie; empty: those that come with Worldy
    planet::LayerSet set = planet::earthLayers();

    bool operator==(const LayerSettings&) const = default;
};

struct SurfaceSettings {
    planet::gl::SurfaceColour surface = planet::gl::SurfaceColour::Image;
    double imageOpacity = 1;    // of the colour image over the ramp, [0, 1]
    bool streamed = true;       // the file's own colours instead of an image, where it has them
    double texelsPerPixel = 1;  // of streamed colours, [0.1, 4]
    ColourMode colourMode = ColourMode::Tiles;
    int clipmapSizePx = 1024;                // of its windows, texels a side, a power of two, [256, 4096]
    std::vector<planet::gl::RampStop> ramp;  // lowest first; empty: the built-in ramp
    bool sea = true;
    double seaLevelM = 0;     // [-20000, 20000]
    double exaggeration = 1;  // heights are drawn this many times as high, [0.1, 100]
    bool lighting = true;     // off: flat colour
    bool atmosphere = true;
    bool detail = true;      // roughens the ground between the samples; invented, only for the eye
    bool sunFollows = true;  // the sun keeps to the camera's east, so that it is always day there
    bool sunByDate = false;  // else: it stands as at a moment over the Earth,
    planet::SunDate sunDate;
    double sunLatitudeDeg = 29;   // or where it is placed in the zenith, [-90, 90]
    double sunLongitudeDeg = 31;  // [-180, 180]
    planet::gl::LightDrawing light;
    LayerSettings layers;

    bool operator==(const SurfaceSettings&) const = default;
};

enum class CameraMode : std::uint8_t { Fly, Orbit, FollowFlight };
// How the viewport is shared between the lod view and the observer, who looks at it from outside.
enum class ObserverMode : std::uint8_t { Off, Split, Alone };

struct CameraSettings {
    double fovDeg = 60;  // horizontal field of view, degrees, [5, 150]
    CameraMode mode = CameraMode::Fly;
    ObserverMode observer = ObserverMode::Off;
    bool observerOwnLod = false;       // the observer draws what it would choose itself, as a second view
    bool showFrustum = true;           // in the observer's picture: the lod view's frustum,
    bool showHorizon = true;           // its horizon,
    bool showSwitchDistances = false;  // and how far d_m of the chunk that is selected reaches
    std::string flight;                // of FollowFlight: a flight's file

    bool operator==(const CameraSettings&) const = default;
};

// The cracks instrument.
struct CrackKnobs {
    bool live = false;     // measures again and again
    int everyFrames = 30;  // then: frames from one measurement to the next, [1, 1000]
    bool mark = true;      // shows the crack pixels in the viewport

    bool operator==(const CrackKnobs&) const = default;
};

// How two pictures are shown while comparing.
enum class CompareMode : std::uint8_t { SideBySide, Wipe, Difference, Flip };

struct CompareKnobs {
    CompareMode mode = CompareMode::SideBySide;
    double gain = 8;     // of the difference, [1, 255]
    double wipe = 0.5;   // where the divider stands, share of the width, [0, 1]
    bool showB = false;  // of Flip

    bool operator==(const CompareKnobs&) const = default;
};

struct ViewSettings {
    LodKnobs lod;
    SeamKnobs seams;
    PagingKnobs paging;
    OverlaySettings overlay;
    SurfaceSettings surface;
    CameraSettings camera;
    CrackKnobs cracks;
    CompareKnobs compare;

    bool operator==(const ViewSettings&) const = default;
};

}  // namespace worldy
