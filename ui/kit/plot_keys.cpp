#include "ui/kit/plot_keys.h"

#include <imgui_internal.h>

namespace worldy::ui {

namespace {

int plotKeysFrame = -2;  // ImGui's count of frames

}  // namespace

void takePlotKeys() {
    plotKeysFrame = ImGui::GetFrameCount();
    ImGui::NavMoveRequestCancel();
}

bool plotTakesKeys() {
    const int ago = ImGui::GetFrameCount() - plotKeysFrame;
    return ago == 0 || ago == 1;
}

}  // namespace worldy::ui
