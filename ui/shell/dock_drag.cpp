#include "ui/shell/dock_drag.h"

#include <imgui_internal.h>

#include <algorithm>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

Point pointerNow(const Layout& layout) {
    const ImVec2 at = ImGui::GetIO().MousePos;
    return pointerOverWindows({at.x, at.y}, layout);
}

// Returns where the dragged panel would float: below the pointer, inside the area.
FloatingPlace placeAtPointer(const PanelDrag& drag, const Layout& layout, const FloatingPlace& before) {
    const Point pointer = pointerNow(layout);
    const Rect rect{pointer.x - drag.grab.x, pointer.y - drag.grab.y, drag.size.x, drag.size.y};
    return floatingPlace(rect, layout.area, unitPx(), before);
}

// Returns the rectangle that the panel would fill, by laying out the window as it would be then. It is empty if the panel
// would open the second window.
Rect rectAfterDrop(const DropTarget& target, PanelId panel, const Layout& layout,
                   const Workspace& workspace) {
    if (*target.dock == Dock::Second) return layout.docks[static_cast<std::size_t>(Dock::Second)];
    Workspace after = workspace;
    dockPanel(panel, *target.dock, target.position, after);
    const float height = layout.menuBar.height + layout.area.height + layout.statusBar.height;
    const Layout then =
        layoutOf(layout.area.width, height, after, layout.menuBar.height, layout.statusBar.height, unitPx());
    return then.docks[static_cast<std::size_t>(*target.dock)];
}

void drawPreview(const PanelDrag& drag, const DropTarget& target, const Layout& layout,
                 const Workspace& workspace) {
    ImDrawList& drawList = *ImGui::GetForegroundDrawList();
    // A floating panel moves with the pointer and needs no preview.
    if (drag.floated && !target.dock) return;
    Rect rect;
    if (target.dock) {
        rect = rectAfterDrop(target, drag.panel, layout, workspace);
    } else {
        const FloatingPlace& before = workspace.panels[static_cast<std::size_t>(drag.panel)].floating;
        rect = floatingRect(placeAtPointer(drag, layout, before), layout.area, unitPx());
    }
    setItemScope("drop");
    noteRect("Preview", rect);
    // ImGui clips this list to the main window.
    const Rect& second = layout.docks[static_cast<std::size_t>(Dock::Second)];
    const bool isInSecond = second.width > 0 && target.dock == Dock::Second;
    if (isInSecond)
        drawList.PushClipRect({second.x, second.y}, {second.x + second.width, second.y + second.height});
    const ImVec2 from(rect.x, rect.y), to(rect.x + rect.width, rect.y + rect.height);
    drawList.AddRectFilled(from, to, packed(palette().accent, 0.22f), 3);
    drawList.AddRect(from, to, packed(palette().accent), 3, 0, 2);
    if (target.mark) {
        const Rect& mark = *target.mark;
        noteRect("Mark", mark);
        drawList.AddRectFilled({mark.x, mark.y}, {mark.x + mark.width, mark.y + mark.height},
                               packed(palette().accent));
    }
    const std::string text = dropText(target, drag.panel, workspace);
    const float font = ImGui::GetFontSize();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const Rect shown = isInSecond ? second : Rect{0, 0, screen.x, screen.y};
    const Point pointer = pointerNow(layout);
    const auto within = [](float wanted, float begin, float room) {
        return std::clamp(wanted, begin, begin + std::max(room, 0.0f));
    };
    const ImVec2 at(within(pointer.x + font, shown.x, shown.width - size.x - 2 * font),
                    within(pointer.y + font, shown.y, shown.height - 2 * font));
    badge(drawList, at, text.c_str(), palette().text);
    if (isInSecond) drawList.PopClipRect();
    noteRect(text, {at.x, at.y, size.x, size.y});
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
}

void drop(const PanelDrag& drag, const DropTarget& target, const Layout& layout, Workspace& workspace) {
    if (target.dock) return dockPanel(drag.panel, *target.dock, target.position, workspace);
    const FloatingPlace before = placeOf(drag.panel, workspace).floating;
    floatPanel(drag.panel, placeAtPointer(drag, layout, before), workspace);
}

// Returns a floating panel to where its drag began.
void cancel(const PanelDrag& drag, Workspace& workspace) {
    if (drag.floated) placeOf(drag.panel, workspace).floating = drag.before;
    // Otherwise ImGui would go on moving the window, or the tab would take the release for a click.
    ImGui::GetCurrentContext()->MovingWindow = nullptr;
    ImGui::ClearActiveID();
}

}  // namespace

void beginTabDrag(PanelId panel, const Rect& tab, const Layout& layout, const Workspace& workspace,
                  DocksState& state) {
    const PanelPlace& place = workspace.panels[static_cast<std::size_t>(panel)];
    PanelDrag drag{.panel = panel, .before = place.floating, .grab = {}, .size = {}};
    const Rect& dock = layout.docks[static_cast<std::size_t>(place.dock)];
    // A panel that has not floated before keeps about the size that it has in its dock.
    const bool isFirst = place.floating == FloatingPlace{};
    const Rect floated = floatingRect(place.floating, layout.area, unitPx());
    drag.size = isFirst ? ImVec2(std::min(dock.width, 0.6f * layout.area.width),
                                 std::min(dock.height, 0.6f * layout.area.height))
                        : ImVec2(floated.width, floated.height);
    const ImVec2 press = ImGui::GetIO().MouseClickedPos[0];
    drag.grab = {std::clamp(press.x - tab.x, 0.0f, drag.size.x),
                 std::clamp(press.y - tab.y, 0.0f, ImGui::GetFrameHeight())};
    state.drag = drag;
}

void advanceDrag(const Layout& layout, DocksState& state, Workspace& workspace) {
    if (!state.drag) return;
    const PanelDrag drag = *state.drag;
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) {
        cancel(drag, workspace);
        state.drag.reset();
        return;
    }
    const DropTarget target =
        io.KeyCtrl ? DropTarget{}
                   : dropTarget(pointerNow(layout), drag.panel, layout, state.rows, workspace, unitPx());
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return drawPreview(drag, target, layout, workspace);
    state.drag.reset();
    drop(drag, target, layout, workspace);
}

}  // namespace worldy::ui
