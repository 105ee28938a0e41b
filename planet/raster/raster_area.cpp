#include "planet/raster/raster_area.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <mutex>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "planet/base/error_bytes.h"
#include "planet/base/little_endian.h"
#include "planet/base/parallel.h"
#include "planet/base/stopwatch.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

namespace {

constexpr int cellSamples = 32;    // samples along a square of the survey
constexpr int latticeSamples = 8;  // samples between the places that are converted
constexpr int cellSamplesLog2 = 5;
constexpr std::int64_t leastResolutionApart = 1024;  // samples between places where the resolution is taken
constexpr std::int64_t mostResolutionsAlong = 256;
constexpr std::int64_t capPlaces = 32;  // places along a side of a tile that its cap is made from
constexpr double differenceRad = 1e-6;
constexpr double latitudeSlackRad = 0.02;  // of a grid that does not follow the parallels

// A block of a tile that is surveyed by one call.
struct SurveyBlock {
    std::size_t tile = 0;
    int x = 0;
    int y = 0;
};

// A square of the survey on the grid of a mosaic: samples from cellSamples * column and cellSamples * row on. It depends
// only on the grid, so that tiles and blocks do not change what is covered.
struct SurveyCell {
    std::int64_t column = 0;
    std::int64_t row = 0;

    auto operator<=>(const SurveyCell&) const = default;
};

std::vector<SurveyBlock> blocksOf(const RasterMosaic& mosaic) {
    std::vector<SurveyBlock> blocks;
    for (std::size_t tile = 0; tile < mosaic.tiles().size(); ++tile) {
        const RasterLayout& layout = mosaic.tiles()[tile].raster->layout();
        for (int y = 0; y * layout.blockHeight < layout.height; ++y) {
            for (int x = 0; x * layout.blockWidth < layout.width; ++x) blocks.push_back({tile, x, y});
        }
    }
    return blocks;
}

// Returns the indices of the blocks of a part, in the order in which to read them. Threads that ask for blocks of the same
// rows would wait for one another. So of as many groups of such rows as there are threads, first one block each is read.
std::vector<std::size_t> readingOrderOf(const std::vector<SurveyBlock>& blocks, const RasterMosaic& mosaic,
                                        const SurveyShare& part) {
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    std::vector<std::size_t> order, first, others;
    std::pair<std::size_t, int> group{};  // tile and row of the last block that was added
    const auto flush = [&] {
        order.insert(order.end(), first.begin(), first.end());
        order.insert(order.end(), others.begin(), others.end());
        first.clear();
        others.clear();
    };
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (!part.reads(i)) continue;
        const SurveyBlock& block = blocks[i];
        const int rows = mosaic.tiles()[block.tile].raster->rowsReadTogether();
        if (rows == 0) {
            flush();
            order.push_back(i);
            continue;
        }
        const std::pair own{block.tile, block.y / rows};
        if (!first.empty() && own == group) {
            others.push_back(i);
            continue;
        }
        if (first.size() == threads) flush();
        first.push_back(i);
        group = own;
    }
    flush();
    return order;
}

// Positions on the grid, and what they become on the planet.
struct Lattice {
    std::vector<double> columns;
    std::vector<double> rows;

    // Adds a lattice of positions over a rectangle, whose outer positions lie on the samples' outer edges.
    void add(const GridRect& rect, std::int64_t samplesApart) {
        const std::int64_t across = (rect.columns + samplesApart - 1) / samplesApart;
        const std::int64_t down = (rect.rows + samplesApart - 1) / samplesApart;
        const auto between = [](std::int64_t first, std::int64_t count, std::int64_t i, std::int64_t parts) {
            return static_cast<double>(first) - 0.5 +
                   static_cast<double>(count * i) / static_cast<double>(parts);
        };
        for (std::int64_t j = 0; j <= down; ++j) {
            for (std::int64_t i = 0; i <= across; ++i) {
                columns.push_back(between(rect.column, rect.columns, i, across));
                rows.push_back(between(rect.row, rect.rows, j, down));
            }
        }
    }

