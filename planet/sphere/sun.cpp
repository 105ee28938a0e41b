#include "planet/sphere/sun.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace planet {

namespace {

// Returns the days since the epoch of the formulae, 2000-01-01 12:00.
double daysSinceEpoch(const SunDate& date) {
    using namespace std::chrono;
    const year_month_day midnight{
        year(date.year), month(static_cast<unsigned>(date.month)),
        day(static_cast<unsigned>(std::clamp(date.day, 1, daysInMonth(date.year, date.month))))};
    constexpr year_month_day epoch{year(2000), month(1), day(1)};
    return static_cast<double>((sys_days(midnight) - sys_days(epoch)).count()) + date.hour / 24 - 0.5;
}

}  // namespace

int daysInMonth(int year, int month) {
    assert(month >= 1 && month <= 12);
    using namespace std::chrono;
    const year_month_day_last last{std::chrono::year(year),
                                   month_day_last(std::chrono::month(static_cast<unsigned>(month)))};
    return static_cast<int>(static_cast<unsigned>(last.day()));
}

Geographic sunOverhead(const SunDate& date) {
    const double days = daysSinceEpoch(date);
    const double meanLongitude = glm::radians(280.460 + 0.9856474 * days);
    const double meanAnomaly = glm::radians(357.528 + 0.9856003 * days);
    const double longitude =
        meanLongitude + glm::radians(1.915 * std::sin(meanAnomaly) + 0.020 * std::sin(2 * meanAnomaly));
    const double obliquity = glm::radians(23.439 - 0.0000004 * days);
    const double rightAscension = std::atan2(std::cos(obliquity) * std::sin(longitude), std::cos(longitude));
    const double declination = std::asin(std::sin(obliquity) * std::sin(longitude));
    const double siderealTime = glm::radians(15 * (6.697375 + 0.0657098242 * days + date.hour));
    return {declination, std::remainder(rightAscension - siderealTime, 2 * std::numbers::pi)};
}

}  // namespace planet
