// The view settings with their defaults, in the user's units. Panels edit them; presets, undo and the
// settings file copy them as a whole. app/settings/settings_schema.cpp describes each: name, help, unit and
// range.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "planet/gl/draw/render_settings.h"
#include "planet/paging/disk_simulator.h"
#include "planet/paging/paging_types.h"
#include "planet/select/lod_select.h"
#include "planet/sphere/sun.h"
#include "planet/surface/layer_set.h"
#include "planet/tree/region.h"

namespace worldy {

// The range of tau, pixels.
inline constexpr double smallestTauPx = 0.1;
inline constexpr double largestTauPx = 64;

struct PagingOptions {
    int budgetMB = 256;
    int loaderThreads = 1;
    double uploadLimitMs = 4;
    double colourShare = 0.25;
    double normalShare = 0.2;
    int retries = 4;
    double retryDelayS = 0.25;
    planet::PrefetchSettings prefetch;
    planet::BadDiskSettings badDisk;
    bool simulated = false;

    bool operator==(const PagingOptions&) const = default;
};

// How streamed colours are sampled.
enum class ColourMode : std::uint8_t { Tiles, Clipmap };

enum class ColourBy : std::uint8_t {
    None,
    Level,
    Error,
    DeltaC,
    Morph,
    Age,
    LoadOrder,
    Measured,
    LeafDepth,
    Spacing,
    Source,
    Region,
    Atlas
};
enum class ChunkLabels : std::uint8_t { None, Level, Error, LevelAndError };

// Markings drawn over the planet.
struct OverlaySettings {
    ColourBy colourBy = ColourBy::None;
    double opacity = 0.85;
    double errorScale = 1;
    double deltaTopM = 1000;
    double ageTopS = 10;
    bool outlines = false;
    bool bounds = false;
    bool wireframe = false;
    bool lodSeams = false;  // edges between chunks of different levels
    planet::gl::SkirtPaint skirtPaint = planet::gl::SkirtPaint::AsGround;
    ChunkLabels labels = ChunkLabels::None;
    bool cube = false;
    bool clipmap = false;
    bool regions = true;   // outlines of the planet's regions
    bool sources = false;  // outlines of the layers of the source
    bool notes = true;     // pins of the notes

    bool operator==(const OverlaySettings&) const = default;
};

// Material textures on near ground.
struct LayerSettings {
    planet::gl::FeatureUse use = planet::gl::FeatureUse::Automatic;
    double opacity = 1;
    double beginM = 3000;
    double endM = 60000;
    double colourBelow = 0.4;
    planet::gl::LayerPreview preview = planet::gl::LayerPreview::Off;
    int previewed = 1;  // number of the layer, counted from the lowest, which is 1
    std::string file;   // the set's file, which texture paths are relative to; empty: the built-in textures
    planet::LayerSet set = planet::earthLayers();

    bool operator==(const LayerSettings&) const = default;
};

struct SurfaceSettings {
    planet::gl::SurfaceColour surface = planet::gl::SurfaceColour::Image;
    double imageOpacity = 1;
    bool streamed = true;
    double texelsPerPixel = 1;
    ColourMode colourMode = ColourMode::Tiles;
    int clipmapSizePx = 1024;
    std::vector<planet::gl::RampStop> ramp;  // lowest first; empty: the built-in ramp
    bool sea = true;
    double seaLevelM = 0;
    double exaggeration = 1;
    bool lighting = true;
    bool atmosphere = true;
    planet::gl::FeatureUse detail = planet::gl::FeatureUse::Automatic;
    // The sun stays east of the camera; otherwise its position follows from the date, or is the latitude and
    // longitude below.
    bool sunFollows = true;
    bool sunByDate = false;
    planet::SunDate sunDate;
    double sunLatitudeDeg = 29;
    double sunLongitudeDeg = 31;
    planet::gl::LightDrawing light;
    LayerSettings layers;

    bool operator==(const SurfaceSettings&) const = default;
};

enum class CameraMode : std::uint8_t { Fly, Orbit, FollowFlight };
// How the viewport is shared between the LOD view and the observer, who looks at it from outside.
enum class ObserverMode : std::uint8_t { Off, Split, Alone };

struct CameraSettings {
    double fovDeg = 60;
    CameraMode mode = CameraMode::Fly;
    ObserverMode observer = ObserverMode::Off;
    bool observerOwnLod = false;
    bool showFrustum = true;
    bool showHorizon = true;
    bool showSwitchDistances = false;
    std::string flight;  // the file of the flight that FollowFlight follows

    bool operator==(const CameraSettings&) const = default;
};

// The measurement of cracks.
struct CrackSettings {
    bool live = false;
    int everyFrames = 30;
    bool mark = true;

    bool operator==(const CrackSettings&) const = default;
};

enum class CompareMode : std::uint8_t { SideBySide, Wipe, Difference, Flip };

struct CompareSettings {
    CompareMode mode = CompareMode::SideBySide;
    double gain = 8;
    double wipe = 0.5;
    bool showB = false;

    bool operator==(const CompareSettings&) const = default;
};

// The budgets that the governor keeps by moving τ; 0: off.
struct BudgetSettings {
    double cpuMs = 0;
    double gpuMs = 0;
    int triangles = 0;
    int memoryMB = 0;
    double readMBs = 0;
    double leastTauPx = 0.5;
    double mostTauPx = 16;
    double hysteresis = 0.12;

    bool isOn() const { return cpuMs > 0 || gpuMs > 0 || triangles > 0 || memoryMB > 0 || readMBs > 0; }
    bool operator==(const BudgetSettings&) const = default;
};

// The regions of the planet. They belong to it, and not to the settings that files and presets hold (region_file.h).
struct RegionSettings {
    bool on = true;
    std::shared_ptr<const std::vector<planet::Region>> list{};  // null: none
    std::string file{};  // that they were read from or saved to; empty if there is none

    // Returns those that apply, and all of them.
    std::vector<planet::Region> applied() const { return on && list ? *list : std::vector<planet::Region>{}; }
    std::vector<planet::Region> all() const { return list ? *list : std::vector<planet::Region>{}; }
    bool operator==(const RegionSettings& other) const {
        return on == other.on && file == other.file && (list == other.list || all() == other.all());
    }
};

struct ViewSettings {
    planet::LodSettings lod;
    RegionSettings regions;
    BudgetSettings budget;
    PagingOptions paging;
    OverlaySettings overlay;
    SurfaceSettings surface;
    CameraSettings camera;
    CrackSettings cracks;
    CompareSettings compare;

    bool operator==(const ViewSettings&) const = default;
};

}  // namespace worldy
