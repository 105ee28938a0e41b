// Bakes a height source into a chunk file: bottom-up, streamed in quadtree order, in bounded memory.
//
// The tree is as deep as the source is fine (bake_tree.h). Every sample is taken with the filter of the
// finest grid, whatever the level of its leaf, so a height depends only on its place. An edge between leaves
// of different levels thus has equal heights where both have a vertex.
//
// The geometric error δg of a chunk is the largest 3-D distance on the sphere, metres, between a vertex that
// its children have and it lacks, and the point of its mesh that replaces the vertex: the middle of an edge
// or diagonal. Distances at the same place bound every point of the finer surface, because the finer
// triangles subdivide the coarser ones, and the difference of two surfaces that are linear on a triangle is
// largest at a corner. So δc = δg + max(δc of the four children) bounds the whole pyramid (de Boer 2000 for
// δg; Ulrich 2002 for chunks). The tight metric is the exact distance of a chunk from its finest samples
// (finest_distance.h), or its children's metric if that is larger.
//
// The bake works on complete subtrees of up to 128 cells, each with leaves of one level. It keeps in memory
// three of them per thread, three chunks per level, and all chunks whose cells are wider than a subtree below
// them. For the distances of those it searches the file once the finer levels are written. In a dense planet
// they have about one sample in 50,000 of the finest; with faces of 4097 and chunks of 33 there are none.
#pragma once

#include <filesystem>

#include "planet/bake/bake_report.h"
#include "planet/bake/bake_settings.h"
#include "planet/base/result.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source_types.h"

namespace planet {

// Writes the output atomically (AtomicFile): after any Error, including Cancelled, an existing output is
// unchanged. The same source and settings give the same bytes with any number of threads. colour: null for a
// file without colours.
Result<BakeReport> bake(const HeightSource& source, const BakeSettings& settings,
                        const std::filesystem::path& output, const BakeProgressCallback& progress = {},
                        const ColourSource* colour = nullptr);

}  // namespace planet
