// Where the window's parts lie. Pure functions.
#pragma once

#include <array>

#include "ui/model/panel_list.h"

namespace ui {

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

// How the user has arranged the window. Kept between runs; sizes in units of a font of 13 pixels, so that
// they fit any monitor.
struct Workspace {
    double leftWidth = 300;     // [160, 1000]
    double rightWidth = 310;    // [160, 1000]
    double bottomHeight = 210;  // [60, 1000]
    std::array<PanelPlace, panelCount> panels = firstPlaces();
    // The panel that each dock shows, as long as it is among those that stand there.
    std::array<PanelId, dockCount> inFront{PanelId::Quadtree, PanelId::Lod, PanelId::Paging};
    Theme theme = Theme::Dark;
    double scale = 1;  // of the monitor's own, [0.5, 3]; Ctrl + and Ctrl -

    bool operator==(const Workspace&) const = default;
};

struct Rect {
    float x = 0;  // pixels from the window's top left
    float y = 0;
    float width = 0;
    float height = 0;
};

struct Layout {
    Rect viewport;
    std::array<Rect, dockCount> docks;      // empty where no panel is shown
    std::array<Rect, dockCount> splitters;  // towards the viewport
    Rect menuBar;
    Rect statusBar;
};

// The viewport keeps at least a third of the window each way, however large the docks are asked to be.
Layout layoutOf(float windowWidth, float windowHeight, const Workspace& workspace, float menuHeight,
                float statusHeight, float unitPx);

}  // namespace ui
