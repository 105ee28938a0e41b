// Chooses what to draw: chunked LOD after Ulrich (SIGGRAPH 2002 course).
//
// A chunk with a screen-space error eps = delta_c K' / D over tau is replaced by its four children, once all
// four are resident; until then it is drawn itself and its children are requested. So the drawn chunks cover
// the visible planet once, without holes or overlaps.
//
// A pure function of its arguments: no GL, no I/O, no clock; the same input gives the same answer. Any
// thread.
//
// With hysteresis a split chunk stays split a little longer, so a view has a memory: its last Selection.
//
// Morphing slides a chunk onto its parent's surface before the parent takes its place: morph is 0 while the
// parent's eps is at least tau (1 + range) and 1 when it is tau or less. All four siblings have the same
// morph at that moment, so the switch moves nothing. The range is at most delta_c(parent) / delta_c - 1, less
// with hysteresis, so that a chunk has not begun to slide when its children replace it.
//
// Fading does the same if the view, the tolerance or the disk changes too fast for that: with a memory, a
// chunk's morph moves towards its natural value by at most elapsed time / fadeS per frame. A chunk is
// replaced by its children only once it was drawn with morph 0, and they begin with morph 1; they are
// replaced by it only once all four were drawn with morph 1 or not at all, and it begins with morph 0. Until
// then the switch waits while the morphs slide; the same applies to the morphs of edges. So a switch moves
// nothing, a change over several levels takes fadeS for each, and a chunk that was not in the picture begins
// at its natural value. Two cases still pop. Children that are evicted, or that stitched seams do not allow,
// vanish at once. One edge of a chunk moves if a coarser chunk beside it is split in the frame in which the
// chunk replaces its children, or in which the chunk is split itself and the neighbour's children there are
// culled.
//
// Stitched seams: along an edge whose neighbour is coarser by d levels, the vertex shader moves each vertex
// onto a multiple of 2^d, so both sides have the same vertices; drawn_surface.h describes which, and how they
// move there before the neighbour changes its level. So neighbours must not differ by more than log2(cells) -
// 1 levels; selection draws parents of chunks that would.
#pragma once

#include <limits>

#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Refills the selection, keeping its capacity. It must hold the last selection of this view, whose splits
// hysteresis and fading remember; an empty one has no memory. elapsedS: seconds since that selection, >= 0;
// infinity ends every fade.
void selectChunks(const ChunkTree& tree, const View& lodView, const LodSettings& settings,
                  Selection& selection, double elapsedS = std::numeric_limits<double>::infinity());

}  // namespace planet
