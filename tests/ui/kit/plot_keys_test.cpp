// The keyboard in plots, without a window.
#include "ui/kit/plot_keys.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <optional>

#include "tests/support/panel_fixture.h"
#include "ui/kit/columns.h"

namespace worldy::ui {
namespace {

constexpr int firstKey = 300;  // in ImGui's list of keys that are down

class PlotKeysTest : public testing::Test {
protected:
    PlotKeysTest() {
        ImGuiIO& io = ImGui::GetIO();
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = firstKey + key;
        frame();
        frame();
    }
    void frame() {
        window_.frame([&] {
            if (drawPanel_) return drawPanel_();
            ImGui::Button("before");
            plotItem("samples", {200, 50});
            wasClicked_ |= ImGui::IsItemActive();
            const PlotCursor cursor = plotCursor(count_);
            at_ = cursor.at;
            acts_ += cursor.acts ? 1 : 0;
            plotItem("view", {200, 50});
            keys_ = takePlotKeys(PlotReads::View);
            right_ += keys_.right;
            hasView_ = plotHasKeyboard();
        });
    }
    void type(ImGuiKey key) {
        for (const bool down : {true, false, false}) {
            ImGui::GetIO().KeysDown[firstKey + key] = down;
            frame();
        }
    }

    PanelWindow window_{{400, 300}};
    std::function<void()> drawPanel_;  // in place of the two plots
    std::size_t count_ = 21;
    std::optional<std::size_t> at_;
    int acts_ = 0, right_ = 0;
    bool hasView_ = false, wasClicked_ = false;
    PlotKeys keys_;
};

TEST_F(PlotKeysTest, tabReachesPlotsInTheirOrderWithoutPressingThem) {
    EXPECT_FALSE(at_);
    EXPECT_FALSE(plotShowsFocus());
    type(ImGuiKey_Tab);
    EXPECT_EQ(at_, 20u) << "the cursor begins at the newest sample";
    EXPECT_TRUE(plotShowsFocus());
    EXPECT_FALSE(plotTakesKeys()) << "this plot leaves + and - to the camera";
    type(ImGuiKey_Tab);
    EXPECT_FALSE(at_);
    EXPECT_TRUE(hasView_);
    EXPECT_TRUE(plotTakesKeys());
    EXPECT_EQ(acts_, 0);
    EXPECT_FALSE(wasClicked_);
}

TEST_F(PlotKeysTest, keysMoveTheCursorAndUpAndDownLeaveThePlot) {
    type(ImGuiKey_Tab);
    type(ImGuiKey_LeftArrow);
    EXPECT_EQ(at_, 19u);
    type(ImGuiKey_PageUp);
    EXPECT_EQ(at_, 17u);
    type(ImGuiKey_Home);
    EXPECT_EQ(at_, 0u);
    type(ImGuiKey_RightArrow);
    EXPECT_EQ(at_, 1u);
    type(ImGuiKey_DownArrow);
    EXPECT_FALSE(at_);
    EXPECT_TRUE(hasView_);
    EXPECT_EQ(right_, 0);
    type(ImGuiKey_RightArrow);
    type(ImGuiKey_UpArrow);
    EXPECT_EQ(right_, 1);
    EXPECT_TRUE(hasView_) << "this plot reads Up itself";
}

TEST_F(PlotKeysTest, theCursorKeepsItsDistanceFromTheNewestSample) {
    type(ImGuiKey_Tab);
    type(ImGuiKey_LeftArrow);
    count_ = 31;
    frame();
    EXPECT_EQ(at_, 29u);
    count_ = 0;
    frame();
    EXPECT_FALSE(at_);
    count_ = 1;
    frame();
    EXPECT_EQ(at_, 0u);
}

TEST_F(PlotKeysTest, enterAndSpaceActOnceAndAreNoClicks) {
    type(ImGuiKey_Tab);
    type(ImGuiKey_Enter);
    EXPECT_EQ(acts_, 1);
    type(ImGuiKey_Space);
    EXPECT_EQ(acts_, 2);
    EXPECT_FALSE(wasClicked_);
}

TEST_F(PlotKeysTest, thePointerTakesOverWhenItMovesOverThePlot) {
    type(ImGuiKey_Tab);
    ASSERT_TRUE(at_);
    PanelWindow::movePointer({50, 60});
    frame();
    frame();
    EXPECT_FALSE(at_);
    type(ImGuiKey_LeftArrow);
    EXPECT_EQ(at_, 19u);
}

// Columns side by side are windows within the panel's window.
class PlotsInColumnsTest : public PlotKeysTest {
protected:
    PlotsInColumnsTest() {
        PanelWindow::resize({1200, 300});
        drawPanel_ = [this] {
            const std::array<Column, 2> columns = {
                {{.title = "left", .draw = [this] { plot("left", isLeft_); }},
                 {.title = "right", .draw = [this] { plot("right", isRight_); }}}};
            drawColumns("columns", columns);
        };
        frame();
        frame();
    }
    static void plot(const char* id, bool& hasKeyboard) {
        plotItem(id, {200, 50});
        takePlotKeys(PlotReads::View);
        hasKeyboard = plotHasKeyboard();
    }

    bool isLeft_ = false, isRight_ = false;
};

TEST_F(PlotsInColumnsTest, tabGoesFromColumnToColumn) {
    type(ImGuiKey_Tab);
    EXPECT_TRUE(isLeft_);
    type(ImGuiKey_Tab);
    EXPECT_FALSE(isLeft_);
    EXPECT_TRUE(isRight_);
}

}  // namespace
}  // namespace worldy::ui
