#include "ui/shell/docks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/empty_view.h"
#include "tests/support/panel_fixture.h"

namespace worldy::ui {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int escapeKey = 256;  // GLFW's

// The docks of a window of 1280 x 800 without a planet, and a mouse.
class DocksTest : public testing::Test {
protected:
    DocksTest() {
        ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
        ImGui::GetIO().KeyMap[ImGuiKey_Escape] = escapeKey;
        for (PanelPlace& place : workspace_.panels) place.shown = false;
        for (const PanelId id : {PanelId::Lod, PanelId::Seams, PanelId::Overlay})
            dockPanel(id, Dock::Right, panelCount, workspace_);
        dockPanel(PanelId::Chunk, Dock::Left, 0, workspace_);
        dockPanel(PanelId::Log, Dock::Bottom, 0, workspace_);
        frames(3);
    }
    ~DocksTest() override { collectItems(nullptr); }

    void frame() {
        items_.clear();
        collectItems(&items_);
        ImGui::NewFrame();
        layout_ = layoutOf(1280, 800, workspace_, 22, 24, unitPx());
        drawDocks(layout_, empty_.view, panels_, docks_, workspace_, settings_, commands_);
        ImGui::Render();
        collectItems(nullptr);
    }
    void frames(int count) {
        for (int i = 0; i < count; ++i) frame();
    }

    bool isThere(std::string_view name) const {
        return std::any_of(items_.begin(), items_.end(),
                           [&](const ItemPlace& item) { return item.name == name; });
    }
    ImVec2 middleOf(std::string_view name, float share = 0.5f) const {
        for (const ItemPlace& item : items_) {
            if (item.name == name)
                return {item.rect.x + share * item.rect.width, item.rect.y + item.rect.height / 2};
        }
        ADD_FAILURE() << name << " is not there";
        return {-1, -1};
    }
    void pressAt(ImVec2 at) {
        window_.movePointer(at);
        frames(2);
        window_.press(true);
        frames(2);
    }
    void moveTo(ImVec2 at) {
        window_.movePointer({at.x + 9, at.y + 9});
        frame();
        window_.movePointer(at);
        frames(2);
    }
    void release() {
        window_.press(false);
        frames(2);
    }
    void drag(std::string_view from, ImVec2 to) {
        pressAt(middleOf(from));
        moveTo(to);
        release();
    }
    void doubleClick(std::string_view name) {
        window_.movePointer(middleOf(name));
        frames(2);
        for (const bool down : {true, false, true, false}) {
            window_.press(down);
            frame();
        }
        frames(20);  // so that the next click is a single one
        ImGui::GetIO().MouseClickedTime[0] = -10;
    }
    const PanelPlace& placeOf(PanelId panel) const {
        return workspace_.panels[static_cast<std::size_t>(panel)];
    }

