#include "ui/kit/exports.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "tests/support/panel_fixture.h"
#include "ui/kit/plots.h"
#include "ui/kit/tables.h"

namespace worldy::ui {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::size_t rowCount = 200;

class Exports : public testing::Test {
protected:
    // A table of more rows than are seen, whose first column is a link.
    void drawTable() {
        beginExports(state_, commands_);
        window_.frame([&] {
            constexpr std::array columns = {TableColumn{"Name"}, TableColumn{"Value"}};
            if (!beginListTable("table", columns, rowCount, 10)) return;
            const auto key = [](std::size_t row, std::size_t) -> SortKey { return static_cast<double>(row); };
            tableRows(rowCount, key, [&](std::size_t row) {
                ImGui::TableNextColumn();
                if (ImGui::Selectable(fmt::format("name {}", row).c_str(), false)) pressed_.push_back(row);
                noteItem(fmt::format("Row {}", row));
                cell(fmt::format("about {}", row));
                noteItem(fmt::format("Value {}", row));
            });
            endTable(exportTable<std::size_t>(
                "numbers", rowCount, [](std::size_t row) { return row; },
                {{"name", [](std::size_t row) { return fmt::format("name {}", row); }, true},
                 {"value_m", [](std::size_t row) { return static_cast<double>(row) / 3; }}}));
        });
        endExports();
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) drawTable();
    }
    void click(const std::string& name) {
        frames(2);
        window_.click(name, 0.5f, [&] { drawTable(); });
        frames(2);
    }
    // Opens the menu and chooses an item. Returns what was sent.
    Commands choose(const std::string& item) {
        click("numbers menu");
        commands_.clear();
        click(item);
        ImGui::GetIO().MousePos = {-1, -1};
        return std::move(commands_);
    }
    static std::size_t linesOf(const std::string& text) {
        return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    }

    PanelWindow window_{{500, 400}};
    ExportState state_;
    Commands commands_;
    std::vector<std::size_t> pressed_;
};

TEST_F(Exports, copiesRowsOutOfSightWithExactValues) {
    const Commands sent = choose("Copy all");
    ASSERT_EQ(sent.size(), 1u);
    const auto* const copy = sent[0].as<CopyText>();
    ASSERT_TRUE(copy);
    EXPECT_EQ(linesOf(copy->text), rowCount + 1);
    EXPECT_TRUE(copy->text.starts_with("name\tvalue_m\nname 0\t0\nname 1\t0.3333333333333333\n"))
        << copy->text;
    EXPECT_EQ(copy->done, "Copied 200 rows");
}

TEST_F(Exports, savesAllRowsAsCsv) {
    const Commands sent = choose("Save all as CSV");
    ASSERT_EQ(sent.size(), 1u);
    const auto* const save = sent[0].as<SaveExport>();
    ASSERT_TRUE(save);
    EXPECT_EQ(save->name, "numbers");
    EXPECT_EQ(save->extension, "csv");
    EXPECT_TRUE(save->text.starts_with("schema_version,name,value_m\r\n2,name 0,0\r\n")) << save->text;
}

TEST_F(Exports, selectsRowsByClickShiftAndCtrl) {
    click("Value 1");
    ImGui::GetIO().KeyShift = true;
    click("Row 3");
    ImGui::GetIO().KeyShift = false;
    ImGui::GetIO().KeyCtrl = true;
    click("Row 6");
    click("Row 2");
    ImGui::GetIO().KeyCtrl = false;
    EXPECT_TRUE(pressed_.empty()) << "a row was selected and pressed";
    const Commands sent = choose("Copy selected");
    ASSERT_EQ(sent.size(), 1u);
    const std::string& text = sent[0].as<CopyText>()->text;
    EXPECT_EQ(linesOf(text), 4u) << text;
    for (const char* name : {"name 1\t", "name 3\t", "name 6\t"}) EXPECT_THAT(text, HasSubstr(name));
    EXPECT_THAT(text, Not(HasSubstr("name 2\t")));
}

