// Sorts only the visible rows of long tables.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace worldy::ui {

// Sorts [first, last) as a full sort would; the items outside this range stay before or after it in any
// order. Runs in linear time if the range is short, so that a table of thousands of rows can be sorted every
// frame. first <= last <= items.size().
template <class T, class Less>
void sortWindow(std::vector<T>& items, std::size_t first, std::size_t last, const Less& less) {
    const auto at = [&](std::size_t i) { return items.begin() + static_cast<std::ptrdiff_t>(i); };
    if (first > 0 && first < items.size()) std::nth_element(items.begin(), at(first), items.end(), less);
    std::partial_sort(at(first), at(last), items.end(), less);
}

}  // namespace worldy::ui
