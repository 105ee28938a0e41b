#include "planet/bake/rim_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "planet/bake/bake.h"
#include "planet/bake/file_report.h"
#include "planet/format/chunk_file.h"
#include "tests/support/sparse_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::boxAround;
using test::FineBox;

constexpr int rimCells = 2048;
const FineBox fineBox = boxAround({0.1, 0.2, 1}, 0.05, rimCells);

// How far a direction lies inside of the fine box, in units of the cube; negative outside.
double insideBy(const glm::dvec3& direction) {
    const FacePoint point = facePointFromDirection(direction);
    if (point.face != Face::PosZ) return -1;
    const glm::dvec3 on = cubePoint(point.face, point.u, point.v);
    return std::min(
        {on.x - fineBox.low.x, fineBox.high.x - on.x, on.y - fineBox.low.y, fineBox.high.y - on.y});
}

// Bakes heights that depend on the distance from the rim of the fine box, and verifies the file.
VerifyReport verified(const std::function<double(double)>& heightM, bool isSparse = true) {
    const tests::TemporaryFolder folder;
    HeightSource source = test::formulaSource([&](const glm::dvec3& d) { return heightM(insideBy(d)); },
                                              -1000, 1000, 1, rimCells + 1);
    if (isSparse) source = test::sparse(std::move(source), {fineBox}, 64);
    const auto path = folder / "a.chk";
    const BakeSettings settings{.faceSize = isSparse ? rimCells + 1 : 257, .chunkSize = 17};
    const auto baked = bake(source, settings, path);
    EXPECT_TRUE(baked) << baked.error().message;
    const VerifyReport report = verifyFile(ChunkFile::open(path).value(), nullptr).value();
    EXPECT_EQ(report.problemCount, 0u);
    return report;
}

TEST(RimSteps, CliffAtARimIsFound) {
    const auto rims = verified([](double inside) { return inside > 0 ? 400 : 0; }).rims;
    ASSERT_TRUE(rims);
    EXPECT_GT(rims->leaves, 0u);
    EXPECT_EQ(rims->steepest.stepM, 400);
    EXPECT_LT(std::abs(insideBy(directionFromGeographic(rims->steepest.place))), 2 * 2.0 / rimCells);
    // In the middle of a face, a cell has 2 / 2048 of the radius times the square root of 1 / 2.
    EXPECT_NEAR(rims->steepest.overM, 4400, 100);
    EXPECT_EQ(rims->levelLargestSlope, rims->steepest.slope());
}

TEST(RimSteps, BlendAtARimIsAsSteepAsItsWidthSays) {
    // 400 m over a tenth of the cube's side that the box spans: 0.025 of 1, about 125 km.
    const auto rims = verified([](double inside) { return std::clamp(inside / 0.025, 0.0, 1.0) * 400; }).rims;
    ASSERT_TRUE(rims);
    EXPECT_GT(rims->steepest.stepM, 10);
    EXPECT_LT(rims->steepest.stepM, 25);
}

TEST(RimSteps, CliffAwayFromTheRimDoesNotCount) {
    const auto rims = verified([](double inside) { return inside > 0.04 ? 700 : 0; }).rims;
    ASSERT_TRUE(rims);
    EXPECT_EQ(rims->steepest.stepM, 0);
    EXPECT_EQ(rims->steepest.slope(), 0);
}

TEST(RimSteps, PlanetOfOneDepthHasNoRims) {
    EXPECT_FALSE(verified([](double inside) { return inside > 0 ? 400 : 0; }, false).rims);
}

}  // namespace
}  // namespace planet
