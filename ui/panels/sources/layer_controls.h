// The controls of one edited layer of the source.
#pragma once

#include <optional>

#include "app/data/world_edit.h"

namespace worldy::ui {

// Draws the controls of a layer. Returns true if the layer has changed. planetDatum: none if the world file gives none.
bool sourceLayerControls(planet::WorldLayer& layer, const std::optional<planet::VerticalDatum>& planetDatum);

}  // namespace worldy::ui
