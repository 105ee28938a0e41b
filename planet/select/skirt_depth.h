// The automatic skirt depth (LodSettings::skirtDepth), for selection and for meters. Pure functions, any
// thread.
#pragma once

#include "planet/select/lod_types.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Returns an upper bound of the gap between two drawn neighbours along their edge, metres: the sum of their
// errors there, by the metric, with the morph of each edge. Of two chunks of one level, either may be the
// finer; both have the same morph. Both must be nodes of the tree.
//
// Both errors must be distances from the same data: the finest samples on the edge. In a dense planet both
// sides have all of these. In a sparse one, the coarser chunk's own side may have fewer, because its leaves
// are coarser; its error may even be 0. So the error of its edge is taken from the other side: it is that of
// the finer chunk's ancestor of its level. This ancestor is resident, has the same vertices on the edge,
// because a height depends only on its place, and so the same edge; and its error bounds the distance of that
// edge from the finest samples on its side. The same holds for the parents of both, onto which they morph.
float mostApartM(const ChunkTree& tree, ErrorMetric metric, const DrawItem& finer, Edge finerEdge,
                 const DrawItem& coarser, Edge coarserEdge);

// Returns that ancestor, or the finer node itself if it has the level.
NodeIndex ancestorAt(const ChunkTree& tree, NodeIndex finer, int level);

// Returns the smallest automatic depth, metres, because even equal edges part by the rounding of heights and
// pixels.
float leastSkirtDepthM(const ChunkTree& tree, const DrawItem& item);

// Returns the depth of a chunk's skirt, metres. apartM: upper bound of the gap to its neighbours. Both sides
// of an edge have a skirt that covers both errors, so the skirt of the higher side extends below the other.
// factor: LodSettings::skirtFactor, >= 0; 0: no skirt.
float automaticSkirtDepthM(const ChunkTree& tree, const DrawItem& item, float apartM, double factor);

}  // namespace planet
