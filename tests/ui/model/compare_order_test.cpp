#include "ui/model/compare_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace worldy::ui {
namespace {

TEST(CompareOrder, figuresSortByValueAndByTheRatioOfBToA) {
    std::array<ComparedFigures, 2> figures;
    figures[0].chunks = 100;
    figures[1].chunks = 50;
    figures[0].late = 0;
    figures[1].late = 3;
    figures[0].switches = figures[1].switches = 0;
    const auto key = [&](std::string_view name, FigureColumn column) {
        const auto rows = compareRows();
        const auto row =
            std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.name == name; });
        return figureSortKey(*row, column, figures);
    };
    using Column = FigureColumn;
    EXPECT_EQ(key("Drawn chunks", Column::A), SortKey(100.0));
    EXPECT_EQ(key("Drawn chunks", Column::B), SortKey(50.0));
    EXPECT_EQ(key("Drawn chunks", Column::Name), SortKey(std::string("Drawn chunks")));
    EXPECT_EQ(key("Drawn chunks", Column::Change), SortKey(0.5));
    EXPECT_EQ(key("Level changes", Column::Change), SortKey(1.0));
    EXPECT_GT(key("Late arrivals", Column::Change), SortKey(1e300));
    EXPECT_LT(key("Memory", Column::Change), key("Drawn chunks", Column::Change));
}

}  // namespace
}  // namespace worldy::ui
