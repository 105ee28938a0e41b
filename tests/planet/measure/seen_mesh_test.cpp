#include "planet/measure/seen_mesh.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace planet {
namespace {

// From the origin along -z; 100 pixels to the unit at distance 1, so a pixel's footprint at z is z / 100.
View straightView() {
    View view;
    view.widthPx = 200;
    view.heightPx = 100;
    view.horizontalFovRad = 1.5707963267948966;
    return view;
}

TEST(SeenMesh, TellsTheDistanceAtAPixelsCentre) {
    SeenMesh mesh(straightView());
    mesh.add({glm::dvec3(-100, -100, -10), {100, -100, -10}, {0, 200, -10}}, 7);
    const auto hit = mesh.frontAt(100, 50);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->label, 7u);
    EXPECT_EQ(hit->offPx, 0);
    EXPECT_NEAR(hit->distanceM, 10, 1e-9);
    EXPECT_NEAR(hit->nearestM, 10, 1e-9);
    EXPECT_NEAR(hit->farthestM, 10, 1e-9);
    EXPECT_NEAR(*mesh.nearestAtM(3, 97), 10, 1e-9);
    EXPECT_NEAR(glm::length(SeenMesh::pointAt(straightView(), 100, 50, 10) - glm::dvec3(0.05, -0.05, -10)), 0,
                1e-9);
}

TEST(SeenMesh, TheFrontOneIsTheNearest) {
    SeenMesh mesh(straightView());
    mesh.add({glm::dvec3(-100, -100, -20), {100, -100, -20}, {0, 200, -20}}, 1);
    mesh.add({glm::dvec3(-100, -100, -10), {100, -100, -10}, {0, 200, -10}}, 2);
    EXPECT_EQ(mesh.frontAt(100, 50)->label, 2u);
    EXPECT_NEAR(*mesh.nearestAtM(100, 50), 10, 1e-9);
}

TEST(SeenMesh, EdgeOnTheDistanceIsARange) {
    // A wall along the line of sight through the middle of pixel 100, as wide as a thousandth of a pixel.
    SeenMesh mesh(straightView());
    const double left = 0.00499;
    const double right = 0.00501;
    mesh.add({glm::dvec3(left * 10, -5, -10), {right * 40, -5, -40}, {right * 40, 5, -40}}, 1);
    mesh.add({glm::dvec3(left * 10, -5, -10), {right * 40, 5, -40}, {left * 10, 5, -10}}, 1);
    const auto hit = mesh.frontAt(100, 50);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->nearestM, 10, 1e-6);
    EXPECT_NEAR(hit->farthestM, 40, 1e-6);
}

TEST(SeenMesh, BesideItTheClosestIsFoundAndSaysHowFarOff) {
    SeenMesh mesh(straightView());
    mesh.add({glm::dvec3(-10, -10, -10), {0, -10, -10}, {0, 10, -10}});  // its right edge is at x = 100 px
    const auto hit = mesh.frontAt(100, 50);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->offPx, 0.5, 1e-9);
    EXPECT_FALSE(mesh.nearestAtM(100, 50));
    EXPECT_FALSE(mesh.frontAt(110, 50));
}

TEST(SeenMesh, WhatIsBehindTheEyeIsLeftOut) {
    SeenMesh mesh(straightView());
    mesh.add({glm::dvec3(-100, -100, 10), {100, -100, 10}, {0, 200, 10}});
    EXPECT_FALSE(mesh.frontAt(100, 50));
    // And of a triangle through the eye's plane only that part: a floor from behind to far ahead.
    mesh.add({glm::dvec3(-1000, -1, 50), {1000, -1, 50}, {0, -1, -1000}});
    const auto floor = mesh.frontAt(100, 74);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->distanceM, 1 / 0.245, 1e-6);
    EXPECT_FALSE(mesh.nearestAtM(100, 20));
}

}  // namespace
}  // namespace planet
