// Changing the order and number of texture layers, which are kept lowest first. Pure functions.
#pragma once

#include <cstddef>
#include <vector>

#include "planet/surface/layer_set.h"

namespace worldy::ui {

using LayerList = std::vector<planet::TextureLayer>;

// Moves a layer to another's place; those between make room.
void moveLayer(LayerList& layers, std::size_t from, std::size_t to);

// A copy of a layer above it, with a name of its own. There must be room. Returns where it is.
std::size_t duplicateLayer(LayerList& layers, std::size_t index);

// A new layer above all others, which covers everything and has no textures yet. Returns where it is.
std::size_t addLayer(LayerList& layers);

// Removes a layer. Returns which is chosen then, where that one was; 0 where none is left.
std::size_t removeLayer(LayerList& layers, std::size_t index);

}  // namespace worldy::ui
