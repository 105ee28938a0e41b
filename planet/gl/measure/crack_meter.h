// Counts the pixels of a view that show a crack between drawn chunks, and those that the skirts leave open.
//
// The chunks are drawn three times, in plain tints, with one sample per pixel:
//   closed  with skirts down to an inner shell below all terrain,
//   open    without any,
//   as set  with the skirts that the items have.
// A crack pixel shows a long skirt when closed and what lies behind it when open. A leaking pixel is a crack
// pixel that as set shows neither the same skirt nor anything as near.
//
// Each pass tells whose skirt a pixel shows: a chunk is tinted with its number, and without lighting a tint
// of full opacity passes the shaders exactly. Casting the pixel's position back would have to guess between
// chunks where edges meet.
//
// If both passes show ground, the depth decides. One step of the rasteriser's grid moves the depth of a skirt
// seen nearly edge-on far, even in front of the ground. So such a pixel counts only if the skirt is nearer
// than the ground anywhere within that step (SeenMesh), computed in doubles. A pixel without ground in the
// open pass needs no such check, since every rasteriser decides exactly whether a triangle covers it. So a
// surface without gaps reads 0, and no tolerance is a guess.
//
// Wants the renderer's context current, on its thread. Leaves everything as ChunkRenderer::draw does, and the
// framebuffers and the viewport unchanged; counters and projection are those of the last pass.
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

// Returns how far skirts must hang down to end below everything the tree can draw, metres.
double innerShellDepthM(const ChunkTree& tree);

// Draws the closed and the open pass and returns the crack pixels; no pixel leaks yet. pairs:
// drawnPairs(ground.items). Ignores the skirts of the items. The Error says that the context cannot draw a
// picture of this size.
Result<CrackMap> findCracks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                            std::span<const DrawnPair> pairs, double shellDepthM);

// Draws the pass as set, for the view and items of findCracks, and marks the pixels that leak.
Result<void> findLeaks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground, CrackMap& map);

// Calls findCracks and findLeaks.
Result<CrackMap> measureCracks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                               std::span<const DrawnPair> pairs, double shellDepthM);

}  // namespace planet::gl
