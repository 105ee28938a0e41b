// The controls of one texture layer.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the inside of a section. problem: what is wrong with the layer; empty if nothing is.
void layerControls(planet::TextureLayer& layer, const std::string& problem, Commands& commands);

}  // namespace worldy::ui
