// The layout of the window that is kept between sessions.
#pragma once

#include <array>
#include <cstdint>

#include "app/settings/panel_list.h"

namespace worldy {

inline constexpr double leastFloatingWidth = 160;
inline constexpr double leastFloatingHeight = 100;
inline constexpr double mostFloatingSize = 2000;

// The place of a floating panel in the area between the menu bar and the status bar. It lies inside that area
// whatever the size of the window.
struct FloatingPlace {
    // Shares of the room that the panel's own size leaves, [0, 1]: 0 is the left or the top, 1 the right or
    // the bottom.
    double x = 0.5;
    double y = 0.3;
    // In units of Workspace, [leastFloatingWidth, mostFloatingSize] and [leastFloatingHeight, mostFloatingSize];
    // less on screen if the area is smaller.
    double width = 380;
    double height = 420;

    bool operator==(const FloatingPlace&) const = default;
};

// The dock of a panel, and whether it is shown.
struct PanelPlace {
    Dock dock = Dock::Right;
    bool shown = true;
    bool floats = false;  // in a window of its own, instead of the dock; it returns to the dock
    FloatingPlace floating{};

    bool operator==(const PanelPlace&) const = default;
};
constexpr std::array<PanelPlace, panelCount> firstPlaces() {
    std::array<PanelPlace, panelCount> places{};
    for (const PanelInfo& info : panelInfos)
        places[static_cast<std::size_t>(info.id)] = {info.dock, info.shown};
    return places;
}

using PanelOrder = std::array<PanelId, panelCount>;
constexpr PanelOrder firstOrder() {
    PanelOrder order{};
    for (std::size_t i = 0; i < panelCount; ++i) order[i] = panelInfos[i].id;
    return order;
}

enum class Theme : std::uint8_t { Dark, Light };
// Viewport: no dock and no floating panel is drawn, and the viewport has their room.
enum class MaximisedDock : std::uint8_t { None, Left, Right, Bottom, Viewport };

struct WindowPreferences {
    Theme theme = Theme::Dark;
    double scale = 1;             // relative to the monitor's scale; Ctrl + and Ctrl -
    bool idle = true;             // draws frames only while something changes
    bool vsync = true;            // frames wait for the monitor
    int frameLimit = 0;           // most frames a second, [0, 1000]; 0: no limit
    bool resume = true;           // a start without a file goes on with the last session
    bool glide = true;            // the camera glides to places instead of jumping
    double steering = 1;          // how fast gamepads and 3-D mice move and turn the camera, [0.1, 5]
    bool invertSteering = false;  // a stick pushed forward looks down

    bool operator==(const WindowPreferences&) const = default;
};

// The content of the second window on the screen, in screen coordinates. A place that no monitor shows is replaced.
struct SecondWindowPlace {
    int x = nowhere;
    int y = nowhere;
    int width = 900;
    int height = 900;

    static constexpr int nowhere = -32768;
    bool operator==(const SecondWindowPlace&) const = default;
};

// The layout of the window, kept between sessions. Sizes are in units of a 13 px font, so that they fit any
// monitor.
struct Workspace {
    double leftWidth = 300;
    double rightWidth = 310;
    double bottomHeight = 210;
    std::array<PanelPlace, panelCount> panels = firstPlaces();
    PanelOrder order = firstOrder();  // of the tabs, in every dock; each panel once
    // The panel that each dock shows; ignored if that panel is not docked there.
    std::array<PanelId, dockCount> inFront{PanelId::Quadtree, PanelId::Lod, PanelId::Paging, PanelId::Log};
    // The dock, or the viewport, that fills the area between the menu bar and the status bar. A dock without a panel is
    // ignored.
    MaximisedDock maximised = MaximisedDock::None;
    WindowPreferences preferences;  // not a part of a layout

    bool operator==(const Workspace&) const = default;
};

inline bool isShown(const Workspace& workspace, PanelId panel) {
    return workspace.panels[static_cast<std::size_t>(panel)].shown;
}

}  // namespace worldy
