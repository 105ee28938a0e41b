// Coarse chunks lit with tiles of normals, held to the finest mesh lit with its own.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "planet/paging/normal_tile.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"
#include "tests/support/made_chunks.h"

namespace planet::gl {
namespace {

// 512 cells a face, so tiles of levels 0 and 1; chunks of levels 0 to 4.
PlanetShape testShape() {
    PlanetShape shape;
    shape.faceCellsLog2 = 9;
    shape.chunkCellsLog2 = 5;
    shape.quantumM = 0.25;
    return shape;
}
constexpr int finest = 4;

// Waves of some 10 texels, far finer than a root chunk's cells.
double wavesM(const glm::dvec3& d) {
    return 3500 * std::sin(172 * d.x + 31 * d.y) * std::cos(147 * d.y - 53 * d.z) +
           1500 * std::sin(191 * d.z + 40 * d.x);
}
double gentleM(const glm::dvec3& d) {
    return 4000 * std::sin(9 * d.x + 2 * d.z) * std::cos(8 * d.y - d.x) + 3000 * std::sin(7 * d.z + 1);
}

struct Tiles {
    std::array<TileData, faceCount> roots;
    std::array<TileBlock, faceCount> blocks;
};
Tiles tilesOf(const HeightFunction& height) {
    const test::MadeChunks made(testShape(), height);
    NormalDeriver deriver(made.shape, made.roots(), made.loader());
    deriver.keepHeights(64 << 20);
    Tiles tiles;
    for (const Face face : allFaces) {
        const auto f = static_cast<std::size_t>(face);
        tiles.roots[f] = deriver.tile({face, 0, 0, 0}).value();
        tiles.blocks[f] = deriver.childrenOf({face, 0, 0, 0}).value();
    }
    return tiles;
}
const Tiles& waveTiles() {
    static const Tiles tiles = tilesOf(wavesM);
    return tiles;
}

// How far two pictures are apart, 8-bit steps, over the pixels that look down on lit ground.
struct Apart {
    double mean = 0;
    int most = 0;
    double off = 0;  // share of the pixels more than 8 steps apart
    int pixels = 0;
};

class NormalTiles : public GlTest {
protected:
    NormalTiles() : planet_(testShape(), 6 + 6 * 16 + 6 * 256) {
        settings_.atmosphere = false;
        settings_.sea = false;
        settings_.detail = FeatureUse::Off;
        settings_.surface = SurfaceColour::HeightRamp;
        settings_.ramp = {{0, {0.6f, 0.6f, 0.6f}}};
        settings_.light.normals.use = FeatureUse::On;
    }

    void addGround(const HeightFunction& height, bool withFinest = true) {
        planet_.addLevel(0, height);
        planet_.addLevel(2, height);
        if (withFinest) planet_.addLevel(finest, height);
    }
    std::span<const DrawItem> roots() { return std::span(planet_.items()).first(6); }
    std::span<const DrawItem> middle() { return std::span(planet_.items()).subspan(6, 6 * 16); }
    // Those of the finest that are not far behind the limb.
    std::vector<DrawItem> fine(const View& view) {
        std::vector<DrawItem> seen;
        for (const DrawItem& item : std::span(planet_.items()).subspan(6 + 6 * 16)) {
            const FaceSquare square = faceSquareOf(item.id);
            const glm::dvec3 middle = sphereFromCube(
                cubePoint(item.id.face, square.u + square.side / 2, square.v + square.side / 2));
            if (glm::dot(middle, glm::normalize(view.eyeM)) > 0.35) seen.push_back(item);
        }
        return seen;
    }

    void makePool() {
        const Result<void> made =
            planet_.renderer().setNormals(NormalPoolConfig{1, 30, testShape().quantumM});
        ASSERT_TRUE(made) << made.error().message;
        TileChange reset;
        reset.resets = true;
        planet_.renderer().followNormals({&reset, 1});
    }
    void addTiles(const Tiles& tiles, bool withBlocks = true) {
        for (std::uint32_t face = 0; face < faceCount; ++face) {
            TileChange change;
            change.firstSlot = face;
            change.arrived = {tiles.roots[face]};
            planet_.renderer().followNormals({&change, 1});
            if (!withBlocks) continue;
            change.firstSlot = faceCount + quadrantCount * face;
            change.arrived.assign(tiles.blocks[face].begin(), tiles.blocks[face].end());
            planet_.renderer().followNormals({&change, 1});
        }
    }

    // From where a texel of level 1 is a pixel wide in a face's middle.
    static View wholeDisc(double latitudeDeg, double longitudeDeg) {
        constexpr int sidePx = 400;
        const double scalePx = sidePx / (2 * std::tan(glm::radians(30.0)));
        const double altitudeM = std::sqrt(2.0) * testShape().radiusM / 512 * scalePx;
        return viewFrom(testShape(), latitudeDeg, longitudeDeg, altitudeM, -90, 0, sidePx, sidePx);
    }
    // The sun, so that the whole of the disc's middle is lit from aside.
    void lightFrom(const View& view) {
        settings_.sunDirection = glm::normalize(glm::normalize(view.eyeM) + 1.2 * view.right + 0.6 * view.up);
    }

