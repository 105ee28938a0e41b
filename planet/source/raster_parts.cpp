#include "planet/source/raster_parts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <numbers>

#include "planet/base/try.h"
#include "planet/source/height_quanta.h"
#include "planet/source/height_source.h"
#include "planet/source/source_parts.h"

namespace planet {

namespace {

// The filter is stretched to the spacing of its grid, and its taps, in whole groups of four on means of up to as many
// samples, lie within seven times that spacing along each axis: ten along a diagonal.
constexpr double tapsReach = 10;

// A distance from the rim is measured with the width of columns at its own latitude. Up to this latitude, that of
// the rim's latitude is less than this factor larger, and cells of the coverage add a few sixteenths.
constexpr double steadyLatitudeRad = 75 * std::numbers::pi / 180;
constexpr double featherReach = 3;

// Is raised when the same rasters get other heights, so that a bake copies nothing from one of before.
constexpr std::int32_t samplingRevision = 2;

SampleDensities densitiesOf(const RasterArea& area) {
    const RasterPlacement& placement = area.mosaic.placement();
    if (placement.isGeographic())
        return {placement.rowsPerRad(), placement.columnsAround() / (2 * std::numbers::pi)};
    return {mostUneven * area.samplesPerRad, 0};
}

SourcePart partOn(const DirectionCone& cap, double marginRad, std::uint64_t signature,
                  const RasterArea& area) {
    return {signature, cap.axis, std::min(cap.halfAngleRad + marginRad + 1e-9, std::numbers::pi),
            densitiesOf(area)};
}

// Returns whether the reach of a tile's samples is bounded.
bool reachIsBounded(const RasterArea& area, const RasterReach& reach) {
    if (reach.fillsVoids) return false;
    if (reach.featherRad <= 0) return true;
    // On other grids, distances are measured with the spacing at the middle of the area, wherever that is.
    if (!area.mosaic.placement().isGeographic()) return false;
    const double middleRad = std::asin(std::clamp(std::abs(area.centre.z), 0.0, 1.0));
    return middleRad + area.radiusRad + reach.featherRad < steadyLatitudeRad;
}

// Returns a hash of what all heights of an area depend on but its tiles.
std::uint64_t hashOfGrid(const RasterArea& area, std::uint64_t settings) {
    const RasterLayout& layout = area.mosaic.layout();
    Fingerprint hash;
    hash.add(settings).add(samplingRevision).add(layout.crs);
    for (const double value : layout.x) hash.add(value);
    for (const double value : layout.y) hash.add(value);
    return hash.add(area.samplesPerRad).add(area.stepM).add(std::int32_t{area.faceCells}).hash();
}

// Returns a hash of the files of each tile.
Result<std::vector<std::uint64_t>> hashesOfTiles(const RasterArea& area) {
    std::vector<std::vector<std::filesystem::path>> files;
    for (const RasterMosaic::Tile& tile : area.mosaic.tiles())
        files.push_back(heightSourceFiles(tile.raster->path()).files);
    return hashesOfFiles(files);
}

}  // namespace

Result<void> appendParts(const RasterArea& area, std::uint64_t settings, const RasterReach& reach,
                         std::vector<SourcePart>& parts) {
    TRY_ASSIGN(const auto hashes, hashesOfTiles(area));
    const std::vector<RasterMosaic::Tile>& tiles = area.mosaic.tiles();
    const bool hasRoom = parts.size() + tiles.size() < mostSourceParts / 2;
    if (tiles.size() < 2 || !hasRoom || !reachIsBounded(area, reach)) {
        Fingerprint hash;
        hash.add(settings).add(samplingRevision);
        for (const std::uint64_t ofTile : hashes) hash.add(ofTile);
        // A place counts if the sample nearest to it lies on a tile, so the cap of the samples needs a margin of a
        // sample at most. Feathers and the filter reach inwards.
        const double sampleRad = area.samplesPerRad > 0 ? 1 / area.samplesPerRad : 0;
        parts.push_back(partOn({area.centre, area.radiusRad}, 4 * sampleRad, hash.hash(), area));
        return {};
    }
    const std::uint64_t grid = hashOfGrid(area, settings);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const GridRect& rect = tiles[i].rect;
        const std::uint64_t hash =
            Fingerprint().add(grid).add(rect.column).add(rect.row).add(hashes[i]).hash();
        const double spacingRad = std::max(reach.filterSpacingRad, mostUneven * area.tiles[i].spacingRad);
        const double marginRad = tapsReach * spacingRad + featherReach * reach.featherRad;
        parts.push_back(partOn(area.tiles[i].cap, marginRad, hash, area));
    }
    return {};
}

double quantumOf(const RasterArea& area, double radiusM) {
    return neededQuantumM(area.stepM, area.samplesPerRad > 0 ? radiusM / area.samplesPerRad : noQuantumM);
}

}  // namespace planet
