#include "ui/shell/docks.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

constexpr std::array<const char*, dockCount> dockNames = {"left dock", "right dock", "bottom dock"};
constexpr std::array<const char*, dockCount> splitterNames = {"left splitter", "right splitter",
                                                              "bottom splitter"};
constexpr std::array<const char*, dockCount> moveNames = {"Move to the left", "Move to the right",
                                                          "Move to the bottom"};

std::size_t indexOf(Dock dock) {
    return static_cast<std::size_t>(dock);
}

PanelPlace& placeOf(PanelId id, Workspace& workspace) {
    return workspace.panels[static_cast<std::size_t>(id)];
}

std::vector<const PanelInfo*> panelsIn(Dock dock, Workspace& workspace) {
    std::vector<const PanelInfo*> panels;
    for (const PanelInfo& info : panelInfos) {
        const PanelPlace& place = placeOf(info.id, workspace);
        if (place.shown && place.dock == dock) panels.push_back(&info);
    }
    return panels;
}

void tabMenu(const PanelInfo& info, Workspace& workspace) {
    if (!ImGui::BeginPopupContextItem(info.title)) return;
    PanelPlace& place = placeOf(info.id, workspace);
    for (std::size_t dock = 0; dock < dockCount; ++dock) {
        const bool here = indexOf(place.dock) == dock;
        if (ImGui::MenuItem(moveNames[dock], nullptr, false, !here)) {
            place.dock = static_cast<Dock>(dock);
            workspace.inFront[dock] = info.id;
        }
        if (here) tooltip("The panel is already there.");
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Hide", info.shortcut)) place.shown = false;
    ImGui::EndPopup();
}

// Draws the tabs as buttons that wrap in a narrow dock, so that every tab stays reachable.
void tabs(const std::vector<const PanelInfo*>& panels, PanelId shown, Workspace& workspace, Dock dock) {
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {2, 2});
    ImGui::PushStyleVar(ImGuiStyleVar_FrameRounding, 3);
    const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const PanelInfo& info = *panels[i];
        const float width = ImGui::CalcTextSize(info.title).x + 2 * ImGui::GetStyle().FramePadding.x;
        if (i > 0 && ImGui::GetItemRectMax().x + 2 + width <= end) ImGui::SameLine();
        const bool active = info.id == shown;
        ImGui::PushStyleColor(ImGuiCol_Button,
                              ImGui::GetStyleColorVec4(active ? ImGuiCol_TabActive : ImGuiCol_Tab));
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, ImGui::GetStyleColorVec4(ImGuiCol_TabHovered));
        ImGui::PushStyleColor(ImGuiCol_Text, active ? palette().text : palette().dim);
        if (ImGui::Button(info.title)) workspace.inFront[indexOf(dock)] = info.id;
        noteItem(info.title);
        ImGui::PopStyleColor(3);
        if (active) {
            const ImVec2 min = ImGui::GetItemRectMin();
            const ImVec2 max = ImGui::GetItemRectMax();
            ImGui::GetWindowDrawList()->AddRectFilled({min.x + 2, max.y - 2}, {max.x - 2, max.y},
                                                      ImGui::GetColorU32(palette().accent));
        }
        tabMenu(info, workspace);
    }
    ImGui::PopStyleVar(2);
    ImGui::Separator();
}

void dragSplitter(Dock dock, const Layout& layout, Workspace& workspace) {
    const bool upright = dock != Dock::Bottom;
    double movedPx = 0;
    if (!splitter(splitterNames[indexOf(dock)], layout.splitters[indexOf(dock)], upright, movedPx)) return;
    // Resizes from the current size, which may be less than the stored size.
    const Rect& rect = layout.docks[indexOf(dock)];
    const double shownPx = static_cast<double>(upright ? rect.width : rect.height);
    const double size = (shownPx + (dock == Dock::Left ? movedPx : -movedPx)) / static_cast<double>(unitPx());
    if (movedPx == 0) return;
    if (dock == Dock::Left) workspace.leftWidth = std::clamp(size, 160.0, 1000.0);
    if (dock == Dock::Right) workspace.rightWidth = std::clamp(size, 160.0, 1000.0);
    if (dock == Dock::Bottom) workspace.bottomHeight = std::clamp(size, 60.0, 1000.0);
}

}  // namespace

void showPanel(PanelId id, Workspace& workspace) {
    PanelPlace& place = placeOf(id, workspace);
    place.shown = true;
    workspace.inFront[indexOf(place.dock)] = id;
}

void drawDock(Dock dock, const Layout& layout, const EditorView& view, PanelStates& panels,
              Workspace& workspace, ViewSettings& settings, Commands& commands) {
    const std::vector<const PanelInfo*> shown = panelsIn(dock, workspace);
    if (shown.empty()) return;
    const auto isActive = [&](const PanelInfo* info) { return info->id == workspace.inFront[indexOf(dock)]; };
    if (std::none_of(shown.begin(), shown.end(), isActive))
        workspace.inFront[indexOf(dock)] = shown.front()->id;
    const PanelId active = workspace.inFront[indexOf(dock)];

    beginFixedWindow(dockNames[indexOf(dock)], layout.docks[indexOf(dock)],
                     ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBackground);
    setItemScope("tab");
    tabs(shown, active, workspace, dock);
    // Each panel has its own child window, so that it keeps its scroll position while another is shown.
    ImGui::BeginChild(panelInfos[static_cast<std::size_t>(active)].title);
    ImGui::PushID(static_cast<int>(active));
    setItemScope(panelInfos[static_cast<std::size_t>(active)].key);
    drawPanel(active, view, panels, settings, commands);
    ImGui::PopID();
    ImGui::EndChild();
    ImGui::End();
    dragSplitter(dock, layout, workspace);
}

}  // namespace worldy::ui
