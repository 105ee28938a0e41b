// The docks as data: which panel lies where, in which order, and where a dragged panel would go. Pure
// functions.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ui/model/layout.h"

namespace worldy::ui {

struct Point {
    float x = 0;  // pixels from the window's top left
    float y = 0;
};
bool contains(const Rect& rect, Point point);

inline const PanelInfo& infoOf(PanelId panel) {
    return panelInfos[static_cast<std::size_t>(panel)];
}
inline PanelPlace& placeOf(PanelId panel, Workspace& workspace) {
    return workspace.panels[static_cast<std::size_t>(panel)];
}
inline const PanelPlace& placeOf(PanelId panel, const Workspace& workspace) {
    return workspace.panels[static_cast<std::size_t>(panel)];
}

// Returns the shown panels of a dock in the order of their tabs.
std::vector<PanelId> panelsIn(Dock dock, const Workspace& workspace);
// Returns the panels that are drawn in windows of their own, in the order of the tabs.
std::vector<PanelId> floatingPanels(const Workspace& workspace);
// Returns the panel that a dock shows; none if it has no panel.
std::optional<PanelId> frontPanel(Dock dock, const Workspace& workspace);
// Returns true if the panel is drawn: it floats or is in front in a dock that no other dock covers.
bool isVisible(PanelId panel, const Workspace& workspace);

// Shows a panel in front of its dock, or floating. Ends the maximising of another dock, which would cover it, and of the
// viewport.
void showPanel(PanelId panel, Workspace& workspace);
// Hides a visible panel; shows any other.
void togglePanel(PanelId panel, Workspace& workspace);

// Maximises the dock, or restores it if it is maximised. The second window has no dock to maximise.
void toggleMaximised(Dock dock, Workspace& workspace);

// Puts all panels away, or brings back those that were put away. If no panel is shown, shows the default ones.
void toggleAllPanels(Workspace& workspace);

// Moves a panel into a dock, in front, before the tab at the position among those of its other panels; a
// position past the end stands for the end.
void dockPanel(PanelId panel, Dock dock, std::size_t position, Workspace& workspace);
// Returns a docked panel's position among the tabs of its dock, or the end of the dock if the panel is
// not there.
std::size_t positionIn(Dock dock, PanelId panel, const Workspace& workspace);
// Returns the panels of the second window, which is closed then, to the docks where they are by default.
void leaveSecondWindow(Workspace& workspace);
// Lets a panel float.
void floatPanel(PanelId panel, const FloatingPlace& place, Workspace& workspace);

// Returns the rectangle of a floating panel, in whole pixels. It lies inside the area, and is smaller than
// its stored size if the area is. unitPx: size of a unit of Workspace, > 0.
Rect floatingRect(const FloatingPlace& place, const Rect& area, float unitPx);
// Returns the place whose rectangle is the nearest one inside the area. The place keeps its share in a
// direction in which the rectangle fills the area.
FloatingPlace floatingPlace(const Rect& rect, const Rect& area, float unitPx, const FloatingPlace& before);

// The tabs that are drawn in a dock, in reading order. They may fill several rows.
struct TabRow {
    Dock dock = Dock::Left;
    std::vector<PanelId> panels;
    std::vector<Rect> tabs;  // of the panels
};

// The place that a dragged panel takes when it is dropped.
struct DropTarget {
    std::optional<Dock> dock;    // none: it floats
    std::size_t position = 0;    // among the tabs of the dock without the panel
    std::optional<Rect> mark{};  // between two tabs; none if it becomes the only tab
};
// Returns where a pointer is while a button is held. Its position then refers to the window in which the button went
// down, even over the other window.
Point pointerOverWindows(Point pointer, const Layout& layout);
// Returns the target for a pointer. Outside of the windows, the panel goes into the second one. Over a dock's tabs, the panel goes between those that are nearest. Over the
// rest of a dock, it goes to the end; over its own dock, it stays. At an edge of the window's area where a
// dock has no panel, it opens that dock. Elsewhere it floats.
DropTarget dropTarget(Point pointer, PanelId panel, const Layout& layout, std::span<const TabRow> rows,
                      const Workspace& workspace, float unitPx);

// Returns what a drop does, for the user: "Right dock, after LOD".
std::string dropText(const DropTarget& target, PanelId panel, const Workspace& workspace);

}  // namespace worldy::ui
