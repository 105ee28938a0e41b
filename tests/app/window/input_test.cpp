#include "app/window/input.h"

#include <gtest/gtest.h>

#include "tests/support/panel_fixture.h"

namespace worldy {
namespace {

class Input : public testing::Test {
protected:
    PointerInput at(ImVec2 place, bool down, ImGuiMouseButton button = 0) {
        ui::PanelWindow::movePointer(place);
        ImGui::GetIO().MouseDown[button] = down;
        PointerInput input;
        window_.frame([&] {
            ImGui::InvisibleButton("picture", {300, 200},
                                   ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
            input = readPointer(1);
        });
        return input;
    }

    ui::PanelWindow window_{{400, 300}};
};

TEST_F(Input, motionBeforeThePressIsNoDrag) {
    for (const ImGuiMouseButton button : {ImGuiMouseButton_Left, ImGuiMouseButton_Right}) {
        at({20, 20}, false, button);
        at({20, 20}, false, button);
        const PointerInput pressed = at({120, 90}, true, button);  // moved and pressed in one frame
        EXPECT_EQ(pressed.dragPx, glm::dvec2(0, 0));
        EXPECT_EQ(pressed.lookPx, glm::dvec2(0, 0));
        const PointerInput dragged = at({125, 88}, true, button);
        EXPECT_EQ(button == 0 ? dragged.dragPx : dragged.lookPx, glm::dvec2(5, -2));
        at({125, 88}, false, button);
    }
}

TEST_F(Input, aClickRightAfterAMotionSelectsAndDoesNotMove) {
    at({20, 20}, false);
    at({20, 20}, false);
    EXPECT_EQ(at({150, 100}, true).dragPx, glm::dvec2(0, 0));
    const PointerInput released = at({150, 100}, false);
    EXPECT_TRUE(released.clicked);
    EXPECT_EQ(released.dragPx, glm::dvec2(0, 0));
}

TEST_F(Input, theWheelZoomsAndChangesTheSpeedWhileAButtonIsHeld) {
    const auto turn = [&](ImVec2 place, bool down) {
        ImGui::GetIO().MouseWheel = 2;
        return at(place, down, ImGuiMouseButton_Right);
    };
    at({50, 50}, false);
    const PointerInput free = turn({50, 50}, false);
    EXPECT_EQ(free.wheelNotches, 2);
    EXPECT_EQ(free.speedNotches, 0);
    at({50, 50}, true, ImGuiMouseButton_Right);
    const PointerInput held = turn({50, 50}, true);
    EXPECT_EQ(held.wheelNotches, 0);
    EXPECT_EQ(held.speedNotches, 2);
    EXPECT_EQ(turn({380, 290}, true).speedNotches, 2);  // dragged off the picture
    at({50, 50}, false, ImGuiMouseButton_Right);
    ImGui::GetIO().KeyCtrl = true;
    const PointerInput lens = turn({50, 50}, false);
    ImGui::GetIO().KeyCtrl = false;
    EXPECT_EQ(lens.fovNotches, 2);
    EXPECT_EQ(lens.wheelNotches + lens.speedNotches, 0);
}

TEST_F(Input, aDragWithAltHoldsAPointInsteadOfMoving) {
    for (const ImGuiMouseButton button : {ImGuiMouseButton_Left, ImGuiMouseButton_Right}) {
        at({50, 50}, false, button);
        ImGui::GetIO().KeyAlt = true;
        EXPECT_FALSE(at({50, 50}, false, button).grabs);
        EXPECT_TRUE(at({50, 50}, true, button).grabs);
        const PointerInput dragged = at({57, 46}, true, button);
        ImGui::GetIO().KeyAlt = false;
        EXPECT_TRUE(dragged.grabs);
        EXPECT_EQ(button == 0 ? dragged.orbitPx : dragged.dollyPx, glm::dvec2(7, -4));
        EXPECT_EQ(dragged.dragPx + dragged.lookPx, glm::dvec2(0, 0));
        at({57, 46}, false, button);
    }
}

}  // namespace
}  // namespace worldy
