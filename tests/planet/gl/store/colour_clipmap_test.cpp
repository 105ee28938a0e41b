// The clipmap held to the tiles that it is filled from, picture against picture.
#include "planet/gl/store/colour_clipmap.h"

#include <gmock/gmock.h>

#include <cstring>
#include <glm/common.hpp>
#include <random>
#include <utility>

#include "tests/planet/gl/streamed_colours.h"
#include "tests/support/clipmap_levels.h"

namespace planet::gl {
namespace {

// A pole, the date line, corners and edges of the cube, and between them.
constexpr std::array<std::pair<double, double>, 9> placesToSee = {{{90, 0},
                                                                   {-90, 30},
                                                                   {10, 180},
                                                                   {35.264, 45},
                                                                   {-35.1, -134.8},
                                                                   {3, 45.2},
                                                                   {46, 10},
                                                                   {12, 20},
                                                                   {-60, 100}}};

class ClippedColours : public StreamedColours {
protected:
    static constexpr int size = 512;  // level 2 has a window, the others are whole

    void useClipmap(int sizePx = size) {
        const Result<void> made = planet_.renderer().setColourClipmap(sizePx);
        ASSERT_TRUE(made) << made.error().message;
    }
    void useTiles() { ASSERT_TRUE(planet_.renderer().setColourClipmap(std::nullopt)); }
    void moveTo(const View& view, int finestLevel = leaf) {
        const Result<void> moved = planet_.renderer().moveColourClipmap(view.eyeM, finestLevel);
        ASSERT_TRUE(moved) << moved.error().message;
    }
    const ColourClipmapState& state() { return *planet_.renderer().colourClipmap(); }

    // So small that the windows hold all that it wants of their levels.
    View smallView(const std::pair<double, double>& place, double altitudeM, double pitchDeg = -90,
                   double headingDeg = 0) const {
        return viewFrom({}, place.first, place.second, altitudeM, pitchDeg, headingDeg, 96, 72);
    }
    // Its middle shows ground.
    View anyView(std::mt19937& random) const {
        const auto between = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(random);
        };
        const auto& place = placesToSee[random() % placesToSee.size()];
        const double latitudeDeg = std::clamp(place.first + between(-3, 3), -90.0, 90.0);
        const double longitudeDeg = place.second + between(-3, 3);
        const double altitudeM = std::exp2(between(14.5, 23));
        const double horizonDeg = -glm::degrees(std::acos(earthRadiusM / (earthRadiusM + altitudeM)));
        const double pitchDeg = between(-90, horizonDeg - 8);
        return smallView({latitudeDeg, longitudeDeg}, altitudeM, pitchDeg, between(0, 360));
    }

    // No two texels alike, and no level like another: whatever is off by a texel or a level shows.
    TileData noiseTile(const ChunkId& id) const {
        TileData tile{id, {}, std::vector<std::byte>(colourTileBytes(format_))};
        // Bytes of a block of BC1, or of a texel, and blocks or texels from one tile to the next: what tiles
        // share is the same in both.
        const bool blocks = format_ == ColourFormat::Bc1;
        const std::size_t bytes = blocks ? 8 : 3;
        const std::uint32_t across = blocks ? colourTileTexels / 4 : colourTileTexels;
        const std::uint32_t apart = blocks ? colourTileCells / 4 : colourTileCells;
        for (std::uint32_t j = 0; j < across; ++j) {
            for (std::uint32_t i = 0; i < across; ++i) {
                std::uint64_t value = keyOf({id.face, id.level, 0, 0}) +
                                      (std::uint64_t{id.y * apart + j} << 20) + id.x * apart + i;
                value = (value ^ (value >> 31)) * 0x9E3779B97F4A7C15u;
                value = (value ^ (value >> 29)) * 0xBF58476D1CE4E5B9u;
                std::memcpy(&tile.texels[(std::size_t{j} * across + i) * bytes], &value, bytes);
            }
        }
        return tile;
    }
    void addNoise() {
        addAll([&](const ChunkId& id) { return noiseTile(id); });
    }
};

struct Difference {
    int largest = 0;   // 8-bit steps
    double mean = 0;   // over all pixels and channels
    int contrast = 0;  // of the first picture
};

Difference differenceOf(const Picture& a, const Picture& b) {
    Difference difference;
    int sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const int apart = std::abs(int{a.rgb[i]} - int{b.rgb[i]});
        difference.largest = std::max(difference.largest, apart);
        sum += apart;
    }
    difference.mean = sum / static_cast<double>(a.rgb.size());
    const auto [darkest, lightest] = std::minmax_element(a.rgb.begin(), a.rgb.end());
    difference.contrast = *lightest - *darkest;
    return difference;
}