    PanelWindow window_{{1280, 800}};
    EmptyView empty_;
    PanelStates panels_;
    DocksState docks_;
    Workspace workspace_;
    ViewSettings settings_;
    Commands commands_;
    Layout layout_;
    std::vector<ItemPlace> items_;
};

TEST_F(DocksTest, aDoubleClickMaximisesADockAndRestoresIt) {
    doubleClick("tab/Seams");
    EXPECT_EQ(maximisedDock(workspace_), Dock::Right);
    EXPECT_EQ(frontPanel(Dock::Right, workspace_), PanelId::Seams);
    EXPECT_TRUE(isThere("tab/Restore"));
    EXPECT_FALSE(isThere("tab/Chunk"));
    doubleClick("tab/Seams");
    EXPECT_FALSE(maximisedDock(workspace_));
    EXPECT_FALSE(isThere("tab/Restore"));
    EXPECT_TRUE(isThere("tab/Chunk"));
}

TEST_F(DocksTest, aTabDroppedOverTheViewportFloatsBelowThePointer) {
    drag("tab/Chunk", {600, 300});
    ASSERT_TRUE(placeOf(PanelId::Chunk).floats);
    const Rect rect = floatingRect(placeOf(PanelId::Chunk).floating, layout_.area, unitPx());
    EXPECT_TRUE(contains(rect, {600, 300}));
    EXPECT_TRUE(isThere("float/Chunk"));
    EXPECT_FALSE(isThere("tab/Chunk"));
}

TEST_F(DocksTest, aFloatingPanelFollowsItsTitleBarAndDocksOverADock) {
    drag("tab/Chunk", {600, 300});
    const FloatingPlace before = placeOf(PanelId::Chunk).floating;
    drag("float/Chunk", {500, 150});
    EXPECT_NE(placeOf(PanelId::Chunk).floating, before);
    EXPECT_TRUE(placeOf(PanelId::Chunk).floats);
    pressAt(middleOf("float/Chunk"));
    moveTo(middleOf("tab/Seams", 0.1f));
    EXPECT_TRUE(isThere("drop/Preview"));
    EXPECT_TRUE(isThere("drop/Right dock, after LOD"));
    release();
    EXPECT_THAT(panelsIn(Dock::Right, workspace_),
                ElementsAre(PanelId::Lod, PanelId::Chunk, PanelId::Seams, PanelId::Overlay));
    EXPECT_THAT(floatingPanels(workspace_), IsEmpty());
}

TEST_F(DocksTest, aDraggedTabChangesItsPlaceAmongTheOthers) {
    drag("tab/Overlay", middleOf("tab/LOD", 0.1f));
    EXPECT_THAT(panelsIn(Dock::Right, workspace_),
                ElementsAre(PanelId::Overlay, PanelId::Lod, PanelId::Seams));
    EXPECT_EQ(frontPanel(Dock::Right, workspace_), PanelId::Overlay);
}

TEST_F(DocksTest, escLeavesADraggedPanelWhereItWas) {
    pressAt(middleOf("tab/Chunk"));
    moveTo({600, 300});
    ASSERT_TRUE(isThere("drop/Preview"));
    ImGui::GetIO().KeysDown[escapeKey] = true;
    frame();
    ImGui::GetIO().KeysDown[escapeKey] = false;
    frame();
    EXPECT_FALSE(isThere("drop/Preview"));
    release();
    EXPECT_FALSE(placeOf(PanelId::Chunk).floats);

    drag("tab/Chunk", {600, 300});
    const FloatingPlace before = placeOf(PanelId::Chunk).floating;
    pressAt(middleOf("float/Chunk"));
    moveTo({500, 150});
    ImGui::GetIO().KeysDown[escapeKey] = true;
    frame();
    ImGui::GetIO().KeysDown[escapeKey] = false;
    release();
    EXPECT_EQ(placeOf(PanelId::Chunk).floating, before);
}

TEST_F(DocksTest, withCtrlAPanelFloatsOverADock) {
    pressAt(middleOf("tab/Chunk"));
    ImGui::GetIO().KeyCtrl = true;
    moveTo({1100, 400});
    release();
    ImGui::GetIO().KeyCtrl = false;
    EXPECT_TRUE(placeOf(PanelId::Chunk).floats);
}

TEST_F(DocksTest, aFloatingPanelStaysInsideASmallerWindow) {
    drag("tab/Chunk", {600, 300});
    drag("float/Chunk", {5000, 5000});
    EXPECT_EQ(placeOf(PanelId::Chunk).floating.x, 1);
    EXPECT_EQ(placeOf(PanelId::Chunk).floating.y, 1);
    const Layout small = layoutOf(500, 400, workspace_, 22, 24, unitPx());
    const Rect rect = floatingRect(placeOf(PanelId::Chunk).floating, small.area, unitPx());
    EXPECT_LE(rect.x + rect.width, 500);
    EXPECT_LE(rect.y + rect.height, 376);
}

TEST_F(DocksTest, aDockThatLostItsLastPanelIsNotMaximisedLater) {
    doubleClick("tab/Chunk");
    ASSERT_EQ(maximisedDock(workspace_), Dock::Left);
    togglePanel(PanelId::Chunk, workspace_);
    frames(2);
    togglePanel(PanelId::Chunk, workspace_);
    frames(2);
    EXPECT_FALSE(maximisedDock(workspace_));
    EXPECT_TRUE(isThere("tab/LOD"));
}

}  // namespace
}  // namespace worldy::ui
