// The layout of the window. Pure functions.
#pragma once

#include <array>

#include "app/settings/workspace.h"

namespace worldy::ui {

struct Rect {
    float x = 0;  // pixels from the window's top left
    float y = 0;
    float width = 0;
    float height = 0;
};

struct Layout {
    Rect viewport;
    std::array<Rect, dockCount> docks;      // empty if no panel is shown
    std::array<Rect, dockCount> splitters;  // on the side of the viewport
    Rect menuBar;
    Rect statusBar;
};

// Returns the layout. The viewport keeps at least a third of the window in each direction, whatever the sizes
// of the docks.
Layout layoutOf(float windowWidth, float windowHeight, const Workspace& workspace, float menuHeight,
                float statusHeight, float unitPx);

}  // namespace worldy::ui
