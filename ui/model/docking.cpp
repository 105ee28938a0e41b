#include "ui/model/docking.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace worldy::ui {

namespace {

// The depth of the zone at an edge of the window where a panel opens an empty dock, in units.
constexpr float edgeUnits = 28;

const char* titleOf(PanelId panel) {
    return panelInfos[static_cast<std::size_t>(panel)].title;
}

template <class Wanted>
std::vector<PanelId> shownPanels(const Workspace& workspace, const Wanted& wanted) {
    std::vector<PanelId> panels;
    for (const PanelId id : workspace.order) {
        const PanelPlace& place = placeOf(id, workspace);
        if (place.shown && wanted(place)) panels.push_back(id);
    }
    return panels;
}

std::vector<PanelId> without(std::vector<PanelId> panels, PanelId panel) {
    panels.erase(std::remove(panels.begin(), panels.end(), panel), panels.end());
    return panels;
}

// Returns the share of the free room that lies before the panel, or the stored one if there is no free room.
double shareOf(float start, float length, float areaStart, float areaLength, double before) {
    const float free = areaLength - length;
    if (free < 1) return before;
    return std::clamp(static_cast<double>((start - areaStart) / free), 0.0, 1.0);
}

// Returns the length in units. A panel that fills the area keeps a stored length that is larger.
double unitsOf(float length, float areaLength, float unitPx, double least, double before) {
    const bool fills = length > areaLength - 0.5f;
    if (fills && before * static_cast<double>(unitPx) > static_cast<double>(areaLength)) return before;
    return std::clamp(static_cast<double>(length / unitPx), least, mostFloatingSize);
}

bool isInRow(const Rect& tab, float y) {
    return y >= tab.y && y < tab.y + tab.height;
}

// Returns the height of the pointer, moved into the first or the last row if it is above or below the tabs.
float rowAt(std::span<const Rect> tabs, Point pointer) {
    return std::clamp(pointer.y, tabs.front().y, tabs.back().y + tabs.back().height - 1);
}

// Returns the position of the pointer among tabs that may fill several rows: the number of tabs in the rows
// above it, and of those in its row with their middle to the left of it.
std::size_t positionAmong(std::span<const Rect> tabs, Point pointer) {
    const float y = rowAt(tabs, pointer);
    std::size_t position = 0;
    for (const Rect& tab : tabs) {
        const bool isAbove = tab.y + tab.height <= y;
        if (isAbove || (isInRow(tab, y) && tab.x + tab.width / 2 < pointer.x)) ++position;
    }
    return position;
}

// Returns a bar at a position among the tabs. At the end of the pointer's row it follows the last tab there.
Rect markAt(std::span<const Rect> tabs, std::size_t position, Point pointer) {
    constexpr float barPx = 3;
    const float y = rowAt(tabs, pointer);
    const bool follows = position == tabs.size() || (position > 0 && isInRow(tabs[position - 1], y));
    if (follows) {
        const Rect& tab = tabs[position - 1];
        return {tab.x + tab.width - 1, tab.y, barPx, tab.height};
    }
    const Rect& tab = tabs[position];
    return {tab.x - barPx + 1, tab.y, barPx, tab.height};
}

// Returns the band in which the tabs of a dock lie: the whole width of the dock, down to the last row.
Rect bandOf(const Rect& dock, std::span<const Rect> tabs) {
    float bottom = dock.y;
    for (const Rect& tab : tabs) bottom = std::max(bottom, tab.y + tab.height);
    return {dock.x, dock.y, dock.width, bottom + 3 - dock.y};
}

DropTarget amongTabs(const TabRow& row, PanelId panel, Point pointer) {
    DropTarget target{row.dock};
    const std::size_t among = positionAmong(row.tabs, pointer);
    target.mark = markAt(row.tabs, among, pointer);
    const auto own = std::find(row.panels.begin(), row.panels.end(), panel);
    const auto ownPosition = static_cast<std::size_t>(own - row.panels.begin());
    target.position = own != row.panels.end() && ownPosition < among ? among - 1 : among;
    return target;
}

Rect mainWindow(const Layout& layout) {
    return {0, 0, layout.area.width, layout.menuBar.height + layout.area.height + layout.statusBar.height};
}

// Returns the empty dock that a panel opens at an edge of the area.
std::optional<Dock> edgeAt(Point pointer, const Layout& layout, float unitPx) {
    const Rect& area = layout.area;
    if (!contains(area, pointer)) return std::nullopt;
    const float depth = edgeUnits * unitPx;
    const auto isEmpty = [&](Dock dock) {
        const Rect& rect = layout.docks[static_cast<std::size_t>(dock)];
        return rect.width <= 0 || rect.height <= 0;
    };
    if (isEmpty(Dock::Left) && pointer.x < area.x + depth) return Dock::Left;
    if (isEmpty(Dock::Right) && pointer.x >= area.x + area.width - depth) return Dock::Right;
    if (isEmpty(Dock::Bottom) && pointer.y >= area.y + area.height - depth) return Dock::Bottom;
    return std::nullopt;
}

// Returns true if a maximised dock or the maximised viewport takes the panel's room.
bool isCovered(const PanelPlace& place, const Workspace& workspace) {
    if (!place.floats && place.dock == Dock::Second) return false;
    if (isViewportMaximised(workspace)) return true;
    const std::optional<Dock> maximised = maximisedDock(workspace);
    return !place.floats && maximised && *maximised != place.dock;
}

}  // namespace

