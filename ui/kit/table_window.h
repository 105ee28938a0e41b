// Long tables that are sorted where they are seen.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace worldy::ui {

// Puts into [first, last) what a whole sort would put there, sorted; the rest is in any order, before or
// after. In linear time while the window is short, so that a table of thousands can be shown sorted anew
// every frame. first <= last <= items.size().
template <class T, class Less>
void sortWindow(std::vector<T>& items, std::size_t first, std::size_t last, const Less& less) {
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    if (first > 0 && first < items.size()) std::nth_element(items.begin(), at(first), items.end(), less);
    std::partial_sort(at(first), at(last), items.end(), less);
}

}  // namespace worldy::ui
