// Counts the pixels of a view that show a crack between drawn chunks, and those that the skirts leave open.
//
// The chunks are drawn without colour to speak of, one sample a pixel, three times:
//   closed  with skirts down to an inner shell below all terrain,
//   open    without any,
//   as set  with the skirts that the items have.
// A crack pixel shows a long skirt when closed and what lies behind it when open. A leaking pixel is a crack
// pixel that as set shows neither the same skirt nor anything as near.
//
// Whose skirt it is each pass says itself: a chunk is tinted with its number, and a tint of full strength
// without lighting comes through the shaders to the last bit. Casting the pixel's position back would have to
// guess between chunks where edges meet.
//
// Where there is ground in both passes the depth decides, and a skirt that is seen nearly edge-on has a depth
// that a step of the rasteriser's grid throws far off, in front of the ground too. So such a pixel counts
// only if the skirt stands before the ground wherever within that step (SeenMesh) the two are looked at,
// worked out in doubles. Whether a triangle covers a pixel at all is exact in any rasteriser, so nothing is
// asked where the open pass shows no ground. A surface without gaps thus reads 0, and no tolerance is a
// guess.
//
// Wants the renderer's context current, on its thread. Everything is as ChunkRenderer::draw leaves it, and
// the framebuffers and the viewport are as before; counters and projection are those of the last pass.
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
    int leaking = 0;                 // of them
};

// How far skirts have to hang down to end below everything the tree can draw, metres.
double innerShellDepthM(const ChunkTree& tree);

// The closed and the open pass: crack pixels, none of which leaks yet. pairs: drawnPairs(ground.items). The
// skirts of the items are not looked at. The Error says that the context cannot draw a picture of this size.
Result<CrackMap> findCracks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                            std::span<const DrawnPair> pairs, double shellDepthM);

// The pass as set, for the same view and items as the cracks were found for: marks the pixels that leak.
Result<void> findLeaks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground, CrackMap& map);

// Both.
Result<CrackMap> measureCracks(ChunkRenderer& renderer, const View& view, const DrawnGround& ground,
                               std::span<const DrawnPair> pairs, double shellDepthM);

// 1 at each such pixel, 0 elsewhere; row 0 at the top.
std::vector<std::uint8_t> crackMask(const CrackMap& map);
std::vector<std::uint8_t> leakMask(const CrackMap& map);

}  // namespace planet::gl
