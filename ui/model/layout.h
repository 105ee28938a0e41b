// The layout of the window. Pure functions.
#pragma once

#include <array>
#include <optional>

#include "app/settings/workspace.h"

namespace worldy::ui {

struct Rect {
    float x = 0;  // pixels from the window's top left
    float y = 0;
    float width = 0;
    float height = 0;
};

// The second window is drawn to the right of all that the main window can show.
inline constexpr float secondWindowX = 16384;

struct Layout {
    Rect viewport;
    std::array<Rect, dockCount> docks;      // empty if no panel is shown
    std::array<Rect, dockCount> splitters;  // on the side of the viewport
    Rect menuBar;
    Rect statusBar;
    Rect area;  // between the menu bar and the status bar
    // A maximised dock fills the area. The viewport keeps its rectangle, so that the size of the picture, and
    // with it every reading in pixels, stays the same.
    bool viewportCovered = false;
    // The top left of the second window on the screen, relative to the main window's, pixels.
    float secondLeft = 0;
    float secondTop = 0;
};

// Returns the dock that fills the area; none if no dock is maximised, or that dock has no panel.
std::optional<Dock> maximisedDock(const Workspace& workspace);
// Returns true while all panels are away, so that only the viewport is seen.
bool isViewportMaximised(const Workspace& workspace);

// Returns the layout of the main window. Floating panels take no room in it, and the dock of the second window is empty.
// The viewport keeps at least a third of the window in each direction, whatever the sizes of the docks.
Layout layoutOf(float windowWidth, float windowHeight, const Workspace& workspace, float menuHeight,
                float statusHeight, float unitPx);

// Returns the scale of text that a window can show: the user's, but at most one at which the window is 45 heights of
// the font wide and 28 high, so that every panel keeps its shape. Never less than 1, the monitor's own scale, on
// account of the window. fontPx: height of the font at scale 1, > 0.
double fittingScale(double scale, float windowWidth, float windowHeight, float fontPx);

}  // namespace worldy::ui
