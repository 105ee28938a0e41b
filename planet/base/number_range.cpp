#include "planet/base/number_range.h"

#include <fmt/format.h>

namespace planet {

std::string textOf(const NumberRange& range) {
    const std::string_view gap = range.unit.empty() || range.unit == "°" ? "" : " ";
    return fmt::format("[{}, {}]{}{}", range.min, range.max, gap, range.unit);
}

}  // namespace planet
