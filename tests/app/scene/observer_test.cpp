#include "app/scene/observer.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/data/bake_job.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/sudden_lod.h"

namespace worldy {
namespace {

// Where a point stands in a view's picture, in halves of its width and height; nothing behind the eye.
std::optional<glm::dvec2> placeInPicture(const planet::View& view, const glm::dvec3& pointM) {
    const glm::dvec3 offset = pointM - view.eyeM;
    const double ahead = -glm::dot(offset, view.back);
    if (ahead <= 0) return std::nullopt;
    const double scale = planet::screenScalePx(view);
    return glm::dvec2(glm::dot(offset, view.right) / ahead * scale * 2 / view.widthPx,
                      glm::dot(offset, view.up) / ahead * scale * 2 / view.heightPx);
}

bool isInPicture(const planet::View& view, const glm::dvec3& pointM) {
    const std::optional<glm::dvec2> place = placeInPicture(view, pointM);
    return place && std::abs(place->x) < 1 && std::abs(place->y) < 1;
}

TEST(Observer, beginsWhereItSeesTheEyeAndTheGroundBelowIt) {
    for (const double altitudeM : {50.0, 5000.0, 4e5, 1.4e7, 1e8}) {
        for (const double pitchDeg : {-90.0, -20.0, 30.0}) {
            const planet::View lodView =
                planet::viewFromPose({27, 86, altitudeM, 120, pitchDeg}, planet::earthRadiusM, 1.0, 800, 600);
            const Ground ground{planet::earthRadiusM, 0};
            const Camera observer = observerStart(lodView, ground);
            const planet::View view = viewOf(observer, glm::radians(60.0), 800, 600);
            EXPECT_NEAR(glm::dot(observer.right, glm::normalize(observer.eyeM)), 0, 1e-9);
            EXPECT_GT(glm::length(observer.eyeM), glm::length(lodView.eyeM) * 0.999);
            EXPECT_TRUE(isInPicture(view, lodView.eyeM)) << altitudeM;
            if (altitudeM < 1e7) {
                EXPECT_TRUE(isInPicture(view, planet::earthRadiusM * glm::normalize(lodView.eyeM)))
                    << altitudeM;
            }
        }
    }
}

TEST(Observer, theFrustumReachesTheGroundOrTheHorizon) {
    const planet::View down =
        planet::viewFromPose({.altitudeM = 1000, .pitchDeg = -90}, planet::earthRadiusM, 0.2, 400, 400);
    EXPECT_NEAR(frustumLengthM(down, planet::earthRadiusM),
                1000 * std::sqrt(1 + 2 * std::pow(std::tan(0.1), 2)), 5);
    const planet::View level =
        planet::viewFromPose({.altitudeM = 1000, .pitchDeg = 0}, planet::earthRadiusM, 0.2, 400, 400);
    const double horizonM = std::sqrt(2 * planet::earthRadiusM * 1000 + 1e6);
    EXPECT_NEAR(frustumLengthM(level, planet::earthRadiusM), horizonM, 1);
    const planet::View up =
        planet::viewFromPose({.altitudeM = 1000, .pitchDeg = 90}, planet::earthRadiusM, 0.2, 400, 400);
    EXPECT_NEAR(frustumLengthM(up, planet::earthRadiusM), 1000, 1e-6);
}

class ObserverLines : public testing::Test {
protected:
    ObserverLines() : planet_(*planet::Planet::open(planet::fakePyramid().source(), {})) {
        view_ = planet::viewFromPose({.altitudeM = 2e4, .pitchDeg = -60}, 1e5, 1.0, 800, 600);
        nothing_.showFrustum = false;
        nothing_.showHorizon = false;
        planet::LodSettings lod = planet::suddenLod();
        lod.tauPx = 2;
        planet_->settle(
            view_, lod, [](std::uint32_t, planet::StepsView) {}, 60);
    }
    planet::Lines linesOf(const CameraSettings& settings, std::optional<planet::ChunkId> selected = {}) {
        return observerLines(*planet_, view_, settings, selected);
    }

    CameraSettings nothing_;
    std::unique_ptr<planet::Planet> planet_;
    planet::View view_;
};

TEST_F(ObserverLines, eachSwitchAddsItsLines) {
    const std::size_t eyeAlone = linesOf(nothing_).size();
    EXPECT_GT(eyeAlone, 0u);
    CameraSettings frustum = nothing_;
    frustum.showFrustum = true;
    EXPECT_GT(linesOf(frustum).size(), eyeAlone);
    CameraSettings horizon = nothing_;
    horizon.showHorizon = true;
    EXPECT_GT(linesOf(horizon).size(), eyeAlone);
    CameraSettings distances = nothing_;
    distances.showSwitchDistances = true;
    EXPECT_EQ(linesOf(distances).size(), eyeAlone);
    EXPECT_GT(linesOf(distances, planet::ChunkId{}).size(), eyeAlone);
    EXPECT_EQ(linesOf(distances, planet::ChunkId{planet::Face::PosX, 9, 1, 1}).size(), eyeAlone);
}

TEST_F(ObserverLines, switchDistancesLieWhereTheErrorIsExactlyTau) {
    CameraSettings distances = nothing_;
    const std::size_t before = linesOf(distances).size();
    distances.showSwitchDistances = true;
    const planet::ChunkId id{planet::Face::PosX, 1, 0, 0};
    const planet::NodeIndex index = planet::findNode(planet_->tree(), id);
    ASSERT_NE(index, planet::noNode);
    const planet::ChunkNode& node = planet_->tree().nodes[index];
    const planet::Lines lines = linesOf(distances, id);
    std::size_t checked = 0;
    for (std::size_t i = before; i < lines.size(); ++i) {
        const double distanceM = planet::distanceM(node.bounds.box, lines[i].positionM);
        if (distanceM < 1e-3) continue;  // the bounds themselves
        const double epsPx = static_cast<double>(node.deltaCM) * planet::screenScalePx(view_) / distanceM;
        ASSERT_NEAR(epsPx, 2, 1e-6);
        ++checked;
    }
    EXPECT_GT(checked, 100u);
}

}  // namespace
}  // namespace worldy
