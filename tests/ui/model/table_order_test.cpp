#include "ui/model/table_order.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/panel_fixture.h"
#include "ui/kit/tables.h"

namespace worldy::ui {
namespace {

using Order = std::vector<std::size_t>;

TEST(TableOrder, rowsKeepTheirOrderUntilAColumnIsChosen) {
    const auto key = [](std::size_t row, std::size_t) -> SortKey { return -static_cast<double>(row); };
    EXPECT_EQ(tableOrder(3, std::nullopt, key), (Order{0, 1, 2}));
    EXPECT_EQ(tableOrder(3, TableSort{0, false}, key), (Order{2, 1, 0}));
}

TEST(TableOrder, numbersSortByValueAndTextsAlphabetically) {
    const std::array<double, 3> numbers = {9, 100, 20};
    const std::array<std::string, 3> texts = {"split", "camera moved", "late"};
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        if (column == 0) return numbers[row];
        return texts[row];
    };
    EXPECT_EQ(tableOrder(3, TableSort{0, false}, key), (Order{0, 2, 1}));
    EXPECT_EQ(tableOrder(3, TableSort{0, true}, key), (Order{1, 2, 0}));
    EXPECT_EQ(tableOrder(3, TableSort{1, false}, key), (Order{1, 2, 0}));
}

TEST(TableOrder, equalRowsKeepTheirOrderInBothDirections) {
    const auto key = [](std::size_t row, std::size_t) -> SortKey { return row == 1 ? 1.0 : 0.0; };
    EXPECT_EQ(tableOrder(4, TableSort{0, false}, key), (Order{0, 2, 3, 1}));
    EXPECT_EQ(tableOrder(4, TableSort{0, true}, key), (Order{1, 0, 2, 3}));
}

TEST(TableOrder, chunksSortByLevelAsNumbers) {
    const std::array<planet::ChunkId, 3> ids = {
        {{planet::Face::PosX, 10, 0, 0}, {planet::Face::PosX, 2, 3, 0}, {planet::Face::PosX, 2, 1, 1}}};
    const auto key = [&](std::size_t row, std::size_t) { return sortKey(ids[row]); };
    EXPECT_EQ(tableOrder(3, TableSort{0, false}, key), (Order{2, 1, 0}));
}

TEST(TableOrder, textsThatAreNumbersSortByValue) {
    EXPECT_EQ(textSortKey("10"), SortKey(10.0));
    EXPECT_LT(textSortKey("9.5"), textSortKey("10"));
    EXPECT_LT(textSortKey("10"), textSortKey("tight"));
    EXPECT_EQ(textSortKey("10 m"), SortKey(std::string("10 m")));
}

// Three rows of a list table, drawn in the order of its titles' clicks.
class SortedTable : public testing::Test {
protected:
    void frame() {
        drawn_.clear();
        window_.frame([&] {
            constexpr std::array columns = {TableColumn{"Name"}, TableColumn{"Size", 1, nullptr, "1234 MiB"}};
            if (!beginListTable("list", columns, 3)) return;
            tableRows(
                3,
                [&](std::size_t row, std::size_t column) -> SortKey {
                    if (column == 1) return sizes_[row];
                    return std::string(1, static_cast<char>('c' - row));
                },
                [&](std::size_t row) {
                    drawn_.push_back(row);
                    cell("name");
                    cell("size");
                });
            ImGui::EndTable();
        });
    }
    void clickTitle(const char* title) {
        frame();
        window_.click(title, 0.3f, [&] { frame(); });
        frame();
    }
    PanelWindow window_{{300, 300}};
    Order drawn_;
    std::array<double, 3> sizes_ = {2, 1, 3};
};

TEST_F(SortedTable, aClickOnATitleSortsByItAndAnotherTurnsItAround) {
    frame();
    EXPECT_EQ(drawn_, (Order{0, 1, 2}));
    clickTitle("Sort by Size");
    EXPECT_EQ(drawn_, (Order{1, 0, 2}));
    clickTitle("Sort by Size");
    EXPECT_EQ(drawn_, (Order{2, 0, 1}));
    clickTitle("Sort by Size");
    EXPECT_EQ(drawn_, (Order{0, 1, 2}));
    clickTitle("Sort by Name");
    EXPECT_EQ(drawn_, (Order{2, 1, 0}));
}

TEST_F(SortedTable, columnsAreAsWideAsTheirTitlesAndWidestText) {
    frame();
    const ItemPlace* size = window_.find("Sort by Size");
    ASSERT_TRUE(size);
    EXPECT_GE(size->rect.width, 8 * ImGui::GetFontSize() * 0.5);
}

}  // namespace
}  // namespace worldy::ui