    // Returns the directions of the positions that the projection reaches.
    std::vector<glm::dvec3> directions(const RasterPlacement& placement) const {
        std::vector<double> longitudes(columns.size());
        std::vector<double> latitudes(columns.size());
        placement.toPlanet(columns, rows, longitudes, latitudes);
        std::vector<glm::dvec3> found;
        // The outer edge of an image of the whole planet can lie beyond a pole.
        const double mostBeyondRad = placement.isGeographic() ? 1 / placement.rowsPerRad() : latitudeSlackRad;
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (!std::isfinite(longitudes[i])) continue;
            if (!(std::abs(latitudes[i]) <= std::numbers::pi / 2 + mostBeyondRad)) continue;
            const double latitude = std::clamp(latitudes[i], -std::numbers::pi / 2, std::numbers::pi / 2);
            found.push_back(directionFromGeographic({latitude, longitudes[i]}));
        }
        return found;
    }
};

std::uint64_t squareAt(const glm::dvec3& direction, int level) {
    return indexInQuadtreeOrder(chunkAt(facePointFromDirection(direction), level));
}

template <class T>
void sortUnique(std::vector<T>& values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

// The statistics of a block, and its cells that hold a height: those that lie in it, and those that its edges cut, of
// which another block may hold a height too.
struct BlockSurvey {
    HeightStatistics statistics;
    std::vector<SurveyCell> whole;
    std::vector<SurveyCell> cut;
};

GridRect rectOf(const SurveyCell& cell) {
    return {cell.column * cellSamples, cell.row * cellSamples, cellSamples, cellSamples};
}

BlockSurvey surveyBlock(const GridRect& rect, std::span<const float> heights) {
    BlockSurvey survey;
    const auto first = [](std::int64_t sample) { return sample >> cellSamplesLog2; };  // rounds down
    for (std::int64_t cellRow = first(rect.row); cellRow <= first(rect.row + rect.rows - 1); ++cellRow) {
        for (std::int64_t cellColumn = first(rect.column);
             cellColumn <= first(rect.column + rect.columns - 1); ++cellColumn) {
            const SurveyCell cell{cellColumn, cellRow};
            const GridRect part = sharedBy(rectOf(cell), rect);
            std::int64_t missing = 0;
            for (std::int64_t row = part.row; row < part.row + part.rows; ++row) {
                const auto from =
                    static_cast<std::size_t>((row - rect.row) * rect.columns + part.column - rect.column);
                for (const float h : heights.subspan(from, static_cast<std::size_t>(part.columns))) {
                    missing += std::isnan(h) ? 1 : 0;
                    survey.statistics.minM = std::min(survey.statistics.minM, h);  // unchanged by NaN
                    survey.statistics.maxM = std::max(survey.statistics.maxM, h);
                }
            }
            survey.statistics.missingCount += static_cast<std::uint64_t>(missing);
            if (missing == part.columns * part.rows) continue;
            const bool isWhole = part.columns == cellSamples && part.rows == cellSamples;
            (isWhole ? survey.whole : survey.cut).push_back(cell);
        }
    }
    return survey;
}

// Returns the squares of a level that cells touch, ascending.
std::vector<std::uint64_t> squaresOf(const RasterMosaic& mosaic, std::span<const SurveyCell> cells,
                                     int level) {
    constexpr std::size_t cellsAtOnce = 1024;  // a cell takes up to 2 KB
    std::vector<std::uint64_t> squares;
    for (std::size_t first = 0; first < cells.size(); first += cellsAtOnce) {
        Lattice lattice;
        for (const SurveyCell& cell : cells.subspan(first, std::min(cellsAtOnce, cells.size() - first)))
            lattice.add(sharedBy(rectOf(cell), mosaic.bounds()), latticeSamples);
        std::vector<std::uint64_t> found;
        for (const glm::dvec3& direction : lattice.directions(mosaic.placement()))
            found.push_back(squareAt(direction, level));
        sortUnique(found);
        squares.insert(squares.end(), found.begin(), found.end());
    }
    sortUnique(squares);
    return squares;
}

// Returns the largest angle, in radians, that a cell of a face with one cell would cover at the scale of a place.
double cellRadAt(const glm::dvec3& direction) {
    constexpr double step = 1e-4;
    const FacePoint point = facePointFromDirection(direction);
    const double u = point.u < 0 ? point.u + step : point.u - step;
    const double v = point.v < 0 ? point.v + step : point.v - step;
    const glm::dvec3 here = sphereFromCube(cubePoint(point.face, point.u, point.v));
    const double alongU = glm::length(sphereFromCube(cubePoint(point.face, u, point.v)) - here);
    const double alongV = glm::length(sphereFromCube(cubePoint(point.face, point.u, v)) - here);
    return 2 * std::max(alongU, alongV) / step;
}

// The resolution of a grid at a place.
struct Resolution {
    double mostPerRad = 0;  // samples in a radian along the axis with more of them
    // Along the axis with fewer samples, which has the resolution: towards the poles, columns stand closer than rows.
    double leastPerRad = 0;
    int faceCells = 1;  // that lose no samples
};

std::pair<double, double> middleOf(const GridRect& rect) {
    return {static_cast<double>(rect.column) + static_cast<double>(rect.columns - 1) / 2,
            static_cast<double>(rect.row) + static_cast<double>(rect.rows - 1) / 2};
}

// Returns the resolution at a position on the grid; nothing where the projection does not reach.
std::optional<Resolution> resolutionAt(const RasterPlacement& placement,
                                       const std::pair<double, double>& position) {
    Lattice single;
    single.columns.push_back(position.first);
    single.rows.push_back(position.second);
    const std::vector<glm::dvec3> place = single.directions(placement);
    if (place.empty()) return std::nullopt;
    const SampleDensity density = densitiesAt(placement, place)[0];
    const auto [least, most] = std::minmax(density.columnsPerRad, density.rowsPerRad);
    if (!std::isfinite(most)) return std::nullopt;
    return Resolution{most, least, powerOfTwoCells(cellRadAt(place[0]) * least)};
}

// Sets the resolution of each tile at its middle.
void setTileSpacings(RasterArea& area) {
    area.tiles.resize(area.mosaic.tiles().size());
    for (std::size_t i = 0; i < area.tiles.size(); ++i) {
        const auto found = resolutionAt(area.mosaic.placement(), middleOf(area.mosaic.tiles()[i].rect));
        area.tiles[i].spacingRad = std::numbers::pi;
        if (found && found->leastPerRad > 0)
            area.tiles[i].spacingRad = std::min(1 / found->leastPerRad, std::numbers::pi);
    }
}

// Returns the positions at which the resolution of a mosaic is taken: its middle, and those of a lattice over its grid
// that lie on a tile. How the mosaic is cut into tiles changes none of them.
std::vector<std::pair<double, double>> resolutionPositions(const RasterMosaic& mosaic) {
    const GridRect& bounds = mosaic.bounds();
    std::int64_t apart = leastResolutionApart;
    while (apart * mostResolutionsAlong < std::max(bounds.columns, bounds.rows)) apart *= 2;
    std::vector<std::pair<double, double>> positions;
    const auto [column, row] = middleOf(bounds);
    if (!mosaic.tilesIn({std::llround(column), std::llround(row), 1, 1}).empty())
        positions.emplace_back(column, row);
    const auto firstFrom = [&](std::int64_t sample) {
        std::int64_t first = sample / apart * apart + apart / 2;
        while (first - apart >= sample) first -= apart;
        while (first < sample) first += apart;
        return first;
    };
    for (const RasterMosaic::Tile& tile : mosaic.tiles()) {
        const GridRect& rect = tile.rect;
        for (std::int64_t y = firstFrom(rect.row); y < rect.row + rect.rows; y += apart) {
            for (std::int64_t x = firstFrom(rect.column); x < rect.column + rect.columns; x += apart)
                positions.emplace_back(static_cast<double>(x), static_cast<double>(y));
        }
    }
    if (!positions.empty()) return positions;
    // Small tiles that lie apart.
    for (const RasterMosaic::Tile& tile : mosaic.tiles()) positions.push_back(middleOf(tile.rect));
    return positions;
}

void setResolution(RasterArea& area) {
    for (const auto& position : resolutionPositions(area.mosaic)) {
        const auto found = resolutionAt(area.mosaic.placement(), position);
        if (!found) continue;
        area.samplesPerRad = std::max(area.samplesPerRad, found->mostPerRad);
        area.faceCells = std::max(area.faceCells, found->faceCells);
    }
}

// Returns a cap of the sphere that holds places.
DirectionCone capAround(std::span<const glm::dvec3> places) {
    glm::dvec3 sum{};
    for (const glm::dvec3& place : places) sum += place;
    const double length = glm::length(sum);
    // Places all around the planet have no middle.
    const bool hasMiddle = length > 1e-6 * static_cast<double>(places.size());
    DirectionCone cap{hasMiddle ? sum / length : glm::dvec3(1, 0, 0), 0};
    double least = 1;
    for (const glm::dvec3& place : places) least = std::min(least, glm::dot(cap.axis, place));
    cap.halfAngleRad = std::acos(std::clamp(least, -1.0, 1.0));
    return cap;
}

// Sets the caps of the tiles and of the area, from a lattice over each tile.
void setCaps(RasterArea& area) {
    std::vector<glm::dvec3> places;
    double mostMarginRad = 0;
    for (std::size_t tile = 0; tile < area.tiles.size(); ++tile) {
        const GridRect& rect = area.mosaic.tiles()[tile].rect;
        const std::int64_t apart = std::max<std::int64_t>(1, std::max(rect.columns, rect.rows) / capPlaces);
        Lattice lattice;
        lattice.add(rect, apart);
        const std::vector<glm::dvec3> ofTile = lattice.directions(area.mosaic.placement());
        // Nowhere does a tile reach further beyond a place of the lattice.
        const double marginRad =
            std::min(static_cast<double>(apart) * mostUneven * area.tiles[tile].spacingRad, 1.0);
        DirectionCone& cap = area.tiles[tile].cap;
        cap = capAround(ofTile);
        cap.halfAngleRad = std::min(cap.halfAngleRad + marginRad, std::numbers::pi);
        mostMarginRad = std::max(mostMarginRad, marginRad);
        places.insert(places.end(), ofTile.begin(), ofTile.end());
    }
    const DirectionCone cap = capAround(places);
    area.centre = cap.axis;
    area.radiusRad = cap.halfAngleRad + mostMarginRad;
}

double commonStepM(const RasterMosaic& mosaic) {
    const double first = mosaic.tiles()[0].raster->layout().stepM;
    const bool same = std::ranges::all_of(
        mosaic.tiles(), [&](const RasterMosaic::Tile& tile) { return tile.raster->layout().stepM == first; });
    return same ? first : 0;
}

// Joins the surveys of the blocks of a part.
struct PartSurvey {
    HeightStatistics statistics;
    std::uint64_t sampleCount = 0;
    std::vector<std::uint64_t>
        covered;                  // as CoveredSquares::indices, of the cells that lie in one block; any order
    std::vector<SurveyCell> cut;  // ascending
    std::map<std::size_t, Error> broken;  // by tile
};

// Reads the blocks of a part of so many.
PartSurvey surveyPart(const RasterArea& area, const SurveyShare& part, const std::stop_token& stop) {
    const std::vector<SurveyBlock> blocks = blocksOf(area.mosaic);
    const std::vector<std::size_t> order = readingOrderOf(blocks, area.mosaic, part);
    PartSurvey survey;
    std::size_t mostUnsorted = std::size_t{1} << 16;
    std::mutex mutex;
    parallelFor(order.size(), [&](std::size_t turn) {
        if (stop.stop_requested()) return;
        const auto& [tileIndex, x, y] = blocks[order[turn]];
        const RasterMosaic::Tile& tile = area.mosaic.tiles()[tileIndex];
        const RasterLayout& layout = tile.raster->layout();
        {
            const std::lock_guard lock(mutex);
            if (survey.broken.contains(tileIndex)) return;
        }
        const int left = x * layout.blockWidth;
        const int top = y * layout.blockHeight;
        const GridRect rect{tile.rect.column + left, tile.rect.row + top,
                            std::min(layout.blockWidth, layout.width - left),
                            std::min(layout.blockHeight, layout.height - top)};
        if (tile.raster->isEmpty(x, y)) {
            const std::lock_guard lock(mutex);
            const auto samples = static_cast<std::uint64_t>(rect.columns * rect.rows);
            survey.sampleCount += samples;
            survey.statistics.missingCount += samples;
            return;
        }
        const Result<std::vector<float>> heights = area.mosaic.readBlock(tileIndex, x, y);
        if (!heights) {
            const std::lock_guard lock(mutex);
            survey.broken.emplace(tileIndex, heights.error());
            return;
        }
        const BlockSurvey block = surveyBlock(rect, *heights);
        const std::vector<std::uint64_t> squares = squaresOf(area.mosaic, block.whole, area.covered.level);
        const std::lock_guard lock(mutex);
        addTo(survey.statistics, block.statistics);
        survey.sampleCount += heights->size();
        std::vector<std::uint64_t>& covered = survey.covered;
        covered.insert(covered.end(), squares.begin(), squares.end());
        // Neighbouring blocks share squares. Without this, most of the list would be repetitions.
        if (covered.size() > mostUnsorted) {
            sortUnique(covered);
            mostUnsorted = std::max(mostUnsorted, 2 * covered.size());
        }
        survey.cut.insert(survey.cut.end(), block.cut.begin(), block.cut.end());
    });
    sortUnique(survey.cut);
    return survey;
}

// Returns numbers that are the same in all processes that survey the same area.
std::array<std::int64_t, 6> identityOf(const RasterArea& area) {
    const GridRect& bounds = area.mosaic.bounds();
    return {static_cast<std::int64_t>(area.mosaic.tiles().size()),
            area.covered.level,
            bounds.column,
            bounds.row,
            bounds.columns,
            bounds.rows};
}

std::vector<std::byte> bytesOf(const RasterArea& area, const PartSurvey& survey) {
    std::vector<std::byte> bytes;
    ByteWriter to(bytes);
    for (const std::int64_t number : identityOf(area)) to.put(number);
    to.put(survey.statistics.minM);
    to.put(survey.statistics.maxM);
    to.put(survey.statistics.missingCount);
    to.put(survey.sampleCount);
    to.put(static_cast<std::uint64_t>(survey.covered.size()));
    for (const std::uint64_t square : survey.covered) to.put(square);
    to.put(static_cast<std::uint64_t>(survey.cut.size()));
    for (const SurveyCell& cell : survey.cut) {
        to.put(cell.column);
        to.put(cell.row);
    }
    for (const auto& [tile, error] : survey.broken) {
        to.put(static_cast<std::uint64_t>(tile));
        putError(bytes, error);
    }
    return bytes;
}

// Adds what another process has found; returns false if it has another area.
bool addFrom(const RasterArea& area, std::span<const std::byte> bytes, PartSurvey& survey) {
    const auto identity = identityOf(area);
    if (bytes.size() < sizeof(identity)) return false;
    ByteReader in(bytes);
    for (const std::int64_t number : identity) {
        if (in.get<std::int64_t>() != number) return false;
    }
    HeightStatistics statistics;
    statistics.minM = in.get<float>();
    statistics.maxM = in.get<float>();
    statistics.missingCount = in.get<std::uint64_t>();
    addTo(survey.statistics, statistics);
    survey.sampleCount += in.get<std::uint64_t>();
    for (auto count = in.get<std::uint64_t>(); count > 0; --count)
        survey.covered.push_back(in.get<std::uint64_t>());
    for (auto count = in.get<std::uint64_t>(); count > 0; --count) {
        const auto column = in.get<std::int64_t>();
        survey.cut.push_back({column, in.get<std::int64_t>()});
    }
    while (!in.rest().empty()) {
        const auto tile = static_cast<std::size_t>(in.get<std::uint64_t>());
        survey.broken.emplace(tile, takeError(in));
    }
    return true;
}

// Surveys the blocks of a share, and joins what all processes have found. All of them return the same, but if they cannot
// survey together, this one reads all blocks.
PartSurvey surveyTogether(const RasterArea& area, const SurveyShare& share, const std::stop_token& stop) {
    const Stopwatch stopwatch;
    PartSurvey own = surveyPart(area, share, stop);
    if (stop.stop_requested()) return own;
    sortUnique(own.covered);
    const auto all = share.exchange(bytesOf(area, own), stopwatch.elapsedS());
    PartSurvey joined;
    if (!all || !std::ranges::all_of(*all, [&](const auto& theirs) { return addFrom(area, theirs, joined); }))
        return surveyPart(area, {}, stop);
    sortUnique(joined.cut);
    return joined;
}

}  // namespace

