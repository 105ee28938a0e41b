// The controls of one texture layer.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the inside of a section. problem: the fault of the layer; empty if it has none.
void layerControls(planet::TextureLayer& layer, const std::string& problem, Commands& commands);

}  // namespace worldy::ui
