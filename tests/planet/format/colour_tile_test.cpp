#include "planet/format/colour_tile.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <random>

#include "planet/bake/colour_tile_sampling.h"
#include "planet/sphere/face_fold.h"
#include "tests/support/synthetic_colours.h"

namespace planet {
namespace {

using Rgb = std::vector<std::uint8_t>;

Rgb sampledTile(const ColourSource& source, const ChunkId& id) {
    Rgb rgb(colourTileBytes(ColourFormat::Lossless));
    const Result<void> sampled = sampleColourTile(source, id, rgb);
    EXPECT_TRUE(sampled) << sampled.error().message;
    return rgb;
}

// As drawn: packed into what the GPU takes, and out again.
Rgb drawnTile(const ColourSource& source, const ChunkId& id, ColourFormat format) {
    return rgbOfColourTexels(format, colourTexels(format, sampledTile(source, id)));
}

// Texels count from the tile's own first one.
const std::uint8_t* texel(const Rgb& rgb, int column, int row) {
    const int at = (row + colourBorderBefore) * colourTileTexels + column + colourBorderBefore;
    return &rgb[3 * static_cast<std::size_t>(at)];
}

int largestStep(const std::uint8_t* one, const std::uint8_t* other) {
    int largest = 0;
    for (int channel = 0; channel < 3; ++channel)
        largest = std::max(largest, std::abs(one[channel] - other[channel]));
    return largest;
}

TEST(ColourTile, ItsTexelsAreTheSourcesAtTheirPlaces) {
    const ColourSource source = test::formulaColours(
        [](const glm::dvec3& d) { return glm::dvec3(0.5 + 0.5 * d.x, 0.5 + 0.5 * d.y, 0.5 + 0.5 * d.z); });
    const ChunkId id{Face::NegY, 2, 1, 3};
    const Rgb rgb = sampledTile(source, id);
    for (const auto& [column, row] : {std::pair{0, 0}, {256, 256}, {17, 200}, {-7, -7}, {264, 9}}) {
        const double cells = 4.0 * colourTileCells;
        const glm::dvec3 d = sphereFromCube(cubePoint(id.face, 2 * (256 + column) / cells - 1,
                                                      2 * std::min(3 * 256 + row, 1024) / cells - 1));
        const auto srgb = [](double linear) {
            return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
        };
        EXPECT_NEAR(texel(rgb, column, row)[0], srgb(0.5 + 0.5 * d.x), 0.51);
        EXPECT_NEAR(texel(rgb, column, row)[1], srgb(0.5 + 0.5 * d.y), 0.51);
        EXPECT_NEAR(texel(rgb, column, row)[2], srgb(0.5 + 0.5 * d.z), 0.51);
    }
}

TEST(ColourTile, TilesOfAFaceAreTheSameWhereverBothReach) {
    const ColourSource source = test::mottledColours();
    for (const ColourFormat format : {ColourFormat::Lossless, ColourFormat::Bc1}) {
        const Rgb west = drawnTile(source, {Face::PosX, 1, 0, 0}, format);
        const Rgb east = drawnTile(source, {Face::PosX, 1, 1, 0}, format);
        const Rgb north = drawnTile(source, {Face::PosX, 1, 0, 1}, format);
        for (int along = 0; along <= colourTileCells; ++along) {
            for (int over = -colourBorderBefore; over <= colourBorderAfter; ++over) {
                EXPECT_EQ(largestStep(texel(west, 256 + over, along), texel(east, over, along)), 0);
                EXPECT_EQ(largestStep(texel(west, along, 256 + over), texel(north, along, over)), 0);
            }
        }
    }
}

// The tile of a level that holds a point of its face, and the point's texel in it.
struct TexelPlace {
    ChunkId tile;
    int column;
    int row;
};
TexelPlace placeOf(const FaceGridPoint& point, int level) {
    const int last = (1 << level) - 1;
    const int x = std::min(point.column / colourTileCells, last);
    const int y = std::min(point.row / colourTileCells, last);
    return {{point.face, static_cast<std::uint8_t>(level), static_cast<std::uint32_t>(x),
             static_cast<std::uint32_t>(y)},
            point.column - x * colourTileCells,
            point.row - y * colourTileCells};
}

// Of the texels that two faces share along an edge, and of those that lie in the border of one.
struct FaceEdgeSteps {
    int onEdge = 0;
    int inBorder = 0;
};
FaceEdgeSteps stepsOverFaceEdges(const ColourSource& source, ColourFormat format, int level) {
    const int cells = colourTileCells << level;
    FaceEdgeSteps largest;
    std::map<ChunkId, Rgb> drawn;
    const auto tileOf = [&](const ChunkId& id) -> const Rgb& {
        const auto [at, isNew] = drawn.try_emplace(id);
        if (isNew) at->second = drawnTile(source, id, format);
        return at->second;
    };
    for (const Face face : allFaces) {
        for (int along = 0; along <= colourTileCells; ++along) {
            for (int over = 1; over <= colourBorderBefore; ++over) {
                // Over each of the four edges, in the tile at its southern or western end.
                for (const auto& [column, row] : {std::pair{cells + over, along},
                                                  {-over, along},
                                                  {along, cells + over},
                                                  {along, -over}}) {
                    const FaceGridPoint inside{face, std::clamp(column, 0, cells), std::clamp(row, 0, cells)};
                    const TexelPlace here = placeOf(inside, level);
                    const int beyondColumn = here.column + column - inside.column;
                    const int beyondRow = here.row + row - inside.row;
                    const FaceGridPoint beyond = foldedOver({face, column, row}, cells);
                    const TexelPlace there = placeOf(beyond, level);
                    largest.inBorder = std::max(
                        largest.inBorder, largestStep(texel(tileOf(here.tile), beyondColumn, beyondRow),
                                                      texel(tileOf(there.tile), there.column, there.row)));
                    if (over > 1) continue;
                    // The edge's own texel, one step back towards this face.
                    const FaceGridPoint folded = foldedOver({face, column, row}, cells);
                    const FaceGridPoint twice = foldedOver(
                        {face, column + (column - inside.column), row + (row - inside.row)}, cells);
                    const FaceGridPoint edge{folded.face, 2 * folded.column - twice.column,
                                             2 * folded.row - twice.row};
                    const TexelPlace its = placeOf(edge, level);
                    largest.onEdge =
                        std::max(largest.onEdge, largestStep(texel(tileOf(here.tile), here.column, here.row),
                                                             texel(tileOf(its.tile), its.column, its.row)));
                }
            }
        }
    }
    return largest;
}

TEST(ColourTile, FacesAreTheSameOverTheirEdgesWithoutLoss) {
    const ColourSource source = test::mottledColours();
    for (const int level : {0, 1}) {
        const FaceEdgeSteps steps = stepsOverFaceEdges(source, ColourFormat::Lossless, level);
        EXPECT_EQ(steps.onEdge, 0);
        EXPECT_EQ(steps.inBorder, 0);
    }
}

// Faces turned against each other pack other blocks, each as near the source as it can.
TEST(ColourTile, FacesDifferOverTheirEdgesByNoMoreThanBc1Loses) {
    const FaceEdgeSteps steps = stepsOverFaceEdges(test::mottledColours(), ColourFormat::Bc1, 1);
    RecordProperty("onEdge", steps.onEdge);
    EXPECT_LE(steps.onEdge, 16);
}

TEST(ColourTile, ACornersTexelsAreTheSameThroughAllThreeFaces) {
    const ColourSource source = test::mottledColours();
    std::map<std::string, std::vector<std::vector<int>>> corners;
    for (const Face face : allFaces) {
        const Rgb rgb = sampledTile(source, {face, 0, 0, 0});
        for (const int column : {0, 256}) {
            for (const int row : {0, 256}) {
                const glm::dvec3 at = cubePoint(face, column / 128.0 - 1, row / 128.0 - 1);
                const std::uint8_t* own = texel(rgb, column, row);
                corners[fmt::format("{} {} {}", at.x, at.y, at.z)].push_back({own[0], own[1], own[2]});
                // Beyond the corner too.
                const int dx = column == 0 ? -3 : 3;
                const int dy = row == 0 ? -3 : 3;
                EXPECT_EQ(largestStep(own, texel(rgb, column + dx, row + dy)), 0);
            }
        }
    }
    EXPECT_EQ(corners.size(), 8u);
    for (const auto& [place, colours] : corners) {
        ASSERT_EQ(colours.size(), 3u);
        EXPECT_EQ(colours[0], colours[1]) << place;
        EXPECT_EQ(colours[0], colours[2]) << place;
    }
}

TEST(ColourTile, Bc1StaysNearTheSource) {
    const ColourSource source = test::mottledColours();
    const Rgb rgb = sampledTile(source, {Face::PosX, 1, 1, 0});
    const Rgb drawn = rgbOfColourTexels(ColourFormat::Bc1, colourTexels(ColourFormat::Bc1, rgb));
    double squares = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const double off = rgb[i] - drawn[i];
        squares += off * off;
    }
    const double rms = std::sqrt(squares / static_cast<double>(rgb.size()));
    RecordProperty("rms", fmt::format("{:.2f}", rms));
    EXPECT_LT(rms, 4);
    EXPECT_GT(rms, 0);
}

TEST(ColourTile, PackedTexelsComeOutAsTheyWentIn) {
    const Rgb rgb = sampledTile(test::mottledColours(), {Face::NegZ, 1, 0, 1});
    for (const ColourFormat format : {ColourFormat::Bc1, ColourFormat::Lossless}) {
        const std::vector<std::byte> texels = colourTexels(format, rgb);
        ASSERT_EQ(texels.size(), colourTileBytes(format));
        const std::vector<std::byte> packed = packColourTexels(format, texels);
        EXPECT_LT(packed.size(), texels.size());
        EXPECT_LE(packed.size(), largestPackedColourTile(format));
        const auto unpacked = unpackColourTexels(format, packed);
        ASSERT_TRUE(unpacked) << unpacked.error().message;
        EXPECT_EQ(*unpacked, texels);
    }
    EXPECT_EQ(rgbOfColourTexels(ColourFormat::Lossless, colourTexels(ColourFormat::Lossless, rgb)), rgb);
}

TEST(ColourTile, DamagedTexelsAreUnpackedOrRefusedButNeverReadBeyondTheirEnd) {
    const Rgb rgb = sampledTile(test::mottledColours(), {Face::NegZ, 1, 0, 1});
    std::mt19937 random(11);
    for (const ColourFormat format : {ColourFormat::Bc1, ColourFormat::Lossless}) {
        const std::vector<std::byte> whole = packColourTexels(format, colourTexels(format, rgb));
        EXPECT_FALSE(unpackColourTexels(format, {}));
        EXPECT_FALSE(unpackColourTexels(format, std::span(whole).first(whole.size() / 2)));
        const ColourFormat other = format == ColourFormat::Bc1 ? ColourFormat::Lossless : ColourFormat::Bc1;
        EXPECT_FALSE(unpackColourTexels(other, whole));
        for (int i = 0; i < 100; ++i) {
            std::vector<std::byte> damaged = whole;
            for (int bits = 0; bits < 4; ++bits)
                damaged[random() % damaged.size()] ^= static_cast<std::byte>(1u << random() % 8);
            const auto unpacked = unpackColourTexels(format, damaged);
            if (unpacked) {
                EXPECT_EQ(unpacked->size(), colourTileBytes(format));
            }
        }
    }
}

}  // namespace
}  // namespace planet
