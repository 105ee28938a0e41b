// Parts of a panel, side by side in a wide dock and one below the other in a narrow one.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace worldy::ui {

struct Column {
    const char* title = "";  // a heading where they are stacked
    float share = 1;         // of the width where they are side by side
    // Rows of text that it is high where they are stacked; 0: as high as what it holds.
    float stackedLines = 0;
    std::function<void()> draw;
    // Pixels that its content needs where they are side by side, without a scrollbar; 0: any width is enough.
    float needed = 0;
};

// Returns whether the current window is wide enough for columns side by side, each as wide as it needs.
bool hasWideRoom(std::span<const Column> columns = {});
// Divides a width among columns by their shares, pixels; each gets at least what it needs if all of that
// fits.
std::vector<float> sideBySideWidths(std::span<const Column> columns, float width);
// Side by side each column scrolls by itself and fills the height that is left.
void drawColumns(const char* id, std::span<const Column> columns);

}  // namespace worldy::ui
