// Bakes a colour source into the colour quadtree of a chunk file: level by level from the finest, so that
// children's blocks come before their parents'. In memory at a time: a few tiles a thread, and 12 bytes for
// each block of one level.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "planet/atomic_file.h"
#include "planet/chunk_file.h"
#include "planet/colour_source.h"
#include "planet/colour_tile.h"
#include "planet/result.h"

namespace planet {

struct ColourBakeSettings {
    std::optional<int> faceSize{};  // texels a side, 256 * 2^n + 1; the source's natural size where not given
    ColourFormat format = ColourFormat::Bc1;
    bool operator==(const ColourBakeSettings&) const = default;
};

// The finest level of a source's tiles. The Error names the setting and its range.
Result<int> colourLeafLevel(const ColourSource& source, const ColourBakeSettings& settings);

// Tiles of all levels down to a finest one.
std::uint64_t colourTileCount(int leafLevel);

// Called after every few tiles, by the calling thread, with how many more are done; false cancels.
using ColourProgress = std::function<bool(std::uint64_t moreTiles)>;

// Appends the blocks. The same source and settings give the same bytes whatever the number of threads.
Result<ColourPyramid> bakeColour(const ColourSource& source, const ColourBakeSettings& settings, int threads,
                                 AtomicFile& file, const ColourProgress& progress);

}  // namespace planet
