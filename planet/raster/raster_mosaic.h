// Rasters that lie on one grid, read as one: tiles of a data set are joined before they are filtered, so that
// heights do not depend on where the tiles meet. Internal to the library.
#pragma once

#include <algorithm>
#include <atomic>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/raster.h"
#include "planet/raster/raster_placement.h"

namespace planet {

// A rectangle of the grid, in samples. Columns go on beyond the date line if the grid follows the meridians.
struct GridRect {
    std::int64_t column = 0;
    std::int64_t row = 0;
    std::int64_t columns = 0;
    std::int64_t rows = 0;
};

// Returns what two rectangles share; its sides are 0 or negative if they share nothing.
inline GridRect sharedBy(const GridRect& a, const GridRect& b) {
    const std::int64_t column = std::max(a.column, b.column);
    const std::int64_t row = std::max(a.row, b.row);
    return {column, row, std::min(a.column + a.columns, b.column + b.columns) - column,
            std::min(a.row + a.rows, b.row + b.rows) - row};
}

// The resolution at which a mosaic is read: a sample is the mean of 2^columnsLog2 x 2^rowsLog2 samples. Sample
// i of a halved axis covers samples 2 i and 2 i + 1.
struct GridReduction {
    int columnsLog2 = 0;  // [0, 22]
    int rowsLog2 = 0;     // [0, 22]

    auto operator<=>(const GridReduction&) const = default;
};

// The blocks of mosaics in memory. Each number of halvings has a limit of its own, so that reading fine blocks drops no
// coarse ones, which take many fine ones to make again. The samples get what these leave, but at least a third.
// Thread-safe.
class MosaicCache {
public:
    // bytes: the limit, to which each number of halvings that is read adds at most 2 MB.
    explicit MosaicCache(std::size_t bytes);

    MosaicCache(const MosaicCache&) = delete;
    MosaicCache& operator=(const MosaicCache&) = delete;

    HeightBlockCache& of(const GridReduction& reduction);
    // Returns a number that no other mosaic with this cache has.
    int newNumber() { return nextNumber_++; }

private:
    std::deque<HeightBlockCache> byHalvings_;
    std::atomic<int> nextNumber_ = 0;
};

inline constexpr std::size_t mostRasters = 1u << 20;  // in all mosaics of a source

// Several threads may read at once.
class RasterMosaic {
public:
    struct Tile {
        std::shared_ptr<const Raster> raster;
        GridRect rect;
    };

    // Returns the fewest mosaics that hold all rasters, each on the grid of its first raster. The rasters keep
    // their order in a mosaic. At most mostRasters.
    static Result<std::vector<RasterMosaic>> join(const std::vector<std::shared_ptr<const Raster>>& rasters,
                                                  const std::shared_ptr<MosaicCache>& cache);

    const std::vector<Tile>& tiles() const { return tiles_; }
    const RasterPlacement& placement() const { return placement_; }
    // The layout of the raster from whose first sample the grid is counted.
    const RasterLayout& layout() const { return layout_; }
    const GridRect& bounds() const { return bounds_; }  // of all tiles
    // The columns once around the planet, after which the grid repeats; 0: it does not repeat.
    std::int64_t period() const { return period_; }

    // Reads heights in metres, row-major; NaN where no tile has a height. Where tiles overlap, the last one
    // with a height there counts. Beyond a pole, a grid that repeats goes on half a turn further.
    Result<void> read(GridReduction reduction, const GridRect& rect, std::span<float> out) const;

    // Reads a block of a tile from its file, past the cache: heights as Raster::readBlock returns them.
    Result<std::vector<float>> readBlock(std::size_t tile, int blockX, int blockY) const;
    // Returns the number of samples that were read from the files so far.
    std::uint64_t samplesRead() const;

    // Returns the places of the tiles that touch a rectangle, in each turn in which they do.
    std::vector<GridRect> tilesIn(const GridRect& rect) const;

    // Sets the samples of a rectangle to 0 where a tile lies, whether it has a height there or not, and beyond a pole;
    // to NaN elsewhere.
    void markTiles(const GridRect& rect, std::span<float> out) const;

private:
    RasterMosaic(const Raster& first, RasterPlacement placement, std::shared_ptr<MosaicCache> cache);
    void add(const std::shared_ptr<const Raster>& raster);
    void sortIntoBands();
    Result<void> readTile(std::size_t tile, const GridRect& rect, const GridRect& target,
                          std::span<float> out) const;
    template <class Visit>
    Result<void> forTilesIn(const GridRect& rect, const Visit& visit) const;
    bool mayHaveHeightsIn(const GridRect& rect) const;
    Result<void> readTiles(const GridRect& rect, std::span<float> out) const;
    Result<void> readSamples(const GridRect& rect, std::span<float> out) const;
    Result<std::vector<float>> reducedBlock(GridReduction reduction, std::int64_t blockX,
                                            std::int64_t blockY) const;

    RasterPlacement placement_;
    RasterLayout layout_;
    std::shared_ptr<MosaicCache> cache_;
    int number_ = 0;  // distinguishes the mosaics that share the cache
    std::shared_ptr<std::atomic<std::uint64_t>> samplesRead_ =
        std::make_shared<std::atomic<std::uint64_t>>(0);
    std::vector<Tile> tiles_;
    GridRect bounds_;
    std::int64_t period_ = 0;
    // Tiles by the bands of rows that they touch. A band is as high as the highest tile.
    std::int64_t bandRows_ = 1;
    std::vector<std::vector<std::size_t>> bands_;
};

}  // namespace planet
