#include "app/measure/comparison.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>

#include "app/measure/comparison_job.h"
#include "app/scene/offscreen.h"
#include "tests/app/session_fixture.h"
#include "tests/support/job_result.h"

namespace worldy {
namespace {

using testing::HasSubstr;

constexpr double pi = 3.14159265358979;

class ComparisonTest : public test::SessionTest {
protected:
    std::filesystem::path bakeHills(const std::string& name = "hills.chk", double radiusM = 100'000) const {
        std::ofstream stream(folder_ / "hills.pgm", std::ios::binary);
        stream << "P5\n256 128\n255\n";
        for (int row = 0; row < 128; ++row) {
            for (int column = 0; column < 256; ++column) {
                const double x = 2 * pi * column / 256, y = pi * row / 128;
                stream.put(static_cast<char>(
                    std::lround(100 + 100 * std::sin(6 * x) * std::sin(y) * std::cos(5 * y))));
            }
        }
        stream.close();
        planet::HeightSourceSettings heights;
        heights.metresPerUnit = 20;
        const auto source = planet::openHeightSource(folder_ / "hills.pgm", heights);
        const planet::BakeSettings settings{.faceSize = 129, .chunkSize = 17, .radiusM = radiusM};
        if (!source || !planet::bake(*source, settings, folder_ / name)) throw std::runtime_error("no bake");
        return folder_ / name;
    }
    ComparisonPlan planFor(const std::filesystem::path& file) const {
        ComparisonPlan plan;
        plan.sides[0].chunkFile = plan.sides[1].chunkFile = file;
        plan.path.name = "Down";
        plan.path.keys = {{0, {10, 20, 200'000, 0, -80}}, {1, {12, 21, 15'000, 0, -50}}};
        plan.moments = 2;
        plan.popStepS = 0.05;
        plan.size = {200, 150};
        return plan;
    }
    static ComparedPair compare(const ComparisonPlan& plan) {
        auto pair = compareOverFlight(plan, [](double) { return true; });
        if (!pair) throw std::runtime_error(pair.error().message);
        return *pair;
    }
};

TEST_F(ComparisonTest, equalSettingsHaveEqualFigures) {
    ComparedPair pair = compare(planFor(bakeHills()));
    ASSERT_TRUE(pair[0].frameMs && pair[1].frameMs);
    pair[0].frameMs = pair[1].frameMs = 0;
    EXPECT_EQ(pair[0], pair[1]);
    for (const CompareRow& row : compareRows())
        EXPECT_EQ((pair[0].*row.value).has_value(), row.flight) << row.name;
    EXPECT_GT(pair[0].bytesRead, 0);
    EXPECT_GT(pair[0].switches, 0);
    EXPECT_EQ(pair[0].late, 0);
    EXPECT_EQ(pair[0].violations, 0);
}

TEST_F(ComparisonTest, aLargerTauHasFewerTrianglesAndALargerError) {
    ComparisonPlan plan = planFor(bakeHills());
    plan.sides[0].settings.lod.tauPx = 1;
    plan.sides[1].settings.lod.tauPx = 8;
    const ComparedPair pair = compare(plan);
    EXPECT_LT(*pair[1].triangles, 0.7 * *pair[0].triangles);
    EXPECT_LT(*pair[1].residentBytes, *pair[0].residentBytes);
    EXPECT_LT(*pair[1].bytesRead, *pair[0].bytesRead);
    EXPECT_GT(*pair[1].worstErrorPx, 2 * *pair[0].worstErrorPx);
    EXPECT_GE(*pair[1].p99ErrorPx, *pair[0].p99ErrorPx);
    EXPECT_GT(*pair[1].worstDrawnBoundPx, *pair[1].worstErrorPx);
    EXPECT_GE(*pair[1].worstDrawnBoundPx, *pair[1].worstEpsPx);
}

TEST_F(ComparisonTest, stitchedSeamsHaveNoCrackPixelsWhereNoneHaveSome) {
    ComparisonPlan plan = planFor(bakeHills());
    plan.path.keys = {{0, {12, 21, 100'000, 0, -70}}, {1, {12, 21, 60'000, 0, -60}}};
    plan.size = {640, 400};
    for (ComparedSide& side : plan.sides) {
        side.settings.lod.tauPx = 2;
        side.settings.lod.morph = false;
    }
    plan.sides[0].settings.lod.seams = planet::SeamMode::None;
    plan.sides[1].settings.lod.seams = planet::SeamMode::Stitched;
    const ComparedPair pair = compare(plan);
    EXPECT_GT(*pair[0].crackPx, 0);
    EXPECT_EQ(pair[0].leakingPx, pair[0].crackPx);
    EXPECT_EQ(pair[1].crackPx, 0);
}

// The sea is so high that it covers all land where it is drawn as water.
TEST_F(ComparisonTest, anAutomaticSeaIsTakenAsItIsDrawn) {
    ComparisonPlan plan = planFor(bakeHills());
    const auto offscreen = openOffscreen({.chunkFile = plan.sides[0].chunkFile}, {}, plan.size, 1);
    ASSERT_TRUE(offscreen);
    const bool software = offscreen->scene.renderer.chunks().capabilities().software;
    for (ComparedSide& side : plan.sides) {
        side.settings.lod.morph = false;
        side.settings.surface.seaLevelM = 9000;
    }
    plan.sides[0].settings.surface.light.sea.use = planet::gl::FeatureUse::Automatic;
    plan.sides[1].settings.surface.light.sea.use =
        software ? planet::gl::FeatureUse::Off : planet::gl::FeatureUse::On;
    const ComparedPair pair = compare(plan);
    EXPECT_EQ(*pair[0].worstPopPx > 0, software);
    EXPECT_EQ(pair[0].worstPopPx, pair[1].worstPopPx);
}

TEST_F(ComparisonTest, whatIsWrongIsToldByName) {
    ComparisonPlan plan = planFor(bakeHills());
    plan.sides[1].chunkFile = folder_ / "none.chk";
    const auto none = compareOverFlight(plan, [](double) { return true; });
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("none.chk"));
    plan.sides[1].chunkFile = bakeHills("moon.chk", 50'000);
    const auto moon = compareOverFlight(plan, [](double) { return true; });
    ASSERT_FALSE(moon);
    EXPECT_THAT(moon.error().message, HasSubstr("that of B 50000 m"));
    EXPECT_FALSE(compareInPictures(plan, [](double) { return true; }));
}

TEST_F(ComparisonTest, progressOnlyGrowsAndFalseEndsIt) {
    const ComparisonPlan plan = planFor(bakeHills());
    double last = 0;
    const auto cancelled = compareOverFlight(plan, [&](double share) {
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1);
        last = share;
        return share < 0.6;
    });
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_GE(last, 0.6);
}

TEST_F(ComparisonTest, picturesAreOfTheMomentThatDiffersMost) {
    ComparisonPlan plan = planFor(bakeHills());
    const auto equal = compareInPictures(plan, [](double) { return true; });
    ASSERT_TRUE(equal);
    EXPECT_EQ(equal->pixels, 0u);
    EXPECT_EQ(equal->largestSteps, 0);
    EXPECT_EQ(equal->a.rgb, equal->b.rgb);
    plan.sides[0].settings.lod.tauPx = 1;
    plan.sides[1].settings.lod.tauPx = 16;
    const auto other = compareInPictures(plan, [](double) { return true; });
    ASSERT_TRUE(other);
    EXPECT_GT(other->pixels, 100u);
    EXPECT_EQ(other->timeS, 1);
    EXPECT_EQ(other->a.width, 200);
    EXPECT_NE(other->a.rgb, other->b.rgb);
}

TEST(ComparedPictures, aDifferenceIsThatOfEachChannelTimesTheGain) {
    const Picture a{2, 1, {10, 20, 30, 0, 0, 255}};
    const Picture b{2, 1, {12, 20, 25, 0, 0, 0}};
    EXPECT_EQ(differenceOf(a, b, 1).rgb, (std::vector<std::uint8_t>{2, 0, 5, 0, 0, 255}));
    EXPECT_EQ(differenceOf(a, b, 8).rgb, (std::vector<std::uint8_t>{16, 0, 40, 0, 0, 255}));
    const Picture both = besideEachOther({1, 2, {1, 1, 1, 2, 2, 2}}, {1, 2, {3, 3, 3, 4, 4, 4}});
    EXPECT_EQ(both.width, 2);
    EXPECT_EQ(both.rgb, (std::vector<std::uint8_t>{1, 1, 1, 3, 3, 3, 2, 2, 2, 4, 4, 4}));
}

// The context of the fixture stays current here meanwhile, as the window's does.
using ComparisonJobTest = ComparisonTest;

TEST_F(ComparisonJobTest, measuresOnAThreadAndInAContextOfItsOwn) {
    ComparisonPlan plan = planFor(bakeHills());
    plan.sides[1].settings.lod.tauPx = 8;
    ComparisonJob job(plan);
    const auto result = tests::resultOf(job);
    ASSERT_TRUE(result) << result.error().message;
    ComparedPair here = compare(plan), there = *result;
    for (ComparedPair* pair : {&here, &there}) (*pair)[0].frameMs = (*pair)[1].frameMs = 0;
    EXPECT_EQ(here, there);
    EXPECT_FALSE(job.takeResult());
}

TEST_F(ComparisonJobTest, cancellingEndsIt) {
    ComparisonPlan plan = planFor(bakeHills());
    plan.moments = 100'000;
    ComparisonJob job(plan);
    while (job.progress() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    job.cancel();
    const auto result = tests::resultOf(job);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, planet::ErrorKind::Cancelled);
    // So does dropping it.
    ComparisonJob dropped(plan);
}

TEST(CompareTable, sayWhatBIsOfA) {
    const CompareRow& triangles = compareRows().front();
    EXPECT_EQ(changeText(triangles, 100, 53), "x 0.53");
    EXPECT_EQ(changeText(triangles, 5, 5), "=");
    EXPECT_EQ(changeText(triangles, 0, 0), "=");
    EXPECT_EQ(changeText(triangles, 0, 12), "+12");
    EXPECT_EQ(changeText(triangles, 12, 0), "-12");
    EXPECT_EQ(changeText(triangles, 1, 2500), "x 2500");
    EXPECT_EQ(changeText(triangles, std::nullopt, 3), "-");
    EXPECT_EQ(figureText(triangles, std::nullopt), "-");
    EXPECT_EQ(figureText(triangles, 950), "950");
    const auto rows = compareRows();
    const auto pop = std::find_if(rows.begin(), rows.end(), [](const CompareRow& row) {
        return std::string_view(row.key) == "worst_pop_px";
    });
    ASSERT_NE(pop, rows.end());
    for (const auto& [px, text] : {std::pair(0.0, "0 px"),
                                   {0.00412, "0.00412 px"},
                                   {0.2046, "0.205 px"},
                                   {0.229, "0.229 px"},
                                   {9.876, "9.88 px"},
                                   {12.34, "12.3 px"}})
        EXPECT_EQ(figureText(*pop, px), text);
}

}  // namespace
}  // namespace worldy
