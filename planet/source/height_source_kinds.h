// The kinds of height source behind openHeightSource, and their shared parts. Internal to the library.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planet/base/result.h"
#include "planet/raster/geo_tags.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/raster_area.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

class GdalRaster;

// Opens an image, which must show the whole planet (image_placement.h).
Result<HeightSource> openEquirectangularSource(const std::filesystem::path& path,
                                               const HeightSourceSettings& settings);

// Opens georeferenced rasters of any projection (gdal_raster.h). path: for messages and the description; it names
// the one file, or is the pattern that lists the files.
Result<HeightSource> openRasterSource(const std::filesystem::path& path,
                                      const std::vector<std::filesystem::path>& files,
                                      const HeightSourceSettings& settings);

// The areas of rasters, those with the most samples in a radian first.
struct RasterAreas {
    std::vector<RasterArea> areas;     // none if all files were skipped
    std::vector<std::string> skipped;  // as in HeightSource
};
Result<RasterAreas> openRasterAreas(const std::vector<std::filesystem::path>& files,
                                    const HeightSourceSettings& settings,
                                    const std::shared_ptr<MosaicCache>& cache);
// The same for rasters that open() opens by their number; files are for messages.
Result<RasterAreas> openRasterAreas(
    const std::vector<std::filesystem::path>& files, const HeightSourceSettings& settings,
    const std::shared_ptr<MosaicCache>& cache,
    const std::function<Result<std::shared_ptr<const Raster>>(std::size_t)>& open);

// Returns ", 1 file skipped" for a description; empty if none was.
std::string skippedText(std::size_t count);

// Returns whether a path names an image of the whole planet or six cube faces.
bool coversPlanet(const std::filesystem::path& path, const HeightSourceSettings& settings);

// Opens a file as a georeferenced raster; null if it is none.
std::shared_ptr<const GdalRaster> openGeoreferenced(const std::filesystem::path& path,
                                                    const HeightSourceSettings& settings);

// Opens a world file (world_file.h).
Result<HeightSource> openWorld(const std::filesystem::path& path, const HeightSourceSettings& settings);

// Returns whether a path has wildcards (*, ?, [a-z]) or lists files (a.tif|b.tif), and names no file itself.
bool isFilePattern(const std::filesystem::path& path);
// Returns the files that match a pattern, in the order of the bytes of their names; those of a list in the order of its
// parts, each of which may be a pattern.
std::vector<std::filesystem::path> filesOfPattern(const std::filesystem::path& pattern);

// Six files named [name][size]_[face].[ext], in the order of allFaces; some may be missing.
struct FaceFiles {
    std::string stem;               // "earth4097"
    std::string extension;          // ".raw"
    std::optional<int> sizeInName;  // 4097: the digits at the end of the stem
    std::array<std::filesystem::path, faceCount> paths;
};

// Finds the six faces if a path names one of them or their common stem; otherwise returns nothing.
std::optional<FaceFiles> findFaceFiles(const std::filesystem::path& path);

// MustAgree, for heights: it is an Error if faces differ along their shared edges by more than rounding.
// MayDiffer, for colours: a visible difference gives a notice.
enum class FaceEdges : std::uint8_t { MustAgree, MayDiffer };
Result<HeightSource> openFaceSource(const FaceFiles& files, const HeightSourceSettings& settings,
                                    FaceEdges edges);

// Returns the memory that a cache of samples fills.
inline std::uint64_t cachedBytes(std::uint64_t samples, std::size_t mostBytes) {
    return std::min<std::uint64_t>(samples * sizeof(float), mostBytes);
}

// Sets stepM, minM, maxM and missingCount.
void describeHeights(HeightSource& source, const HeightConversion& conversion,
                     const HeightStatistics& statistics);

}  // namespace planet
