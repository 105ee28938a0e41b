#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/base/plot_scale.h"
#include "app/measure/sweep_points.h"

namespace worldy::ui {
namespace {

using planet::ErrorMetric;
using testing::HasSubstr;

TEST(SweepPanel, ReadsTolerancesHoweverTheyAreSeparated) {
    for (const char* text : {"0.5 1 2", "0.5,1,2", " 2;0.5 ;1 ", "1\t2 0.5,"}) {
        const TauList taus = tausFromText(text);
        EXPECT_EQ(taus.problem, "") << text;
        EXPECT_EQ(taus.tausPx, (std::vector{0.5, 1.0, 2.0})) << text;
    }
    EXPECT_EQ(tausFromText("0.1 64").tausPx, (std::vector{0.1, 64.0}));
}

TEST(SweepPanel, SaysWhatIsWrongWithTolerancesAndWhatWouldBeRight) {
    const std::pair<std::string, const char*> wrong[] = {{"", "no tolerance"},
                                                         {" , ", "no tolerance"},
                                                         {"1 two 3", "\"two\" is not a number"},
                                                         {"1x", "\"1x\""},
                                                         {"0.05", "0.05 is out"},
                                                         {"65", "65 is out"},
                                                         {"nan", "\"nan\" is not a number"},
                                                         {"inf", "\"inf\" is not a number"},
                                                         {"-1", "-1 is out"},
                                                         {"1 2 1.0", "1.0 is given twice"},
                                                         {"1e999", "\"1e999\""}};
    for (const auto& [text, problem] : wrong) {
        const TauList taus = tausFromText(text);
        EXPECT_THAT(taus.problem, HasSubstr(problem)) << text;
        EXPECT_THAT(taus.problem, HasSubstr("; expected ")) << text;
        EXPECT_TRUE(taus.tausPx.empty()) << text;
    }
    std::string many;
    for (std::size_t i = 0; i <= mostTaus; ++i) many += std::to_string(i + 1) + " ";
    EXPECT_THAT(tausFromText(many).problem, HasSubstr("more than 32"));
}

TEST(SweepPanel, AnswersInWords) {
    EXPECT_EQ(suggestionText({true, SweepCost::Triangles, 1}, {1.8342, 0.9831, true, 7}, "tau"),
              "tau = 1.83 px: max measured error 0.983 px, within the limit (7 flights flown).");
    EXPECT_EQ(suggestionText({false, SweepCost::Triangles, 200'000}, {2, 198'000, true, 11}, "tau"),
              "tau = 2 px: mean triangles 198 k, within the limit (11 flights flown).");
    EXPECT_EQ(suggestionText({false, SweepCost::MemoryMiB, 4}, {64, 12.5, false, 1}, "tau"),
              "No tau in [0.1, 64] px meets the limit of 4 MiB; at 64 px: memory of resident chunks 12.5 MiB "
              "(1 flight flown).");
}

TEST(SweepPanel, JoinsPointsOfOneChunkSizeAndMetricByTheirTau) {
    const std::vector<SweepPoint> points = {{33, ErrorMetric::Tight, 4},
                                            {33, ErrorMetric::Additive, 1},
                                            {17, ErrorMetric::Tight, 1},
                                            {33, ErrorMetric::Tight, 1},
                                            {33, ErrorMetric::Tight, 0.5}};
    const std::vector<SweepSeries> series = seriesOf(points);
    ASSERT_EQ(series.size(), 3u);
    EXPECT_EQ(series[0].name(), "17 tight");
    EXPECT_EQ(series[1].name(), "33 additive");
    EXPECT_EQ(series[2].points, (std::vector<std::size_t>{4, 3, 0}));
}

TEST(LogAxis, GoesFromRoundNumberToRoundNumber) {
    const std::vector<double> decades = {0.02, 300};
    const LogAxis wide = logAxisOver(decades);
    EXPECT_DOUBLE_EQ(wide.lowest, 0.01);
    EXPECT_DOUBLE_EQ(wide.highest, 1000);
    EXPECT_EQ(wide.ticks.size(), 6u);
    const LogAxis one = logAxisOver(std::vector{7.0});
    EXPECT_LE(one.lowest, 7);
    EXPECT_GT(one.highest, one.lowest);
    EXPECT_DOUBLE_EQ(one.position(one.lowest), 0);
    EXPECT_DOUBLE_EQ(one.position(one.highest), 1);
    EXPECT_EQ(logAxisOver({}).highest, 10);
    // What has no logarithm is plotted at the least.
    EXPECT_GT(plottedErrorPx({}), 0);
    EXPECT_GT(plottedCost({}, SweepCost::MemoryMiB), 0);
}

}  // namespace
}  // namespace worldy::ui
