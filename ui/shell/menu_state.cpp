#include "ui/shell/menu_state.h"

#include <utility>

namespace worldy::ui {

void togglePalette(PaletteState& palette) {
    const bool opens = !palette.isOpen;
    palette = {.isOpen = opens, .takesFocus = opens, .recent = std::move(palette.recent)};
}

void leavePalette(PaletteState& palette) {
    palette.takesFocus = !palette.edited.empty();
    palette.isOpen = palette.takesFocus;
    palette.edited.clear();
}

}  // namespace worldy::ui
