#include "ui/kit/table_window.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace worldy::ui {
namespace {

TEST(TableWindow, aWindowHoldsWhatAWholeSortPutsThere) {
    std::mt19937 random(1);
    std::vector<int> sorted(500);
    for (int& value : sorted) value = static_cast<int>(random() % 100);
    const std::vector<int> shuffled = sorted;
    std::sort(sorted.begin(), sorted.end(), std::greater<>());
    for (const auto& [first, last] :
         {std::pair<std::size_t, std::size_t>{0, 10}, {0, 0}, {240, 260}, {490, 500}, {500, 500}, {0, 500}}) {
        std::vector<int> items = shuffled;
        sortWindow(items, first, last, std::greater<>());
        for (std::size_t i = first; i < last; ++i) EXPECT_EQ(items[i], sorted[i]) << i;
    }
}

TEST(TableWindow, anEmptyTableStaysEmpty) {
    std::vector<int> none;
    sortWindow(none, 0, 0, std::less<>());
    EXPECT_TRUE(none.empty());
}

}  // namespace
}  // namespace worldy::ui
