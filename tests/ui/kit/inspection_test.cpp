#include "ui/kit/inspection.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace worldy::ui {
namespace {

constexpr double radiusM = 1000;

planet::View nearOf(const planet::View& measured, const glm::dvec3& placeM) {
    return planet::viewFromPose(inspectionOf({}, measured, placeM, radiusM).pose, radiusM, 1, 640, 480);
}

TEST(Inspection, comesNearerAlongTheLineOfSightAndLooksAtThePlace) {
    const planet::View measured = planet::viewFromPose({0, 0, 1000, 0, -90}, radiusM, 1, 640, 480);
    const glm::dvec3 placeM = radiusM * glm::normalize(measured.eyeM + glm::dvec3(0, 300, 200));
    const planet::View near = nearOf(measured, placeM);
    EXPECT_NEAR(glm::length(near.eyeM - placeM), 0.35 * glm::length(measured.eyeM - placeM), 1e-6);
    EXPECT_NEAR(glm::dot(-near.back, glm::normalize(placeM - near.eyeM)), 1, 1e-9);
    EXPECT_NEAR(glm::length(glm::cross(glm::normalize(measured.eyeM - placeM), near.back)), 0, 1e-9);
}

TEST(Inspection, aPlaceBeyondTheHorizonIsSeenFromAboveTheGround) {
    const planet::View measured = planet::viewFromPose({0, 0, 500, 0, -90}, radiusM, 1, 640, 480);
    const glm::dvec3 below = -radiusM * glm::normalize(measured.eyeM);
    for (const glm::dvec3& aside : {glm::dvec3(0), glm::dvec3(0, 900, 0), glm::dvec3(300, 2000, 900)}) {
        const glm::dvec3 placeM = radiusM * glm::normalize(below + aside);
        const planet::View near = nearOf(measured, placeM);
        EXPECT_GT(glm::length(near.eyeM), radiusM);
        EXPECT_GT(glm::dot(near.back, glm::normalize(placeM)), 0.1);
        EXPECT_NEAR(glm::dot(-near.back, glm::normalize(placeM - near.eyeM)), 1, 1e-9);
    }
}

}  // namespace
}  // namespace worldy::ui
