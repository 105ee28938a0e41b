// The palette (Ctrl+K): finds commands, panels, settings, bookmarks, flights, presets, files, chunks and
// places by a few typed letters.
#pragma once

#include "ui/shell/actions.h"

namespace worldy::ui {

// Draws the palette if it is open, over everything else. Choosing a setting opens its control there. Call
// every frame.
void palette(const ActionContext& context);

}  // namespace worldy::ui
