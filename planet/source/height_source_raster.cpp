// Samples georeferenced rasters of any projection: one file, or several that a pattern lists. Rasters on one grid
// are joined; where rasters of different grids overlap, the finest lies on top.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/raster/gdal_raster.h"
#include "planet/raster/spilled_raster.h"
#include "planet/source/height_quanta.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/layer_readings.h"
#include "planet/source/raster_parts.h"
#include "planet/source/raster_sampling.h"
#include "planet/source/sample_tiles.h"
#include "planet/source/source_parts.h"
#include "planet/source/whole_layer.h"

namespace planet {

namespace {

constexpr int rasterPieceSide = 65;    // samples per side of a piece of a tile
constexpr std::size_t mostNamed = 10;  // broken files in a message

struct Rasters {
    std::vector<RasterArea> areas;  // the finest first
    float minM = 0;
    float maxM = 0;
    float fillM = 0;
};

// needed: where the quanta that the heights need are wanted, for the same places as out; else null.
Result<void> samplePiece(const Rasters& rasters, const SampleTile& piece, double radiusM, float* out,
                         float* needed, std::size_t stride) {
    std::vector<float> heights(samplesIn(piece), std::numeric_limits<float>::quiet_NaN());
    std::vector<float> quanta(needed ? heights.size() : 0, static_cast<float>(noQuantumM));
    const PiecePlaces places(piece);
    for (const RasterArea& area : rasters.areas) {
        const PlacesOnGrid onGrid = placesOnGrid(area, places);
        const auto quantum = static_cast<float>(quantumOf(area, radiusM));
        const auto isNew = [&](std::size_t i) { return std::isnan(heights[i]); };
        std::vector<std::size_t> open;
        if (needed) std::ranges::copy_if(onGrid.index, std::back_inserter(open), isNew);
        TRY(fillFrom(area, places, onGrid, heights));
        for (const std::size_t i : open) {
            if (!isNew(i)) quanta[i] = quantum;
        }
    }
    const auto columns = static_cast<std::size_t>(piece.columns);
    for (std::size_t row = 0; row < static_cast<std::size_t>(piece.rows); ++row) {
        const float* const from = &heights[row * columns];
        for (std::size_t i = 0; i < columns; ++i)
            out[row * stride + i] =
                std::isnan(from[i]) ? rasters.fillM : std::clamp(from[i], rasters.minM, rasters.maxM);
        if (needed) std::copy_n(&quanta[row * columns], columns, needed + row * stride);
    }
    return {};
}

std::string describe(const std::filesystem::path& path, const std::vector<RasterArea>& areas) {
    // A list of files is named after the first one.
    const std::string text = path.string();
    return aboutRasters(std::filesystem::path(text.substr(0, text.find('|'))).filename().string(), areas);
}

// Returns the reading of the finest raster that has a height at a place, or else of the finest one that lies there.
Result<SourceReading> readingOf(const Rasters& rasters, const Geographic& place) {
    SourceReading reading;
    const PiecePlaces places(place);
    for (const RasterArea& area : rasters.areas) {
        const PlacesOnGrid onGrid = placesOnGrid(area, places);
        if (onGrid.index.empty()) continue;
        TRY_ASSIGN(auto sample, readSample(area, onGrid));
        if (!sample.isVoid) return sample;
        if (reading.file.empty()) reading = std::move(sample);
    }
    return reading;
}

struct BrokenFile {
    std::size_t number = 0;
    Error error;
};

// An open raster, and the number of its file.
struct OpenRaster {
    std::shared_ptr<const Raster> raster;
    std::size_t number = 0;
};

// Returns the Error of the first broken file, with the names of up to ten.
Error errorOf(const std::vector<std::filesystem::path>& files, const std::vector<BrokenFile>& broken) {
    Error error = broken[0].error;
    if (files.size() == 1) return error;
    std::string names;
    for (std::size_t i = 0; i < broken.size() && i < mostNamed; ++i)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", files[broken[i].number].filename().string());
    if (broken.size() > mostNamed) names += fmt::format(" and {} more", broken.size() - mostNamed);
    error.message += fmt::format("; {} of {} files {} broken ({}); --skip-broken leaves {} out",
                                 broken.size(), files.size(), broken.size() == 1 ? "is" : "are", names,
                                 broken.size() == 1 ? "it" : "them");
    return error;
}

// Opens rasters. PROJ must know the way to each reference system.
Result<std::vector<OpenRaster>> openRasters(
    const std::vector<std::filesystem::path>& files,
    const std::function<Result<std::shared_ptr<const Raster>>(std::size_t)>& open,
    const HeightSourceSettings& settings, std::vector<BrokenFile>& broken) {
    std::vector<OpenRaster> rasters;
    std::set<std::string> known;
    TemporarySpace space(settings.fileCalls);
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (settings.stop.stop_requested()) return cancelled();
        const Result<std::shared_ptr<const Raster>> opened = open(i);
        if (!opened) {
            broken.push_back({i, opened.error()});
            continue;
        }
        TRY_ASSIGN(const auto raster, inSmallBlocks(*opened, settings.cacheBytes, space));
        const RasterLayout& layout = raster->layout();
        if (!known.contains(layout.crs)) {
            const auto placement = RasterPlacement::make(files[i].string(), {layout.x, layout.y, layout.crs});
            if (!placement) {
                broken.push_back({i, placement.error()});
                continue;
            }
            known.insert(layout.crs);
        }
        rasters.push_back({raster, i});
    }
    return rasters;
}

// Says of a raster with heights that none of them lies on the planet.
Error liesNowhere(const Raster& raster) {
    return {ErrorKind::BadInput,
            fmt::format(
                "{}: lies nowhere on the planet by its coordinates in {}; expected longitude and latitude "
                "in [-180, 180] and [-90, 90] degrees",
                raster.path().string(), raster.layout().crsName)};
}

// Joins and surveys rasters. Moves those that cannot be read or lie nowhere to the broken ones.
Result<std::vector<RasterArea>> surveyed(std::vector<OpenRaster>& rasters,
                                         const std::shared_ptr<MosaicCache>& cache,
                                         const HeightSourceSettings& settings,
                                         std::vector<BrokenFile>& broken) {
    std::vector<std::shared_ptr<const Raster>> whole;
    for (const OpenRaster& raster : rasters) whole.push_back(raster.raster);
    TRY_ASSIGN(auto mosaics, RasterMosaic::join(whole, cache));
    std::vector<RasterArea> areas;
    for (RasterMosaic& mosaic : mosaics) {
        AreaSurvey survey = surveyArea(std::move(mosaic), settings.stop, settings.share.get());
        if (settings.stop.stop_requested()) return cancelled();
        const std::vector<RasterMosaic::Tile>& tiles = survey.area.mosaic.tiles();
        const auto remove = [&](std::size_t tile, Error error) {
            const auto found = std::ranges::find(rasters, tiles[tile].raster, &OpenRaster::raster);
            broken.push_back({found->number, std::move(error)});
            rasters.erase(found);
        };
        const bool hasHeights = survey.area.statistics.missingCount < survey.area.sampleCount;
        if (survey.broken.empty() && hasHeights && survey.area.covered.indices.empty()) {
            for (std::size_t tile = 0; tile < tiles.size(); ++tile)
                remove(tile, liesNowhere(*tiles[tile].raster));
        }
        for (auto& [tile, error] : survey.broken) remove(tile, std::move(error));
        areas.push_back(std::move(survey.area));
    }
    return areas;
}

}  // namespace

