// Checks that a setting lies in its range. Internal to the library; pure, any thread.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "planet/base/result.h"

namespace planet {

// Accepts [least, most]; NaN is out of range. The Error reads "retry delay: 61 s is out of range; expected
// [0, 60] s".
template <class Number>
Result<void> checkRange(std::string_view setting, Number value, Number least, Number most,
                        std::string_view unit = {}) {
    if (value >= least && value <= most) return {};
    const std::string suffix = unit.empty() ? "" : fmt::format(" {}", unit);
    return badInput(fmt::format("{}: {}{} is out of range; expected [{}, {}]{}", setting, value, suffix,
                                least, most, suffix));
}

}  // namespace planet
