// Drives the net with a mouse, without a window.
#include "ui/panels/lod/quadtree_panel.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "tests/support/editor_fixture.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"

namespace worldy::ui {
namespace {

class QuadtreePanel : public testing::Test {
protected:
    QuadtreePanel() {
        fixture_.fly({}, 2);
        frame();
        frame();
    }

    void frame() {
        commands_.clear();
        EditorView view = fixture_.view();
        view.focus = focus_;
        window_.frame([&] { quadtreePanel(view, state_, settings_, commands_); });
    }

    static void pointAt(const ImVec2& at) { PanelWindow::movePointer(at); }
    static void press(bool down) { PanelWindow::press(down); }

    // The middle of a chunk's square on the screen.
    ImVec2 middleOf(const planet::ChunkId& id) const {
        const NetSquare square = netSquare(id);
        const NetPoint at = onScreen(placementOf(netSize, state_.focus, state_.area),
                                     {square.x + 0.45 * square.side, square.y + 0.55 * square.side});
        return {static_cast<float>(at.x), static_cast<float>(at.y)};
    }

    template <class Kind>
    std::optional<planet::ChunkId> asked() const {
        for (const Command& command : commands_) {
            if (const Kind* found = command.as<Kind>()) return found->id;
        }
        return std::nullopt;
    }

    // On the far side: one square.
    planet::ChunkId farRoot() const {
        for (const planet::NodeIndex root : {5u, 3u, 1u, 0u}) {
            const planet::ChunkNode& node = planetOf().tree().nodes[root];
            if (node.childrenState != planet::ChildrenState::Resident) return node.id;
        }
        ADD_FAILURE() << "all roots have children";
        return {};
    }
    const planet::Planet& planetOf() const { return *fixture_.view().planet; }

    PanelWindow window_{{400, 700}};
    worldy::test::EditorFixture fixture_{planet::openFake()};
    QuadtreePanelState state_;
    ViewSettings settings_;
    Commands commands_;
    ChunkFocus focus_;
};

TEST_F(QuadtreePanel, HoverLightsAndAClickSelectsTheChunkUnderThePointer) {
    const planet::ChunkId id = farRoot();
    pointAt(middleOf(id));
    frame();
    frame();
    EXPECT_EQ(asked<HoverChunk>(), id);
    EXPECT_FALSE(asked<SelectChunk>());
    press(true);
    frame();
    press(false);
    frame();
    EXPECT_EQ(asked<SelectChunk>(), id);
}

TEST_F(QuadtreePanel, ADragMovesTheNetAndSelectsNothing) {
    state_.focus = {4, 0.5, 0.5};
    frame();
    const planet::ChunkId id = farRoot();
    const ImVec2 start(state_.area.x + state_.area.width / 2, state_.area.y + state_.area.height / 2);
    pointAt(start);
    frame();
    press(true);
    frame();
    const NetPoint held = onPlan(placementOf(netSize, state_.focus, state_.area),
                                 static_cast<double>(start.x), static_cast<double>(start.y));
    pointAt({start.x + 30, start.y - 20});
    frame();
    frame();
    const NetPoint now = onPlan(placementOf(netSize, state_.focus, state_.area),
                                static_cast<double>(start.x + 30), static_cast<double>(start.y - 20));
    EXPECT_NEAR(now.x, held.x, 1e-6) << toString(id);
    EXPECT_NEAR(now.y, held.y, 1e-6);
    press(false);
    frame();
    EXPECT_FALSE(asked<SelectChunk>());
}

TEST_F(QuadtreePanel, ShiftAndArrowsMoveTheViewAndKeepTheSelection) {
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    constexpr int firstKey = 300;  // beside those that ImGui maps itself
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = firstKey + key;
    const auto type = [&](ImGuiKey key) {
        io.KeysDown[firstKey + key] = true;
        frame();
        io.KeysDown[firstKey + key] = false;
    };
    state_.focus = {4, 0.5, 0.5};
    pointAt({state_.area.x + state_.area.width / 2, state_.area.y + state_.area.height / 2});
    frame();
    press(true);
    frame();
    press(false);
    frame();
    const NetFocus before = state_.focus;
    io.KeyShift = true;
    type(ImGuiKey_RightArrow);
    EXPECT_GT(state_.focus.centreX, before.centreX);
    EXPECT_EQ(state_.focus.centreY, before.centreY);
    EXPECT_FALSE(asked<SelectChunk>());
    type(ImGuiKey_UpArrow);
    EXPECT_NE(state_.focus.centreY, before.centreY);
    EXPECT_EQ(state_.focus.zoom, before.zoom);
    io.KeyShift = false;
    type(ImGuiKey_LeftArrow);
    EXPECT_TRUE(asked<SelectChunk>());
}

TEST_F(QuadtreePanel, TheWheelZoomsAboutThePointer) {
    const ImVec2 middle = middleOf(farRoot());
    const ImVec2 at(std::floor(middle.x), std::floor(middle.y));  // ImGui's pointer is on whole pixels
    const auto under = [&] {
        return onPlan(placementOf(netSize, state_.focus, state_.area), static_cast<double>(at.x),
                      static_cast<double>(at.y));
    };
    pointAt(at);
    frame();
    const NetPoint before = under();
    ImGui::GetIO().MouseWheel = 3;
    frame();
    ImGui::GetIO().MouseWheel = 0;
    EXPECT_GT(state_.focus.zoom, 2);
    EXPECT_NEAR(under().x, before.x, 1e-9);
    EXPECT_NEAR(under().y, before.y, 1e-9);
}

TEST_F(QuadtreePanel, ADoubleClickLooksAtAChunkAndBesideTheFacesFitsTheNet) {
    const planet::ChunkId id = farRoot();
    const auto doubleClick = [&](const ImVec2& at) {
        pointAt(at);
        frame();
        for (const bool down : {true, false, true}) {
            press(down);
            frame();
        }
    };
    doubleClick(middleOf(id));
    EXPECT_EQ(asked<LookAtChunk>(), id);
    press(false);
    for (int i = 0; i < 60; ++i) frame();
    state_.focus = {1.3, 0.5, 0.5};
    frame();
    doubleClick({state_.area.x + 4, state_.area.y + 4});
    EXPECT_FALSE(asked<LookAtChunk>());
    EXPECT_EQ(state_.focus.zoom, 1);
}

TEST_F(QuadtreePanel, ASelectionFromElsewhereOpensTheListToIt) {
    const planet::ChunkId drawn = planetOf().selection().draw.front().id;
    ASSERT_GT(drawn.level, 0);
    EXPECT_TRUE(state_.open.empty());
    focus_.selected = drawn;
    frame();
    EXPECT_TRUE(state_.open.contains(parentOf(drawn)));
}

TEST_F(QuadtreePanel, SquaresStayWithinTheNetsArea) {
    for (const double zoom : {1.0, 7.0, 900.0}) {
        state_.focus = {zoom, 0.6, 0.4};
        frame();
        EXPECT_FALSE(state_.rects.empty());
        for (const NetRect& rect : state_.rects) {
            EXPECT_GE(rect.x0, state_.area.x);
            EXPECT_LE(rect.x1, state_.area.x + state_.area.width);
            EXPECT_GE(rect.y0, state_.area.y);
            EXPECT_LE(rect.y1, state_.area.y + state_.area.height);
        }
    }
}

}  // namespace
}  // namespace worldy::ui
