// How deep a skirt hangs when its depth is Automatic (LodSettings::skirtDepth): one rule, for selecting and
// for what measures skirts. Pure functions, any thread.
#pragma once

#include "planet/select/lod_types.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// How far two drawn chunks side by side may be apart along their edge, metres: what both may be from the
// truth there, by the metric, with the morph of each one's edge. The finer one of two of one level is either;
// then the edge of the other is not looked at, since both have the same morph. Both must be nodes of the
// tree.
float mostApartM(const ChunkTree& tree, ErrorMetric metric, const DrawItem& finer, Edge finerEdge,
                 const DrawItem& coarser, Edge coarserEdge);

// Shallower than this no automatic skirt is, metres: edges that agree exactly still part by rounding, of
// heights and of pixels.
float leastSkirtDepthM(const ChunkTree& tree, const DrawItem& item);

// The depth of a chunk's skirt, metres, where it may be that far from any chunk beside it. Both sides of an
// edge have a skirt that covers both errors, so whichever of the two lies higher there, its skirt reaches
// below the other. factor: LodSettings::skirtFactor, >= 0; 0: no skirt.
float automaticSkirtDepthM(const ChunkTree& tree, const DrawItem& item, float apartM, double factor);

}  // namespace planet
