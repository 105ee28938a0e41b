#include "planet/source/height_source.h"

#include <fmt/format.h>

#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <system_error>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/raster/gdal_formats.h"
#include "planet/raster/gdal_raster.h"
#include "planet/raster/image_formats.h"
#include "planet/raster/image_names.h"
#include "planet/raster/image_placement.h"
#include "planet/raster/raster_placement.h"
#include "planet/source/height_quanta.h"
#include "planet/source/height_source_kinds.h"
#include "planet/source/source_parts.h"
#include "planet/source/terrain.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

namespace {

constexpr double mostM = 1e9;  // larger heights and steps are invalid

Result<void> checkSettings(const HeightSourceSettings& settings) {
    // The comparison is written so that NaN fails too.
    const double metresPerUnit = settings.metresPerUnit.value_or(1);
    if (!(std::abs(metresPerUnit) > 0 && std::abs(metresPerUnit) <= mostM)) {
        return badInput(fmt::format("metresPerUnit is {}; expected a magnitude over 0, at most {}",
                                    metresPerUnit, mostM));
    }
    const double offsetM = settings.offsetM.value_or(0);
    if (!(std::abs(offsetM) <= mostM)) {
        return badInput(fmt::format("offsetM is {}; expected at most {} in magnitude", offsetM, mostM));
    }
    if (!(std::abs(settings.fillM) <= mostM)) {
        return badInput(fmt::format("fillM is {}; expected at most {} in magnitude", settings.fillM, mostM));
    }
    if (settings.rawBits && *settings.rawBits != 8 && *settings.rawBits != 16) {
        return badInput(fmt::format("rawBits is {}; expected 8 or 16", *settings.rawBits));
    }
    if (settings.rawSize && *settings.rawSize < 2) {
        return badInput(
            fmt::format("rawSize is {}; expected at least 2 samples per side", *settings.rawSize));
    }
    return {};
}

bool asRead(const HeightSourceSettings& settings) {
    const HeightSourceSettings plain;
    return !settings.metresPerUnit && !settings.offsetM && !settings.noDataValue &&
           settings.fillM == plain.fillM && !settings.rawSize && !settings.rawBits && !settings.rawSigned &&
           !settings.rawBigEndian;
}

Result<HeightSource> openTerrain(const std::filesystem::path& text, const HeightSourceSettings& settings) {
    TRY_ASSIGN(const auto terrain, terrainFromText(text));
    const auto* const detail = std::get_if<DetailTerrain>(&terrain.settings);
    if (!detail) {
        if (asRead(settings)) return makeTerrain(terrain.settings);
        return badInput(
            fmt::format("{}: is procedural terrain, so units, offset, no-data value, fill and raw formats do "
                        "not apply; expected settings in its own text, such as offset_m=100",
                        text.string()));
    }
    Result<HeightSource> source = openHeightSource(terrain.of, settings);
    if (!source) return source;
    std::vector<std::string> skipped = source->skipped;
    Result<HeightSource> result = amplified(*std::move(source), *detail);
    if (result) result->skipped = std::move(skipped);
    // The description must be enough to open the source again.
    if (result) result->description = wholeTerrainText(text).value_or(result->description);
    return result;
}

// Returns whether a raster surely covers less than the whole planet: from its middle to the middle of its left edge is less
// than a quarter of the way around. OpenImageIO, which takes long to load, need not be asked then.
bool isPartOfPlanet(const Raster& raster) {
    const RasterLayout& layout = raster.layout();
    const auto placement = RasterPlacement::make(raster.path().string(), {layout.x, layout.y, layout.crs});
    if (!placement) return false;
    const double middleRow = (layout.height - 1) / 2.0;
    const std::array columns = {(layout.width - 1) / 2.0, -0.5};
    const std::array rows = {middleRow, middleRow};
    std::array<double, 2> longitudes{};
    std::array<double, 2> latitudes{};
    placement->toPlanet(columns, rows, longitudes, latitudes);
    // False for places that are not finite.
    return glm::dot(directionFromGeographic({latitudes[0], longitudes[0]}),
                    directionFromGeographic({latitudes[1], longitudes[1]})) > 0;
}

// Opens an image: one of the whole planet by OpenImageIO, any other that has a position on the planet by GDAL, which
// alone knows masks and alpha.
Result<HeightSource> openImage(const std::filesystem::path& path, const HeightSourceSettings& settings) {
    if (isRawImage(path)) {
        return badInput(
            fmt::format("{}: is a headerless file without a position; expected six cube faces, or a layer of "
                        "a world file "
                        "with place = {{lat = 46.5, lon = 8.0, width_m = 8192}}",
                        path.string()));
    }
    const auto raster = openGeoreferenced(path, settings);
    if (raster && isPartOfPlanet(*raster)) return openRasterSource(path, {path}, settings);
    const Result<std::shared_ptr<ImageFile>> image = ImageFile::open(path, settings.colourChannel);
    const auto placement = image.and_then([&](const std::shared_ptr<ImageFile>& file) {
        const ImageLayout& layout = file->layout();
        return placementOf(path.string(), layout.width, layout.height, layout.geoTags);
    });
    if (placement) {
        if (!raster || !raster->hidesSamples()) return openEquirectangularSource(path, settings);
    } else if (!isGdalRaster(path)) {
        return openEquirectangularSource(path, settings);
    }
    Result<HeightSource> placed = openRasterSource(path, {path}, settings);
    // Without a position, what matters is what the image lacks to be one of the whole planet.
    const bool hasPosition = image ? (*image)->layout().geoTags.placement.has_value()
                                   : !isImageExtension(path.extension().string()) || isPlacedBand(path);
    return placed || hasPosition ? placed : tl::unexpected(placement.error());
}

}  // namespace

