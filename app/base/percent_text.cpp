#include "app/base/percent_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace worldy {

std::string percentText(std::uint64_t part, std::uint64_t of) {
    if (part == 0) return "0 %";
    if (part >= of) return "100 %";
    const double percent = 100.0 * static_cast<double>(part) / static_cast<double>(of);
    if (percent < 0.01) return "< 0.01 %";
    if (percent >= 99.5) return fmt::format("{:.2f} %", std::min(percent, 99.99));
    return percent < 9.95 ? fmt::format("{:.2g} %", percent) : fmt::format("{:.0f} %", percent);
}

}  // namespace worldy
