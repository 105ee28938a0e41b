// Streamed tiles of colour on the GPU, held to the colours that they were made of.
#include "planet/gl/store/tile_pool.h"

#include <gmock/gmock.h>

#include "planet/sphere/face_fold.h"
#include "tests/planet/gl/streamed_colours.h"

namespace planet::gl {
namespace {

TEST_F(StreamedColours, AreTheSourcesEverywherePolesAndDateLineIncluded) {
    const ColourSource source = test::formulaColours(smoothColour);
    for (const ColourFormat format : {ColourFormat::Lossless, ColourFormat::Bc1}) {
        useFormat(format);
        addAll([&](const ChunkId& id) { return tileOf(source, id); });
        for (const auto& [latitude, longitude] :
             {std::pair{0.0, 0.0}, {90.0, 0.0}, {-90.0, 0.0}, {10.0, 180.0}, {35.0, 45.0}, {-35.0, -135.0}}) {
            for (const double altitudeM : {2e7, 4e6, 5e5}) {
                const View view = viewFrom({}, latitude, longitude, altitudeM);
                EXPECT_LE(furthestFromSource(drawn(view), view), format == ColourFormat::Bc1 ? 8 : 5)
                    << latitude << " " << longitude << " " << altitudeM;
            }
        }
    }
}

// Returns the face that a direction passes through; nothing if it passes within a distance of an edge.
std::optional<Face> faceAwayFromEdges(const glm::dvec3& direction, double distance) {
    const glm::dvec3 away = glm::abs(direction);
    const int axis = away.x > away.y && away.x > away.z ? 0 : away.y > away.z ? 1 : 2;
    if (away[axis] - std::max(away[(axis + 1) % 3], away[(axis + 2) % 3]) < distance) return std::nullopt;
    glm::dvec3 normal(0);
    normal[axis] = direction[axis] < 0 ? -1 : 1;
    return faceAlong(normal);
}

// A pixel then covers up to dozens of texels of a root, so the mipmaps of the roots are drawn. Up to its edges, a face shows
// no colour of another face and no empty texel.
TEST_F(StreamedColours, OfAFarPlanetAreThoseOfItsFaces) {
    constexpr std::array<double, faceCount> linear = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    for (const ColourFormat format : {ColourFormat::Lossless, ColourFormat::Bc1}) {
        useFormat(format);
        addAll([&](const ChunkId& id) {
            return plainTile(id, glm::ivec3(srgb(linear[static_cast<std::size_t>(id.face)])));
        });
        for (const double altitudeM : {2e7, 6e7, 1.5e8}) {
            const double pixel =
                1.5 * altitudeM / PlanetShape().radiusM / 129;  // in radii, and a little more
            for (const auto& [latitude, longitude] : {std::pair{35.0, 45.0}, {-35.0, -135.0}}) {
                const View view = viewFrom({}, latitude, longitude, altitudeM, -90, 0, 129, 129);
                const Picture picture = drawn(view);
                int compared = 0;
                for (int pixelIndex = 0; pixelIndex < 129 * 129; ++pixelIndex) {
                    const int column = pixelIndex % 129;
                    const int row = pixelIndex / 129;
                    const auto ground = groundAt(view, column, row);
                    if (!ground) continue;
                    const auto face = faceAwayFromEdges(*ground, pixel);
                    if (!face) continue;
                    const double expected = linear[static_cast<std::size_t>(*face)];
                    EXPECT_NEAR(picture.at(column, row).y, srgb(1.2 * expected),
                                format == ColourFormat::Bc1 ? 6 : 2)
                        << altitudeM << " " << column << " " << row;
                    ++compared;
                }
                EXPECT_GT(compared, 10) << altitudeM;
            }
        }
    }
}

TEST_F(StreamedColours, AreThoseOfTheFinestTileThatIsThere) {
    useFormat(ColourFormat::Lossless);
    const std::array<glm::ivec3, 3> ofLevel = {{{200, 40, 40}, {40, 180, 40}, {60, 60, 190}}};
    const auto plain = [&](const ChunkId& id) { return plainTile(id, ofLevel[id.level]); };
    const auto levelFrom = [&](double altitudeM) {
        const glm::ivec3 seen = colourFrom(altitudeM);
        for (int level = 0; level < 3; ++level) {
            // The strongest channel tells.
            if (seen[level] > seen[(level + 1) % 3] && seen[level] > seen[(level + 2) % 3]) return level;
        }
        return -1;
    };
    addRoots(plain);
    EXPECT_EQ(levelFrom(1e5), 0);
    const ChunkId root{Face::PosX, 0, 0, 0};
    addChildren(root, plain);
    EXPECT_EQ(levelFrom(1e5), 1);
    addChildren(childOf(root, 3), plain);
    EXPECT_EQ(levelFrom(1e5), 2);
    removeChildren(childOf(root, 3));
    EXPECT_EQ(levelFrom(1e5), 1);
    removeChildren(root);
    EXPECT_EQ(levelFrom(1e5), 0);
}

// In a face's middle a texel of level l is sqrt(2) R / (256 2^l) metres wide.
TEST_F(StreamedColours, AreOfTheLevelWithATexelAPixel) {
    useFormat(ColourFormat::Lossless);
    const std::array<glm::ivec3, 3> ofLevel = {{{200, 40, 40}, {40, 180, 40}, {60, 60, 190}}};
    addAll([&](const ChunkId& id) { return plainTile(id, ofLevel[id.level]); });
    const double scalePx = 33 / (2 * std::tan(glm::radians(30.0)));
    const auto altitudeOf = [&](double level) {
        return std::sqrt(2.0) * PlanetShape().radiusM / (256 * std::exp2(level)) * scalePx;
    };
    const auto lightest = [](const glm::ivec3& c) {
        return c.x > std::max(c.y, c.z) ? 0 : c.y > c.z ? 1 : 2;
    };
    EXPECT_EQ(lightest(colourFrom(altitudeOf(0.0), 0.5, 0.5)), 0);
    EXPECT_EQ(lightest(colourFrom(altitudeOf(1.0), 0.5, 0.5)), 1);
    EXPECT_EQ(lightest(colourFrom(altitudeOf(2.0), 0.5, 0.5)), 2);
    settings_.texelsPerPixel = 2;
    EXPECT_EQ(lightest(colourFrom(altitudeOf(0.0), 0.5, 0.5)), 1);
    settings_.texelsPerPixel = 0.5;
    EXPECT_EQ(lightest(colourFrom(altitudeOf(2.0), 0.5, 0.5)), 1);
}

TEST_F(StreamedColours, GiveWayToTheImageWhereTheyAreNotWanted) {
    const std::vector<std::uint8_t> rgb(16 * 8 * 3, 90);
    ASSERT_TRUE(planet_.renderer().setColourImage(rgb, 16, 8));
    const glm::ivec3 image = colourFrom(1e5);
    useFormat(ColourFormat::Bc1);
    addRoots([&](const ChunkId& id) { return plainTile(id, {200, 40, 40}); });
    EXPECT_GT(colourFrom(1e5).x, image.x + 50);
    settings_.streamed = false;
    EXPECT_EQ(colourFrom(1e5), image);
    settings_.streamed = true;
    ASSERT_TRUE(planet_.renderer().setColours(std::nullopt));
    EXPECT_EQ(colourFrom(1e5), image);
}

TEST_F(StreamedColours, MoreTilesThanTheContextHoldsAreRefused) {
    const auto made = TilePool::create(ColourPoolConfig{ColourFormat::Bc1, leaf, mostColourTiles() + 1});
    ASSERT_FALSE(made);
    EXPECT_THAT(made.error().message, testing::HasSubstr("GL_MAX_ARRAY_TEXTURE_LAYERS"));
}

}  // namespace
}  // namespace planet::gl