bool coversPlanet(const std::filesystem::path& path, const HeightSourceSettings& settings) {
    if (findFaceFiles(path)) return true;
    const auto raster = openGeoreferenced(path, settings);
    if (raster && isPartOfPlanet(*raster)) return false;
    const auto image = ImageFile::open(path, settings.colourChannel);
    if (!image) return false;
    const ImageLayout& layout = (*image)->layout();
    return placementOf(path.string(), layout.width, layout.height, layout.geoTags).has_value();
}

std::shared_ptr<const GdalRaster> openGeoreferenced(const std::filesystem::path& path,
                                                    const HeightSourceSettings& settings) {
    if (!isGdalRaster(path)) return nullptr;
    return GdalRaster::open(path, settings).value_or(nullptr);
}

bool isGeoreferenced(const std::filesystem::path& file) {
    return openGeoreferenced(file, {}) != nullptr;
}

namespace {

// Returns the one part of an image, cube faces or a terrain text.
std::function<Result<std::vector<SourcePart>>(double)> wholeSource(const std::filesystem::path& path,
                                                                   const HeightSourceSettings& settings,
                                                                   const SampleDensities& densities) {
    return [path, settings = hashOf(settings), densities](double) -> Result<std::vector<SourcePart>> {
        const HeightSourceFiles source = heightSourceFiles(path);
        Fingerprint fingerprint;
        // Files count by their content; without any, the path is the text of a terrain.
        if (source.files.empty()) fingerprint.add(path.string());
        TRY_ASSIGN(const auto files, hashOfFiles(source.files));
        fingerprint.add(files).add(settings);
        return std::vector{wholePlanet(fingerprint.hash(), densities)};
    };
}

Result<HeightSource> openAnySource(const std::filesystem::path& path, const HeightSourceSettings& settings) {
    if (isTerrainText(path)) return openTerrain(path, settings);
    if (isWorldFile(path)) {
        if (asRead(settings)) return openWorld(path, settings);
        return badInput(fmt::format(
            "{}: is a world file, so units, offset, no-data value, fill and raw formats do not apply; "
            "expected scale, offset_m and voids in its layers, and fill_m",
            path.string()));
    }
    if (isFilePattern(path)) {
        const std::vector<std::filesystem::path> files = filesOfPattern(path);
        if (files.empty()) return ioError(fmt::format("{}: no file matches this pattern", path.string()));
        return openRasterSource(path, files, settings);
    }
    if (const std::optional<FaceFiles> faces = findFaceFiles(path)) {
        // Lossy pictures differ slightly along their edges, which is not an error for colours.
        const FaceEdges edges = settings.colourChannel ? FaceEdges::MayDiffer : FaceEdges::MustAgree;
        return openFaceSource(*faces, settings, edges);
    }
    std::error_code problem;
    if (!std::filesystem::exists(path, problem)) {
        return ioError(fmt::format("{}: no such file, and no cube faces named {}_x_pos.raw or similar",
                                   path.string(), path.string()));
    }
    return openImage(path, settings);
}

}  // namespace

Result<HeightSource> openHeightSource(const std::filesystem::path& path,
                                      const HeightSourceSettings& settings) {
    TRY(checkSettings(settings));
    Result<HeightSource> source = openAnySource(path, settings);
    // Rasters, worlds and detail have parts of their own; anything else is one.
    if (source && !source->parts) source->parts = wholeSource(path, settings, source->densities);
    if (source && source->memoryBytes == 0)
        source->memoryBytes = cachedBytes(source->sampleCount, settings.cacheBytes);
    if (source && !source->finestQuantumM && source->sampleCount > 0) {
        const double spacingRad = std::numbers::pi / 2 / (source->naturalFaceSize - 1);
        source->finestQuantumM = [stepM = source->stepM, spacingRad](double radiusM) {
            return neededQuantumM(stepM, spacingRad * radiusM);
        };
    }
    return source;
}

}  // namespace planet
