// Describes what the keyboard asks of a plot, and moves a cursor over its samples. Pure functions, no ImGui.
#pragma once

#include <cstddef>

namespace worldy::ui {

// The keys that were pressed in a frame, counted with their repetitions.
struct PlotKeys {
    int right = 0;         // arrows to the right, less those to the left
    int up = 0;            // arrows up, less those down
    int pagesDown = 0;     // Page Down, less Page Up
    int zoomIn = 0;        // + or =, less -
    bool toFirst = false;  // Home
    bool toLast = false;   // End
    bool acts = false;     // Enter or Space
    bool withShift = false;

    bool operator==(const PlotKeys&) const = default;
};

// Returns where the keys move a cursor over samples: an arrow by one sample, a page by a tenth of all of them, Home and End to
// the ends. count > 0; at and the result are in [0, count - 1].
std::size_t movedCursor(std::size_t at, std::size_t count, const PlotKeys& keys);

}  // namespace worldy::ui
