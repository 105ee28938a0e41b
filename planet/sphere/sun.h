// The position of the sun over the Earth. Pure functions, any thread.
#pragma once

#include "planet/sphere/cube_sphere.h"

namespace planet {

// A date in universal time and the Gregorian calendar.
struct SunDate {
    int year = 2024;   // [1950, 2050]
    int month = 6;     // [1, 12]
    int day = 21;      // [1, 31]; clamped to the month's last day
    double hour = 12;  // [0, 24]

    bool operator==(const SunDate&) const = default;
};

// Returns the number of days in a month of a year.
int daysInMonth(int year, int month);

// Returns the subsolar point, accurate to 0.01°, by the Astronomical Almanac's low-precision formulae, as in
// Michalsky, "The Astronomical Almanac's algorithm for approximate solar position (1950-2050)", Solar Energy
// 40 (1988).
Geographic sunOverhead(const SunDate& date);

}  // namespace planet
