// The layout of the window that is kept between sessions.
#pragma once

#include <array>
#include <cstdint>

#include "app/settings/panel_list.h"

namespace worldy {

// The dock of a panel, and whether it is shown.
struct PanelPlace {
    Dock dock = Dock::Right;
    bool shown = true;

    bool operator==(const PanelPlace&) const = default;
};
constexpr std::array<PanelPlace, panelCount> firstPlaces() {
    std::array<PanelPlace, panelCount> places{};
    for (const PanelInfo& info : panelInfos)
        places[static_cast<std::size_t>(info.id)] = {info.dock, info.shown};
    return places;
}

enum class Theme : std::uint8_t { Dark, Light };

// The layout of the window, kept between sessions. Sizes are in units of a 13 px font, so that they fit any
// monitor.
struct Workspace {
    double leftWidth = 300;
    double rightWidth = 310;
    double bottomHeight = 210;
    std::array<PanelPlace, panelCount> panels = firstPlaces();
    // The panel that each dock shows; ignored if that panel is not docked there.
    std::array<PanelId, dockCount> inFront{PanelId::Quadtree, PanelId::Lod, PanelId::Paging};
    Theme theme = Theme::Dark;
    double scale = 1;    // relative to the monitor's scale; Ctrl + and Ctrl -
    bool idle = true;    // draws frames only while something changes
    bool vsync = true;   // frames wait for the monitor
    bool resume = true;  // a start without a file goes on with the last session

    bool operator==(const Workspace&) const = default;
};

inline bool isShown(const Workspace& workspace, PanelId panel) {
    return workspace.panels[static_cast<std::size_t>(panel)].shown;
}

}  // namespace worldy