TEST_F(ClippedColours, AreThoseOfTheTilesAtTheSameResolution) {
    for (const ColourFormat format : {ColourFormat::Bc1, ColourFormat::Lossless}) {
        useFormat(format);
        addNoise();
        std::mt19937 random(17);
        std::vector<View> views;
        std::vector<Picture> fromTiles;
        for (int i = 0; i < 40; ++i) {
            views.push_back(anyView(random));
            fromTiles.push_back(drawn(views.back()));
        }
        useClipmap();
        for (std::size_t i = 0; i < views.size(); ++i) {
            moveTo(views[i]);
            const Difference difference = differenceOf(fromTiles[i], drawn(views[i]));
            EXPECT_LE(difference.largest, 3) << "view " << i;
            EXPECT_LT(difference.mean, 0.05) << "view " << i;
            EXPECT_GT(difference.contrast, 40) << "view " << i;
        }
    }
}

TEST_F(ClippedColours, AreTheSamePictureHoweverTheViewerCameThere) {
    useFormat(ColourFormat::Bc1);
    addNoise();
    std::mt19937 random(23);
    for (int round = 0; round < 6; ++round) {
        const View view = anyView(random);
        useClipmap();
        moveTo(view);
        const Picture fresh = drawn(view);
        for (int step = 0; step < 5; ++step) moveTo(anyView(random), static_cast<int>(random() % 3));
        moveTo(view, 0);  // without fine levels, and with them again
        moveTo(view);
        EXPECT_EQ(drawn(view).rgb, fresh.rgb) << round;
    }
}

TEST_F(ClippedColours, FollowTilesThatComeAndGo) {
    useFormat(ColourFormat::Lossless);
    const auto tile = [&](const ChunkId& id) { return noiseTile(id); };
    addRoots(tile);
    useClipmap(256);
    const View view = smallView({20, 30}, 3e5, -50);
    moveTo(view);
    const Picture coarse = drawn(view);
    const auto expectAsNew = [&] {
        moveTo(view);
        const Picture followed = drawn(view);
        useClipmap(256);
        moveTo(view);
        EXPECT_EQ(drawn(view).rgb, followed.rgb);
        return followed;
    };
    const ChunkId root{Face::PosX, 0, 0, 0};
    addChildren(root, tile);
    const Picture finer = expectAsNew();
    EXPECT_GT(differenceOf(coarse, finer).mean, 5);
    for (int q = 0; q < quadrantCount; ++q) addChildren(childOf(root, q), tile);
    const Picture finest = expectAsNew();
    EXPECT_GT(differenceOf(finer, finest).mean, 5);
    for (int q = 0; q < quadrantCount; ++q) removeChildren(childOf(root, q));
    EXPECT_EQ(expectAsNew().rgb, finer.rgb);
    removeChildren(root);
    EXPECT_EQ(expectAsNew().rgb, coarse.rgb);
}

