#include "app/base/percent_text.h"

#include <gtest/gtest.h>

namespace worldy {
namespace {

TEST(PercentText, onlyNothingIsZeroAndOnlyTheWholeIsAHundred) {
    EXPECT_EQ(percentText(0, 598981), "0 %");
    EXPECT_EQ(percentText(598981, 598981), "100 %");
    EXPECT_EQ(percentText(598980, 598981), "99.99 %");
    EXPECT_EQ(percentText(1, 598981), "< 0.01 %");
}

TEST(PercentText, hasTwoDigitsOrMoreAndNoExponent) {
    EXPECT_EQ(percentText(25, 10'000), "0.25 %");
    EXPECT_EQ(percentText(75, 1000), "7.5 %");
    EXPECT_EQ(percentText(994, 10'000), "9.9 %");
    EXPECT_EQ(percentText(996, 10'000), "10 %");
    EXPECT_EQ(percentText(42, 100), "42 %");
    EXPECT_EQ(percentText(994, 1000), "99 %");
    EXPECT_EQ(percentText(997, 1000), "99.70 %");
}

}  // namespace
}  // namespace worldy
