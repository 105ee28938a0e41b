// Fonts, colours and spacing. Sizes scale with the font, and the font scales with the monitor.
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
    ImVec4 box{0.07f, 0.08f, 0.10f, 0.78f};  // background of text over a picture
};
inline constexpr float baseFontPx = 15;  // for a monitor scale of 1

// Returns the palette of the current theme.
const Palette& palette();

// Returns a colour for draw lists, multiplied by the style's opacity.
ImU32 packed(const ImVec4& colour, float alpha);
ImU32 packed(const ImVec4& colour);
ImU32 packed(const glm::vec3& colour);

// Applies the theme between two frames, with a current ImGui context. Loads DejaVu Sans with Greek, or the
// built-in font if DejaVu Sans is missing, and tells ui/model/font_symbols.h which. Recreate the font's
// texture afterwards.
void applyTheme(Theme theme, float contentScale);

// Returns the size of one unit of ui::PanelSizes, pixels.
float unitPx();

}  // namespace worldy::ui
