#include "planet/select/shadow_cascades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <set>

#include "tests/support/fake_selection.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet {

namespace {

View someView(double pitchDeg, double headingDeg = 20, double altitudeM = 8000) {
    return viewFromPose({20, 30, altitudeM, headingDeg, pitchDeg}, earthRadiusM, glm::radians(60.0), 1280,
                        768);
}

// A point of the view's picture so far along its direction, relative to the eye.
glm::dvec3 pointIn(const View& view, double x, double y, double alongM) {
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    return alongM * (-view.back + x * tanX * view.right + y * tanY * view.up);
}

TEST(ShadowCascades, HoldTheirPiecesOfTheView) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const View view = someView(-45 + 45 * unit(random), 180 * unit(random));
        const glm::dvec3 sun(unit(random), unit(random), unit(random));
        const double groundM = std::exp2(12 + 2 * unit(random));
        const ShadowCascades cascades = shadowCascades(view, sun, groundM, 2e5, 1024);
        double startM = groundM;
        for (const ShadowCascade& cascade : cascades) {
            ASSERT_GT(cascade.endM, startM);
            for (int corner = 0; corner < 8; ++corner) {
                const glm::dvec3 at = pointIn(view, corner & 1 ? 1 : -1, corner & 2 ? 1 : -1,
                                              corner & 4 ? cascade.endM : startM);
                const glm::dvec4 clip = cascade.clipFromEye * glm::dvec4(at, 1);
                for (int axis = 0; axis < 3; ++axis) ASSERT_LE(std::abs(clip[axis]), 1 + 1e-9);
            }
            startM = cascade.endM;
        }
        EXPECT_NEAR(cascades.back().endM, 2e5, 1e-6);
    }
}

TEST(ShadowCascades, WhatIsNearerToTheSunIsLessDeep) {
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    for (const ShadowCascade& cascade : shadowCascades(someView(-30), sun, 1000, 1e5, 512)) {
        const glm::dvec4 here = cascade.clipFromEye * glm::dvec4(100, 200, 300, 1);
        const glm::dvec4 nearer = cascade.clipFromEye * glm::dvec4(glm::dvec3(100, 200, 300) + 50.0 * sun, 1);
        EXPECT_NEAR(nearer.x, here.x, 1e-9);
        EXPECT_NEAR(nearer.y, here.y, 1e-9);
        EXPECT_NEAR(here.z - nearer.z, 2 * 50 / (512 * cascade.texelM), 1e-9);
    }
}

// A fixed place keeps its place within a texel while the camera moves and turns.
TEST(ShadowCascades, MoveInWholeTexels) {
    const glm::dvec3 sun(0.6, 0.2, 0.5);
    const View first = someView(-30);
    const glm::dvec3 place = first.eyeM + pointIn(first, 0.1, -0.2, 3000);
    const auto texelOf = [&](const View& view, std::size_t i) {
        const ShadowCascade cascade = shadowCascades(view, sun, 1000, 1e5, 1024)[i];
        const glm::dvec4 clip = cascade.clipFromEye * glm::dvec4(place - view.eyeM, 1);
        return (glm::dvec2(clip) * 0.5 + 0.5) * 1024.0;
    };
    for (std::size_t i = 0; i < shadowCascadeCount; ++i) {
        const glm::dvec2 before = texelOf(first, i);
        for (int step = 1; step < 20; ++step) {
            const View moved = someView(-30 + 0.7 * step, 20 + 1.3 * step, 8000 + 37 * step);
            const glm::dvec2 by = texelOf(moved, i) - before;
            EXPECT_NEAR(by.x, std::round(by.x), 1e-4);
            EXPECT_NEAR(by.y, std::round(by.y), 1e-4);
        }
    }
}

TEST(ShadowCasters, AreWhatTheViewLeavesOutWithinReach) {
    std::mt19937 random(9);
    std::size_t beside = 0;
    for (int i = 0; i < 100; ++i) {
        const View view = randomView(random, 1e5);
        const double reachM = 3e4 * (1 + i % 20);
        LodSettings settings = suddenLod();
        settings.tauPx = 4;
        const auto drawn = drawnIds(select(wholeTree(), view, settings));
        std::set<ChunkId> casters;
        for (const DrawItem& item : shadowCasters(wholeTree(), view, settings, reachM))
            casters.insert(item.id);
        beside += casters.size();
        const Selection all = select(wholeTree(), view, withoutCulling(4));
        for (const DrawItem& item : all.draw) {
            const bool isNear = static_cast<double>(item.distanceM) <= reachM;
            EXPECT_EQ(casters.contains(item.id), isNear && !drawn.contains(item.id)) << toString(item.id);
        }
    }
    EXPECT_GT(beside, 100u);
}

TEST(ShadowCasters, AreNoneWhereNothingIsCulled) {
    std::mt19937 random(10);
    EXPECT_TRUE(shadowCasters(wholeTree(), randomView(random, 1e5), withoutCulling(4), 1e9).empty());
}

}  // namespace

}  // namespace planet