bool contains(const Rect& rect, Point point) {
    return point.x >= rect.x && point.x < rect.x + rect.width && point.y >= rect.y &&
           point.y < rect.y + rect.height;
}

std::vector<PanelId> panelsIn(Dock dock, const Workspace& workspace) {
    return shownPanels(workspace,
                       [&](const PanelPlace& place) { return !place.floats && place.dock == dock; });
}

std::vector<PanelId> floatingPanels(const Workspace& workspace) {
    if (isViewportMaximised(workspace)) return {};
    return shownPanels(workspace, [](const PanelPlace& place) { return place.floats; });
}

std::optional<PanelId> frontPanel(Dock dock, const Workspace& workspace) {
    const std::vector<PanelId> panels = panelsIn(dock, workspace);
    if (panels.empty()) return std::nullopt;
    const PanelId front = workspace.inFront[static_cast<std::size_t>(dock)];
    return std::find(panels.begin(), panels.end(), front) == panels.end() ? panels.front() : front;
}

bool isVisible(PanelId panel, const Workspace& workspace) {
    const PanelPlace& place = placeOf(panel, workspace);
    if (!place.shown || isCovered(place, workspace)) return false;
    return place.floats || frontPanel(place.dock, workspace) == panel;
}

void showPanel(PanelId panel, Workspace& workspace) {
    PanelPlace& place = placeOf(panel, workspace);
    place.shown = true;
    if (isCovered(place, workspace)) workspace.maximised = MaximisedDock::None;
    if (!place.floats) workspace.inFront[static_cast<std::size_t>(place.dock)] = panel;
}

void togglePanel(PanelId panel, Workspace& workspace) {
    // A panel behind another tab comes to the front instead of being hidden.
    if (isVisible(panel, workspace))
        placeOf(panel, workspace).shown = false;
    else
        showPanel(panel, workspace);
}

void toggleMaximised(Dock dock, Workspace& workspace) {
    if (dock == Dock::Second) return;
    if (maximisedDock(workspace) == dock)
        workspace.maximised = MaximisedDock::None;
    else
        workspace.maximised = static_cast<MaximisedDock>(static_cast<int>(dock) + 1);
}

void toggleAllPanels(Workspace& workspace) {
    if (isViewportMaximised(workspace)) {
        workspace.maximised = MaximisedDock::None;
        return;
    }
    if (std::ranges::any_of(workspace.panels, &PanelPlace::shown)) {
        workspace.maximised = MaximisedDock::Viewport;
        return;
    }
    const auto first = firstPlaces();
    for (std::size_t i = 0; i < panelCount; ++i) workspace.panels[i].shown = first[i].shown;
}

std::size_t positionIn(Dock dock, PanelId panel, const Workspace& workspace) {
    const std::vector<PanelId> panels = panelsIn(dock, workspace);
    return static_cast<std::size_t>(std::find(panels.begin(), panels.end(), panel) - panels.begin());
}

void dockPanel(PanelId panel, Dock dock, std::size_t position, Workspace& workspace) {
    const std::vector<PanelId> others = without(panelsIn(dock, workspace), panel);
    PanelOrder& order = workspace.order;
    // Only the moved panel changes its place in the order, so that hidden panels keep theirs.
    const auto from = std::find(order.begin(), order.end(), panel);
    if (!others.empty() && from != order.end()) {
        std::rotate(from, from + 1, order.end());  // to the end; the others keep their order
        const bool atEnd = position >= others.size();
        const auto next = std::find(order.begin(), order.end(), atEnd ? others.back() : others[position]);
        std::rotate(atEnd ? next + 1 : next, order.end() - 1, order.end());
    }
    PanelPlace& place = placeOf(panel, workspace);
    place.dock = dock;
    place.floats = false;
    showPanel(panel, workspace);
}

