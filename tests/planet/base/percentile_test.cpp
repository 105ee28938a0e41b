#include "planet/base/percentile.h"

#include <gtest/gtest.h>

#include <array>
#include <span>
#include <vector>

namespace planet {
namespace {

TEST(Percentile, IsTheValueOfTheNearestRank) {
    std::vector<double> values;
    for (int i = 200; i > 0; --i) values.push_back(i);
    EXPECT_EQ(percentileOf(values, 0.99), 198);
    EXPECT_EQ(percentileOf(values, 1), 200);
    EXPECT_EQ(percentileOf(values, 0.001), 1);
    std::array five{5.0f, 1.0f, 4.0f, 2.0f, 3.0f};
    EXPECT_EQ(percentileOf(five, 0.5), 3);
    EXPECT_EQ(percentileOf(five, 0), 1);
    EXPECT_EQ(percentileOf(five, 0.99), 5);
}

TEST(Percentile, OfTwoTheMedianIsTheLower) {
    std::array two{8.0f, 6.0f};
    EXPECT_EQ(percentileOf(two, 0.5), 6);
}

TEST(Percentile, OfOneIsThatOneAndOfNoneIsNothing) {
    EXPECT_EQ(percentileOf(std::vector{5.0}, 0.99), 5);
    EXPECT_EQ(percentileOf(std::vector<double>(), 0.99), 0);
    EXPECT_EQ(percentileOf(std::span<float>(), 0.5), 0);
}

TEST(Percentile, SharesBeyondTheEndsAreTheEnds) {
    EXPECT_EQ(percentileOf(std::vector{3, 1, 2}, -1), 1);
    EXPECT_EQ(percentileOf(std::vector{3, 1, 2}, 7), 3);
}

}  // namespace
}  // namespace planet
