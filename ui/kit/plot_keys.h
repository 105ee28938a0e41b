// The keyboard in plots: Tab gives a plot the focus, which a frame shows, and its keys move a cursor over its samples or change
// its view. Esc leaves it, as ImGui does. The state is global, like Dear ImGui's own. One thread.
#pragma once

#include <imgui.h>

#include <cstddef>
#include <cstdint>
#include <optional>

#include "ui/model/plot_cursor.h"

namespace worldy::ui {

// Begins a plot: an invisible button that Tab reaches too. A frame shows its focus.
void plotItem(const char* id, ImVec2 size, ImGuiButtonFlags flags = 0);

// Returns true while the pointer is over the last item and was used after the keyboard. ImGui::IsItemHovered() is true for the
// item with the focus while the keyboard is used, wherever the pointer is.
bool plotIsHovered();

// The keys that a plot reads. The others keep their meaning: Up and Down leave a plot that reads Samples.
enum class PlotReads : std::uint8_t {
    Samples,  // Left, Right, Home, End, Page Up, Page Down
    View      // also Up, Down, + and -
};
// Returns the keys for the last item, a plot; no key while it has not the focus.
PlotKeys takePlotKeys(PlotReads reads);

// Returns true if a plot has read + and - in this frame or in the last one; they do not change the camera's speed then.
bool plotTakesKeys();
// Returns how often + was typed, less how often - was, since the frame before.
int typedSteps();
// Returns true if a plot had the focus of the keyboard in this frame or in the last one, and showed it.
bool plotShowsFocus();

// The sample under the keyboard's cursor; none while the last item has not the focus or the pointer is used over it.
struct PlotCursor {
    std::optional<std::size_t> at{};
    bool acts = false;  // Enter or Space was pressed
};
// Reads the keys of the last item, a plot of so many samples. The cursor begins at the newest sample, the last one, and keeps
// its distance from it while samples are added.
PlotCursor plotCursor(std::size_t count);

// Begins the tooltip of a sample: at the pointer, or beside a cursor at this x in the last item, where it begins with the keys.
// End it with ImGui::EndTooltip().
void beginSampleTooltip(const PlotCursor& cursor, float x,
                        const char* keys = "Left, Right, PageUp, PageDown, Home, End: move");
// Returns true if the keyboard is used in the last item, a plot, rather than the pointer.
bool plotHasKeyboard();

}  // namespace worldy::ui