    Picture drawn(const View& view, std::span<const DrawItem> items, FeatureUse use = FeatureUse::On) {
        settings_.light.normals.use = use;
        return drawPicture(planet_.renderer(), view, items, settings_);
    }

    // Where the ground is seen steeply enough and the sun is high enough.
    bool isSeen(const View& view, int column, int row) const {
        const double tanX = std::tan(view.horizontalFovRad / 2);
        const double x = tanX * (2 * (column + 0.5) / view.widthPx - 1);
        const double y = tanX * (view.heightPx - 2 * (row + 0.5)) / view.widthPx;
        const glm::dvec3 ray = glm::normalize(-view.back + x * view.right + y * view.up);
        const double radiusM = testShape().radiusM;
        const double along = glm::dot(ray, view.eyeM);
        const double under = along * along - glm::dot(view.eyeM, view.eyeM) + radiusM * radiusM;
        if (under <= 0) return false;
        const glm::dvec3 up = glm::normalize(view.eyeM + (-along - std::sqrt(under)) * ray);
        return glm::dot(up, -ray) > 0.45 && glm::dot(up, settings_.sunDirection) > 0.3;
    }
    Apart apart(const View& view, const Picture& a, const Picture& b) const {
        Apart found;
        for (int row = 0; row < view.heightPx; ++row) {
            for (int column = 0; column < view.widthPx; ++column) {
                if (!isSeen(view, column, row)) continue;
                const int steps = std::abs(a.at(column, row).y - b.at(column, row).y);
                found.mean += steps;
                found.off += steps > 8;
                found.most = std::max(found.most, steps);
                ++found.pixels;
            }
        }
        found.mean /= std::max(found.pixels, 1);
        found.off /= std::max(found.pixels, 1);
        return found;
    }
    // The largest bend of the brightness along a row or a column, 8-bit steps: of even light about that of
    // the dither, over a step its height.
    int largestBend(const View& view, const Picture& picture) const {
        int most = 0;
        for (int row = 1; row + 1 < view.heightPx; ++row) {
            for (int column = 1; column + 1 < view.widthPx; ++column) {
                if (!isSeen(view, column, row)) continue;
                const auto light = [&](int c, int r) { return picture.at(c, r).y; };
                const int twice = 2 * light(column, row);
                most = std::max({most, std::abs(light(column - 1, row) + light(column + 1, row) - twice),
                                 std::abs(light(column, row - 1) + light(column, row + 1) - twice)});
            }
        }
        return most;
    }