// What lies above a missing tile is stretched over it, to the same colours as where tiles are drawn from.
TEST_F(ClippedColours, AreThoseOfTheTilesWhereSomeAreMissing) {
    useFormat(ColourFormat::Lossless);
    const ColourSource smooth = test::formulaColours(smoothColour);
    const auto tile = [&](const ChunkId& id) { return tileOf(smooth, id); };
    addRoots(tile);
    addChildren({Face::PosX, 0, 0, 0}, tile);
    addChildren({Face::PosX, 1, 1, 0}, tile);
    addChildren({Face::PosZ, 0, 0, 0}, tile);
    for (const auto& place : {std::pair{5.0, 5.0}, {44.0, 2.0}, {2.0, 44.5}, {35.0, 45.0}}) {
        const View view = smallView(place, 4e5, -40, 70);
        useTiles();
        const Picture tiles = drawn(view);
        useClipmap();
        moveTo(view);
        EXPECT_LE(differenceOf(tiles, drawn(view)).largest, 3) << place.first << " " << place.second;
    }
}

// The picture is far larger than the windows: where they end, the coarser level takes over.
TEST_F(ClippedColours, AreTheSourcesBeyondTheWindowsToo) {
    const ColourSource source = test::formulaColours(smoothColour);
    useFormat(ColourFormat::Lossless);
    const auto tile = [&](const ChunkId& id) { return tileOf(source, id); };
    addRoots(tile);
    for (const Face face : allFaces) addChildren({face, 0, 0, 0}, tile);
    useClipmap(256);
    for (const auto& [latitude, longitude] : placesToSee) {
        for (const double altitudeM : {2e7, 4e6, 5e5}) {
            const View view = viewFrom({}, latitude, longitude, altitudeM);
            moveTo(view);
            EXPECT_LE(furthestFromSource(drawn(view), view), 5)
                << latitude << " " << longitude << " " << altitudeM;
            // Seen from elsewhere than where the windows are.
            moveTo(viewFrom({}, latitude - 15, longitude + 20, altitudeM));
            EXPECT_LE(furthestFromSource(drawn(view), view), 5)
                << latitude << " " << longitude << " " << altitudeM << " from afar";
        }
    }
}

// Each level in a colour of its own, asked for finer than there is: what is seen is how far the windows reach
// and how they fade.
TEST_F(ClippedColours, AreOfTheLevelsThatTheWindowsReach) {
    useFormat(ColourFormat::Lossless);
    const std::array<glm::ivec3, 3> ofLevel = {{{200, 40, 40}, {40, 180, 40}, {60, 60, 190}}};
    addAll([&](const ChunkId& id) { return plainTile(id, ofLevel[id.level]); });
    useClipmap(256);
    settings_.texelsPerPixel = 64;
    const auto linear = [&](int level, int channel) {
        return std::pow((ofLevel[static_cast<std::size_t>(level)][channel] / 255.0 + 0.055) / 1.055, 2.4);
    };
    std::array<int, 3> seen{};
    for (const auto& place : placesToSee) {
        const View view = smallView(place, 3e6);
        moveTo(view);
        const Picture picture = drawn(view);
        const ClipmapCentre centre = clipmapCentre(view.eyeM);
        double sum = 0;
        int pixels = 0;
        for (int row = 0; row < view.heightPx; ++row) {
            for (int column = 0; column < view.widthPx; ++column) {
                const std::optional<glm::dvec3> ground = groundAt(view, column, row);
                if (!ground) continue;
                const FacePoint point = facePointFromDirection(*ground);
                const double finest = clipmapFinest(
                    state().layout,
                    clipmapDistance(centre, point.face, {(point.u + 1) / 2, (point.v + 1) / 2}));
                const int coarser = std::min(static_cast<int>(finest), 1);
                ++seen[static_cast<std::size_t>(std::lround(finest))];
                for (int channel = 0; channel < 3; ++channel) {
                    const double mixed =
                        glm::mix(linear(coarser, channel), linear(coarser + 1, channel), finest - coarser);
                    sum += std::abs(picture.at(column, row)[channel] - srgb(1.2 * mixed));
                    ++pixels;
                }
            }
        }
        EXPECT_LT(sum / pixels, 1.5) << place.first << " " << place.second;
    }
    for (const int pixels : seen) EXPECT_GT(pixels, 1000);
}

