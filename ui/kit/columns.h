// Arranges the parts of a panel side by side in a wide dock and stacked in a narrow one.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace worldy::ui {

struct Column {
    const char* title = "";  // the heading if stacked
    float share = 1;         // of the width, if side by side
    // The height if stacked, in lines of text; 0: the height of the content.
    float stackedLines = 0;
    std::function<void()> draw;
    // The width that the content needs side by side, pixels, without a scrollbar; 0: any width is enough.
    float needed = 0;
    // The width that the content would like side by side, pixels, for example that of a table that need not scroll.
    // The columns get it if all of them do.
    float wanted = 0;
};

// Returns true if the current window is wide enough for columns side by side, each as wide as it needs.
bool hasWideRoom(std::span<const Column> columns = {});
// Divides a width among columns by their shares, pixels. Each gets at least the width it wants if they all fit, otherwise
// the width it needs if they all fit.
std::vector<float> sideBySideWidths(std::span<const Column> columns, float width);
// Draws the columns. Side by side, each scrolls by itself and fills the remaining height.
void drawColumns(const char* id, std::span<const Column> columns);

}  // namespace worldy::ui
