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

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "planet/bake/bake_settings.h"
#include "planet/base/result.h"
#include "planet/source/colour_source.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

struct BakeProgress {
    std::uint64_t samplesDone = 0;
    std::uint64_t samplesTotal = 0;  // samples of leaves, plus texels of colour tiles
    double elapsedS = 0;
    double samplesPerS = 0;
    double remainingS = 0;
};
// Called from one thread at a time, a few times per second. Returning false cancels the bake.
using BakeProgressCallback = std::function<bool(const BakeProgress&)>;

struct BakeReport {
    PlanetShape shape;
    std::string quantumNotice;  // the source needs a finer quantum than the steps allow; empty: it does not
    std::uint64_t samples = 0;  // of all leaves, each distinct
    std::uint64_t chunks = 0;
    int coarsestLeafLevel = 0;  // the deepest level if the tree is dense
    std::uint64_t fileBytes = 0;
    std::uint64_t missingSamples = 0;
    float largestDeltaCM = 0;  // of the six roots, metres
    float largestDeltaTightM = 0;
    std::uint64_t colourTiles = 0;
    std::uint64_t colourBytes = 0;  // in the file
    std::string colourNotice;       // ColourSource::notice
    // These count only in a bake with BakeSettings::reuse.
    std::uint64_t copiedChunks = 0;       // chunks whose blocks were copied
    std::uint64_t copiedColourTiles = 0;  // all or none
    std::uint64_t sampledCells = 0;       // cells of leaves that were sampled; without reuse, of all leaves
    std::string reuseNotice;      // why nothing was copied, or what was damaged; empty: nothing to say
    bool reuseIsDamaged = false;  // where the earlier bake is damaged, chunks were baked
    double seconds = 0;
};

// Writes the output atomically (AtomicFile): after any Error, including Cancelled, an existing output is
// unchanged. The same source and settings give the same bytes with any number of threads. colour: null for a
// file without colours.
Result<BakeReport> bake(const HeightSource& source, const BakeSettings& settings,
                        const std::filesystem::path& output, const BakeProgressCallback& progress = {},
                        const ColourSource* colour = nullptr);

}  // namespace planet
