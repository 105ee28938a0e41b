// The legend of a picture whose colours have a meaning.
#pragma once

#include "ui/model/overlay_legend.h"

namespace worldy::ui {

// Draws swatches with labels, as many per row as fit.
void legendRows(const Legend& legend);

}  // namespace worldy::ui
