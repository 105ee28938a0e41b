#include "ui/shell/docks.h"

#include <algorithm>
#include <cmath>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/shell/dock_drag.h"
#include "ui/shell/floating_panels.h"

namespace worldy::ui {

namespace {

constexpr std::array<const char*, dockCount> dockNames = {"left dock", "right dock", "bottom dock",
                                                          "second window"};
// The second window has no splitter.
constexpr std::array<const char*, dockCount> splitterNames = {"left splitter", "right splitter",
                                                              "bottom splitter", ""};

std::size_t indexOf(Dock dock) {
    return static_cast<std::size_t>(dock);
}

// Draws one tab. Returns its rectangle.
Rect tab(const PanelInfo& info, bool active, Dock dock, Workspace& workspace) {
    ImGui::PushStyleColor(ImGuiCol_Button,
                          ImGui::GetStyleColorVec4(active ? ImGuiCol_TabActive : ImGuiCol_Tab));
    ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(ImGuiCol_TabHovered));
    ImGui::PushStyleColor(ImGuiCol_Text, active ? palette().text : palette().dim);
    if (ImGui::Button(info.title)) workspace.inFront[indexOf(dock)] = info.id;
    noteItem(info.title);
    ImGui::PopStyleColor(3);
    const ImVec2 min = ImGui::GetItemRectMin();
    const ImVec2 max = ImGui::GetItemRectMax();
    if (active) {
        ImGui::GetWindowDrawList()->AddRectFilled({min.x + 2, max.y - 2}, {max.x - 2, max.y},
                                                  ImGui::GetColorU32(palette().accent));
    }
    return {min.x, min.y, max.x - min.x, max.y - min.y};
}

// Reacts to the mouse on the tab that was drawn last.
void obeyTab(const PanelInfo& info, const Rect& rect, Dock dock, const Layout& layout, DocksState& state,
             Workspace& workspace) {
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        workspace.inFront[indexOf(dock)] = info.id;
        toggleMaximised(dock, workspace);
    }
    if (!state.drag && ImGui::IsItemActive() && ImGui::IsMouseDragging(ImGuiMouseButton_Left))
        beginTabDrag(info.id, rect, layout, workspace, state);
    if (!state.drag)
        lateTooltip(dock == Dock::Second ? "Drag it to move the panel, or close the window to move all back."
                    : layout.viewportCovered ? "Double-click it to restore the docks and the planet."
                                             : "Drag it to move the panel, double-click it to maximise.");
    if (!ImGui::BeginPopupContextItem(info.title)) return;
    panelMenu(info.id, workspace);
    ImGui::EndPopup();
}

// Draws the button that restores a maximised dock, at the right end of the tabs.
void restoreButton(float end, Workspace& workspace) {
    constexpr const char* label = "Restore";
    const float width = ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
    if (ImGui::GetItemRectMax().x + 2 + width <= end) ImGui::SameLine();
    ImGui::SetCursorPosX(std::max(end - width - ImGui::GetWindowPos().x, ImGui::GetCursorPosX()));
    if (button(label, "Restores the docks and the planet (Esc, or double-click a tab).")) {
        workspace.maximised = MaximisedDock::None;
    }
}

// Draws the tabs as buttons that wrap in a narrow dock, so that every tab stays reachable.
void tabs(Dock dock, PanelId front, const Layout& layout, DocksState& state, Workspace& workspace) {
    setItemScope("tab");
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {2, 2});
    ImGui::PushStyleVar(ImGuiStyleVar_FrameRounding, 3);
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    TabRow row{dock, panelsIn(dock, workspace), {}};
    for (const PanelId id : row.panels) {
        const PanelInfo& info = infoOf(id);
        const float width = ImGui::CalcTextSize(info.title).x + 2 * ImGui::GetStyle().FramePadding.x;
        if (!row.tabs.empty() && ImGui::GetItemRectMax().x + 2 + width <= end) ImGui::SameLine();
        row.tabs.push_back(tab(info, id == front, dock, workspace));
        obeyTab(info, row.tabs.back(), dock, layout, state, workspace);
        setItemScope("tab");
    }
    if (layout.viewportCovered && dock != Dock::Second) restoreButton(end, workspace);
    ImGui::PopStyleVar(2);
    ImGui::Separator();
    state.rows.push_back(std::move(row));
}