    TestPlanet planet_;
    RenderSettings settings_;
};

// Faces' middles, an edge, a corner of the cube, a pole.
constexpr std::array<std::array<double, 2>, 4> litPlaces = {{{0, 0}, {35.26, 45}, {90, 0}, {-30, -120}}};

TEST_F(NormalTiles, RootChunksAreLitAsTheFinestMeshIsOverTheWholeDisc) {
    addGround(wavesM);
    makePool();
    addTiles(waveTiles());
    for (const auto& [latitude, longitude] : litPlaces) {
        const View view = wholeDisc(latitude, longitude);
        lightFrom(view);
        const Picture truth = drawn(view, fine(view), FeatureUse::Off);
        const Apart with = apart(view, drawn(view, roots()), truth);
        const Apart without = apart(view, drawn(view, roots(), FeatureUse::Off), truth);
        EXPECT_GT(with.pixels, 60'000);
        EXPECT_LT(with.mean, 1.6) << latitude << " " << longitude;
        EXPECT_LT(with.off, 0.02) << latitude << " " << longitude;
        EXPECT_GT(without.mean, 6) << latitude << " " << longitude;
        EXPECT_GT(without.off, 0.2) << latitude << " " << longitude;
    }
}

TEST_F(NormalTiles, CoarseChunksAreLitAsTheFinestMeshIsNearTheGround) {
    addGround(wavesM);
    makePool();
    addTiles(waveTiles());
    for (const double altitudeM : {3e5, 1e6}) {
        const View view = viewFrom(testShape(), 8, 12, altitudeM, -90, 20, 240, 240);
        lightFrom(view);
        const Picture truth = drawn(view, fine(view), FeatureUse::Off);
        const Apart with = apart(view, drawn(view, middle()), truth);
        EXPECT_LT(with.mean, 0.2) << altitudeM;
        EXPECT_LE(with.most, 2) << altitudeM;
        EXPECT_GT(apart(view, drawn(view, middle(), FeatureUse::Off), truth).mean, 2) << altitudeM;
    }
}

TEST_F(NormalTiles, FollowExaggerationAndTheBareCube) {
    addGround(wavesM);
    makePool();
    addTiles(waveTiles());
    const View view = wholeDisc(10, 20);
    lightFrom(view);
    PlanetShape flatter = testShape();
    flatter.quantumM *= 0.3;
    planet_.renderer().setShape(flatter);
    EXPECT_LT(apart(view, drawn(view, roots()), drawn(view, fine(view), FeatureUse::Off)).mean, 2);
    planet_.renderer().setShape(testShape());
    settings_.cube = true;
    const View oneSide = viewFrom(testShape(), 0, 0, 0.5 * testShape().radiusM, -90, 0, 240, 240);
    lightFrom(oneSide);
    const Picture truth = drawn(oneSide, fine(oneSide), FeatureUse::Off);
    EXPECT_LT(apart(oneSide, drawn(oneSide, roots()), truth).mean, 3);
    EXPECT_GT(apart(oneSide, drawn(oneSide, roots(), FeatureUse::Off), truth).mean, 6);
}

// On the ground under test nothing changes fast, so that what bends is a seam.
TEST_F(NormalTiles, NoStepShowsAtTilesFacesOrLevels) {
    addGround(gentleM, false);
    makePool();
    const Tiles tiles = tilesOf(gentleM);
    addTiles(tiles);
    for (const auto& [latitude, longitude] : litPlaces) {
        for (const double nearer : {1.0, 0.8, 1.4}) {  // levels are mixed
            View view = wholeDisc(latitude, longitude);
            view.eyeM *= nearer;
            lightFrom(view);
            EXPECT_LE(largestBend(view, drawn(view, roots())), 5)
                << latitude << " " << longitude << " " << nearer;
        }
    }
    // As it is when it does: one tile is off.
    Tiles wrong = tiles;
    for (const Face face : allFaces) {
        for (std::size_t i = 0; i < normalTileBytes; i += 4) {
            const std::uint16_t half = 0x2C00;  // 1/16
            std::memcpy(wrong.blocks[static_cast<std::size_t>(face)][0].texels.data() + i, &half, 2);
        }
    }
    addTiles(wrong);
    const View view = wholeDisc(0, 0);
    lightFrom(view);
    EXPECT_GT(largestBend(view, drawn(view, roots())), 10);
}

TEST_F(NormalTiles, OffOrTurnedDownThePictureIsTheOneWithoutThem) {
    addGround(wavesM, false);
    const View view = wholeDisc(10, 20);
    lightFrom(view);
    const Picture before = drawn(view, middle());
    makePool();
    addTiles(waveTiles());
    EXPECT_NE(drawn(view, middle()).rgb, before.rgb);
    EXPECT_EQ(drawn(view, middle(), FeatureUse::Off).rgb, before.rgb);
    if (planet_.renderer().capabilities().software) {
        EXPECT_EQ(drawn(view, middle(), FeatureUse::Automatic).rgb, before.rgb);
    }
    settings_.lighting = false;
    const Picture flat = drawn(view, middle());
    ASSERT_TRUE(planet_.renderer().setNormals(std::nullopt));
    EXPECT_EQ(drawn(view, middle()).rgb, flat.rgb);
    settings_.lighting = true;
    EXPECT_EQ(drawn(view, middle()).rgb, before.rgb);
}

// Detail makes light be worked out by pixel with and without them.
TEST_F(NormalTiles, WhereNoTileIsAsFineAsTheMeshTheMeshIsDrawn) {
    addGround(wavesM);
    settings_.detail = FeatureUse::On;
    const View view = viewFrom(testShape(), 8, 12, 2e5, -90, 20, 240, 240);
    lightFrom(view);
    const Picture mesh = drawn(view, fine(view), FeatureUse::Off);
    makePool();
    EXPECT_EQ(drawn(view, fine(view)).rgb, mesh.rgb);  // none at all
    addTiles(waveTiles(), false);
    EXPECT_EQ(drawn(view, fine(view)).rgb, mesh.rgb);  // coarser ones alone
    EXPECT_NE(drawn(view, middle()).rgb, drawn(view, middle(), FeatureUse::Off).rgb);
}

TEST_F(NormalTiles, TheirMemoryIsCountedAndGivenBack) {
    const std::size_t before = planet_.renderer().gpuMemory().textures;
    makePool();
    EXPECT_GE(planet_.renderer().gpuMemory().textures, before + 30 * normalTileBytes);
    ASSERT_TRUE(planet_.renderer().setNormals(std::nullopt));
    EXPECT_EQ(planet_.renderer().gpuMemory().textures, before);
    const auto tooMany = planet_.renderer().setNormals(NormalPoolConfig{1, 1u << 20, 1});
    ASSERT_FALSE(tooMany);
    EXPECT_THAT(tooMany.error().message, testing::HasSubstr("1048576 normal tiles"));
}

}  // namespace
}  // namespace planet::gl
