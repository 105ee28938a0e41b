// Computes percentiles by nearest rank: the result is always one of the values. Pure functions, any thread.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <type_traits>

namespace planet {

// Returns the smallest value that at least a share of all values, [0, 1], does not exceed: 0.5 gives the
// lower median, 0 the smallest value. Returns 0 if there are no values. values: std::vector or std::span of
// numbers, which this reorders. Linear time.
template <class Values>
auto percentileOf(Values&& values, double share) {
    using Value = std::remove_cv_t<typename std::remove_reference_t<Values>::value_type>;
    if (values.empty()) return Value{0};
    const double rank = std::ceil(std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size()));
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
    std::nth_element(values.begin(), place, values.end());
    return Value{*place};
}

}  // namespace planet
