// The automatic skirt depth (LodSettings::skirtDepth), for selection and for meters. Pure functions, any
// thread.
#pragma once

#include "planet/select/lod_types.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Returns an upper bound of the gap between two drawn neighbours along their edge, metres: the sum of their
// errors there, by the metric, with the morph of each edge. Of two chunks of one level, either may be the
// finer; both have the same morph. Both must be nodes of the tree.
float mostApartM(const ChunkTree& tree, ErrorMetric metric, const DrawItem& finer, Edge finerEdge,
                 const DrawItem& coarser, Edge coarserEdge);

// Returns the smallest automatic depth, metres, because even equal edges part by the rounding of heights and
// pixels.
float leastSkirtDepthM(const ChunkTree& tree, const DrawItem& item);

// Returns the depth of a chunk's skirt, metres. apartM: upper bound of the gap to its neighbours. Both sides
// of an edge have a skirt that covers both errors, so the skirt of the higher side extends below the other.
// factor: LodSettings::skirtFactor, >= 0; 0: no skirt.
float automaticSkirtDepthM(const ChunkTree& tree, const DrawItem& item, float apartM, double factor);

}  // namespace planet