std::vector<SampleDensity> densitiesAt(const RasterPlacement& placement,
                                       const std::vector<glm::dvec3>& directions) {
    const std::size_t count = directions.size();
    std::vector<double> longitudes(3 * count);
    std::vector<double> latitudes(3 * count);
    const auto set = [&](std::size_t at, const glm::dvec3& direction) {
        const Geographic place = geographicFromDirection(direction);
        longitudes[at] = place.longitudeRad;
        latitudes[at] = place.latitudeRad;
    };
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3& here = directions[i];
        const glm::dvec3 axis = std::abs(here.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
        const glm::dvec3 east = glm::normalize(glm::cross(axis, here));
        set(3 * i, here);
        set(3 * i + 1, here + differenceRad * east);
        set(3 * i + 2, here + differenceRad * glm::cross(here, east));
    }
    std::vector<double> columns(3 * count);
    std::vector<double> rows(3 * count);
    placement.toGrid(longitudes, latitudes, columns, rows);
    std::vector<SampleDensity> densities(count);
    const double around = placement.columnsAround();
    const auto columnDifference = [&](double a, double b) {
        return around > 0 ? std::remainder(a - b, around) : a - b;
    };
    for (std::size_t i = 0; i < count; ++i) {
        const double* const column = &columns[3 * i];
        const double* const row = &rows[3 * i];
        densities[i] = {
            std::hypot(columnDifference(column[1], column[0]), columnDifference(column[2], column[0])) /
                differenceRad,
            std::hypot(row[1] - row[0], row[2] - row[0]) / differenceRad};
    }
    return densities;
}

