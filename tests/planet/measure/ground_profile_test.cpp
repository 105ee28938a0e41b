#include "planet/measure/ground_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "planet/measure/pick.h"
#include "planet/select/drawn_surface.h"
#include "tests/support/fake_selection.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

const glm::dvec3 fromPlace{1, 0.2, 0.3};
const glm::dvec3 toPlace{0.1, 1, -0.6};  // over two edges of faces

GroundProfile measured(const ProfileGround& ground, int count = 301) {
    FinestHeights heights(pyramidLoader());
    return groundProfile(ground, heights, fromPlace, toPlace, count).value();
}

View lookingDown() {
    CameraPose pose;
    pose.latitudeDeg = 5;
    pose.longitudeDeg = 45;
    pose.altitudeM = 2 * fakePyramid().shape.radiusM;
    return viewFromPose(pose, fakePyramid().shape.radiusM, 1.2, 1280, 720);
}

// Returns the height of the picked surface in a direction, by a ray from above.
double pickedM(const ChunkTree& tree, const Selection& selection, const glm::dvec3& direction) {
    const double radiusM = tree.shape.radiusM;
    const auto hit = pickSurface(tree, selection.draw, 2 * radiusM * direction, -direction);
    EXPECT_TRUE(hit);
    return hit ? glm::length(hit->positionM) - radiusM : 0;
}

TEST(GroundProfile, drawnAndFinestAreWhatRaysHit) {
    const ChunkTree coarse = residentTree(fakePyramid(), 2);
    const Selection drawn = select(coarse, lookingDown(), withoutCulling(1e-6));
    const Selection finest = select(wholeTree(), lookingDown(), withoutCulling(1e-6));
    const GroundProfile profile = measured(profileGroundOf(coarse, drawn.draw, lookingDown(), false));
    double mostApartM = 0;
    for (const ProfilePoint& point : profile.points) {
        ASSERT_TRUE(point.drawnM);
        EXPECT_NEAR(*point.drawnM, pickedM(coarse, drawn, point.direction), 1e-3);
        EXPECT_NEAR(point.finestM, pickedM(wholeTree(), finest, point.direction), 1e-3);
        mostApartM = std::max(mostApartM, std::abs(*point.drawnM - point.finestM));
    }
    EXPECT_GT(mostApartM, 1) << "the coarse surface is no different, so nothing is compared";
    EXPECT_NEAR(summaryOf(profile).worstErrorM, mostApartM, 1e-9);
}

TEST(GroundProfile, hasNoErrorWhereTheFinestChunksAreDrawn) {
    const Selection all = select(wholeTree(), lookingDown(), withoutCulling(1e-6));
    const ProfileSummary summary =
        summaryOf(measured(profileGroundOf(wholeTree(), all.draw, lookingDown(), false)));
    EXPECT_EQ(summary.drawn, 301u);
    EXPECT_LT(summary.worstErrorM, 1e-6);
}

TEST(GroundProfile, whereNothingIsDrawnTheFinestDataAreReadFromTheRoots) {
    const ChunkTree coarse = residentTree(fakePyramid(), 1);
    const GroundProfile without = measured(profileGroundOf(coarse, {}, lookingDown(), false));
    const Selection drawn = select(coarse, lookingDown(), withoutCulling(1e-6));
    const GroundProfile with = measured(profileGroundOf(coarse, drawn.draw, lookingDown(), false));
    ASSERT_EQ(without.points.size(), with.points.size());
    for (std::size_t i = 0; i < with.points.size(); ++i) {
        EXPECT_FALSE(without.points[i].drawnM);
        EXPECT_EQ(without.points[i].finestM, with.points[i].finestM);
    }
    EXPECT_EQ(summaryOf(without).drawn, 0u);
}

// The reference is the drawn surface's own point at a place, which need not lie in the direction of that place.
TEST(GroundProfile, seesMorphAndStitchedEdges) {
    const ChunkTree tree = residentTree(fakePyramid(), 3);
    LodSettings settings = withoutCulling(3);
    settings.seams = SeamMode::Stitched;
    settings.morph = true;
    const View view = lookingDown();
    const Selection selection = select(tree, view, settings);
    const ProfileGround ground = profileGroundOf(tree, selection.draw, view, true);
    FinestHeights heights(pyramidLoader());
    std::mt19937 random(4);
    bool isMorphed = false;
    bool isStitched = false;
    for (int i = 0; i < 300; ++i) {
        const std::size_t item = random() % selection.draw.size();
        const DrawnGrid grid =
            drawnGrid(tree.shape, selection.draw[item], *tree.nodes[selection.draw[item].node].heights, true);
        std::uniform_real_distribution<double> cell(0.05, grid.cells - 0.05);
        const glm::dvec3 point = pointOn(grid, cell(random), cell(random));
        const auto profile = groundProfile(ground, heights, point, point + glm::dvec3(0, 0, 1e-7), 2);
        ASSERT_TRUE(profile);
        ASSERT_TRUE(profile->points[0].drawnM);
        EXPECT_NEAR(*profile->points[0].drawnM, glm::length(point) - tree.shape.radiusM, 1e-4);
        isMorphed |= selection.draw[item].morph > 0;
        isStitched |= grid.stitched;
    }
    EXPECT_TRUE(isMorphed);
    EXPECT_TRUE(isStitched);
}

