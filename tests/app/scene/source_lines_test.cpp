#include "app/scene/source_lines.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <numbers>

#include "app/scene/overlay_colours.h"
#include "tests/support/planet_fixture.h"

namespace worldy {
namespace {

constexpr double rad = std::numbers::pi / 180;

// A square of four degrees around a place.
planet::SourceLayer squareAt(double latitudeDeg, double longitudeDeg) {
    planet::SourceLayer layer;
    layer.middle = {latitudeDeg * rad, longitudeDeg * rad};
    planet::Outline outline;
    for (const auto& [y, x] : {std::pair{-2, -2}, {-2, 2}, {2, 2}, {2, -2}, {-2, -2}})
        outline.push_back({(latitudeDeg + y) * rad, (longitudeDeg + x) * rad});
    layer.outlines.push_back(outline);
    return layer;
}

TEST(SourceLines, OutlinesLieOnTheGroundInTheColourOfTheirLayer) {
    const auto planet = planet::openFake(planet::fakePyramid().source());
    const planet::View view = planet::viewAt(10, 20);
    ASSERT_TRUE(planet->settle(view, {}, planet::noUpload, planet::timeoutS));
    const planet::ChunkTree& tree = planet->tree();
    planet::SourceLayers source;
    source.layers = {squareAt(-10, -160), squareAt(10, 20)};
    const planet::Lines lines = sourceLines(source, tree, view);
    // The first square is behind the planet.
    ASSERT_EQ(lines.size(), 8u);
    for (const planet::LineVertex& vertex : lines) {
        EXPECT_EQ(vertex.colour, colourBytes(layerColour(1), 255));
        const double groundM = tree.shape.radiusM + planet::sampledHeightM(tree, vertex.positionM);
        const double liftM = glm::length(vertex.positionM) - groundM;
        const double pixelM = glm::length(vertex.positionM - view.eyeM) / planet::screenScalePx(view);
        EXPECT_NEAR(liftM / pixelM, 2, 0.05);
    }
}

TEST(SourceLines, CameraOverALayerSeesAllOfIt) {
    const auto planet = planet::openFake(planet::fakePyramid().source());
    const planet::SourceLayer layer = squareAt(10, 20);
    EXPECT_NEAR(reachRad(layer), std::sqrt(2 * 2 + 2 * 2) * rad, 0.03 * rad);
    const planet::CameraPose pose = poseOver(layer, planet->tree());
    EXPECT_DOUBLE_EQ(pose.latitudeDeg, 10);
    EXPECT_DOUBLE_EQ(pose.longitudeDeg, 20);
    const planet::View view = planet::viewFromPose(pose, planet->tree().shape.radiusM, 1.05, 1000, 700);
    for (const planet::Geographic& place : layer.outlines[0]) {
        const glm::dvec3 away =
            planet->tree().shape.radiusM * planet::directionFromGeographic(place) - view.eyeM;
        const double ahead = -glm::dot(away, view.back);
        EXPECT_LT(std::abs(glm::dot(away, view.up)), ahead * std::tan(1.05 / 2) * 0.7);
    }
    planet::SourceLayer whole;
    whole.coversPlanet = true;
    EXPECT_DOUBLE_EQ(reachRad(whole), std::numbers::pi);
}

}  // namespace
}  // namespace worldy
