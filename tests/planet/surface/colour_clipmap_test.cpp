#include "planet/surface/colour_clipmap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <random>

#include "tests/support/clipmap_levels.h"

namespace planet {
namespace {

using Random = std::mt19937;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

glm::dvec3 anyDirection(Random& random) {
    const auto axis = [&] { return std::normal_distribution<double>()(random); };
    return {axis(), axis(), axis()};
}

// Now and then on an edge or in a corner of the cube, or right beside one.
glm::dvec3 anyPlace(Random& random) {
    glm::dvec3 cube = cubeFromSphere(anyDirection(random));
    for (int axis = 0; axis < 3; ++axis) {
        const double chance = between(random, 0, 1);
        if (chance < 0.2) cube[axis] = cube[axis] < 0 ? -1 : 1;
        if (chance < 0.1) cube[axis] *= 1 - 1e-3 * between(random, 0, 1);
    }
    cube /= std::max({std::abs(cube.x), std::abs(cube.y), std::abs(cube.z)});
    return sphereFromCube(cube);
}

bool holds(const TexelRect& rect, int x, int y) {
    return x >= rect.x && x < rect.x + rect.width && y >= rect.y && y < rect.y + rect.height;
}

TEST(ColourClipmap, KeepsWholeWhatFitsIntoAWindow) {
    EXPECT_EQ(clipmapLayout(1024, 10), (ClipmapLayout{1024, 10, 2}));
    EXPECT_EQ(clipmapLayout(256, 10), (ClipmapLayout{256, 10, 0}));
    EXPECT_EQ(clipmapLayout(4096, 3), (ClipmapLayout{4096, 3, 3}));
    EXPECT_EQ(clipmapLayout(1500, 10).sizePx, 1024);
    EXPECT_EQ(clipmapLayout(1, 10).sizePx, 256);
    EXPECT_EQ(clipmapLayout(100000, 10).sizePx, 4096);
}

TEST(ColourClipmap, MovingBringsInExactlyTheTexelsThatWereNotThere) {
    Random random(3);
    const auto coordinate = [&] { return static_cast<int>(between(random, -20, 20)); };
    const auto extent = [&] { return static_cast<int>(between(random, 0, 20)); };
    for (int round = 0; round < 300; ++round) {
        const TexelRect before{coordinate(), coordinate(), extent(), extent()};
        const TexelRect now{coordinate(), coordinate(), extent(), extent()};
        const std::vector<TexelRect> rects = texelsThatCameIn(before, now);
        for (int y = -45; y < 45; ++y) {
            for (int x = -45; x < 45; ++x) {
                int times = 0;
                for (const TexelRect& rect : rects) times += holds(rect, x, y) ? 1 : 0;
                EXPECT_EQ(times, holds(now, x, y) && !holds(before, x, y) ? 1 : 0);
            }
        }
    }
}

TEST(ColourClipmap, AStepAsideCostsAStripAndAStepAcrossAnL) {
    const TexelRect before{96, 200, 512, 512};
    EXPECT_EQ(texelsThatCameIn(before, {104, 200, 512, 512}), (std::vector<TexelRect>{{608, 200, 8, 512}}));
    const std::vector<TexelRect> corner = texelsThatCameIn(before, {88, 216, 512, 512});
    EXPECT_EQ(corner, (std::vector<TexelRect>{{88, 712, 512, 16}, {88, 216, 8, 496}}));
    EXPECT_TRUE(texelsThatCameIn(before, before).empty());
}

TEST(ColourClipmap, PiecesOnTheTorusAreTheRectangleOnceEach) {
    for (const TexelRect& rect : {TexelRect{-7, -7, 256, 256}, TexelRect{250, 3, 12, 40},
                                  TexelRect{1000, 511, 256, 2}, TexelRect{0, 0, 256, 256}}) {
        std::int64_t texels = 0;
        for (const TorusPiece& piece : onTorus(rect, 256)) {
            EXPECT_EQ(intersectionOf(piece.texels, rect), piece.texels);
            EXPECT_EQ(piece.column, ((piece.texels.x % 256) + 256) % 256);
            EXPECT_EQ(piece.row, ((piece.texels.y % 256) + 256) % 256);
            EXPECT_LE(piece.column + piece.texels.width, 256);
            EXPECT_LE(piece.row + piece.texels.height, 256);
            texels += piece.texels.count();
        }
        EXPECT_EQ(texels, rect.count());
    }
}

TEST(ColourClipmap, TilesSideBySideCoverAFaceOnce) {
    for (const int level : {2, 3}) {
        std::int64_t texels = 0;
        for (std::uint32_t y = 0; y < 4; ++y) {
            for (std::uint32_t x = 0; x < 4; ++x) texels += texelsUnder({Face::NegY, 2, x, y}, level).count();
        }
        EXPECT_EQ(texels, faceTexels(level).count());
    }
}

// Shaders read around the middle by as much as half the steps of an anisotropic filter.
TEST(ColourClipmap, WindowsHoldWhatMayBeDrawnFromThem) {
    Random random(5);
    const ClipmapLayout layout = clipmapLayout(512, 7);
    std::map<int, int> seen;
    for (int round = 0; round < 4000; ++round) {
        const glm::dvec3 eye = anyPlace(random);
        const ClipmapCentre centre = clipmapCentre(eye);
        const double spread = std::exp2(between(random, -9, 0));
        const FacePoint point = facePointFromDirection(eye + spread * anyDirection(random));
        const glm::dvec2 place((point.u + 1) / 2, (point.v + 1) / 2);
        const double finestLevel = clipmapFinest(layout, clipmapDistance(centre, point.face, place));
        const int level = static_cast<int>(std::ceil(finestLevel));
        ++seen[level];
        if (level <= layout.wholeLevel) continue;
        const TexelRect window = clipmapWindow(layout, centre, point.face, level);
        const glm::dvec2 texel = place * static_cast<double>(colourTileCells << level);
        const TexelRect face = faceTexels(level);
        for (const int aside : {-colourBorderBefore, colourBorderBefore}) {
            const auto x = std::clamp(static_cast<int>(texel.x) + aside, face.x, face.x + face.width - 1);
            const auto y = std::clamp(static_cast<int>(texel.y) + aside, face.y, face.y + face.height - 1);
            ASSERT_TRUE(holds(window, x, y)) << round << " level " << level;
        }
    }
    for (int level = layout.wholeLevel; level <= layout.leafLevel; ++level)
        EXPECT_GT(seen[level], 20) << level;
}

TEST(ColourClipmap, DistancesAgreeWhereFacesMeet) {
    Random random(7);
    for (int round = 0; round < 2000; ++round) {
        const ClipmapCentre centre = clipmapCentre(anyPlace(random));
        const Face face = allFaces[static_cast<std::size_t>(random() % faceCount)];
        // A point of one of the face's edges, as each of the two faces has it.
        const double along = between(random, -1, 1);
        const glm::dvec3 point = cubePoint(face, random() % 2 == 0 ? 1 : -1, along);
        double first = -1;
        for (const Face of : allFaces) {
            const FaceAxes& axes = faceAxes(of);
            if (glm::dot(point, axes.normal) != 1.0) continue;
            const glm::dvec2 place((glm::dot(point, axes.u) + 1) / 2, (glm::dot(point, axes.v) + 1) / 2);
            const double distance = clipmapDistance(centre, of, place);
            // Farther away no window reaches.
            if (first >= 0 && std::min(first, distance) < 0.5) {
                EXPECT_NEAR(distance, first, 1e-9);
            }
            first = distance;
        }
    }
}

TEST(ColourClipmap, FinestLevelsChangeGradually) {
    const ClipmapLayout layout = clipmapLayout(512, 9);
    double before = clipmapFinest(layout, 1e-4);
    EXPECT_EQ(before, 9);
    for (double distance = 1e-4; distance < 2; distance *= 1.0005) {
        const double now = clipmapFinest(layout, distance);
        EXPECT_LE(now, before);
        EXPECT_GT(now, before - 0.02);
        before = now;
    }
    EXPECT_EQ(before, layout.wholeLevel);
}

// What is stored, texel for texel, held against what the windows say; each texel a number made of all that it
// depends on.
class StoredTexels : public testing::Test {
protected:
    void change(const ChunkId& parent) {
        windows_.changeBlock(parent);
        for (int level = parent.level + 1; level <= layout_.leafLevel; ++level) {
            const int finer = level - parent.level;
            for (std::uint32_t y = parent.y << finer; y < (parent.y + 1) << finer; ++y) {
                for (std::uint32_t x = parent.x << finer; x < (parent.x + 1) << finer; ++x)
                    ++versions_[keyOf({parent.face, static_cast<std::uint8_t>(level), x, y})];
            }
        }
    }

