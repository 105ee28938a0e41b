// Chooses what to draw: chunked LOD after Ulrich (SIGGRAPH 2002 course).
//
// A chunk whose screen-space error ε = δc K' / D exceeds τ is replaced by its four children, once all four
// are resident. Until then it is drawn itself and its children are requested. So the drawn chunks cover the
// visible planet exactly once, without holes or overlaps.
//
// The planet's regions (region.h) change τ, limit levels and choose the metric of each node (ChunkNode::demand). Demands
// never grow stricter from parent to child, just as δc never grows, so all that is said here of τ holds for τ times the
// node's factor. A chunk below a region's least level counts as one whose ε exceeds any τ.
//
// A pure function of its arguments, without GL, I/O or a clock: the same input gives the same result. Any
// thread.
//
// With hysteresis, a split chunk stays split a little longer, so a view has a memory: its last Selection.
//
// Morphing slides a chunk onto its parent's surface before the parent replaces it: morph is 0 while the
// parent's ε is at least τ (1 + range), and 1 when it is at most τ. All four siblings have the same morph
// then, so the switch moves nothing. The range is at most δc(parent) / δc - 1, less with hysteresis, so that
// a chunk has not begun to slide when its children replace it.
//
// Fading does the same if the view, the tolerance or the disk changes too fast for morphing. With a memory, a
// chunk's morph approaches its natural value by at most elapsed time / fadeS per frame. Children replace a
// chunk only after it was drawn with morph 0, and they start with morph 1. It replaces them only after all
// four were drawn with morph 1 or not at all, and it starts with morph 0. Until then the switch waits while
// the morphs slide. The same applies to the morphs of edges. So a switch moves nothing, a change over several
// levels takes fadeS per level, and a chunk that was not in the picture starts at its natural value.
//
// Two cases still pop. Children that are evicted, or that stitched seams do not allow, vanish at once. One
// edge of a chunk moves if a coarser neighbour is split in the frame in which the chunk replaces its
// children, or in which the chunk itself is split and the neighbour's children there are culled.
//
// Stitched seams: along an edge whose neighbour is coarser by d levels, the vertex shader moves each vertex
// onto a multiple of 2^d, so that both sides have the same vertices. drawn_surface.h describes which
// vertices, and how they move there before the neighbour changes its level. So neighbours must not differ by
// more than log2(cells) - 1 levels; where they would, selection draws the finer chunk's ancestor.
#pragma once

#include <limits>

#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Refills the selection, keeping its capacity. It must hold the last selection of this view, whose splits
// hysteresis and fading use; an empty one has no memory. elapsedS: seconds since that selection, >= 0;
// infinity completes every fade.
void selectChunks(const ChunkTree& tree, const View& lodView, const LodSettings& settings,
                  Selection& selection, double elapsedS = std::numeric_limits<double>::infinity());

}  // namespace planet
