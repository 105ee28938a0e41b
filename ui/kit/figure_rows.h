// Figures of measurements as rows of a list of values.
#pragma once

#include <span>

#include "ui/model/figures.h"

namespace worldy::ui {

// Draws one row for each figure. Call between beginValues() and endValues().
void figureRows(std::span<const Figure> figures);

}  // namespace worldy::ui
