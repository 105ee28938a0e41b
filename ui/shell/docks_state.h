// The state of the docks between frames that is not kept between sessions.
#pragma once

#include <imgui.h>

#include <array>
#include <optional>
#include <vector>

#include "ui/model/docking.h"

namespace worldy::ui {

// A panel that is dragged by its tab or by its title bar.
struct PanelDrag {
    PanelId panel = PanelId::Lod;
    bool floated = false;    // before the drag
    FloatingPlace before{};  // restored by Esc if it floated
    ImVec2 grab;             // the pointer's position in the floating panel, pixels
    ImVec2 size;             // of the floating panel, pixels
};

struct DocksState {
    std::optional<PanelDrag> drag;
    std::vector<TabRow> rows;              // the tabs of this frame
    std::array<bool, panelCount> drawn{};  // in this frame
    // Open and closed headings, so that a panel keeps them when it moves to another window.
    std::array<ImGuiStorage, panelCount> headings;
};

}  // namespace worldy::ui
