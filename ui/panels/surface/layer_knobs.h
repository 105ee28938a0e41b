// The knobs of one texture layer.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// problem: what is wrong with it; empty: nothing.
void layerKnobs(planet::TextureLayer& layer, const std::string& problem, Commands& commands);

}  // namespace worldy::ui
