// The kinds of height source behind openHeightSource, and their shared parts. Internal to the library.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "planet/base/result.h"
#include "planet/source/geo_tags.h"
#include "planet/source/height_raster.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

// Opens an image, which must show the whole planet (image_placement.h).
Result<HeightSource> openEquirectangularSource(const std::filesystem::path& path,
                                               const HeightSourceSettings& settings);

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

// Returns the conversion by the settings or, if they are unset, by the file's tags. The Error names an
// unknown unit.
Result<HeightConversion> conversionFor(const std::string& file, const HeightSourceSettings& settings,
                                       SampleType type, const GeoTags& tags);

// Sets stepM, minM, maxM and missingCount.
void describeHeights(HeightSource& source, const HeightConversion& conversion,
                     const HeightStatistics& statistics);

// Returns the smallest 2^n with 2^n >= count, up to 2^maxFaceCellsLog2.
int powerOfTwoCells(double count);

}  // namespace planet
