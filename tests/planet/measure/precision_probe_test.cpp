// The precision probe against planted errors of known size.
#include "planet/measure/precision_probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace planet {
namespace {

PlanetShape earthOfMetres() {
    PlanetShape shape;
    shape.faceCellsLog2 = 19;
    return shape;
}

std::vector<std::int16_t> hills(const PlanetShape& shape) {
    std::mt19937 random(3);
    std::uniform_int_distribution<int> step(-500, 4000);
    std::vector<std::int16_t> heights(static_cast<std::size_t>(chunkVertexCount(shape)));
    for (std::int16_t& height : heights) height = static_cast<std::int16_t>(step(random));
    return heights;
}

// A chunk of a level, and a view from some way above its middle.
struct Place {
    PlanetShape shape = earthOfMetres();
    std::vector<std::int16_t> heights = hills(shape);
    DrawItem item;
    View view;

    explicit Place(int level, double aboveM) {
        item.id = chunkAt({Face::PosY, 0.3, -0.4}, level);
        const glm::dvec3 middle = drawnVertex(shape, item, heights, false, 16, 16).positionM;
        view.up = glm::normalize(middle);
        view.right = glm::normalize(glm::cross(view.up, glm::dvec3(0, 0, 1)));
        view.back = glm::cross(view.right, view.up);
        view.eyeM = middle + aboveM * glm::normalize(view.up + 0.3 * view.back);
    }
    VertexPrecision at(const VertexFrame& frame, glm::ivec2 vertex, bool stitched = false) const {
        return vertexPrecision(shape, frame, item, heights, stitched, view, vertex);
    }
    VertexFrame frame() const { return vertexFrame(shape, view.eyeM); }
};

TEST(PrecisionProbe, TheShadersFloatsAreWrongByAMillionthOfTheDistanceAtMost) {
    for (const double aboveM : {20.0, 3e3, 2e5}) {
        Place place(12, aboveM);
        for (const float morph : {0.0f, 0.4f, 1.0f}) {
            place.item.morph = morph;
            place.item.edgeMorph.fill(morph);
            place.item.coarserBy = {0, 1, 0, 2};
            for (const bool stitched : {false, true}) {
                const VertexPrecision worst = worstPrecision(place.shape, place.frame(), place.item,
                                                             place.heights, stitched, place.view);
                EXPECT_LT(worst.shader.errorM, 1e-6 * worst.distanceM + 1e-4);
                EXPECT_LT(worst.shader.errorPx, 1e-6 * screenScalePx(place.view) + 0.01);
                EXPECT_GE(worst.shader.errorPx, 0);
            }
        }
    }
}

// The reference point put a known way off: every vertex is off by just that.
TEST(PrecisionProbe, AShiftedReferenceIsFoundWithItsSize) {
    const Place place(13, 900);
    VertexFrame frame = place.frame();
    const glm::dvec3 shiftM(0.25, -0.5, 0.125);
    frame.faces[static_cast<std::size_t>(Face::PosY)].originM += glm::vec3(shiftM);
    for (const glm::ivec2 vertex : {glm::ivec2(0, 0), glm::ivec2(16, 16), glm::ivec2(32, 7)}) {
        const VertexPrecision probe = place.at(frame, vertex);
        EXPECT_NEAR(probe.shader.errorM, glm::length(shiftM), 0.005 * glm::length(shiftM));
        const glm::dvec3 sight = glm::normalize(probe.positionM - place.view.eyeM);
        const double acrossM = glm::length(shiftM - glm::dot(shiftM, sight) * sight);
        const double expectedPx = acrossM * screenScalePx(place.view) / probe.distanceM;
        EXPECT_NEAR(probe.shader.errorPx, expectedPx, 0.02 * expectedPx);
    }
}

// One kept with numbers of ten million metres, whose last bit is a metre: off by what that rounds away.
TEST(PrecisionProbe, AReferenceInLargeNumbersIsFoundAsWhatTheyRoundAway) {
    const Place place(13, 900);
    VertexFrame frame = place.frame();
    glm::vec3& originM = frame.faces[static_cast<std::size_t>(Face::PosY)].originM;
    const glm::vec3 exactM = originM;
    const float farM = 10'000'000;
    originM = (originM + glm::vec3(farM)) - glm::vec3(farM);
    const double roundedM = glm::length(glm::dvec3(originM - exactM));
    ASSERT_GT(roundedM, 0.05);
    const VertexPrecision probe = place.at(frame, {16, 16});
    EXPECT_NEAR(probe.shader.errorM, roundedM, 0.02 * roundedM);
    EXPECT_LT(place.at(place.frame(), {16, 16}).shader.errorM, 1e-3);
}

// From the planet's centre each coordinate of Earth is a multiple of 1/4 or 1/2 m.
TEST(PrecisionProbe, FloatsFromTheCentreAreWrongByWhatTheyRound) {
    const Place place(13, 900);
    double worstM = 0;
    for (int row = 0; row <= 32; ++row) {
        const VertexPrecision probe = place.at(place.frame(), {5, row});
        const auto rounded = [](double coordinate) {
            const double unit = std::exp2(std::floor(std::log2(std::abs(coordinate))) - 23);
            return std::round(coordinate / unit) * unit - coordinate;
        };
        const auto roundedAll = [&](const glm::dvec3& p) {
            return glm::dvec3(rounded(p.x), rounded(p.y), rounded(p.z));
        };
        const double expectedM = glm::length(roundedAll(probe.positionM) - roundedAll(place.view.eyeM));
        EXPECT_NEAR(probe.fromCentre.errorM, expectedM, 0.02 * expectedM + 1e-4);
        worstM = std::max(worstM, probe.fromCentre.errorM);
    }
    EXPECT_GT(worstM, 0.1);
}

TEST(PrecisionProbe, TheWorstVertexIsTheWorstOfAll) {
    const Place place(10, 5000);
    const VertexFrame frame = place.frame();
    const VertexPrecision worst =
        worstPrecision(place.shape, frame, place.item, place.heights, false, place.view);
    for (int row = 0; row <= 32; ++row) {
        for (int column = 0; column <= 32; ++column)
            EXPECT_LE(place.at(frame, {column, row}).shader.errorPx, worst.shader.errorPx);
    }
    EXPECT_EQ(place.at(frame, worst.vertex).shader.errorPx, worst.shader.errorPx);
}

TEST(PrecisionProbe, TheNearestVertexIsFoundWhereItIsDrawn) {
    Place place(10, 5000);
    place.item.morph = 0.7f;
    for (const glm::ivec2 vertex : {glm::ivec2(3, 4), glm::ivec2(17, 30), glm::ivec2(32, 32)}) {
        const glm::dvec3 there =
            drawnVertex(place.shape, place.item, place.heights, false, vertex.x, vertex.y).positionM;
        EXPECT_EQ(nearestVertex(place.shape, place.item, place.heights, false, there + glm::dvec3(0.5)),
                  vertex);
    }
}

}  // namespace
}  // namespace planet
