// A source of heights with one sampling function. height_source.h opens sources.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/format/source_record.h"
#include "planet/raster/height_source_settings.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

// A rectangle of a face's grid of (faceCells + 1)^2 samples. Column i lies at u = 2 i / faceCells - 1,
// row j at v = 2 j / faceCells - 1.
struct SampleTile {
    Face face = Face::PosX;
    int faceCells = 0;  // power of two
    int firstColumn = 0;
    int firstRow = 0;
    int columns = 0;  // samples
    int rows = 0;
    // The cells along a face of the grid that the filter is made for, a power of two; 0: faceCells. A coarser
    // part of a planet samples its own grid with the filter of the finest one, so that a height depends only
    // on its place.
    int filterCells = 0;
};

// Returns the cells along a face of the grid that the filter is made for.
constexpr int filterCellsOf(const SampleTile& tile) {
    return tile.filterCells > 0 ? tile.filterCells : tile.faceCells;
}

struct SourceReads {
    std::uint64_t samples = 0;  // in the files
    std::uint64_t read = 0;     // decoded, a sample as often as it was
};

struct SourceLayers;

// Copies share the open files. Several threads may call sample at once.
struct HeightSource {
    std::string description;  // "elevation.tif, 4320 x 2160 int16, equirectangular"
    // The smallest 2^n + 1 that loses no source resolution. Procedural terrain, which may have finer detail,
    // gives a size that bakes in some minutes.
    int naturalFaceSize = 0;
    double stepM = 0;  // step of an integer source, metres; 0 for floats
    // The lowest and highest of the file's samples, metres, including fillM if it was used. All heights from
    // sample() lie in [minM, maxM].
    double minM = 0;
    double maxM = 0;
    std::uint64_t sampleCount = 0;
    std::uint64_t missingCount = 0;  // filled samples without data
    std::uint64_t memoryBytes = 0;   // that its caches hold at most
    // Only for colours: the number of the cube's edges along which six faces differ visibly, and a notice
    // about it. 0 and empty if the faces agree.
    int seamEdges = 0;
    std::string notice{};
    // A message for each file that was left out because of HeightSourceSettings::skipBroken.
    std::vector<std::string> skipped{};
    // The layers of the source, which tell what made the height of a place (source_layers.h). Null for colours.
    std::shared_ptr<const SourceLayers> layers{};

    // Returns how often the files of georeferenced rasters were read so far. Null: it is not counted. Several
    // threads may call it at once.
    std::function<SourceReads()> reads{};
    // A source of one part sets these: beyond them, a finer filter changes nothing.
    SampleDensities densities{};
    // Returns what the heights depend on, in the order in which it is joined: the heights of a place depend only on
    // the parts whose caps hold it and on the grid of the filter, of this spacing; they are clamped to [minM, maxM].
    // Reads the files. Null: unknown. The Error names a file that cannot be read.
    std::function<Result<std::vector<SourcePart>>(double filterSpacingRad)> parts{};

    // Returns the smallest power of two of cells along a face that loses no data under this square of its
    // face, [1, 2^maxFaceCellsLog2]. A child never says more than its parent. Null: naturalFaceSize - 1 everywhere. Several
    // threads may call it at once.
    std::function<int(const ChunkId& square)> finestCells{};

    // Returns the finest quantum, metres, that any of the heights needs on a planet of a radius (height_quanta.h). Null:
    // none needs one, as of procedural terrain.
    std::function<double(double radiusM)> finestQuantumM{};
    // Samples like sample, and says which quantum each height needs, metres; infinity: none. Like the height, it depends
    // only on the point of the cube and the filter's grid. Null: all need finestQuantumM.
    std::function<Result<void>(const SampleTile& tile, double radiusM, std::span<float> out,
                               std::span<float> neededM)>
        sampleWithQuanta{};

    // Fills out, row-major, with columns x rows heights in metres. A sample's value depends only on its point
    // of the cube and on filterCellsOf(tile), never on the tile, the face or faceCells, so shared edges are
    // bit-identical, between grids of different spacings too.
    //
    // The values are filtered: a source finer than the filter's grid is averaged over its spacing, a coarser
    // one is interpolated smoothly, and faces on a grid of their own size are copied exactly. If faces differ
    // by rounding along an edge of the cube, the first in enum order is used. A call needs about 16 MB
    // besides the cache. The Error names the file.
    std::function<Result<void>(const SampleTile& tile, std::span<float> out)> sample;
};

}  // namespace planet