TEST(GroundProfile, hasEqualStepsAlongTheGreatCircle) {
    const ChunkTree coarse = residentTree(fakePyramid(), 1);
    FinestHeights heights(pyramidLoader());
    const auto profile =
        groundProfile(profileGroundOf(coarse, {}, lookingDown(), false), heights, {0, 0, 5}, {0, 7, 0}, 91);
    ASSERT_TRUE(profile);
    const double radiusM = coarse.shape.radiusM;
    EXPECT_NEAR(summaryOf(*profile).arcM, radiusM * std::numbers::pi / 2, 1e-6);
    for (std::size_t i = 0; i < 91; ++i) {
        const double turned = static_cast<double>(i) * std::numbers::pi / 180;
        EXPECT_NEAR(
            glm::length(profile->points[i].direction - glm::dvec3(0, std::sin(turned), std::cos(turned))), 0,
            1e-12);
        EXPECT_NEAR(profile->points[i].alongM, radiusM * turned, 1e-6);
    }
}

TEST(GroundProfile, takesSomeGreatCircleBetweenOppositePlacesAndNoneBetweenTheSame) {
    const ChunkTree coarse = residentTree(fakePyramid(), 1);
    const ProfileGround ground = profileGroundOf(coarse, {}, lookingDown(), false);
    FinestHeights heights(pyramidLoader());
    const auto half = groundProfile(ground, heights, fromPlace, -fromPlace, 33);
    ASSERT_TRUE(half);
    EXPECT_NEAR(summaryOf(*half).arcM, coarse.shape.radiusM * std::numbers::pi, 1e-6);
    for (const ProfilePoint& point : half->points) EXPECT_NEAR(glm::length(point.direction), 1, 1e-12);
    const auto none = groundProfile(ground, heights, fromPlace, 2.0 * fromPlace, 33);
    ASSERT_TRUE(none);
    const ProfileSummary summary = summaryOf(*none);
    EXPECT_NEAR(summary.arcM, 0, 1e-6);
    EXPECT_EQ(summary.slopeRad, 0);
    EXPECT_EQ(summary.steepestRad, 0);
}

TEST(GroundProfile, endsWhenItIsCancelledOrABlockCannotBeRead) {
    const ChunkTree coarse = residentTree(fakePyramid(), 1);
    const ProfileGround ground = profileGroundOf(coarse, {}, lookingDown(), false);
    FinestHeights heights(pyramidLoader());
    int calls = 0;
    const auto stopped =
        groundProfile(ground, heights, fromPlace, toPlace, 100, [&] { return ++calls < 10; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().kind, ErrorKind::Cancelled);
    EXPECT_EQ(calls, 10);
    FinestHeights broken([](const ChunkId& parent, BlockLocation, StepsView) {
        return Result<SiblingBlock>(ioError("hills.chk: reading the block of chunk " + toString(parent)));
    });
    const auto failed = groundProfile(ground, broken, fromPlace, toPlace, 100);
    ASSERT_FALSE(failed);
    EXPECT_NE(failed.error().message.find("hills.chk"), std::string::npos);
}

// A ramp of 100 m over 1 km, then a fall of 50 m over 1 km, of which half is not drawn.
TEST(GroundProfile, theSummaryOfAKnownGroundIsThatGround) {
    GroundProfile profile;
    profile.radiusM = 1e6;
    const auto add = [&](double alongM, double finestM, std::optional<double> drawnM) {
        const double turned = alongM / profile.radiusM;
        profile.points.push_back({{std::cos(turned), std::sin(turned), 0}, alongM, finestM, drawnM});
    };
    add(0, 0, 2);
    add(1000, 100, 93);
    add(2000, 50, std::nullopt);
    const ProfileSummary summary = summaryOf(profile);
    EXPECT_EQ(summary.arcM, 2000);
    EXPECT_EQ(summary.riseM, 50);
    EXPECT_EQ(summary.ascentM, 100);
    EXPECT_EQ(summary.descentM, 50);
    EXPECT_EQ(summary.lowestM, 0);
    EXPECT_EQ(summary.highestM, 100);
    EXPECT_EQ(summary.drawn, 2u);
    EXPECT_EQ(summary.worstErrorM, 7);
    EXPECT_EQ(summary.worstAlongM, 1000);
    // The planet's curve changes the lengths by less than 1 m here.
    EXPECT_NEAR(summary.onGroundM, std::hypot(1000, 100) + std::hypot(1000, 50), 1);
    EXPECT_NEAR(summary.straightM, std::hypot(2000, 50), 1);
    EXPECT_NEAR(summary.steepestRad, std::atan(0.1), 1e-4);
    EXPECT_NEAR(summary.slopeRad, std::atan(0.025), 1e-4);
}

}  // namespace
}  // namespace planet