TEST_F(ClippedColours, AreBlurredAwayFromTheViewerAndSharpUnderHim) {
    useFormat(ColourFormat::Lossless);
    addNoise();
    const View view = smallView({10, 20}, 6e5);
    useTiles();
    const Picture tiles = drawn(view);
    useClipmap(256);
    moveTo(view);
    EXPECT_LE(differenceOf(tiles, drawn(view)).largest, 3);
    moveTo(smallView({-40, -120}, 6e5));
    EXPECT_GT(differenceOf(tiles, drawn(view)).mean, 5);
}

TEST_F(ClippedColours, AMoveFillsStripsOnly) {
    useFormat(ColourFormat::Bc1);
    addNoise();
    useClipmap(256);
    const double texelDeg = 90.0 / 1024;
    moveTo(smallView({10, 20}, 5e5));
    // Level 0 of six faces, and two windows.
    EXPECT_EQ(state().updatedTexels, 6 * 272 * 272 + 2 * 256 * 256);
    moveTo(smallView({10, 20}, 5e5));
    EXPECT_EQ(state().updatedTexels, 0);
    moveTo(smallView({10, 20 + 16 * texelDeg}, 5e5));
    EXPECT_GT(state().updatedTexels, 0);
    EXPECT_LE(state().updatedTexels, 256 * (24 + 16));
    for (const ClipmapUpdate& update : state().updates) EXPECT_TRUE(update.byMoving);
}

TEST_F(ClippedColours, MemoryIsThatOfTheWindowsAndFreeOnceThereAreNone) {
    useFormat(ColourFormat::Bc1);
    addNoise();
    ChunkRenderer& renderer = planet_.renderer();
    const std::size_t before = renderer.gpuMemory().total();
    EXPECT_EQ(renderer.gpuMemory().colourClipmap, 0u);
    useClipmap(256);
    moveTo(smallView({10, 20}, 5e5));
    EXPECT_EQ(state().baseBytes, 4u * 272 * 272 * 6);
    EXPECT_EQ(state().stackBytes, 4u * 256 * 256 * 2);
    // In a corner of the cube each level takes three windows.
    moveTo(smallView({35.264, 45}, 5e5));
    EXPECT_EQ(state().windows.size(), 6u);
    EXPECT_EQ(state().stackBytes, 4u * 256 * 256 * 6);
    EXPECT_EQ(renderer.gpuMemory().colourClipmap, state().bytes());
    EXPECT_GE(renderer.gpuMemory().total(), before + state().bytes());
    useTiles();
    EXPECT_EQ(renderer.colourClipmap(), nullptr);
    EXPECT_EQ(renderer.gpuMemory().total(), before);
}

TEST_F(ClippedColours, EndWithThePoolThatTheyAreFilledFrom) {
    useFormat(ColourFormat::Bc1);
    addNoise();
    useClipmap();
    const View view = smallView({10, 20}, 5e5);
    moveTo(view);
    useFormat(ColourFormat::Bc1);
    EXPECT_EQ(planet_.renderer().colourClipmap(), nullptr);
    addNoise();
    const Picture tiles = drawn(view);
    useClipmap();
    // Not drawn from until it is filled.
    EXPECT_EQ(drawn(view).rgb, tiles.rgb);
    moveTo(view);
    EXPECT_LE(differenceOf(tiles, drawn(view)).largest, 3);
}

TEST_F(ClippedColours, WhatIsBoundForDrawingStays) {
    useFormat(ColourFormat::Bc1);
    addNoise();
    useClipmap();
    const RenderTarget target = valueOf(RenderTarget::create(64, 48, 1));
    target.bind();
    glViewport(1, 2, 30, 40);
    GLint bound = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
    moveTo(smallView({10, 20}, 5e5));
    GLint after = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &after);
    EXPECT_EQ(after, bound);
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    EXPECT_THAT(viewport, testing::ElementsAre(1, 2, 30, 40));
}

}  // namespace
}  // namespace planet::gl
