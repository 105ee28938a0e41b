#include "planet/colour_tile.h"

#include <fmt/format.h>
#include <squish.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <glm/vec3.hpp>

#include "planet/face_fold.h"

#define STB_DXT_IMPLEMENTATION
#include <stb/stb_dxt.h>

namespace planet {

namespace {

constexpr auto sideTexels = static_cast<std::size_t>(colourTileTexels);
constexpr std::size_t texelCount = sideTexels * sideTexels;
constexpr std::size_t blockSide = 4;
constexpr std::size_t blockTexels = blockSide * blockSide;
constexpr std::size_t bc1BlockBytes = 8;
constexpr std::size_t halfBlockBytes = bc1BlockBytes / 2;
constexpr int zstdLevel = 9;

// The sRGB transfer function (IEC 61966-2-1), to the nearest of 256.
std::uint8_t srgbByFormula(float linear) {
    const double value = std::clamp(static_cast<double>(linear), 0.0, 1.0);
    const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

// The same by a table, which takes a tenth of the time: what a float's exponent and first seven bits are at
// least, and from where on each value is the next one.
class SrgbTable {
public:
    SrgbTable() {
        for (std::size_t i = 0; i < atLeast_.size(); ++i)
            atLeast_[i] = srgbByFormula(std::bit_cast<float>(static_cast<std::uint32_t>(i) << dropped));
        for (std::size_t value = 1; value < from_.size(); ++value) {
            std::uint32_t below = 0;  // positive floats are in the order of their bits
            std::uint32_t from = std::bit_cast<std::uint32_t>(1.0f);
            while (from - below > 1) {
                const std::uint32_t middle = below + (from - below) / 2;
                (srgbByFormula(std::bit_cast<float>(middle)) < value ? below : from) = middle;
            }
            from_[value] = std::bit_cast<float>(from);
        }
    }

    std::uint8_t operator()(float linear) const {
        if (!(linear > 0)) return 0;
        if (linear >= 1) return 255;
        std::uint8_t value = atLeast_[std::bit_cast<std::uint32_t>(linear) >> dropped];
        while (value < 255 && linear >= from_[value + 1u]) ++value;
        return value;
    }

private:
    static constexpr int dropped = 16;                                  // bits
    std::array<std::uint8_t, (0x3F800000u >> dropped) + 1> atLeast_{};  // up to 1
    std::array<float, 256> from_{};  // the smallest that is each value, or more
};

std::uint8_t srgbFromLinear(float linear) {
    static const SrgbTable table;
    return table(linear);
}

// Texels of a tile's square, by their columns and rows on the face's grid.
struct TexelSquare {
    Face face;
    int cells;  // of the face
    int firstColumn;
    int firstRow;
    std::vector<glm::vec3> texels;

    glm::vec3& at(int column, int row) {
        return texels[static_cast<std::size_t>(row - firstRow) * sideTexels +
                      static_cast<std::size_t>(column - firstColumn)];
    }
};

// The part of a tile's columns or rows that lies before, on and beyond its face: [begin, end) each.
struct TexelRun {
    int begin;
    int end;
};
std::array<TexelRun, 3> spansOf(int first, int cells) {
    const int end = first + colourTileTexels;
    const int onFace = std::clamp(0, first, end);
    const int beyond = std::clamp(cells + 1, first, end);
    return {{{first, onFace}, {onFace, beyond}, {beyond, end}}};
}

Result<void> fillOnFace(const ColourSource& source, TexelRun columns, TexelRun rows, TexelSquare& square) {
    const SampleTile tile{
        square.face,          square.cells, columns.begin, rows.begin, columns.end - columns.begin,
        rows.end - rows.begin};
    std::vector<glm::vec3> colours(static_cast<std::size_t>(tile.columns) *
                                   static_cast<std::size_t>(tile.rows));
    if (auto sampled = source.sample(tile, colours); !sampled) return sampled;
    auto from = colours.begin();
    for (int row = rows.begin; row < rows.end; ++row, from += tile.columns)
        std::copy_n(from, tile.columns, &square.at(columns.begin, row));
    return {};
}

// Columns or rows are over one edge of the face.
Result<void> fillBeyondEdge(const ColourSource& source, TexelRun columns, TexelRun rows,
                            TexelSquare& square) {
    if (columns.begin == columns.end || rows.begin == rows.end) return {};
    const auto folded = [&](int column, int row) {
        return foldedOver({square.face, column, row}, square.cells);
    };
    const FaceGridPoint one = folded(columns.begin, rows.begin);
    const FaceGridPoint other = folded(columns.end - 1, rows.end - 1);
    const SampleTile tile{one.face,
                          square.cells,
                          std::min(one.column, other.column),
                          std::min(one.row, other.row),
                          std::abs(one.column - other.column) + 1,
                          std::abs(one.row - other.row) + 1};
    std::vector<glm::vec3> colours(static_cast<std::size_t>(tile.columns) *
                                   static_cast<std::size_t>(tile.rows));
    if (auto sampled = source.sample(tile, colours); !sampled) return sampled;
    for (int row = rows.begin; row < rows.end; ++row) {
        for (int column = columns.begin; column < columns.end; ++column) {
            const FaceGridPoint place = folded(column, row);
            square.at(column, row) = colours[static_cast<std::size_t>(place.row - tile.firstRow) *
                                                 static_cast<std::size_t>(tile.columns) +
                                             static_cast<std::size_t>(place.column - tile.firstColumn)];
        }
    }
    return {};
}

// Beyond a corner of the cube there is no fourth face: the corner's own colour.
void fillBeyondCorner(TexelRun columns, TexelRun rows, TexelSquare& square) {
    for (int row = rows.begin; row < rows.end; ++row) {
        for (int column = columns.begin; column < columns.end; ++column)
            square.at(column, row) =
                square.at(std::clamp(column, 0, square.cells), std::clamp(row, 0, square.cells));
    }
}

Result<void> fill(const ColourSource& source, TexelSquare& square) {
    const std::array<TexelRun, 3> columns = spansOf(square.firstColumn, square.cells);
    const std::array<TexelRun, 3> rows = spansOf(square.firstRow, square.cells);
    if (auto filled = fillOnFace(source, columns[1], rows[1], square); !filled) return filled;
    for (const std::size_t outside : {0u, 2u}) {
        if (auto filled = fillBeyondEdge(source, columns[outside], rows[1], square); !filled) return filled;
        if (auto filled = fillBeyondEdge(source, columns[1], rows[outside], square); !filled) return filled;
        for (const std::size_t above : {0u, 2u}) fillBeyondCorner(columns[outside], rows[above], square);
    }
    return {};
}

// One plane after the other, each texel as its difference from what those before it foretell (the median
// predictor of LOCO-I, Weinberger et al. 2000); red and blue as differences from green.
int foretold(const std::vector<std::uint8_t>& plane, std::size_t i) {
    const bool firstColumn = i % sideTexels == 0;
    const bool firstRow = i < sideTexels;
    const int west = firstColumn ? 0 : plane[i - 1];
    const int south = firstRow ? 0 : plane[i - sideTexels];
    if (firstColumn) return south;
    if (firstRow) return west;
    const int corner = plane[i - sideTexels - 1];
    return std::clamp(west + south - corner, std::min(west, south), std::max(west, south));
}

std::vector<std::uint8_t> planesOf(std::span<const std::byte> texels) {
    std::vector<std::uint8_t> residuals;
    residuals.reserve(3 * texelCount);
    std::vector<std::uint8_t> plane(texelCount);
    for (const std::size_t channel : {1u, 0u, 2u}) {
        for (std::size_t i = 0; i < texelCount; ++i) {
            const int green = channel == 1 ? 0 : std::to_integer<int>(texels[3 * i + 1]);
            plane[i] = static_cast<std::uint8_t>(std::to_integer<int>(texels[3 * i + channel]) - green);
        }
        for (std::size_t i = 0; i < texelCount; ++i)
            residuals.push_back(static_cast<std::uint8_t>(plane[i] - foretold(plane, i)));
    }
    return residuals;
}

std::vector<std::byte> texelsOfPlanes(std::span<const std::uint8_t> residuals) {
    std::vector<std::byte> texels(3 * texelCount);
    std::vector<std::uint8_t> plane(texelCount);
    for (const std::size_t channel : {1u, 0u, 2u}) {
        for (std::size_t i = 0; i < texelCount; ++i)
            plane[i] = static_cast<std::uint8_t>(residuals[i] + foretold(plane, i));
        residuals = residuals.subspan(texelCount);
        for (std::size_t i = 0; i < texelCount; ++i) {
            const int green = channel == 1 ? 0 : std::to_integer<int>(texels[3 * i + 1]);
            texels[3 * i + channel] = static_cast<std::byte>(plane[i] + green);
        }
    }
    return texels;
}

std::array<unsigned char, 4 * blockTexels> blockAt(std::span<const std::uint8_t> rgb, std::size_t column,
                                                   std::size_t row) {
    std::array<unsigned char, 4 * blockTexels> rgba;
    rgba.fill(255);
    for (std::size_t i = 0; i < blockTexels; ++i) {
        const std::size_t texel = (row + i / blockSide) * sideTexels + column + i % blockSide;
        std::copy_n(&rgb[3 * texel], 3, &rgba[4 * i]);
    }
    return rgba;
}

// Colours first, then indices: each is more like its own kind.
std::vector<std::uint8_t> halvesOf(std::span<const std::byte> blocks) {
    std::vector<std::uint8_t> halves(blocks.size());
    const std::size_t middle = blocks.size() / 2;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const std::size_t half = i % bc1BlockBytes / halfBlockBytes * middle;
        halves[half + i / bc1BlockBytes * halfBlockBytes + i % halfBlockBytes] =
            std::to_integer<std::uint8_t>(blocks[i]);
    }
    return halves;
}

std::vector<std::byte> blocksOfHalves(std::span<const std::uint8_t> halves) {
    std::vector<std::byte> blocks(halves.size());
    const std::size_t middle = halves.size() / 2;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const std::size_t half = i % bc1BlockBytes / halfBlockBytes * middle;
        blocks[i] = std::byte{halves[half + i / bc1BlockBytes * halfBlockBytes + i % halfBlockBytes]};
    }
    return blocks;
}

}  // namespace