bool CoveredSquares::meet(const ChunkId& square) const {
    if (square.level >= level) {
        return std::ranges::binary_search(indices, indexInQuadtreeOrder(ancestorOf(square, level)));
    }
    const int shift = 2 * (level - square.level);
    const std::uint64_t first = indexInQuadtreeOrder(square) << shift;
    const auto found = std::ranges::lower_bound(indices, first);
    return found != indices.end() && *found - first < (std::uint64_t{1} << shift);
}

AreaSurvey surveyArea(RasterMosaic mosaic, const std::stop_token& stop, const SurveyShare* share) {
    AreaSurvey survey{{.mosaic = std::move(mosaic), .statistics = {}, .tiles = {}, .covered = {}}, {}};
    RasterArea& area = survey.area;
    setTileSpacings(area);
    setResolution(area);
    setCaps(area);
    area.covered.level =
        std::clamp(static_cast<int>(std::lround(std::log2(area.faceCells))) - cellSamplesLog2, 0, maxLevel);
    area.stepM = commonStepM(area.mosaic);
    PartSurvey found = share ? surveyTogether(area, *share, stop) : surveyPart(area, {}, stop);
    if (stop.stop_requested()) return survey;
    area.statistics = found.statistics;
    area.sampleCount = found.sampleCount;
    area.covered.indices = std::move(found.covered);
    const std::vector<std::uint64_t> squares = squaresOf(area.mosaic, found.cut, area.covered.level);
    area.covered.indices.insert(area.covered.indices.end(), squares.begin(), squares.end());
    sortUnique(area.covered.indices);
    for (auto& [tile, error] : found.broken) survey.broken.push_back({tile, std::move(error)});
    return survey;
}

}  // namespace planet
