#include "planet/source/raster_parts.h"

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <vector>

#include "planet/base/try.h"
#include "planet/source/height_quanta.h"
#include "planet/source/height_source.h"
#include "planet/source/source_parts.h"

namespace planet {

namespace {

SampleDensities densitiesOf(const RasterArea& area) {
    const RasterPlacement& placement = area.mosaic.placement();
    if (placement.columnsAround() > 0)
        return {placement.rowsPerRad(), placement.columnsAround() / (2 * std::numbers::pi)};
    // The sampling expects less than this factor between the middle of a tile and its edge.
    constexpr double mostUneven = 2;
    return {mostUneven * area.samplesPerRad, 0};
}

}  // namespace

Result<SourcePart> partOf(const RasterArea& area, std::uint64_t settings) {
    Fingerprint fingerprint;
    fingerprint.add(settings);
    std::vector<std::filesystem::path> files;
    for (const RasterMosaic::Tile& tile : area.mosaic.tiles()) {
        const HeightSourceFiles ofTile = heightSourceFiles(tile.raster->path());
        fingerprint.add(static_cast<std::uint64_t>(ofTile.files.size()));
        files.insert(files.end(), ofTile.files.begin(), ofTile.files.end());
    }
    TRY_ASSIGN(const auto hash, hashOfFiles(files));
    fingerprint.add(hash);
    // A place counts if the sample nearest to it lies on a tile, so the cap of the samples needs a margin of a
    // sample at most. Feathers and the filter reach inwards.
    const double sampleRad = area.samplesPerRad > 0 ? 1 / area.samplesPerRad : 0;
    const double radiusRad = std::min(area.radiusRad + 4 * sampleRad + 1e-9, std::numbers::pi);
    return SourcePart{fingerprint.hash(), area.centre, radiusRad, densitiesOf(area)};
}

double quantumOf(const RasterArea& area, double radiusM) {
    return neededQuantumM(area.stepM, area.samplesPerRad > 0 ? radiusM / area.samplesPerRad : noQuantumM);
}

}  // namespace planet