    std::uint64_t texel(Face face, int level, int x, int y) {
        const auto last = (1 << level) - 1;
        const auto tile = [&](int k) {
            return static_cast<std::uint32_t>(std::clamp(static_cast<int>(std::floor(k / 256.0)), 0, last));
        };
        const ChunkId id{face, static_cast<std::uint8_t>(level), tile(x), tile(y)};
        if (!(id == lastId_)) {
            lastId_ = id;
            lastVersion_ = versions_[keyOf(id)];
        }
        return ((lastVersion_ * 8 + static_cast<std::uint64_t>(face)) * 8 +
                static_cast<std::uint64_t>(level)) *
                   0x100000000u +
               static_cast<std::uint64_t>(y + 100) * 0x10000u + static_cast<std::uint64_t>(x + 100);
    }

    // Returns how many texels were written.
    std::int64_t move(const glm::dvec3& eye, int finestLevel) {
        lastId_ = {Face::PosX, 20, 0, 0};
        std::int64_t written = 0;
        for (const ClipmapUpdate& update : windows_.move(clipmapCentre(eye), finestLevel)) {
            if (update.level <= layout_.wholeLevel) continue;
            written += update.texels.count();
            std::vector<std::uint64_t>& layer = layers_[windows_.layerOf(update.face, update.level)];
            layer.resize(static_cast<std::size_t>(size_ * size_));
            for (const TorusPiece& piece : onTorus(update.texels, size_)) {
                for (int j = 0; j < piece.texels.height; ++j) {
                    for (int i = 0; i < piece.texels.width; ++i)
                        layer[static_cast<std::size_t>((piece.row + j) * size_ + piece.column + i)] =
                            texel(update.face, update.level, piece.texels.x + i, piece.texels.y + j);
                }
            }
        }
        return written;
    }