std::string skippedText(std::size_t count) {
    return count == 0 ? "" : fmt::format(", {} file{} skipped", count, count == 1 ? "" : "s");
}

Result<RasterAreas> openRasterAreas(
    const std::vector<std::filesystem::path>& files, const HeightSourceSettings& settings,
    const std::shared_ptr<MosaicCache>& cache,
    const std::function<Result<std::shared_ptr<const Raster>>(std::size_t)>& open) {
    RasterAreas found;
    std::vector<BrokenFile> broken;
    TRY_ASSIGN(auto rasters, openRasters(files, open, settings, broken));
    // Without the broken rasters, the others are joined and surveyed again.
    for (bool done = rasters.empty(); !done;) {
        const std::size_t count = rasters.size();
        TRY_ASSIGN(found.areas, surveyed(rasters, cache, settings, broken));
        done = rasters.size() == count || rasters.empty() || !settings.skipBroken;
    }
    std::ranges::sort(broken, {}, &BrokenFile::number);
    if (!broken.empty() && !settings.skipBroken) return tl::unexpected(errorOf(files, broken));
    if (rasters.empty()) found.areas.clear();
    for (const BrokenFile& file : broken) found.skipped.push_back(file.error.message);
    std::ranges::stable_sort(found.areas, std::greater(), &RasterArea::samplesPerRad);
    return found;
}

