#include "app/window/input.h"

#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include "ui/kit/plot_keys.h"
#include "ui/kit/widgets.h"

namespace worldy {

namespace {

double axis(int more, int less) {
    return (ImGui::IsKeyDown(more) ? 1.0 : 0.0) - (ImGui::IsKeyDown(less) ? 1.0 : 0.0);
}

glm::dvec2 dragOf(ImGuiMouseButton button) {
    const ImVec2 delta = ui::dragDelta(button);
    return {static_cast<double>(delta.x), static_cast<double>(delta.y)};
}

// Returns true if the button was released where it was pressed, so that a drag selects nothing.
bool clickedInPlace() {
    if (!ImGui::IsItemHovered() || !ImGui::IsMouseReleased(ImGuiMouseButton_Left)) return false;
    const float most = ImGui::GetIO().MouseDragThreshold * ImGui::GetIO().MouseDragThreshold;
    return ImGui::GetIO().MouseDragMaxDistanceSqr[ImGuiMouseButton_Left] < most;
}

}  // namespace

KeyInput readKeys() {
    KeyInput keys;
    if (ImGui::GetIO().WantTextInput || ImGui::GetIO().KeyCtrl) return keys;
    keys.held = {.forward = axis(GLFW_KEY_W, GLFW_KEY_S),
                 .right = axis(GLFW_KEY_D, GLFW_KEY_A),
                 .up = axis(GLFW_KEY_E, GLFW_KEY_Q),
                 .lookRight = axis(GLFW_KEY_L, GLFW_KEY_J),
                 .lookUp = axis(GLFW_KEY_I, GLFW_KEY_K)};
    if (!ui::plotTakesKeys()) keys.speedSteps = ui::typedSteps();
    return keys;
}

PointerInput readPointer(float pixelRatio) {
    PointerInput input;
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 corner = ImGui::GetItemRectMin();
    const double ratio = static_cast<double>(pixelRatio);
    input.over = ImGui::IsItemHovered() || ImGui::IsItemActive();
    input.positionPx = ratio * glm::dvec2(io.MousePos.x - corner.x, io.MousePos.y - corner.y);
    const bool isHeld = ImGui::IsItemActive();
    if (ImGui::IsItemHovered() || isHeld)
        (io.KeyCtrl ? input.fovNotches
         : isHeld   ? input.speedNotches
                    : input.wheelNotches) = static_cast<double>(io.MouseWheel);
    input.clicked = clickedInPlace();
    if (!isHeld) return input;
    input.grabs = io.KeyAlt;
    input.isPressed = !io.KeyAlt && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    // Otherwise ImGui would move the focus to the menu bar when Alt is released.
    if (input.grabs) ImGui::GetCurrentContext()->NavWindowingToggleLayer = false;
    (io.KeyAlt ? input.orbitPx : input.dragPx) = ratio * dragOf(ImGuiMouseButton_Left);
    (io.KeyAlt ? input.dollyPx : input.lookPx) = ratio * dragOf(ImGuiMouseButton_Right);
    return input;
}

}  // namespace worldy
