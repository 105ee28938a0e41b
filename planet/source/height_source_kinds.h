// The kinds of height source behind openHeightSource, and what they share. Internal to the library.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "planet/base/result.h"
#include "planet/source/geo_tags.h"
#include "planet/source/height_raster.h"
#include "planet/source/height_source_types.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

// The image must show the whole planet (image_placement.h).
Result<HeightSource> openEquirectangularSource(const std::filesystem::path& path,
                                               const HeightSourceSettings& settings);

// Six files named [name][size]_[face].[ext], in the order of allFaces; some may be missing.
struct FaceFiles {
    std::string stem;               // "earth4097"
    std::string extension;          // ".raw"
    std::optional<int> sizeInName;  // 4097: the digits that the stem ends in
    std::array<std::filesystem::path, faceCount> paths;
};

// The six faces that a path names one of, or names the common stem of; none where it does neither.
std::optional<FaceFiles> findFaceFiles(const std::filesystem::path& path);

// MustAgree, for heights: faces that differ along their shared edges by more than rounding are an Error.
// MayDiffer, for colours: faces that differ visibly there get a notice.
enum class FaceEdges : std::uint8_t { MustAgree, MayDiffer };
Result<HeightSource> openFaceSource(const FaceFiles& files, const HeightSourceSettings& settings,
                                    FaceEdges edges);

// What the kinds share.
// tags: what the file says of its no-data value, scale, offset and unit, where the settings say nothing. The
// Error names a unit that is not known.
Result<HeightConversion> conversionFor(const std::string& file, const HeightSourceSettings& settings,
                                       SampleType type, const GeoTags& tags);

// Sets stepM, minM, maxM and missingCount.
void describeHeights(HeightSource& source, const HeightConversion& conversion,
                     const HeightStatistics& statistics);

// A tile in square pieces of side samples at most, so that each needs little memory. samplePiece(piece, to,
// stride) fills the piece's samples from to on, its rows stride floats apart; its first Error ends it.
template <class SamplePiece>
Result<void> sampleInPieces(const SampleTile& tile, int side, std::span<float> out,
                            const SamplePiece& samplePiece) {
    const auto stride = static_cast<std::size_t>(tile.columns);
    for (int row = 0; row < tile.rows; row += side) {
        for (int column = 0; column < tile.columns; column += side) {
            SampleTile piece = tile;
            piece.firstColumn += column;
            piece.firstRow += row;
            piece.columns = std::min(side, tile.columns - column);
            piece.rows = std::min(side, tile.rows - row);
            float* const to =
                out.data() + static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column);
            if (Result<void> done = samplePiece(piece, to, stride); !done) return done;
        }
    }
    return {};
}

// The smallest 2^n with 2^n >= count, up to 2^maxFaceCellsLog2.
int powerOfTwoCells(double count);

}  // namespace planet
