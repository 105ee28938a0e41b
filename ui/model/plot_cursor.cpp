#include "ui/model/plot_cursor.h"

#include <algorithm>
#include <cstdint>

namespace worldy::ui {

std::size_t movedCursor(std::size_t at, std::size_t count, const PlotKeys& keys) {
    const auto last = static_cast<std::int64_t>(count) - 1;
    if (keys.toFirst) return 0;
    if (keys.toLast) return static_cast<std::size_t>(last);
    const std::int64_t page = std::max<std::int64_t>(last / 10, 1);
    const std::int64_t moved = static_cast<std::int64_t>(at) + keys.right + keys.pagesDown * page;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(moved, 0, last));
}

}  // namespace worldy::ui