TEST_F(Exports, aPlainClickKeepsItsMeaning) {
    click("Row 4");
    EXPECT_EQ(pressed_, std::vector<std::size_t>{4});
    click("numbers menu");
    EXPECT_FALSE(window_.isShown("Copy selected"));
    EXPECT_TRUE(window_.isShown("Copy all"));
}

TEST_F(Exports, withoutReceiverThereIsNoMenu) {
    window_.frame([&] {
        constexpr std::array columns = {TableColumn{"Name"}};
        if (!beginListTable("table", columns, 1)) return;
        tableRows(1, [](std::size_t) { cell("text"); });
        endTable({.name = "numbers", .columns = {{"name"}}, .rows = 1});
    });
    EXPECT_FALSE(window_.isShown("numbers menu"));
}

TEST_F(Exports, aListOfValuesHasTheMenuOnARightClick) {
    const auto draw = [&] {
        beginExports(state_, commands_);
        window_.frame([&] {
            if (!beginValues("facts")) return;
            valueRow("Height", "12 m", "");
            noteItem("Height");
            valueRow("Slope", "3°", "");
            endValues();
        });
        endExports();
    };
    for (int i = 0; i < 2; ++i) draw();
    EXPECT_FALSE(window_.isShown("facts menu")) << "a button covers a value";
    const ItemPlace* const row = window_.find("Height");
    ASSERT_TRUE(row);
    window_.movePointer({row->rect.x + 2, row->rect.y + row->rect.height / 2});
    for (const bool down : {false, true, false, false}) {
        ImGui::GetIO().MouseDown[1] = down;
        draw();
    }
    window_.click("Save all as CSV", 0.5f, draw);
    ASSERT_EQ(commands_.size(), 1u);
    ASSERT_TRUE(commands_[0].as<SaveExport>());
    EXPECT_EQ(commands_[0].as<SaveExport>()->text,
              "schema_version,name,value\r\n2,Height,12 m\r\n2,Slope,3°\r\n");
}

class PlotExports : public testing::Test {
protected:
    void draw() {
        beginExports(state_, commands_);
        window_.frame([&] {
            const std::array times = {1.0f, 1.5f, 2.0f};
            const std::array series = {Series{"queued", {1, 1, 1, 1}, {1, 2, 4}},
                                       Series{"loading", {1, 1, 1, 1}, {0, 1, 0}}};
            linePlot("queue length", times, series, "blocks");
        });
        endExports();
    }
    void click(const std::string& name) {
        for (int i = 0; i < 2; ++i) draw();
        window_.click(name, 0.5f, [&] { draw(); });
    }

    PanelWindow window_{{500, 400}};
    ExportState state_;
    Commands commands_;
};

TEST_F(PlotExports, copiesSamplesWithTheirUnit) {
    click("queue length menu");
    click("Copy samples");
    ASSERT_EQ(commands_.size(), 1u);
    EXPECT_EQ(commands_[0].as<CopyText>()->text,
              "time_s\tqueued (blocks)\tloading (blocks)\n-1\t1\t0\n-0.5\t2\t1\n0\t4\t0\n");
}

TEST_F(PlotExports, thePictureIsTakenAFrameLaterWithoutAPointer) {
    click("queue length menu");
    click("Save picture as PNG");
    for (int i = 0; i < 3 && commands_.empty(); ++i) {
        ImGui::GetIO().MousePos = {100, 50};
        draw();
    }
    ASSERT_EQ(commands_.size(), 1u);
    const auto* const picture = commands_[0].as<SavePlotPicture>();
    ASSERT_TRUE(picture);
    EXPECT_EQ(picture->name, "queue length");
    EXPECT_GT(picture->rect.width, 400);
    EXPECT_GT(picture->rect.height, 40);
    EXPECT_LT(ImGui::GetIO().MousePos.x, 0) << "the pointer was over the plot";
    EXPECT_FALSE(state_.picture);
}

}  // namespace
}  // namespace worldy::ui
