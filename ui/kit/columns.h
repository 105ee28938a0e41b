// Parts of a panel, side by side in a wide dock and one below the other in a narrow one.
#pragma once

#include <functional>
#include <span>

namespace ui {

struct Column {
    const char* title = "";  // a heading where they are stacked
    float share = 1;         // of the width where they are side by side
    // Rows of text that it is high where they are stacked; 0: as high as what it holds.
    float stackedLines = 0;
    std::function<void()> draw;
};

// Whether the current window is wide enough for columns side by side.
bool hasWideRoom();
// Side by side each column scrolls by itself and fills the height that is left.
void drawColumns(const char* id, std::span<const Column> columns);

}  // namespace ui
