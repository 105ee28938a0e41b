#include "planet/source/layer_readings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "planet/base/try.h"

namespace planet {

namespace {

// The place of a sample in the file of a tile.
struct TileSample {
    const RasterMosaic::Tile* tile = nullptr;
    std::int64_t column = 0;
    std::int64_t row = 0;
};

// Returns the tiles that a sample of the grid lies on, in the order of the mosaic.
std::vector<TileSample> tilesAt(const RasterMosaic& mosaic, std::int64_t column, std::int64_t row) {
    std::vector<TileSample> found;
    for (const RasterMosaic::Tile& tile : mosaic.tiles()) {
        std::int64_t across = column - tile.rect.column;
        if (const std::int64_t period = mosaic.period(); period > 0)
            across = (across % period + period) % period;
        const std::int64_t down = row - tile.rect.row;
        if (across >= 0 && across < tile.rect.columns && down >= 0 && down < tile.rect.rows)
            found.push_back({&tile, across, down});
    }
    return found;
}

Result<float> heightOf(const TileSample& sample) {
    const Raster& raster = *sample.tile->raster;
    const RasterLayout& layout = raster.layout();
    const auto column = static_cast<int>(sample.column);
    const auto row = static_cast<int>(sample.row);
    const int blockX = column / layout.blockWidth;
    const int blockY = row / layout.blockHeight;
    TRY_ASSIGN(const auto block, raster.readBlock(blockX, blockY));
    const int width = std::min(layout.blockWidth, layout.width - blockX * layout.blockWidth);
    return block[static_cast<std::size_t>((row - blockY * layout.blockHeight) * width + column -
                                          blockX * layout.blockWidth)];
}

}  // namespace

std::string aboutRasters(const std::string& name, std::span<const RasterArea> areas) {
    const RasterLayout& first = areas[0].mosaic.tiles()[0].raster->layout();
    std::size_t rasters = 0;
    for (const RasterArea& area : areas) rasters += area.mosaic.tiles().size();
    if (rasters == 1)
        return fmt::format("{}, {} x {} {}, {}", name, first.width, first.height, first.typeName,
                           first.crsName);
    return fmt::format("{}, {} rasters on {} grid{}, {}", name, rasters, areas.size(),
                       areas.size() == 1 ? "" : "s", first.crsName);
}

SourceLayer rasterLayer(const std::string& name, std::span<const RasterArea> areas) {
    SourceLayer layer;
    layer.name = name;
    layer.kind = LayerKind::Rasters;
    layer.about = aboutRasters(areas[0].mosaic.tiles()[0].raster->path().filename().string(), areas);
    double widestRad = 0;
    for (const RasterArea& area : areas) {
        const double spacingRad = 1 / area.samplesPerRad;
        layer.spacingRad = layer.spacingRad > 0 ? std::min(layer.spacingRad, spacingRad) : spacingRad;
        layer.sampleCount += area.sampleCount;
        layer.missingCount += area.statistics.missingCount;
        CoverageOutline outline = outlineOf(area.mosaic);
        layer.coversPlanet |= outline.wholePlanet;
        std::ranges::move(outline.lines, std::back_inserter(layer.outlines));
        if (area.radiusRad < widestRad) continue;
        widestRad = area.radiusRad;
        layer.middle = geographicFromDirection(area.centre);
    }
    if (layer.coversPlanet) layer.outlines.clear();
    return layer;
}

Result<SourceReading> readSample(const RasterArea& area, const PlacesOnGrid& onGrid) {
    const GridCell nearest = nearestSample(area.mosaic, onGrid.column[0], onGrid.row[0]);
    const std::vector<TileSample> tiles = tilesAt(area.mosaic, nearest.column, nearest.row);
    SourceReading reading;
    reading.isVoid = true;
    // The last tile with a height counts where tiles overlap, as in the mosaic.
    for (std::size_t i = tiles.size(); i-- > 0;) {
        TRY_ASSIGN(const auto height, heightOf(tiles[i]));
        if (std::isnan(height) && i > 0) continue;
        reading.file = tiles[i].tile->raster->path().lexically_normal();
        reading.column = tiles[i].column;
        reading.row = tiles[i].row;
        reading.isVoid = std::isnan(height);
        if (!reading.isVoid) reading.heightM = static_cast<double>(height);
        break;
    }
    return reading;
}

}  // namespace planet
