#include "app/base/plot_scale.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace worldy {
namespace {

using testing::ElementsAre;

TEST(PlotScale, axesEndAtOneTwoOrFive) {
    EXPECT_DOUBLE_EQ(roundedTop(0.3), 0.5);
    EXPECT_DOUBLE_EQ(roundedTop(1), 1);
    EXPECT_DOUBLE_EQ(roundedTop(1.01), 2);
    EXPECT_DOUBLE_EQ(roundedTop(5.1), 10);
    EXPECT_DOUBLE_EQ(roundedTop(123), 200);
    EXPECT_DOUBLE_EQ(roundedTop(0.02), 0.02);
}

TEST(PlotScale, anAxisWithoutValuesStillHasATop) {
    EXPECT_EQ(roundedTop(0), 1);
    EXPECT_EQ(roundedTop(-3), 1);
    EXPECT_EQ(roundedTop(std::numeric_limits<double>::quiet_NaN()), 1);
    EXPECT_EQ(roundedTop(std::numeric_limits<double>::infinity()), 1);
}

TEST(PlotScale, axesShowThreeDigits) {
    EXPECT_EQ(axisText(0), "0");
    EXPECT_EQ(axisText(0.25), "0.25");
    EXPECT_EQ(axisText(12.345), "12.3");
    EXPECT_EQ(axisText(99.96), "100");
    EXPECT_EQ(axisText(1234), "1234");
    EXPECT_EQ(axisText(9999.4), "9999");
    EXPECT_EQ(axisText(9999.7), "10000");
    EXPECT_EQ(axisText(12345), "12.3 k");
}

TEST(PlotScale, aColumnKeepsItsHighestPeak) {
    const std::array times{0.0f, 0.1f, 0.2f, 1.0f, 1.5f, 3.2f};
    const std::array values{1.0f, 9.0f, 2.0f, 4.0f, 3.0f, 0.0f};
    EXPECT_THAT(peakOfColumns(times, values, 1), ElementsAre(1u, 3u, 5u));
    EXPECT_THAT(peakOfColumns(times, values, 0.05f), ElementsAre(0u, 1u, 2u, 3u, 4u, 5u));
    EXPECT_TRUE(peakOfColumns({}, {}, 1).empty());
}

TEST(PlotScale, peaksStayWhereTheyAreWhenTimeMovesOn) {
    const std::array times{10.1f, 10.4f, 10.6f, 10.9f};
    const std::array values{1.0f, 2.0f, 5.0f, 3.0f};
    const auto all = peakOfColumns(times, values, 0.5f);
    ASSERT_THAT(all, ElementsAre(1u, 2u));
    // The oldest sample has gone; the same peaks are left.
    const auto later = peakOfColumns(std::span(times).subspan(1), std::span(values).subspan(1), 0.5f);
    EXPECT_THAT(later, ElementsAre(0u, 1u));
}

TEST(PlotScale, stackedRowsAddUp) {
    const std::array a{1.0f, 2.0f};
    const std::array b{10.0f, 20.0f};
    const std::array<std::span<const float>, 2> rows{a, b};
    EXPECT_THAT(summed(rows), ElementsAre(11.0f, 22.0f));
    EXPECT_TRUE(summed({}).empty());
}

TEST(PlotScale, positionsStopAtTheEndsOfTheAxis) {
    EXPECT_DOUBLE_EQ(linearPosition(5, 0, 10), 0.5);
    EXPECT_DOUBLE_EQ(linearPosition(-5, 0, 10), 0);
    EXPECT_DOUBLE_EQ(linearPosition(50, 0, 10), 1);
    EXPECT_DOUBLE_EQ(linearPosition(3, 3, 3), 0);
    EXPECT_DOUBLE_EQ(logarithmicPosition(10, 1, 100), 0.5);
    EXPECT_DOUBLE_EQ(logarithmicPosition(0, 1, 100), 0);
    EXPECT_DOUBLE_EQ(logarithmicPosition(1e6, 1, 100), 1);
    EXPECT_DOUBLE_EQ(logarithmicValue(0.5, 1, 100), 10);
}

TEST(PlotScale, everyValueFallsIntoOneBucket) {
    const std::array positions{0.0f, 0.24f, 0.25f, 0.99f, 1.0f, 7.0f, -1.0f};
    EXPECT_THAT(bucketCounts(positions, 4), ElementsAre(3.0f, 1.0f, 0.0f, 3.0f));
}

TEST(PlotScale, ratesAreGrowthOverTheWindow) {
    const std::array times{0.0f, 0.5f, 1.0f, 1.5f};
    const std::array totals{0.0, 100.0, 100.0, 400.0};
    EXPECT_THAT(growthPerS(times, totals, 0.5), ElementsAre(0.0f, 200.0f, 0.0f, 600.0f));
    EXPECT_THAT(growthPerS(times, totals, 1), ElementsAre(0.0f, 200.0f, 100.0f, 300.0f));
}

TEST(PlotScale, aTotalSetBackIsNoGrowth) {
    const std::array times{0.0f, 1.0f, 2.0f, 3.0f};
    const std::array totals{0.0, 1000.0, 0.0, 50.0};
    EXPECT_THAT(growthPerS(times, totals, 5), ElementsAre(0.0f, 1000.0f, 0.0f, 50.0f));
}

}  // namespace
}  // namespace worldy
