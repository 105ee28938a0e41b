// Seams between chunks of different levels, morphs and faces: where the vertex shader puts their vertices,
// and whether the picture shows anything between them.
#include <gmock/gmock.h>

#include <array>
#include <map>
#include <random>
#include <set>

#include "planet/sphere/geometric_error.h"
#include "tests/planet/gl/gl_test.h"
#include "tests/planet/gl/test_planet.h"
#include "tests/support/seam_patchwork.h"

namespace planet::gl {
namespace {

class Seams : public GlTest {
protected:
    Seams() : planet_(smallChunks(), 24 * 64) {
        target_.bind();
        for (const ChunkId& id : seamPatchwork()) planet_.add(id, mountains);
        morphAtRandom(planet_.items(), random_);
        stitched_.stitched = true;
    }

    std::vector<glm::vec3> positions(std::span<const DrawItem> items, const RenderSettings& settings) {
        return valueOf(planet_.renderer().readVertexPositions(view_, items, settings));
    }

    using Bits = std::array<float, 3>;  // no component is -0 or NaN, so comparing floats compares bits
    std::size_t vertexCount() const { return static_cast<std::size_t>(chunkVertexCount(planet_.shape())); }
    std::set<Bits> edgeVertices(const std::vector<glm::vec3>& all, std::size_t item, Edge edge) const {
        const auto size = static_cast<std::size_t>(chunkSize(planet_.shape()));
        std::set<Bits> vertices;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t last = size - 1;
            const std::array<std::size_t, edgeCount> at = {i * size, i * size + last, i, last * size + i};
            const glm::vec3& p = all[item * vertexCount() + at[static_cast<std::size_t>(edge)]];
            vertices.insert({p.x, p.y, p.z});
        }
        return vertices;
    }

    // Pixels where nothing is drawn until curtains hang down from all borders: through a crack the far side
    // is seen from behind, which is culled.
    int crackPixels(const View& view, std::vector<DrawItem> items, const RenderSettings& settings) {
        const Picture open = drawPicture(planet_.renderer(), view, items, settings);
        for (DrawItem& item : items) item.skirtDepthM = 300000;
        const Picture closed = drawPicture(planet_.renderer(), view, items, settings);
        int cracks = 0;
        for (std::size_t i = 0; i < open.depth.size(); ++i)
            cracks += open.depth[i] == open.clearDepth && closed.depth[i] != closed.clearDepth;
        return cracks;
    }

    RenderTarget target_ = valueOf(RenderTarget::create(8, 8));
    TestPlanet planet_;
    RenderSettings stitched_ = plainSettings();
    View view_ = viewFrom({}, 33, 44, 700000);
    std::mt19937 random_{5};
};

TEST_F(Seams, StitchedNeighboursHaveTheVerySameVertices) {
    const std::vector<DrawItem>& items = planet_.items();
    const auto all = positions(items, stitched_);
    std::map<ChunkId, std::size_t> indexOf;
    for (std::size_t i = 0; i < items.size(); ++i) indexOf[items[i].id] = i;
    const Neighbourhood neighbourhood(items);
    std::map<std::pair<int, bool>, int> pairs;  // by difference of levels and whether across faces
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (const Edge edge : allEdges) {
            const DrawItem* other = neighbourhood.beyond(items[i].id, edge);
            if (other == nullptr) continue;
            const int coarser = items[i].id.level - other->id.level;
            const std::set<Bits> own = edgeVertices(all, i, edge);
            // An edge that morphs fully has let go of its odd vertices.
            const bool halved = items[i].edgeMorph[static_cast<std::size_t>(edge)] == 1;
            EXPECT_EQ(own.size(), static_cast<std::size_t>((16 >> coarser >> (halved ? 1 : 0)) + 1));
            std::set<Bits> border;
            for (const Edge side : allEdges) border.merge(edgeVertices(all, indexOf[other->id], side));
            EXPECT_TRUE(std::includes(border.begin(), border.end(), own.begin(), own.end()))
                << toString(items[i].id) << " beside " << toString(other->id);
            ++pairs[{coarser, items[i].id.face != other->id.face}];
        }
    }
    for (const int coarser : {0, 1, 2, 3}) {
        for (const bool acrossFaces : {false, true})
            EXPECT_GT((pairs[{coarser, acrossFaces}]), 10) << coarser << acrossFaces;
    }
}

