// Fills a tile of the colour quadtree from a colour source.
#pragma once

#include <cstdint>
#include <span>

#include "planet/base/result.h"
#include "planet/source/colour_source.h"
#include "planet/sphere/chunk_id.h"

namespace planet {

// Fills colourTileTexels x colourTileTexels texels (format/colour_tile.h), including the border, with 8-bit
// sRGB, 3 bytes per texel, row 0 at the south, filtered to the tile's spacing. Any thread. The Error names
// the source's file.
Result<void> sampleColourTile(const ColourSource& source, const ChunkId& tile, std::span<std::uint8_t> rgb);

}  // namespace planet
