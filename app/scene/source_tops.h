// Which layer of a source made the heights of a chunk.
#pragma once

#include <optional>
#include <span>
#include <unordered_map>

#include "planet/base/result.h"
#include "planet/select/lod_select.h"
#include "planet/source/source_layers.h"
#include "planet/sphere/chunk_id.h"

namespace worldy {

// The topmost layer with a height in the middle of chunks; nothing where no layer has one.
using SourceTops = std::unordered_map<planet::ChunkId, std::optional<std::size_t>>;

planet::Geographic placeInMiddleOf(const planet::ChunkId& chunk);

// Adds the chunks that are not known yet. Reads samples of the source, so it may take long. The Error is that of the first
// place that cannot be read.
planet::Result<void> addTops(const planet::SourceLayers& source, std::span<const planet::DrawItem> drawn,
                             SourceTops& tops);

}  // namespace worldy