    void expectAllRight() {
        std::map<int, int> uses;
        for (const Face face : allFaces) {
            for (int level = layout_.wholeLevel + 1; level <= layout_.leafLevel; ++level) {
                const TexelRect window = windows_.window(face, level);
                const int layer = windows_.layerOf(face, level);
                ASSERT_EQ(layer < 0, window.isEmpty());
                if (layer < 0) continue;
                EXPECT_EQ(++uses[layer], 1);
                EXPECT_LT(layer, windows_.layerCount());
                int wrong = 0;
                for (int y = window.y; y < window.y + window.height; ++y) {
                    for (int x = window.x; x < window.x + window.width; ++x) {
                        const auto at =
                            static_cast<std::size_t>((y & (size_ - 1)) * size_ + (x & (size_ - 1)));
                        if (layers_[layer][at] != texel(face, level, x, y)) ++wrong;
                    }
                }
                EXPECT_EQ(wrong, 0) << "level " << level;
            }
        }
    }

    static constexpr int size_ = 256;
    ClipmapLayout layout_ = clipmapLayout(size_, 2);
    ClipmapWindows windows_{layout_};
    std::map<int, std::vector<std::uint64_t>> layers_;
    std::map<std::uint64_t, std::uint64_t> versions_;
    ChunkId lastId_;
    std::uint64_t lastVersion_ = 0;
};

TEST_F(StoredTexels, AreRightAfterAnyWalkWithJumpsAndTilesThatComeAndGo) {
    Random random(11);
    glm::dvec3 eye = anyPlace(random);
    for (int step = 0; step < 30; ++step) {
        eye = step % 5 == 4 ? anyPlace(random) : glm::normalize(eye + 0.03 * anyDirection(random));
        const int level = static_cast<int>(random() % 2);
        const ChunkId block = chunkAt(facePointFromDirection(eye + 0.3 * anyDirection(random)), level);
        change(block);
        move(eye, step % 7 == 6 ? 0 : 2);
        expectAllRight();
    }
}

TEST_F(StoredTexels, ASmallMoveWritesStripsAndNoneWritesNothing) {
    const glm::dvec3 eye = sphereFromCube(cubePoint(Face::PosY, 0.1, 0.2));
    EXPECT_EQ(move(eye, 2), 2 * size_ * size_);
    EXPECT_EQ(move(eye, 2), 0);
    // 20 texels of the finest level.
    const glm::dvec3 moved = sphereFromCube(cubePoint(Face::PosY, 0.1 + 2 * 20.0 / 1024, 0.2));
    const std::int64_t written = move(moved, 2);
    EXPECT_GT(written, 0);
    EXPECT_LE(written, (24 + 16) * size_);
    expectAllRight();
}

TEST_F(StoredTexels, AFaceThatNoWindowReachesHasNoLayer) {
    move(sphereFromCube(cubePoint(Face::PosZ, 0, 0)), 2);
    EXPECT_EQ(windows_.layerCount(), 2);
    EXPECT_EQ(windows_.layerOf(Face::PosX, 2), -1);
    move(sphereFromCube(cubePoint(Face::PosZ, 0.99, 0.98)), 2);
    int layers = 0;
    for (const Face face : allFaces) layers += windows_.layerOf(face, 2) >= 0 ? 1 : 0;
    EXPECT_EQ(layers, 3);
    expectAllRight();
}

TEST_F(StoredTexels, ALevelGoesWhenItIsTwoFinerThanWanted) {
    const glm::dvec3 eye = sphereFromCube(cubePoint(Face::PosY, 0.1, 0.2));
    move(eye, 2);
    EXPECT_EQ(move(eye, 1), 0);
    EXPECT_EQ(windows_.finestLevel(), 2);
    EXPECT_EQ(move(eye, 0), 0);
    EXPECT_EQ(windows_.finestLevel(), 1);
    EXPECT_EQ(windows_.layerOf(Face::PosY, 2), -1);
    EXPECT_EQ(move(eye, 2), size_ * size_);
    expectAllRight();
}

TEST_F(StoredTexels, AllIsWrittenAgainOnceForgotten) {
    const glm::dvec3 eye = sphereFromCube(cubePoint(Face::PosY, 0.1, 0.2));
    move(eye, 2);
    windows_.forget();
    EXPECT_EQ(move(eye, 2), 2 * size_ * size_);
}

}  // namespace
}  // namespace planet