Result<RasterAreas> openRasterAreas(const std::vector<std::filesystem::path>& files,
                                    const HeightSourceSettings& settings,
                                    const std::shared_ptr<MosaicCache>& cache) {
    return openRasterAreas(files, settings, cache,
                           [&](std::size_t i) { return GdalRaster::open(files[i], settings); });
}

Result<HeightSource> openRasterSource(const std::filesystem::path& path,
                                      const std::vector<std::filesystem::path>& files,
                                      const HeightSourceSettings& settings) {
    if (files.size() > mostRasters) {
        return badInput(fmt::format("{}: matches {} files; expected at most {}", path.string(), files.size(),
                                    mostRasters));
    }
    TRY_ASSIGN(auto opened,
               openRasterAreas(files, settings, std::make_shared<MosaicCache>(settings.cacheBytes)));
    std::vector<RasterArea>& areas = opened.areas;
    if (areas.empty()) {
        return badInput(fmt::format("{}; all {} files are broken; expected some that can be read",
                                    opened.skipped[0], files.size()));
    }
    ToldDatum told;
    for (const RasterArea& area : areas) {
        for (const RasterMosaic::Tile& tile : area.mosaic.tiles())
            TRY(told.add(*tile.raster, "files of one datum, or a world file with a datum for each layer"));
    }
    HeightSource source;
    source.description = describe(path, areas) + skippedText(opened.skipped.size());
    source.skipped = std::move(opened.skipped);
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
    SourceLayer layer = rasterLayer(source.description.substr(0, source.description.find(", ")), areas);
    layer.skipped = source.skipped;
    const auto shared = std::make_shared<const Rasters>(
        Rasters{std::move(areas), std::min(statistics.minM, fillM), std::max(statistics.maxM, fillM), fillM});
    source.minM = static_cast<double>(shared->minM);
    source.maxM = static_cast<double>(shared->maxM);
    source.parts = [shared,
                    hash = hashOf(settings)](double filterSpacingRad) -> Result<std::vector<SourcePart>> {
        std::vector<SourcePart> parts{wholePlanet(Fingerprint().add(shared->fillM).hash(), {0, 0})};
        for (const RasterArea& area : shared->areas)
            TRY(appendParts(area, hash, {.filterSpacingRad = filterSpacingRad}, parts));
        return parts;
    };
    auto layers = std::make_shared<SourceLayers>(*singleLayer(
        std::move(layer), [shared](const Geographic& place) { return readingOf(*shared, place); }));
    layers->fillM = settings.fillM;
    source.layers = std::move(layers);
    source.finestCells = [shared](const ChunkId& square) {
        int cells = 1;
        for (const RasterArea& area : shared->areas) cells = std::max(cells, finestCellsIn(area, square));
        return cells;
    };
    source.reads = [shared] {
        SourceReads reads;
        for (const RasterArea& area : shared->areas) {
            reads.samples += area.sampleCount;
            reads.read += area.mosaic.samplesRead();
        }
        return reads;
    };
    source.sample = [shared](const SampleTile& tile, std::span<float> out) {
        return sampleInPieces(tile, rasterPieceSide, out,
                              [&](const SampleTile& piece, float* to, std::size_t stride) {
                                  return samplePiece(*shared, piece, 0, to, nullptr, stride);
                              });
    };
    source.finestQuantumM = [shared](double radiusM) {
        double finestM = noQuantumM;
        for (const RasterArea& area : shared->areas) finestM = std::min(finestM, quantumOf(area, radiusM));
        return finestM;
    };
    source.sampleWithQuanta = [shared](const SampleTile& tile, double radiusM, std::span<float> out,
                                       std::span<float> neededM) {
        return sampleInPieces(tile, rasterPieceSide, out,
                              [&](const SampleTile& piece, float* to, std::size_t stride) {
                                  float* const needed = neededM.data() + (to - out.data());
                                  return samplePiece(*shared, piece, radiusM, to, needed, stride);
                              });
    };
    return source;
}

}  // namespace planet