std::size_t colourTileBytes(ColourFormat format) {
    return format == ColourFormat::Bc1 ? texelCount / blockTexels * bc1BlockBytes : 3 * texelCount;
}

Result<void> sampleColourTile(const ColourSource& source, const ChunkId& tile, std::span<std::uint8_t> rgb) {
    assert(tile.level <= maxColourLevel && rgb.size() == 3 * texelCount);
    TexelSquare square{tile.face, colourTileCells << tile.level,
                       static_cast<int>(tile.x) * colourTileCells - colourBorderBefore,
                       static_cast<int>(tile.y) * colourTileCells - colourBorderBefore,
                       std::vector<glm::vec3>(texelCount)};
    if (auto filled = fill(source, square); !filled) return filled;
    for (std::size_t i = 0; i < texelCount; ++i) {
        for (int channel = 0; channel < 3; ++channel)
            rgb[3 * i + static_cast<std::size_t>(channel)] = srgbFromLinear(square.texels[i][channel]);
    }
    return {};
}

std::vector<std::byte> colourTexels(ColourFormat format, std::span<const std::uint8_t> rgb) {
    assert(rgb.size() == 3 * texelCount);
    if (format == ColourFormat::Lossless) {
        const auto bytes = std::as_bytes(rgb);
        return {bytes.begin(), bytes.end()};
    }
    std::vector<std::byte> blocks(colourTileBytes(format));
    std::size_t block = 0;
    for (std::size_t row = 0; row < sideTexels; row += blockSide) {
        for (std::size_t column = 0; column < sideTexels; column += blockSide, ++block) {
            const std::array<unsigned char, 4 * blockTexels> rgba = blockAt(rgb, column, row);
            stb_compress_dxt_block(reinterpret_cast<unsigned char*>(&blocks[block * bc1BlockBytes]),
                                   rgba.data(), 0, STB_DXT_HIGHQUAL);
        }
    }
    return blocks;
}

