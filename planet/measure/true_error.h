// True error: how far what is drawn lies from the finest data, chunk by chunk, beside the bound of what is
// drawn (drawn_bound.h).
//
// Every finest sample under a drawn chunk, at its true height a, is compared with the point b of the drawn
// surface at the same place (drawn_surface.h: morph and stitched edges included, skirts left out). Two
// measures of the step from a to b, both in pixels of the view, with a and b relative to the eye:
//
//   facing  K' |a/|a| - b/|b||: as if the view were turned to face the sample. Never more than |a - b| K' /
//   D,
//           so this is what the bound is of and what a violation is judged by. Every sample counts, also
//           those behind the camera, beside the picture or hidden by other ground.
//   screen  between the projections of a and b into the flat picture, which stretches towards its corners by
//           up to 1 / cos^2 of the angle there. Only samples that project into the picture, with b before the
//           camera, count; hidden ones too.
//
// The cells beside a stitched edge have no proven bound (drawn_bound.h): violations whose worst place lies
// there are told apart.
//
// Heights are drawn as high as the shape says, so exaggeration is counted in. No reliance on a delta_c or an
// extreme of the file: every sample is looked at. The result is the same whatever the number of threads.
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

// A selection with all that measuring it needs: holds while the planet goes on.
struct DrawnSnapshot {
    PlanetShape shape;
    View view;                      // for which they were selected; pixels are counted in it
    std::vector<DrawItem> items;    // their nodes and slots mean nothing here
    std::vector<HeldChunk> chunks;  // of the items, in the same order
    bool stitched = false;          // edges are drawn with RenderSettings::stitched
    ResidentBlocks resident;        // under the chunks
};
DrawnSnapshot snapshotOf(const ChunkTree& tree, std::span<const DrawItem> items, const View& view,
                         bool stitched);

struct ChunkError {
    ChunkId id;
    double epsPx = 0;            // of the chunk's own surface
    double drawnBoundPx = 0;     // of what is drawn
    double facingPx = 0;         // the largest
    double screenPx = 0;         // the largest; 0 where no sample lies in the picture
    double errorM = 0;           // |a - b| where facingPx is largest
    double meanPx = 0;           // of facingPx over all samples
    glm::dvec3 worstM{0, 0, 0};  // a there, metres from the planet's centre
    // Whether it lies in one of the two cells beside an edge that is stitched to a coarser chunk, or about
    // to.
    bool worstInSeam = false;
    std::uint64_t samples = 0;  // compared

    bool operator==(const ChunkError&) const = default;
};

// Returns whether the error is over the bound of what is drawn by more than floats round: facing > bound
// (1 + 1e-4) + 1e-3 px.
bool isViolation(const ChunkError& error);

// The share of the bound that was not needed, 1 - facing / bound; 0 where the bound is 0.
double slackOf(const ChunkError& error);

struct TrueErrorReport {
    std::vector<ChunkError> chunks;  // in the snapshot's order
    double worstEpsPx = 0;
    double worstDrawnBoundPx = 0;
    double worstFacingPx = 0;
    double worstScreenPx = 0;
    // Of chunks, each counting once whatever its size: the nearest-rank 99th percentile of its largest.
    double p99FacingPx = 0;
    double p99ScreenPx = 0;
    double meanSlack = 0;                 // over the chunks with a bound over 0; at most 1
    std::uint32_t violations = 0;         // chunks
    std::uint32_t violationsInSeams = 0;  // of them, those whose worst lies beside a stitched edge
    std::uint64_t samples = 0;

    bool operator==(const TrueErrorReport&) const = default;
};

// Told from time to time, by one thread at a time, how many samples of how many are compared; false cancels.
using TrueErrorProgress = std::function<bool(std::uint64_t done, std::uint64_t total)>;

// The Error names the file and the chunk that could not be read, or is of kind Cancelled.
Result<TrueErrorReport> measureTrueError(const DrawnSnapshot& snapshot, FinestHeights& heights,
                                         const TrueErrorProgress& progress = {});

}  // namespace planet
