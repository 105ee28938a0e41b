#include "app/input.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

namespace worldy {

namespace {

double axis(int more, int less) {
    return (ImGui::IsKeyDown(more) ? 1.0 : 0.0) - (ImGui::IsKeyDown(less) ? 1.0 : 0.0);
}

// By the character, since + and - lie elsewhere on other keyboards.
int speedSteps() {
    int steps = 0;
    for (const ImWchar letter : ImGui::GetIO().InputQueueCharacters) {
        if (letter == '+' || letter == '=') ++steps;
        if (letter == '-') --steps;
    }
    return steps;
}

glm::dvec2 dragOf(ImGuiMouseButton button) {
    if (!ImGui::IsMouseDown(button)) return {0, 0};
    const ImVec2 delta = ImGui::GetIO().MouseDelta;
    return {static_cast<double>(delta.x), static_cast<double>(delta.y)};
}

}  // namespace

KeyInput readKeys(const std::vector<int>& pressedKeys) {
    KeyInput keys;
    if (ImGui::GetIO().WantTextInput) return keys;
    const auto pressed = [&](int key) {
        return std::find(pressedKeys.begin(), pressedKeys.end(), key) != pressedKeys.end();
    };
    keys.held = {.forward = axis(GLFW_KEY_W, GLFW_KEY_S),
                 .right = axis(GLFW_KEY_D, GLFW_KEY_A),
                 .up = axis(GLFW_KEY_E, GLFW_KEY_Q),
                 .lookRight = axis(GLFW_KEY_L, GLFW_KEY_J),
                 .lookUp = axis(GLFW_KEY_I, GLFW_KEY_K)};
    keys.speedSteps = speedSteps();
    keys.toggleWireframe = pressed(GLFW_KEY_F1);
    keys.toggleFreeze = pressed(GLFW_KEY_F2);
    keys.resetCamera = pressed(GLFW_KEY_F3);
    keys.toggleCube = pressed(GLFW_KEY_F4);
    // Escape leaves an open list before it leaves the program.
    keys.quit = pressed(GLFW_KEY_ESCAPE) &&
                !ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    return keys;
}

PointerInput readPointer(float pixelRatio) {
    PointerInput input;
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 corner = ImGui::GetItemRectMin();
    const double ratio = static_cast<double>(pixelRatio);
    input.positionPx = ratio * glm::dvec2(io.MousePos.x - corner.x, io.MousePos.y - corner.y);
    if (ImGui::IsItemHovered()) input.wheelNotches = static_cast<double>(io.MouseWheel);
    if (!ImGui::IsItemActive()) return input;
    input.dragPx = ratio * dragOf(ImGuiMouseButton_Left);
    input.lookPx = ratio * dragOf(ImGuiMouseButton_Right);
    return input;
}

}  // namespace worldy