void dragSplitter(Dock dock, const Layout& layout, Workspace& workspace) {
    const Rect& bar = layout.splitters[indexOf(dock)];
    if (bar.width <= 0 || bar.height <= 0) return;
    const bool upright = dock != Dock::Bottom;
    double movedPx = 0;
    if (!splitter(splitterNames[indexOf(dock)], bar, upright, movedPx)) return;
    // Resizes from the current size, which may be less than the stored size.
    const Rect& rect = layout.docks[indexOf(dock)];
    const double shownPx = static_cast<double>(upright ? rect.width : rect.height);
    const double size = (shownPx + (dock == Dock::Left ? movedPx : -movedPx)) / static_cast<double>(unitPx());
    if (movedPx == 0) return;
    if (dock == Dock::Left) workspace.leftWidth = std::clamp(size, 160.0, 1000.0);
    if (dock == Dock::Right) workspace.rightWidth = std::clamp(size, 160.0, 1000.0);
    if (dock == Dock::Bottom) workspace.bottomHeight = std::clamp(size, 60.0, 1000.0);
}

void drawDock(Dock dock, const Layout& layout, const EditorView& view, PanelStates& panels, DocksState& state,
              Workspace& workspace, ViewSettings& settings, Commands& commands) {
    const std::optional<PanelId> front = frontPanel(dock, workspace);
    const Rect& rect = layout.docks[indexOf(dock)];
    // A dock has no room while another one is maximised.
    if (!front || rect.width <= 0 || rect.height <= 0) return;
    workspace.inFront[indexOf(dock)] = *front;
    beginFixedWindow(dockNames[indexOf(dock)], rect,
                     ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBackground);
    tabs(dock, *front, layout, state, workspace);
    // Each panel has its own child window, so that it keeps its scroll position while another is shown.
    ImGui::BeginChild(infoOf(*front).title);
    drawPanelContent(*front, view, panels, state, settings, commands);
    ImGui::EndChild();
    ImGui::End();
    dragSplitter(dock, layout, workspace);
}

// ImGui clips windows to its viewport and keeps popups inside it, so the viewport is the second window meanwhile.
void drawSecondWindow(const Layout& layout, const EditorView& view, PanelStates& panels, DocksState& state,
                      Workspace& workspace, ViewSettings& settings, Commands& commands) {
    const Rect& rect = layout.docks[indexOf(Dock::Second)];
    ImGuiViewport& viewport = *ImGui::GetMainViewport();
    const ImGuiViewport main = viewport;
    viewport.Pos = viewport.WorkPos = {rect.x, rect.y};
    viewport.Size = viewport.WorkSize = {rect.width, rect.height};
    drawDock(Dock::Second, layout, view, panels, state, workspace, settings, commands);
    viewport = main;
}

}  // namespace

void drawDocks(const Layout& layout, const EditorView& view, PanelStates& panels, DocksState& state,
               Workspace& workspace, ViewSettings& settings, Commands& commands) {
    state.rows.clear();
    state.drawn = {};
    // A dock that has lost its last panel is not maximised when it gets another one.
    if (!maximisedDock(workspace) && !isViewportMaximised(workspace))
        workspace.maximised = MaximisedDock::None;
    for (const Dock dock : {Dock::Left, Dock::Right, Dock::Bottom})
        drawDock(dock, layout, view, panels, state, workspace, settings, commands);
    drawSecondWindow(layout, view, panels, state, workspace, settings, commands);
    for (const PanelId panel : floatingPanels(workspace))
        drawFloatingPanel(panel, layout, view, panels, state, workspace, settings, commands);
    advanceDrag(layout, state, workspace);
}

}  // namespace worldy::ui