void leaveSecondWindow(Workspace& workspace) {
    for (const PanelInfo& info : panelInfos) {
        Dock& dock = placeOf(info.id, workspace).dock;
        if (dock == Dock::Second) dock = info.dock;
    }
}

void floatPanel(PanelId panel, const FloatingPlace& floating, Workspace& workspace) {
    PanelPlace& place = placeOf(panel, workspace);
    place.floats = true;
    place.floating = floating;
    showPanel(panel, workspace);
}

Rect floatingRect(const FloatingPlace& place, const Rect& area, float unitPx) {
    Rect rect;
    rect.width = std::round(std::min(static_cast<float>(place.width) * unitPx, area.width));
    rect.height = std::round(std::min(static_cast<float>(place.height) * unitPx, area.height));
    rect.x = std::round(area.x + static_cast<float>(place.x) * (area.width - rect.width));
    rect.y = std::round(area.y + static_cast<float>(place.y) * (area.height - rect.height));
    return rect;
}

FloatingPlace floatingPlace(const Rect& rect, const Rect& area, float unitPx, const FloatingPlace& before) {
    const float width = std::min(rect.width, area.width);
    const float height = std::min(rect.height, area.height);
    FloatingPlace place;
    place.x = shareOf(rect.x, width, area.x, area.width, before.x);
    place.y = shareOf(rect.y, height, area.y, area.height, before.y);
    place.width = unitsOf(width, area.width, unitPx, leastFloatingWidth, before.width);
    place.height = unitsOf(height, area.height, unitPx, leastFloatingHeight, before.height);
    return place;
}

Point pointerOverWindows(Point pointer, const Layout& layout) {
    const Rect& second = layout.docks[static_cast<std::size_t>(Dock::Second)];
    if (second.width <= 0) return pointer;
    const bool isOfSecond = pointer.x >= secondWindowX / 2;
    const Point onMain =
        isOfSecond ? Point{pointer.x - second.x + layout.secondLeft, pointer.y - second.y + layout.secondTop}
                   : pointer;
    const Point onSecond{onMain.x - layout.secondLeft + second.x, onMain.y - layout.secondTop + second.y};
    // If the windows overlap, the one that holds the button is taken.
    const bool isOverMain = contains(mainWindow(layout), onMain);
    const bool isOverSecond = contains(second, onSecond);
    return isOverSecond && (isOfSecond || !isOverMain) ? onSecond : onMain;
}

DropTarget dropTarget(Point pointer, PanelId panel, const Layout& layout, std::span<const TabRow> rows,
                      const Workspace& workspace, float unitPx) {
    for (const TabRow& row : rows) {
        const Rect& dock = layout.docks[static_cast<std::size_t>(row.dock)];
        if (!contains(dock, pointer) || row.tabs.empty()) continue;
        if (contains(bandOf(dock, row.tabs), pointer)) return amongTabs(row, panel, pointer);
        // A maximised dock covers the place where a panel could float.
        if (maximisedDock(workspace)) return {};
        const PanelPlace& place = placeOf(panel, workspace);
        const bool stays = place.dock == row.dock && !place.floats;
        const std::size_t end = without(panelsIn(row.dock, workspace), panel).size();
        return {row.dock, stays ? positionIn(row.dock, panel, workspace) : end, std::nullopt};
    }
    if (!contains(mainWindow(layout), pointer)) return {Dock::Second, panelCount};
    if (maximisedDock(workspace)) return {};
    return {edgeAt(pointer, layout, unitPx)};
}

std::string dropText(const DropTarget& target, PanelId panel, const Workspace& workspace) {
    if (!target.dock) return "Float";
    constexpr std::array<const char*, dockCount> names = {"Left dock", "Right dock", "Bottom dock",
                                                          "Second window"};
    const char* const name = names[static_cast<std::size_t>(*target.dock)];
    const std::vector<PanelId> others = without(panelsIn(*target.dock, workspace), panel);
    if (others.empty()) return name;
    if (target.position == 0) return fmt::format("{}, before {}", name, titleOf(others.front()));
    const std::size_t before = std::min(target.position, others.size()) - 1;
    return fmt::format("{}, after {}", name, titleOf(others[before]));
}

}  // namespace worldy::ui
