// Edits the list of texture layers, which is ordered lowest first. Pure functions.
#pragma once

#include <cstddef>
#include <vector>

#include "planet/surface/layer_set.h"

namespace worldy::ui {

using LayerList = std::vector<planet::TextureLayer>;

// Moves a layer to another's index; the layers between shift by one.
void moveLayer(LayerList& layers, std::size_t from, std::size_t to);

// Inserts a copy of a layer above it, under a unique name, and returns its index. The list must have room.
std::size_t duplicateLayer(LayerList& layers, std::size_t index);

// Adds a layer above all others that covers everything and has no textures yet. Returns its index.
std::size_t addLayer(LayerList& layers);

// Removes a layer. Returns the index to select next: the same one, or the last layer; 0 if none is left.
std::size_t removeLayer(LayerList& layers, std::size_t index);

}  // namespace worldy::ui