TEST_F(Seams, AMorphingEdgeMovesWithTheCoarserChunksVertices) {
    std::vector<DrawItem> still = planet_.items();
    for (DrawItem& item : still) item.morph = 0;
    fillEdges(still);
    EXPECT_NE(positions(planet_.items(), stitched_), positions(still, stitched_));
    // One seam: the coarser chunk morphs by half or fully, the finer one does not.
    const auto finer =
        std::find_if(still.begin(), still.end(), [](const DrawItem& item) { return item.coarserBy[0] == 2; });
    ASSERT_NE(finer, still.end());
    DrawItem item = *finer;
    const auto before = positions({&item, 1}, stitched_);
    item.edgeMorph[0] = 0.5f;
    const auto halfway = positions({&item, 1}, stitched_);
    item.edgeMorph[0] = 1;
    const auto after = positions({&item, 1}, stitched_);
    // Along the face's edge; of four to a face's side the chunk's own start is a multiple of 16.
    const std::array<std::size_t, 17> onto = {0, 0, 0, 4, 4, 4, 8, 8, 8, 8, 8, 12, 12, 12, 16, 16, 16};
    for (std::size_t row = 0; row <= 16; ++row) {
        const std::size_t at = onto[row];
        EXPECT_EQ(before[row * 17], before[at * 17]) << row;
        if (at % 8 == 0) {
            EXPECT_EQ(halfway[row * 17], before[at * 17]) << row;
            EXPECT_EQ(after[row * 17], before[at * 17]) << row;
        } else {
            const glm::vec3 middle = 0.5f * (before[(at - 4) * 17] + before[(at + 4) * 17]);
            const glm::vec3 way = 0.5f * (before[at * 17] + middle);
            EXPECT_LT(glm::length(halfway[row * 17] - way), 1e-6f * glm::length(way)) << row;
            EXPECT_EQ(after[row * 17], before[(at == 4 ? 0 : 16) * 17]) << row;
        }
    }
}

TEST_F(Seams, StitchedWithoutSkirtsShowNothingBetween) {
    int cracks = 0;
    for (const auto& [latitudeDeg, longitudeDeg, altitudeM] :
         {std::array{30.0, 40.0, 3e5}, {0.0, 0.0, 2e5}, {-20.0, 45.0, 4e5}, {80.0, 10.0, 2e5}}) {
        for (const double headingDeg : {0.0, 130.0, 250.0}) {
            const View view = viewFrom({}, latitudeDeg, longitudeDeg, altitudeM, -20, headingDeg, 400, 300);
            EXPECT_EQ(crackPixels(view, planet_.items(), stitched_), 0) << latitudeDeg << " " << headingDeg;
            cracks += crackPixels(view, planet_.items(), plainSettings());
        }
    }
    EXPECT_GT(cracks, 100) << "what is not stitched";
}

TEST_F(Seams, AnEvenLevelHasNoCracksEvenBetweenFaces) {
    TestPlanet even(smallChunks(), 384);
    even.addLevel(3, mountains);
    planet_ = std::move(even);
    for (const double latitudeDeg : {35.264, 10.0})
        EXPECT_EQ(crackPixels(viewFrom({}, latitudeDeg, 45, 2e5, -20, 20, 400, 400), planet_.items(),
                              plainSettings()),
                  0);
}

TEST_F(Seams, WithoutStitchingACoarserNeighbourMovesNothing) {
    std::vector<DrawItem> items = planet_.items();
    for (DrawItem& item : items) item.morph = 0;
    fillEdges(items);
    std::vector<DrawItem> alone = items;
    for (DrawItem& item : alone) {
        item.coarserBy = {};
        item.edgeMorph = {};
    }
    EXPECT_EQ(positions(items, plainSettings()), positions(alone, plainSettings()));
    EXPECT_EQ(positions(alone, stitched_), positions(alone, plainSettings()));
    // Beside a coarser chunk an edge then morphs by itself.
    const auto finer =
        std::find_if(items.begin(), items.end(), [](const DrawItem& item) { return item.coarserBy[0] > 0; });
    ASSERT_NE(finer, items.end());
    DrawItem item = *finer;
    item.edgeMorph[0] = 1;
    const auto still = positions({&*finer, 1}, plainSettings());
    const auto moved = positions({&item, 1}, plainSettings());
    EXPECT_EQ(moved[2 * 17], still[2 * 17]);
    EXPECT_NE(moved[3 * 17], still[3 * 17]);
}

