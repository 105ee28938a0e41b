#include "app/measure/sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/measure/sweep_plot.h"

namespace worldy {
namespace {

using testing::HasSubstr;

SweepPoint pointOf(double tauPx, double triangles, double errorPx) {
    SweepPoint point;
    point.tauPx = tauPx;
    point.figures.frames = 3;
    point.figures.meanGroundTriangles = 0.6 * triangles;
    point.figures.meanSkirtTriangles = 0.4 * triangles;
    point.figures.meanTriangles = triangles;
    point.figures.medianFrameMs = triangles / 1000;
    point.figures.mostResidentMiB = triangles / 5000;
    point.figures.worstMeasuredPx = errorPx;
    return point;
}

TEST(Sweep, theFrontHoldsWhatNothingElseBeats) {
    std::vector<SweepPoint> points = {pointOf(1, 100, 1), pointOf(2, 50, 2), pointOf(3, 60, 2.5),
                                      pointOf(4, 50, 2), pointOf(5, 50, 2.1)};
    markFront(points, SweepCost::Triangles);
    std::vector<bool> front;
    for (const SweepPoint& point : points) front.push_back(point.onFront);
    EXPECT_EQ(front, (std::vector{true, true, false, true, false}));
}

TEST(Sweep, theTablesHoldEveryPoint) {
    const std::vector<SweepPoint> points = {pointOf(1, 100, 0.5), pointOf(2, 50, 1.5)};
    const std::string csv = sweepCsv(points);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
    EXPECT_THAT(csv, testing::StartsWith("schema_version,metric,chunk_size,tau_px,mean_ground_triangles,mean_"
                                         "skirt_triangles,mean_triangles"));
    EXPECT_THAT(csv, HasSubstr("\n2,additive,33,2,30,20,50,"));
    const auto json = nlohmann::json::parse(sweepJson(points, "a.chk", "Down", SweepCost::FrameMs));
    EXPECT_EQ(json["cost"], "median frame, ms");
    EXPECT_EQ(json["points"][1]["worst_measured_px"], 1.5);
    EXPECT_EQ(json["frames"], 3);
}

TEST(Sweep, countsAreWholeNumbersInBothTables) {
    SweepPoint point = pointOf(0.5, 1234567.25, 0.5);
    point.figures.mostTriangles = 12345678;
    point.figures.violations = 3;
    point.onFront = true;
    const auto json =
        nlohmann::json::parse(sweepJson({{point}}, "a.chk", "Down", SweepCost::FrameMs))["points"][0];
    EXPECT_TRUE(json["chunk_size"].is_number_integer());
    EXPECT_EQ(json["most_triangles"].dump(), "12345678");
    EXPECT_EQ(json["violations"].dump(), "3");
    EXPECT_EQ(json["on_front"], true);
    EXPECT_TRUE(json["tau_px"].is_number_float());
    EXPECT_THAT(sweepCsv({{point}}), HasSubstr("\n2,additive,33,0.5,"));
    EXPECT_THAT(sweepCsv({{point}}), HasSubstr(",1234567.25,12345678,"));
    EXPECT_THAT(sweepCsv({{point}}), testing::EndsWith(",3,true\n"));
}

TEST(Sweep, aGoalIsANameAndALimitOverZero) {
    const auto error = tauGoalFromText("error_px=1.5");
    ASSERT_TRUE(error);
    EXPECT_TRUE(error->limitsError);
    EXPECT_EQ(error->limit, 1.5);
    const auto memory = tauGoalFromText("memory_mib=64");
    ASSERT_TRUE(memory);
    EXPECT_EQ(memory->cost, SweepCost::MemoryMiB);
    for (const char* text : {"", "triangles", "triangles=", "triangles=0", "triangles=-1", "triangles=inf",
                             "triangles=nan", "triangles=1x", "speed=3"}) {
        const auto goal = tauGoalFromText(text);
        ASSERT_FALSE(goal) << text;
        EXPECT_THAT(goal.error().message, HasSubstr("triangles=N")) << text;
    }
}

// Costs fall with tau as 1e5 / tau, errors are half of tau.
planet::Result<double> costAt(double tauPx) {
    return 1e5 / tauPx;
}
planet::Result<double> errorAt(double tauPx) {
    return tauPx / 2;
}

TEST(Sweep, suggestsTheSmallestTauThatKeepsACost) {
    const auto found = suggestTau({false, SweepCost::Triangles, 20'000}, costAt);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->met);
    EXPECT_LE(found->value, 20'000);
    EXPECT_NEAR(found->tauPx, 5, 0.1);
    EXPECT_NEAR(found->value, 1e5 / found->tauPx, 1e-6);
}

TEST(Sweep, suggestsTheLargestTauThatKeepsAnError) {
    const auto found = suggestTau({true, SweepCost::Triangles, 3}, errorAt);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->met);
    EXPECT_LE(found->value, 3);
    EXPECT_NEAR(found->tauPx, 6, 0.12);
}

TEST(Sweep, aGoalThatNothingKeepsIsToldAndOneThatAllKeepIsCheap) {
    const auto never = suggestTau({false, SweepCost::Triangles, 10}, costAt);
    ASSERT_TRUE(never);
    EXPECT_FALSE(never->met);
    EXPECT_EQ(never->tauPx, 64);
    const auto always = suggestTau({true, SweepCost::Triangles, 1000}, errorAt);
    ASSERT_TRUE(always);
    EXPECT_TRUE(always->met);
    EXPECT_EQ(always->tauPx, 64);
    EXPECT_EQ(always->flown, 2);
    const auto broken =
        suggestTau({}, [](double) -> planet::Result<double> { return planet::ioError("gone"); });
    ASSERT_FALSE(broken);
    EXPECT_EQ(broken.error().message, "gone");
}

TEST(Sweep, theLimitOfTrianglesIsAWholeNumber) {
    SweepSuggestion one;
    one.goal = {false, SweepCost::Triangles, 20'000};
    EXPECT_THAT(suggestionsJson(std::array{one}, "s.chk", "down"), testing::HasSubstr("\"limit\": 20000,"));
    one.goal = {true, SweepCost::Triangles, 3};
    EXPECT_THAT(suggestionsJson(std::array{one}, "s.chk", "down"), testing::HasSubstr("\"limit\": 3.0,"));
}

std::size_t pixelsOf(const Picture& picture, int red, int green, int blue) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        count += std::abs(picture.rgb[i] - red) + std::abs(picture.rgb[i + 1] - green) +
                     std::abs(picture.rgb[i + 2] - blue) <
                 30;
    }
    return count;
}

TEST(Sweep, thePlotShowsEachSeriesInItsColour) {
    std::vector<SweepPoint> points = {pointOf(1, 200'000, 0), pointOf(2, 50'000, 1.5), pointOf(8, 9'000, 6)};
    const auto one = plotSweep(points, SweepCost::Triangles, "Down");
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_GT(pixelsOf(*one, 0, 115, 179), 500u);
    EXPECT_EQ(pixelsOf(*one, 214, 94, 0), 0u);
    for (SweepPoint point : std::vector(points)) {
        point.metric = planet::ErrorMetric::Tight;
        point.figures.meanTriangles *= 0.6;
        points.push_back(point);
    }
    const auto two = plotSweep(points, SweepCost::Triangles, "Down");
    ASSERT_TRUE(two);
    EXPECT_GT(pixelsOf(*two, 214, 94, 0), 500u);
    // A single point has an axis too.
    EXPECT_TRUE(plotSweep({points.data(), 1}, SweepCost::MemoryMiB, "One"));
}

}  // namespace
}  // namespace worldy
