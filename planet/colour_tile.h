// A tile of the colour quadtree: what it covers, how it is filled, and how it is packed.
//
// tile_layout.h says what it covers. Of two tiles beside each other the shared texels are the same.
//
// The quadtree is the mip chain too: a level's texels are the source filtered to that level's spacing.
//
// BC1: 4 x 4 texels in 8 bytes (S3TC, Iourcha et al. 1999). The border is such that the blocks of two tiles
// of a face cover the same texels, so that these too are the same after packing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/chunk_id.h"
#include "planet/colour_source.h"
#include "planet/result.h"
#include "planet/tile_layout.h"

namespace planet {

inline constexpr int colourTileCells = tileCells;
inline constexpr int colourBorderBefore = tileBorderBefore;
inline constexpr int colourBorderAfter = tileBorderAfter;
inline constexpr int colourTileTexels = tileTexels;
static_assert(colourTileTexels % 4 == 0 && colourTileCells % 4 == 0);
inline constexpr int maxColourLevel = maxTileLevel;

enum class ColourFormat : std::uint8_t { Bc1, Lossless };

// Of a tile as the GPU takes it, row 0 at the south: BC1 blocks, or 3 bytes a texel, sRGB.
std::size_t colourTileBytes(ColourFormat format);

// Fills a tile with 8-bit sRGB, 3 bytes a texel. The Error names the source's file.
Result<void> sampleColourTile(const ColourSource& source, const ChunkId& tile, std::span<std::uint8_t> rgb);

// What the GPU takes, of a sampled tile.
std::vector<std::byte> colourTexels(ColourFormat format, std::span<const std::uint8_t> rgb);
// Its colours again, as the GPU has them.
std::vector<std::uint8_t> rgbOfColourTexels(ColourFormat format, std::span<const std::byte> texels);

// A loud checker pattern, for what cannot be read.
std::vector<std::byte> checkerTexels(ColourFormat format);

// What the file holds of them: without loss, smaller. Any bytes are either unpacked or refused.
std::vector<std::byte> packColourTexels(ColourFormat format, std::span<const std::byte> texels);
Result<std::vector<std::byte>> unpackColourTexels(ColourFormat format, std::span<const std::byte> packed);
// No honest tile is packed larger.
std::size_t largestPackedColourTile(ColourFormat format);

}  // namespace planet