std::vector<std::uint8_t> rgbOfColourTexels(ColourFormat format, std::span<const std::byte> texels) {
    assert(texels.size() == colourTileBytes(format));
    std::vector<std::uint8_t> rgb(3 * texelCount);
    if (format == ColourFormat::Lossless) {
        std::transform(texels.begin(), texels.end(), rgb.begin(),
                       [](std::byte byte) { return std::to_integer<std::uint8_t>(byte); });
        return rgb;
    }
    std::vector<squish::u8> rgba(4 * texelCount);
    squish::DecompressImage(rgba.data(), colourTileTexels, colourTileTexels, texels.data(), squish::kDxt1);
    for (std::size_t i = 0; i < texelCount; ++i) std::copy_n(&rgba[4 * i], 3, &rgb[3 * i]);
    return rgb;
}

std::vector<std::byte> checkerTexels(ColourFormat format) {
    constexpr std::size_t squareTexels = 32;
    std::vector<std::uint8_t> rgb(3 * texelCount, 0);
    for (std::size_t i = 0; i < texelCount; ++i) {
        const std::size_t column = i % sideTexels + squareTexels - colourBorderBefore;
        const std::size_t row = i / sideTexels + squareTexels - colourBorderBefore;
        if ((column / squareTexels + row / squareTexels) % 2 == 0) rgb[3 * i] = rgb[3 * i + 2] = 255;
    }
    return colourTexels(format, rgb);
}

std::vector<std::byte> packColourTexels(ColourFormat format, std::span<const std::byte> texels) {
    assert(texels.size() == colourTileBytes(format));
    const std::vector<std::uint8_t> ordered =
        format == ColourFormat::Bc1 ? halvesOf(texels) : planesOf(texels);
    std::vector<std::byte> packed(ZSTD_compressBound(ordered.size()));
    const std::size_t size =
        ZSTD_compress(packed.data(), packed.size(), ordered.data(), ordered.size(), zstdLevel);
    assert(!ZSTD_isError(size));
    packed.resize(size);
    return packed;
}

Result<std::vector<std::byte>> unpackColourTexels(ColourFormat format, std::span<const std::byte> packed) {
    std::vector<std::uint8_t> ordered(colourTileBytes(format));
    const std::size_t size = ZSTD_decompress(ordered.data(), ordered.size(), packed.data(), packed.size());
    if (ZSTD_isError(size)) return badInput(fmt::format("its colours: {}", ZSTD_getErrorName(size)));
    if (size != ordered.size()) {
        return badInput(fmt::format("its colours are {} bytes; {} were expected", size, ordered.size()));
    }
    return format == ColourFormat::Bc1 ? blocksOfHalves(ordered) : texelsOfPlanes(ordered);
}

std::size_t largestPackedColourTile(ColourFormat format) {
    return ZSTD_compressBound(colourTileBytes(format));
}

}  // namespace planet
