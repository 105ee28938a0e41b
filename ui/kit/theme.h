// Fonts, colours and spacing. Sizes follow the font, the font follows the monitor.
#pragma once

#include <imgui.h>

#include <glm/vec3.hpp>

#include "ui/model/layout.h"

namespace worldy::ui {

// Colours with a meaning, for text and plots.
struct Palette {
    ImVec4 text{0.88f, 0.90f, 0.92f, 1};
    ImVec4 dim{0.56f, 0.60f, 0.65f, 1};
    ImVec4 accent{0.32f, 0.66f, 0.95f, 1};
    ImVec4 good{0.45f, 0.80f, 0.48f, 1};
    ImVec4 warning{0.96f, 0.75f, 0.30f, 1};
    ImVec4 bad{0.96f, 0.42f, 0.38f, 1};
    ImVec4 box{0.07f, 0.08f, 0.10f, 0.78f};  // behind what is written over a picture
};
inline constexpr float baseFontPx = 15;  // on a monitor of scale 1

// Of the theme applied last.
const Palette& palette();

// As draw lists take it, the style's own opacity counted in.
ImU32 packed(const ImVec4& colour, float alpha);
ImU32 packed(const ImVec4& colour);
ImU32 packed(const glm::vec3& colour);

// Applies the theme between two frames, with a current ImGui context. Loads DejaVu Sans with Greek, or the
// built-in font if DejaVu Sans is missing, and tells ui/model/font_symbols.h which. Recreate the font's
// texture afterwards.
void applyTheme(Theme theme, float contentScale);

// Pixels of one unit of ui::PanelSizes.
float unitPx();

}  // namespace worldy::ui
