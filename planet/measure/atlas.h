// An atlas: a survey of a whole planet, of what a viewer would see and pay at each place, altitude and heading. Plain
// data. ATLAS.md beside this file says how it is sampled and what its file holds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planet/sphere/chunk_id.h"
#include "planet/sphere/view.h"

namespace planet {

enum class AtlasMeasure : std::uint8_t {
    MeasuredPx,
    EpsPx,
    DrawnBoundPx,
    Triangles,
    BytesRead,
    SharpS,
    PopPx,
    Thrashes
};
inline constexpr std::size_t atlasMeasureCount = 8;

struct AtlasMeasureText {
    std::string_view key;   // "measured_px"
    std::string_view name;  // "Measured error"
    std::string_view unit;  // "px"; empty for counts
    std::string_view meaning;
};
inline constexpr std::array<AtlasMeasureText, atlasMeasureCount> atlasMeasureTexts = {{
    {"measured_px", "Measured error", "px",
     "Largest distance of the drawn surface from the finest data, as if the view faced it."},
    {"eps_px", "Screen-space error \u03b5", "px",
     "Largest predicted error of a drawn chunk's own surface. There is no bound where \u03b4c is at least "
     "the "
     "distance to the chunk's bounds, as where the eye is inside them."},
    {"drawn_bound_px", "Drawn bound", "px", "Largest bound of the error of what is drawn, with its morph."},
    {"triangles", "Triangles", "", "Drawn triangles, skirts included."},
    {"bytes_read", "Bytes read", "B",
     "Bytes read until the view is sharp, from the roots alone. They are not known of a view that is not "
     "sharp within an "
     "hour."},
    {"sharp_s", "Time until sharp", "s",
     "Time of the simulated disk until everything that the view wants is there, from the roots alone. It is "
     "not known "
     "of a view that is not sharp within an hour."},
    {"pop_px", "Largest pop", "px", "Largest jump of the surface at a level change of the standard move."},
    {"thrashes", "Thrashes", "",
     "Level changes of the standard move that undo another one less than 1 s before."},
}};
constexpr const AtlasMeasureText& textOf(AtlasMeasure measure) {
    return atlasMeasureTexts[static_cast<std::size_t>(measure)];
}

// A view that is not sharp after this time of the simulated disk is measured as it is then, in seconds.
inline constexpr double atlasTimeoutS = 3600;

// One value of each measure, >= 0; NaN for what was not measured. SharpS and BytesRead are NaN for a view that was not
// sharp within atlasTimeoutS. EpsPx and DrawnBoundPx are infinite where there is no
// bound (atlasBoundPx).
using AtlasFigures = std::array<double, atlasMeasureCount>;
inline double figureOf(const AtlasFigures& figures, AtlasMeasure measure) {
    return figures[static_cast<std::size_t>(measure)];
}

// Returns a predicted error or a drawn bound, pixels; infinity from K' = W / (2 tan(Hfov / 2)) on. There δ is at least the
// distance from the eye to the bounds of the chunk, which is 0 within them. So the true surface may be at the eye, and no
// number of pixels bounds its error.
double atlasBoundPx(double px, double screenScalePx);
constexpr bool mayLackBound(AtlasMeasure measure) {
    return measure == AtlasMeasure::EpsPx || measure == AtlasMeasure::DrawnBoundPx;
}

inline constexpr std::size_t mostAtlasAltitudes = 16;
inline constexpr int mostAtlasHeadings = 36;
inline constexpr std::size_t mostAtlasViewpoints = 1'000'000;
inline constexpr int finestAtlasLevel = 14;
inline constexpr std::size_t atlasBatch = 32;  // most viewpoints that are recorded together

// How viewpoints are chosen (atlas_sampling.h).
struct AtlasGrid {
    std::vector<double> altitudesM{200, 5000, 50'000};  // above the ground or a drawn sea, > 0, ascending
    int headings = 4;           // [1, mostAtlasHeadings], evenly spread, the first one north
    double pitchDeg = -10;      // of the views, from the horizon of the bare sphere; [-90, 0]
    int coarsestLevel = 2;      // the level of the first cells, [0, finestAtlasLevel]
    int finestLevel = 10;       // cells of this level are not split, [coarsestLevel, finestAtlasLevel]
    std::uint64_t most = 5000;  // viewpoints, [6, mostAtlasViewpoints]

    bool operator==(const AtlasGrid&) const = default;
};

// A place to survey from: above the middle of a square cell of a cube face.
struct AtlasPlace {
    ChunkId cell;
    std::uint8_t altitude = 0;  // index of AtlasGrid::altitudesM
    std::uint8_t heading = 0;   // [0, AtlasGrid::headings)

    auto operator<=>(const AtlasPlace&) const = default;
};

struct AtlasViewpoint {
    AtlasPlace place;
    double eyeM = 0;  // altitude of the eye above the planet's radius, metres
    AtlasFigures figures{};
};

// Says which planet was surveyed and with which settings. Two surveys may be joined only if these are equal.
struct AtlasSurvey {
    std::string bake;            // the name of the chunk file, for users
    std::uint64_t bakeHash = 0;  // of its header and its root blocks
    double radiusM = 0;
    std::string settings;  // all settings of the view, as text that the program can read
    std::string regions;   // the regions of the planet, as such a text; empty without any
    int widthPx = 1280;    // [16, 16384]
    int heightPx = 720;
    double fovDeg = 60;          // horizontal, (0, 180)
    bool measuresError = false;  // MeasuredPx is measured
    // The viewpoints are those of another atlas, in its order, and are not chosen by the grid.
    bool isRevisit = false;
    AtlasGrid grid;

    bool operator==(const AtlasSurvey&) const = default;
};

// A chunk of a surveyed planet, to find what a later bake has changed.
struct AtlasChunk {
    float deltaCM = 0;         // metres, without exaggeration
    std::uint32_t digest = 0;  // of its error, extremes and heights; of all chunks below it too if summarised
    bool hasChildren = false;  // that are listed
    bool isSummary = false;    // it has children that are not listed
};

// The chunks of all six faces, each before its children and each quarter completely before the next; empty if they were
// not recorded.
struct AtlasTree {
    std::vector<AtlasChunk> chunks;
};

struct Atlas {
    AtlasSurvey survey;
    AtlasTree tree;
    std::vector<AtlasViewpoint> viewpoints;  // in the order of the survey
    bool isFinished = false;
};

// Returns K' of the views, pixels.
double screenScalePx(const AtlasSurvey& survey);
// Returns the pose of a viewpoint: longitude in [-180, 180].
CameraPose poseOf(const AtlasSurvey& survey, const AtlasViewpoint& viewpoint);
// Returns the direction of the middle of a cell, of length 1.
glm::dvec3 middleOf(const ChunkId& cell);

}  // namespace planet
