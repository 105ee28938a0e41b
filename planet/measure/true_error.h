// Measures the true error of each drawn chunk, the distance of the drawn surface from the finest data, and
// compares it with the bound of the drawn surface (drawn_bound.h).
//
// Every finest sample under a drawn chunk, a point a at its true height, is compared with the point b of the
// drawn surface at the same place (drawn_surface.h: including morph and stitched edges, without skirts). The
// step from a to b is measured in two ways, both in pixels of the view, with a and b relative to the eye:
//
//   facing  K' |a/|a| - b/|b||: the distance in a view turned to face the sample. It never exceeds
//           |a - b| K' / D, so the bound refers to it and violations are judged by it. Every sample counts,
//           also those behind the camera, outside the picture or hidden by other ground.
//   screen  the distance between the projections of a and b in the flat picture, which stretches towards its
//           corners by up to 1 / cos^2 of the angle there. Only samples that project into the picture, with b
//           in front of the camera, count, even if they are hidden.
//
// The cells beside a stitched edge have no proven bound (drawn_bound.h), so violations whose worst place lies
// there are counted separately.
//
// Heights include the exaggeration of the shape. Every sample is compared, without relying on a δc or an
// extreme of the file. The result does not depend on the number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "planet/paging/finest_heights.h"
#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"

namespace planet {

// A selection with all data for measuring it, independent of the planet's later steps.
struct DrawnSnapshot {
    PlanetShape shape;
    View view;                      // for which the items were selected; pixels are measured in it
    std::vector<DrawItem> items;    // their nodes and slots are meaningless here
    std::vector<HeldChunk> chunks;  // of the items, in the same order
    bool stitched = false;          // edges are drawn with RenderSettings::stitched
    bool isSparse = false;          // some leaves of the planet lie above the deepest level
    ResidentBlocks resident;        // under the chunks
};
DrawnSnapshot snapshotOf(const ChunkTree& tree, std::span<const DrawItem> items, const View& view,
                         bool stitched);

struct ChunkError {
    ChunkId id;
    double epsPx = 0;            // of the chunk's own surface
    double drawnBoundPx = 0;     // of what is drawn, including morph and stitched edges
    double facingPx = 0;         // the largest
    double screenPx = 0;         // the largest; 0 if no sample lies in the picture
    double errorM = 0;           // |a - b| at the sample of facingPx, metres
    double meanPx = 0;           // of facingPx over all samples
    glm::dvec3 worstM{0, 0, 0};  // that sample, metres from the planet's centre
    // The worst place lies in one of the two cells beside an edge that is, or will be, stitched to a coarser
    // chunk.
    bool worstInSeam = false;
    std::uint64_t samples = 0;  // number of compared samples

    bool operator==(const ChunkError&) const = default;
};

// Returns whether the error exceeds the bound by more than the rounding of floats: facing > bound (1 + 1e-4)
// + 1e-3 px.
bool isViolation(const ChunkError& error);

// Returns the unused share of the bound, 1 - facing / bound; 0 if the bound is 0.
double slackOf(const ChunkError& error);

struct TrueErrorReport {
    std::vector<ChunkError> chunks;  // in the snapshot's order
    double worstEpsPx = 0;
    double worstDrawnBoundPx = 0;
    double worstFacingPx = 0;
    double worstScreenPx = 0;
    // The nearest-rank 99th percentile of the chunks' largest errors.
    double p99FacingPx = 0;
    double p99ScreenPx = 0;
    double meanSlack = 0;                 // over the chunks with a bound above 0; at most 1
    std::uint32_t violations = 0;         // chunks
    std::uint32_t violationsInSeams = 0;  // those with their worst sample beside a stitched edge
    std::uint64_t samples = 0;

    bool operator==(const TrueErrorReport&) const = default;
};

// Reports progress: called from one thread at a time, a few times per second. Returning false cancels. The
// numbers are samples of a planet that is as fine everywhere.
using TrueErrorProgress = std::function<bool(std::uint64_t done, std::uint64_t total)>;

// Measures the snapshot. The Error names the file and the chunk that could not be read, or is of kind
// Cancelled.
Result<TrueErrorReport> measureTrueError(const DrawnSnapshot& snapshot, FinestHeights& heights,
                                         const TrueErrorProgress& progress = {});

}  // namespace planet
