// The area of the planet that a mosaic of rasters covers, its resolution, and the range of its heights.
// Internal to the library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <stop_token>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/raster_mosaic.h"
#include "planet/raster/survey_share.h"
#include "planet/sphere/bounds.h"
#include "planet/sphere/chunk_id.h"

namespace planet {

// The squares of one level of the cube's quadtrees in which a mosaic has heights. A square is about as wide as
// 32 samples. A mosaic that reaches into a square by less than 8 samples at a corner may be missing.
struct CoveredSquares {
    int level = 0;
    std::vector<std::uint64_t> indices;  // in quadtree order (indexInQuadtreeOrder), ascending

    // Returns whether any of the squares shares more than an edge with a square of any level.
    bool meet(const ChunkId& square) const;
};

// A projection is expected to stretch a tile by less than this factor from its middle to its edge.
inline constexpr double mostUneven = 2;

// The ground that a tile of a mosaic covers.
struct TileExtent {
    DirectionCone cap;      // holds all its samples
    double spacingRad = 0;  // between neighbouring samples at its middle, along the axis where it is larger
};

struct RasterArea {
    RasterMosaic mosaic;
    HeightStatistics statistics;  // of all tiles; missing samples do not count towards the range
    std::uint64_t sampleCount = 0;
    double stepM = 0;  // the common step of integer tiles, metres; 0 if there is none
    // A cap of the unit sphere that holds all samples.
    glm::dvec3 centre{};
    double radiusRad = 0;
    // The largest number of samples in a radian along an axis of the grid, at the middle of any tile.
    double samplesPerRad = 0;
    // The smallest power of two of cells along a face that loses no samples, at the middle of any tile.
    int faceCells = 1;
    std::vector<TileExtent> tiles;  // in the order of the mosaic's tiles
    CoveredSquares covered;
};

// Returns the cells along a face that lose no samples under a square; 1 if there are none.
inline int finestCellsIn(const RasterArea& area, const ChunkId& square) {
    return area.covered.meet(square) ? area.faceCells : 1;
}

// Surveys an area. It is right only if no tile is broken.
struct AreaSurvey {
    RasterArea area;
    struct BrokenTile {
        std::size_t tile = 0;
        Error error;  // names the file
    };
    std::vector<BrokenTile> broken;  // in the order of the tiles
};

// Reads every sample once but those of empty blocks; with `share`, each of its processes reads its part of the blocks. When a
// stop is requested it returns early, and the survey is not whole.
AreaSurvey surveyArea(RasterMosaic mosaic, const std::stop_token& stop = {},
                      const SurveyShare* share = nullptr);

// The number of samples in a radian along each axis of a grid.
struct SampleDensity {
    double columnsPerRad = 0;
    double rowsPerRad = 0;
};
// Computes the densities at places, by differences to two places a millionth of a radian away. They are not
// finite where the projection does not reach.
std::vector<SampleDensity> densitiesAt(const RasterPlacement& placement,
                                       const std::vector<glm::dvec3>& directions);

}  // namespace planet
