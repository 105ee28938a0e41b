// Baked subtrees and chunks as bytes, for messages between ranks and for finished units. Pure functions, any thread.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "planet/bake/subtree_merging.h"
#include "planet/base/result.h"
#include "planet/sphere/planet_shape.h"

namespace planet {

void putSubtree(std::vector<std::byte>& out, const Subtree& subtree);
void putDeferredChunk(std::vector<std::byte>& out, const DeferredChunk& chunk);

// Take one from the beginning of the bytes. The Errors do not say where the bytes are from.
Result<Subtree> takeSubtree(std::span<const std::byte>& bytes, const PlanetShape& shape);
Result<DeferredChunk> takeDeferredChunk(std::span<const std::byte>& bytes, const PlanetShape& shape);

}  // namespace planet
