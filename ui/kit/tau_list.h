// A field for several tolerances.
#pragma once

#include <span>

#include "app/measure/sweep_points.h"

namespace worldy::ui {

// Draws the field, named "Tolerances", and what is wrong with its text. use: what they are for, sentences that follow the
// range in the tooltip.
TauList tauListControl(std::span<char> text, const char* use);

}  // namespace worldy::ui
