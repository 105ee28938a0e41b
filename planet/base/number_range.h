// A range that a number of a file or a command line must lie in. Internal to the library; pure, any thread.
#pragma once

#include <string>
#include <string_view>

namespace planet {

struct NumberRange {
    double min = 0;
    double max = 0;
    std::string_view unit;  // "px"; may be empty
};

// Returns "[0.1, 64] px".
std::string textOf(const NumberRange& range);

}  // namespace planet
