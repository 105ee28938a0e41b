// Bakes a height source into a chunk file: bottom-up, streamed in quadtree order, in bounded memory.
//
// delta_g of a chunk is the largest distance, in metres and in 3-D on the sphere, between a vertex that its
// children have and it lacks, and the point of its own mesh that stands there: the middle of the edge or of
// the diagonal that replaces the vertex. Distances at the same place bound every point of the finer surface,
// because the finer triangles subdivide the coarser ones and the difference of two surfaces that are linear
// on a triangle is largest at a corner. So delta_c = delta_g + max(delta_c of the four children) bounds the
// whole pyramid (de Boer 2000 for delta_g; Ulrich 2002 for chunks). The tight metric is the exact distance of
// a chunk from the finest samples under it (finest_distance.h), or its children's metric if that is larger.
//
// The bake holds in memory three tiles per thread, three chunks per level, and all chunks of levels whose
// cells are wider than a tile; it searches the file for their distances once the finer levels are written.
// Those are one sample in about 50,000 of the finest; a planet with faces of 4097 and chunks of 33 has none.
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
    std::uint64_t samplesTotal = 0;  // finest-level samples, and texels of colour tiles
    double elapsedS = 0;
    double samplesPerS = 0;
    double remainingS = 0;
};
// Called from one thread at a time, a few times per second; returns false to cancel the bake.
using BakeProgressCallback = std::function<bool(const BakeProgress&)>;

struct BakeReport {
    PlanetShape shape;
    std::uint64_t samples = 0;  // distinct finest-level samples
    std::uint64_t chunks = 0;
    std::uint64_t fileBytes = 0;
    std::uint64_t missingSamples = 0;
    float largestDeltaCM = 0;  // the largest of the six roots, metres
    float largestDeltaTightM = 0;
    std::uint64_t colourTiles = 0;
    std::uint64_t colourBytes = 0;  // of the file
    std::string colourNotice;       // ColourSource::notice
    double seconds = 0;
};

// Writes the output atomically (AtomicFile): after any Error, Cancelled included, an existing output is
// unchanged. The same source and settings give the same bytes with any number of threads. colour: null makes
// a file without colours.
Result<BakeReport> bake(const HeightSource& source, const BakeSettings& settings,
                        const std::filesystem::path& output, const BakeProgressCallback& progress = {},
                        const ColourSource* colour = nullptr);

}  // namespace planet
