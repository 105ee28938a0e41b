#include "ui/shell/floating_panels.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

constexpr std::array<const char*, dockCount> moveNames = {"Move to the left", "Move to the right",
                                                          "Move to the bottom", "Move to the second window"};

// Returns a panel to the dock that it floated from, among the tabs where it was.
void dockBack(PanelId panel, Workspace& workspace) {
    placeOf(panel, workspace).floats = false;
    showPanel(panel, workspace);
}

bool entry(const char* label, const char* shortcut = nullptr, const char* whyNot = nullptr) {
    const bool pressed = ImGui::MenuItem(label, shortcut, false, !whyNot);
    noteItem(label);
    if (whyNot) tooltip(whyNot);
    return pressed;
}

// moving: ImGui has moved the window with the pointer.
void setPlace(const Rect& wanted, bool moving, const Rect& area) {
    if (!moving) ImGui::SetNextWindowPos({wanted.x, wanted.y});
    ImGui::SetNextWindowSize({wanted.width, wanted.height});
    const auto least = [](double units, float room) {
        return std::min(static_cast<float>(units) * unitPx(), room);
    };
    ImGui::SetNextWindowSizeConstraints(
        {least(leastFloatingWidth, area.width), least(leastFloatingHeight, area.height)},
        {area.width, area.height});
}

// Takes over where the user moved or resized the current window to.
void readPlace(const Rect& wanted, const Rect& area, FloatingPlace& place) {
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    const auto differs = [](float a, float b) { return std::abs(a - b) >= 1; };
    if (differs(at.x, wanted.x) || differs(at.y, wanted.y) || differs(size.x, wanted.width) ||
        differs(size.y, wanted.height))
        place = floatingPlace({at.x, at.y, size.x, size.y}, area, unitPx(), place);
}

// Call after Begin(), whose last item is the title bar.
void titleBar(PanelId panel, bool moving, DocksState& state, Workspace& workspace) {
    const PanelInfo& info = infoOf(panel);
    setItemScope("float");
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    noteRect(info.title, {at.x, at.y, size.x, ImGui::GetFrameHeight()});
    noteRect(std::string(info.title) + ": corner", {at.x + size.x - 8, at.y + size.y - 8, 8, 8});
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        dockBack(panel, workspace);
    if (moving && !state.drag && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
        const ImVec2 pointer = ImGui::GetIO().MousePos;
        state.drag = PanelDrag{
            panel, true, placeOf(panel, workspace).floating, {pointer.x - at.x, pointer.y - at.y}, size};
    }
    if (!state.drag) lateTooltip("Drag it to a dock, or double-click it, to dock the panel.");
    if (ImGui::BeginPopupContextItem("panel menu")) {
        panelMenu(panel, workspace);
        ImGui::EndPopup();
    }
}

}  // namespace

void drawPanelContent(PanelId panel, const EditorView& view, PanelStates& panels, DocksState& state,
                      ViewSettings& settings, Commands& commands) {
    // A panel that a menu has just moved would be drawn twice.
    if (std::exchange(state.drawn[static_cast<std::size_t>(panel)], true)) return;
    const PanelInfo& info = infoOf(panel);
    ImGuiStorage* const own = ImGui::GetStateStorage();
    ImGui::SetStateStorage(&state.headings[static_cast<std::size_t>(panel)]);
    ImGui::PushOverrideID(ImHashStr(info.key.data(), info.key.size(), 0));
    setItemScope(info.key);
    drawPanel(panel, view, panels, settings, commands);
    ImGui::PopID();
    ImGui::SetStateStorage(own);
}

void panelMenu(PanelId panel, Workspace& workspace) {
    setItemScope("tab menu");
    PanelPlace& place = placeOf(panel, workspace);
    for (std::size_t i = 0; i < dockCount; ++i) {
        const auto dock = static_cast<Dock>(i);
        const bool isHere = place.dock == dock && !place.floats;
        if (entry(moveNames[i], nullptr, isHere ? "The panel is already there." : nullptr))
            dockPanel(panel, dock, panelCount, workspace);
    }
    if (place.floats) {
        if (entry("Dock")) dockBack(panel, workspace);
    } else {
        if (entry("Float")) floatPanel(panel, place.floating, workspace);
        ImGui::Separator();
        const bool isMaximised = maximisedDock(workspace) == place.dock;
        const char* const whyNot =
            place.dock == Dock::Second ? "A panel already fills the second window." : nullptr;
        if (entry(isMaximised ? "Restore" : "Maximise", isMaximised ? "Esc" : nullptr, whyNot)) {
            showPanel(panel, workspace);
            toggleMaximised(place.dock, workspace);
        }
    }
    ImGui::Separator();
    if (entry("Hide", infoOf(panel).shortcut)) place.shown = false;
}

void drawFloatingPanel(PanelId panel, const Layout& layout, const EditorView& view, PanelStates& panels,
                       DocksState& state, Workspace& workspace, ViewSettings& settings, Commands& commands) {
    const PanelInfo& info = infoOf(panel);
    PanelPlace& place = placeOf(panel, workspace);
    const std::string name = fmt::format("{}###floating {}", info.title, info.key);
    const ImGuiWindow* const window = ImGui::FindWindowByName(name.c_str());
    const ImGuiWindow* const moved = ImGui::GetCurrentContext()->MovingWindow;
    const bool moving = window && moved && moved->RootWindow == window;
    const Rect wanted = floatingRect(place.floating, layout.area, unitPx());
    setPlace(wanted, moving, layout.area);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 4);
    bool open = true;
    const bool drawn =
        ImGui::Begin(name.c_str(), &open, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleVar(2);
    titleBar(panel, moving, state, workspace);
    readPlace(wanted, layout.area, place.floating);
    if (drawn) drawPanelContent(panel, view, panels, state, settings, commands);
    ImGui::End();
    if (!open) place.shown = false;
}

}  // namespace worldy::ui
