// Samples georeferenced rasters of any projection: one file, or several that are listed by a pattern. Rasters on
// one grid are joined; of those on different grids, the finest lies on top.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/raster/gdal_raster.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/raster_sampling.h"
#include "planet/source/sample_tiles.h"

namespace planet {

namespace {

constexpr int rasterPieceSide = 65;  // samples per side of a piece of a tile
constexpr std::size_t mostRasters = 1u << 20;

struct Rasters {
    std::vector<RasterArea> areas;  // the finest first
    float minM = 0;
    float maxM = 0;
    float fillM = 0;
};

Result<void> samplePiece(const Rasters& rasters, const SampleTile& piece, float* out, std::size_t stride) {
    std::vector<float> heights(samplesIn(piece), std::numeric_limits<float>::quiet_NaN());
    const PiecePlaces places = placesOf(piece);
    for (const RasterArea& area : rasters.areas)
        TRY(fillFrom(area, places, placesOnGrid(area, places), heights));
    const auto columns = static_cast<std::size_t>(piece.columns);
    for (std::size_t i = 0; i < heights.size(); ++i) {
        out[i / columns * stride + i % columns] =
            std::isnan(heights[i]) ? rasters.fillM : std::clamp(heights[i], rasters.minM, rasters.maxM);
    }
    return {};
}

std::string describe(const std::filesystem::path& path, const std::vector<RasterArea>& areas) {
    const RasterLayout& first = areas[0].mosaic.tiles()[0].raster->layout();
    // A list of files is named after the first one.
    const std::string text = path.string();
    const std::string name = std::filesystem::path(text.substr(0, text.find('|'))).filename().string();
    std::size_t rasters = 0;
    for (const RasterArea& area : areas) rasters += area.mosaic.tiles().size();
    if (rasters == 1)
        return fmt::format("{}, {} x {} {}, {}", name, first.width, first.height, first.typeName,
                           first.crsName);
    return fmt::format("{}, {} rasters on {} grid{}, {}", name, rasters, areas.size(),
                       areas.size() == 1 ? "" : "s", first.crsName);
}

}  // namespace

Result<std::vector<RasterArea>> openRasterAreas(const std::vector<std::filesystem::path>& files,
                                                const HeightSourceSettings& settings) {
    std::vector<std::shared_ptr<const Raster>> rasters;
    for (const std::filesystem::path& file : files) {
        TRY_ASSIGN(auto raster, GdalRaster::open(file, settings));
        rasters.push_back(std::move(raster));
    }
    return surveyRasters(rasters, settings);
}

Result<std::vector<RasterArea>> surveyRasters(const std::vector<std::shared_ptr<const Raster>>& rasters,
                                              const HeightSourceSettings& settings) {
    const auto cache = std::make_shared<HeightBlockCache>(settings.cacheBytes);
    TRY_ASSIGN(auto mosaics, RasterMosaic::join(rasters, cache));
    std::vector<RasterArea> areas;
    for (RasterMosaic& mosaic : mosaics) {
        TRY_ASSIGN(auto area, surveyArea(std::move(mosaic)));
        areas.push_back(std::move(area));
    }
    std::ranges::stable_sort(areas, std::greater(), &RasterArea::samplesPerRad);
    return areas;
}

Result<HeightSource> openRasterSource(const std::filesystem::path& path,
                                      const std::vector<std::filesystem::path>& files,
                                      const HeightSourceSettings& settings) {
    if (files.size() > mostRasters) {
        return badInput(fmt::format("{}: matches {} files; expected at most {}", path.string(), files.size(),
                                    mostRasters));
    }
    TRY_ASSIGN(auto areas, openRasterAreas(files, settings));
    HeightSource source;
    source.description = describe(path, areas);
    HeightStatistics statistics;
    int faceCells = 1;
    source.stepM = areas[0].stepM;
    for (const RasterArea& area : areas) {
        addTo(statistics, area.statistics);
        source.sampleCount += area.sampleCount;
        faceCells = std::max(faceCells, area.faceCells);
        if (area.stepM != source.stepM) source.stepM = 0;
    }
    if (statistics.missingCount == source.sampleCount) {
        return badInput(fmt::format("{}: has no heights, because all {} samples are missing; expected some",
                                    path.string(), source.sampleCount));
    }
    source.naturalFaceSize = faceCells + 1;
    source.missingCount = statistics.missingCount;
    const auto fillM = static_cast<float>(settings.fillM);
    const auto shared = std::make_shared<const Rasters>(
        Rasters{std::move(areas), std::min(statistics.minM, fillM), std::max(statistics.maxM, fillM), fillM});
    source.minM = static_cast<double>(shared->minM);
    source.maxM = static_cast<double>(shared->maxM);
    source.finestCells = [shared](const ChunkId& square) {
        int cells = 1;
        for (const RasterArea& area : shared->areas) cells = std::max(cells, finestCellsIn(area, square));
        return cells;
    };
    source.sample = [shared](const SampleTile& tile, std::span<float> out) {
        return sampleInPieces(tile, rasterPieceSide, out,
                              [&](const SampleTile& piece, float* to, std::size_t stride) {
                                  return samplePiece(*shared, piece, to, stride);
                              });
    };
    return source;
}

}  // namespace planet
