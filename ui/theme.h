// Fonts, colours and spacing. Sizes follow the font, the font follows the monitor.
#pragma once

#include <imgui.h>

#include <filesystem>

namespace ui {

// Colours with a meaning, for text and plots.
struct Palette {
    ImVec4 text{0.88f, 0.90f, 0.92f, 1};
    ImVec4 dim{0.56f, 0.60f, 0.65f, 1};
    ImVec4 accent{0.32f, 0.66f, 0.95f, 1};
    ImVec4 good{0.45f, 0.80f, 0.48f, 1};
    ImVec4 warning{0.96f, 0.75f, 0.30f, 1};
    ImVec4 bad{0.96f, 0.42f, 0.38f, 1};
};
inline constexpr float baseFontPx = 15;  // on a monitor of scale 1

const Palette& palette();

// Call once, with a current ImGui context, before the first frame. Loads DejaVu Sans with Greek, or the
// built-in font where there is none.
void applyTheme(float contentScale);

// "τ" and "ε", or "tau" and "eps" where the font has no Greek. Valid after applyTheme.
const char* tauSymbol();
const char* epsSymbol();

// Pixels of one unit of ui::PanelSizes.
float unitPx();

}  // namespace ui
