// Counts the pixels of a view that show a crack between drawn chunks, and those that the skirts do not cover.
//
// The chunks are drawn three times, in plain tints, with one sample per pixel:
//   closed  with skirts down to an inner shell below all terrain,
//   open    without skirts,
//   as set  with the skirts of the items.
// A crack pixel shows a long skirt in the closed pass and what lies behind it in the open pass. A leaking
// pixel is a crack pixel that in the as-set pass shows neither the same skirt nor anything as near.
//
// Each pass identifies the chunk whose skirt a pixel shows, because the tint encodes the chunk's index, and
// without lighting an opaque tint passes through the shaders exactly. Unprojecting the pixel would have to
// guess between chunks where edges meet.
//
// If both passes show ground, the depth decides. One step of the rasteriser's subpixel grid can change the
// depth of a skirt seen nearly edge-on by a large amount, even to in front of the ground. So such a pixel
// counts only if the skirt is nearer than the ground everywhere within that step (SeenMesh, in doubles). A
// pixel without ground in the open pass needs no such check, because every rasteriser decides coverage
// exactly. So a surface without gaps has no crack pixels, and no tolerance is a guess.
//
// Requires the renderer's context to be current, on its thread. Leaves the state as ChunkRenderer::draw does,
// and restores the framebuffers and the viewport; counters and projection are those of the last pass.
#pragma once

#include <cstdint>
#include <vector>

#include "planet/gl/draw/chunk_renderer.h"
#include "planet/measure/crack_spots.h"
#include "planet/measure/edge_gaps.h"

namespace planet::gl {

struct CrackMap {
    int widthPx = 0;
    int heightPx = 0;
    std::vector<CrackPixel> pixels;  // all crack pixels, rows from the top
    int leaking = 0;                 // pixels that leak
};

// Returns the skirt depth that reaches below everything the tree can draw, metres.
double innerShellDepthM(const ChunkTree& tree);

// Draws the closed and the open pass and returns the crack pixels, none of them marked as leaking. pairs:
// drawnPairs(ground.items). Ignores the skirts of the items. The Error says that the context cannot draw a
// picture of this size.
Result<CrackMap> findCracks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                            std::span<const DrawnPair> pairs, double shellDepthM);

// Draws the as-set pass, for the view and items of findCracks, and marks the pixels that leak.
Result<void> findLeaks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground, CrackMap& map);

// Calls findCracks and findLeaks.
Result<CrackMap> measureCracks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                               std::span<const DrawnPair> pairs, double shellDepthM);

}  // namespace planet::gl
