#include "planet/bake/colour_tile_sampling.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "planet/base/try.h"
#include "planet/format/colour_tile.h"
#include "planet/source/sample_tiles.h"

namespace planet {

namespace {

constexpr auto sideTexels = static_cast<std::size_t>(colourTileTexels);
constexpr std::size_t texelCount = sideTexels * sideTexels;

// Returns the sRGB encoding (IEC 61966-2-1) of a linear value, rounded to 8 bits.
std::uint8_t srgbByFormula(float linear) {
    const double value = std::clamp(static_cast<double>(linear), 0.0, 1.0);
    const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

// Computes the same from a table, ten times as fast. The table has the smallest value for a float's exponent
// and first seven bits, and the float at which each value begins.
class SrgbTable {
public:
    SrgbTable() {
        for (std::size_t i = 0; i < atLeast_.size(); ++i)
            atLeast_[i] = srgbByFormula(std::bit_cast<float>(static_cast<std::uint32_t>(i) << dropped));
        for (std::size_t value = 1; value < from_.size(); ++value) {
            std::uint32_t below = 0;  // positive floats have the same order as their bits
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
    std::array<float, 256> from_{};  // the smallest float for each value or a larger one
};

std::uint8_t srgbFromLinear(float linear) {
    static const SrgbTable table;
    return table(linear);
}

// The texels of a tile's square, by their columns and rows on the face's grid.
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

// The parts of a tile's columns or rows before, on and beyond its face: [begin, end) each.
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
    std::vector<glm::vec3> colours(samplesIn(tile));
    TRY(source.sample(tile, colours));
    auto from = colours.begin();
    for (int row = rows.begin; row < rows.end; ++row, from += tile.columns)
        std::copy_n(from, tile.columns, &square.at(columns.begin, row));
    return {};
}

// Fills columns or rows beyond one edge of the face.
Result<void> fillBeyondEdge(const ColourSource& source, TexelRun columns, TexelRun rows,
                            TexelSquare& square) {
    if (columns.begin == columns.end || rows.begin == rows.end) return {};
    const auto folded = [&](int column, int row) {
        return foldedOver({square.face, column, row}, square.cells);
    };
    const SampleTile tile =
        tileBetween(folded(columns.begin, rows.begin), folded(columns.end - 1, rows.end - 1), square.cells);
    std::vector<glm::vec3> colours(samplesIn(tile));
    TRY(source.sample(tile, colours));
    for (int row = rows.begin; row < rows.end; ++row) {
        for (int column = columns.begin; column < columns.end; ++column) {
            const FaceGridPoint place = folded(column, row);
            square.at(column, row) = colours[indexIn(tile, place.column, place.row)];
        }
    }
    return {};
}

// Fills the texels beyond a corner of the cube, where there is no fourth face, with the corner's colour.
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
    TRY(fillOnFace(source, columns[1], rows[1], square));
    for (const std::size_t outside : {0u, 2u}) {
        TRY(fillBeyondEdge(source, columns[outside], rows[1], square));
        TRY(fillBeyondEdge(source, columns[1], rows[outside], square));
        for (const std::size_t above : {0u, 2u}) fillBeyondCorner(columns[outside], rows[above], square);
    }
    return {};
}

}  // namespace

Result<void> sampleColourTile(const ColourSource& source, const ChunkId& tile, std::span<std::uint8_t> rgb) {
    assert(tile.level <= maxColourLevel && rgb.size() == 3 * texelCount);
    TexelSquare square{tile.face, colourTileCells << tile.level,
                       static_cast<int>(tile.x) * colourTileCells - colourBorderBefore,
                       static_cast<int>(tile.y) * colourTileCells - colourBorderBefore,
                       std::vector<glm::vec3>(texelCount)};
    TRY(fill(source, square));
    for (std::size_t i = 0; i < texelCount; ++i) {
        for (int channel = 0; channel < 3; ++channel)
            rgb[3 * i + static_cast<std::size_t>(channel)] = srgbFromLinear(square.texels[i][channel]);
    }
    return {};
}

}  // namespace planet