// The point of the parent's mesh at a vertex, in doubles.
TEST_F(Seams, AMorphSlidesVerticesToTheParentsMesh) {
    const PlanetShape& shape = planet_.shape();
    const ChunkId id{Face::PosY, 3, 5, 2};
    const auto steps = chunkSteps(shape, id, mountains);
    planet_.renderer().upload(0, steps);
    const FaceSquare square = faceSquareOf(id);
    const auto own = [&](int column, int row) {
        const double u = square.u + square.side * column / 16;
        const double v = square.v + square.side * row / 16;
        const auto index = static_cast<std::size_t>(row * 17 + column);
        return positionM(shape, sphereFromCube(cubePoint(id.face, u, v)), heightM(shape, steps[index])) -
               view_.eyeM;
    };
    for (const float morph : {0.0f, 0.25f, 1.0f}) {
        DrawItem item;
        item.id = id;
        item.morph = morph;
        item.edgeMorph = {morph, morph / 2, morph, 0};
        const auto drawn = positions({&item, 1}, plainSettings());
        for (int row = 0; row <= 16; ++row) {
            for (int column = 0; column <= 16; ++column) {
                const int aside = column % 2;
                const int up = row % 2;
                const glm::dvec3 middle =
                    0.5 * (own(column - aside, row - up) + own(column + aside, row + up));
                const float share = column == 0    ? item.edgeMorph[0]
                                    : column == 16 ? item.edgeMorph[1]
                                    : row == 0     ? item.edgeMorph[2]
                                    : row == 16    ? item.edgeMorph[3]
                                                   : morph;
                const glm::dvec3 expected = glm::mix(own(column, row), middle, static_cast<double>(share));
                const glm::dvec3 at = drawn[static_cast<std::size_t>(row * 17 + column)];
                EXPECT_LT(glm::length(at - expected), 1e-6 * glm::length(expected)) << column << " " << row;
            }
        }
    }
}

// When a chunk takes the place of its wholly morphed children, neither shape nor light must jump.
TEST_F(Seams, WhollyMorphedChildrenLookLikeTheirParents) {
    const auto rough = [](const glm::dvec3& d) {
        return 8000 + 1500 * std::sin(150 * d.x) * std::cos(140 * d.y) +
               900 * std::sin(260 * d.z + 240 * d.x);
    };
    TestPlanet parents({}, 96);
    parents.addLevel(2, rough);
    TestPlanet children({}, 384);
    children.addLevel(3, rough);
    RenderSettings settings;
    settings.surface = SurfaceColour::HeightRamp;
    settings.sunDirection = {1, 1.3, 0.4};
    settings.detail = FeatureUse::Off;
    const View view = viewFrom({}, 20, 15, 1.5e6, -70, 0, 400, 300);
    const Picture wanted = drawPicture(parents.renderer(), view, parents.items(), settings);
    const auto difference = [&](float morph) {
        for (DrawItem& item : children.items()) {
            item.morph = morph;
            item.edgeMorph = {morph, morph, morph, morph};
        }
        const Picture picture = drawPicture(children.renderer(), view, children.items(), settings);
        double sum = 0;
        for (std::size_t i = 0; i < picture.rgb.size(); ++i) sum += std::abs(picture.rgb[i] - wanted.rgb[i]);
        return sum / static_cast<double>(picture.rgb.size());
    };
    const double own = difference(0);
    EXPECT_GT(own, 1);
    EXPECT_LT(difference(0.5), 0.7 * own);
    EXPECT_LT(difference(1), 0.1 * own);
}

TEST_F(Seams, AWholeMorphMovesSiblingsByTheirParentsDeltaG) {
    const PlanetShape& shape = planet_.shape();
    const ChunkId parent{Face::NegX, 2, 1, 3};
    std::vector<std::int32_t> refined(33 * 33);
    std::vector<DrawItem> items(4);
    for (int quadrant = 0; quadrant < quadrantCount; ++quadrant) {
        DrawItem& item = items[static_cast<std::size_t>(quadrant)];
        item.id = childOf(parent, quadrant);
        item.slot = static_cast<std::uint32_t>(quadrant);
        const auto steps = chunkSteps(shape, item.id, mountains);
        planet_.renderer().upload(item.slot, steps);
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const std::size_t column = i % 17 + (quadrant % 2 == 1 ? 16 : 0);
            refined[(i / 17 + (quadrant > 1 ? 16 : 0)) * 33 + column] = steps[i];
        }
    }
    const auto own = positions(items, plainSettings());
    for (DrawItem& item : items) {
        item.morph = 1;
        item.edgeMorph = {1, 1, 1, 1};
    }
    const auto parents = positions(items, plainSettings());
    double furthestM = 0;
    for (std::size_t i = 0; i < own.size(); ++i)
        furthestM = std::max(furthestM, static_cast<double>(glm::length(own[i] - parents[i])));
    GeometricErrorScratch scratch;
    EXPECT_NEAR(furthestM, geometricErrorM(shape, parent, refined, scratch), 3);
    EXPECT_GT(furthestM, 1000);
}

}  // namespace
}  // namespace planet::gl
