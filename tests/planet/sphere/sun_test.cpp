#include "planet/sphere/sun.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

namespace {

using planet::Geographic;
using planet::sunOverhead;

double latitudeDeg(const planet::SunDate& date) {
    return glm::degrees(sunOverhead(date).latitudeRad);
}

double longitudeDeg(const planet::SunDate& date) {
    return glm::degrees(sunOverhead(date).longitudeRad);
}

// Moments as published by the US Naval Observatory, to the minute.
TEST(Sun, SolsticesStandAtTheTropics) {
    EXPECT_NEAR(latitudeDeg({2024, 6, 20, 20 + 51 / 60.0}), 23.44, 0.01);
    EXPECT_NEAR(latitudeDeg({2024, 12, 21, 9 + 20 / 60.0}), -23.44, 0.01);
    EXPECT_NEAR(latitudeDeg({1950, 6, 21, 23 + 36 / 60.0}), 23.445, 0.01);
}

TEST(Sun, EquinoxesStandOverTheEquator) {
    EXPECT_NEAR(latitudeDeg({2024, 3, 20, 3 + 6 / 60.0}), 0, 0.01);
    EXPECT_NEAR(latitudeDeg({2024, 9, 22, 12 + 44 / 60.0}), 0, 0.01);
    EXPECT_NEAR(latitudeDeg({2000, 3, 20, 7 + 35 / 60.0}), 0, 0.01);
}

// The equation of time: apparent less mean time, -14.2 min on 11 February, +16.4 on 3 November.
TEST(Sun, NoonWandersByTheEquationOfTime) {
    EXPECT_NEAR(longitudeDeg({2024, 2, 11, 12}), 14.2 / 4, 0.03);
    EXPECT_NEAR(longitudeDeg({2024, 11, 3, 12}), -16.45 / 4, 0.03);
}

TEST(Sun, GoesWestAroundTheEarthInADay) {
    for (double hour = 0; hour < 24; hour += 1.5) {
        const double step = longitudeDeg({2024, 4, 15, hour}) - longitudeDeg({2024, 4, 15, hour + 0.5});
        EXPECT_NEAR(std::remainder(step, 360.0), 7.5, 0.01) << hour;
    }
}

TEST(Sun, MidnightIsTheNextDaysBeginning) {
    const Geographic before = sunOverhead({2023, 12, 31, 24});
    const Geographic after = sunOverhead({2024, 1, 1, 0});
    EXPECT_NEAR(before.latitudeRad, after.latitudeRad, 1e-9);
    EXPECT_NEAR(std::remainder(before.longitudeRad - after.longitudeRad, 6.283185307179586), 0, 1e-9);
}

TEST(Sun, ADayPastTheMonthsEndIsItsLast) {
    EXPECT_EQ(planet::daysInMonth(2024, 2), 29);
    EXPECT_EQ(planet::daysInMonth(1900, 2), 28);
    EXPECT_EQ(planet::daysInMonth(2023, 11), 30);
    EXPECT_EQ(latitudeDeg({2023, 2, 31, 12}), latitudeDeg({2023, 2, 28, 12}));
    EXPECT_NE(latitudeDeg({2024, 2, 31, 12}), latitudeDeg({2024, 2, 28, 12}));
}

}  // namespace
