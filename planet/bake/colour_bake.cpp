#include "planet/bake/colour_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <vector>

#include "planet/bake/colour_tile_sampling.h"
#include "planet/base/little_endian.h"
#include "planet/base/parallel.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"
#include "planet/format/colour_tile.h"
#include "planet/sphere/chunk_id.h"

namespace planet {

namespace {

struct PackedTile {
    ColourEntry entry;  // without the location of its children
    std::vector<std::byte> bytes;
};

Result<PackedTile> packedTile(const ColourSource& source, ColourFormat format, const ChunkId& id) {
    std::vector<std::uint8_t> rgb(colourTileBytes(ColourFormat::Lossless));
    TRY(sampleColourTile(source, id, rgb));
    PackedTile tile;
    tile.bytes = packColourTexels(format, colourTexels(format, rgb));
    tile.entry.packedBytes = static_cast<std::uint32_t>(tile.bytes.size());
    return tile;
}

// Makes the tiles of a level in quadtree order, some at a time, and writes their blocks.
class LevelWriter {
public:
    LevelWriter(const ColourSource& source, ColourFormat format, int threads, AtomicFile& file,
                const ColourProgress& progress)
        : source_(source), format_(format), threads_(threads), file_(file), progress_(progress) {}

    // Writes a level. below: the locations of each tile's children, empty at the finest level. Returns the
    // location of each block.
    Result<std::vector<BlockLocation>> write(int level, const std::vector<BlockLocation>& below) {
        const std::size_t perBlock = level == 0 ? 1 : quadrantCount;
        const std::uint64_t count = std::uint64_t{faceCount} << (2 * level);
        const std::size_t batch = std::max<std::size_t>(4, static_cast<std::size_t>(threads_) * 2) / 4 * 4;
        std::vector<BlockLocation> locations;
        locations.reserve(count / perBlock);
        for (std::uint64_t first = 0; first < count; first += batch) {
            const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(batch, count - first));
            TRY_ASSIGN(auto tiles, make(level, first, now));
            for (std::size_t i = 0; i < now; ++i) {
                if (!below.empty()) tiles[i].entry.children = below[first + i];
            }
            for (std::size_t i = 0; i < now; i += perBlock) {
                const ChunkId id = chunkInQuadtreeOrder(first + i, level);
                TRY_ASSIGN(const auto location, append(id, std::span(tiles).subspan(i, perBlock)));
                locations.push_back(location);
            }
            if (progress_ && !progress_(now)) return cancelled();
        }
        return locations;
    }

private:
    Result<std::vector<PackedTile>> make(int level, std::uint64_t first, std::size_t count) const {
        std::vector<Result<PackedTile>> made(count, PackedTile{});
        parallelFor(threads_, count, [&](std::size_t i) {
            made[i] = packedTile(source_, format_, chunkInQuadtreeOrder(first + i, level));
        });
        std::vector<PackedTile> tiles;
        for (Result<PackedTile>& result : made) {
            TRY_ASSIGN(auto tile, std::move(result));
            tiles.push_back(std::move(tile));
        }
        return tiles;
    }

    Result<BlockLocation> append(const ChunkId& firstTile, std::span<const PackedTile> tiles) {
        const std::uint64_t offset = file_.size();
        std::vector<std::byte> block;
        for (const PackedTile& tile : tiles) putColourEntry(block, tile.entry, offset);
        for (const PackedTile& tile : tiles) block.insert(block.end(), tile.bytes.begin(), tile.bytes.end());
        const std::uint64_t sum = firstTile.level == 0 ? colourRootChecksum(block, firstTile.face)
                                                       : colourSiblingChecksum(block, parentOf(firstTile));
        ByteWriter(block).put(sum);
        TRY(file_.append(block));
        return BlockLocation{offset, static_cast<std::uint32_t>(block.size())};
    }

    const ColourSource& source_;
    ColourFormat format_;
    int threads_;
    AtomicFile& file_;
    const ColourProgress& progress_;
};

}  // namespace

Result<int> colourLeafLevel(const ColourSource& source, const ColourBakeSettings& settings) {
    constexpr int most = (colourTileCells << maxColourLevel) + 1;
    const int natural = std::clamp(source.naturalFaceSize, colourTileCells + 1, most);
    const int size = settings.faceSize.value_or(natural);
    if (size <= colourTileCells || size > most || !std::has_single_bit(static_cast<unsigned>(size - 1))) {
        return badInput(fmt::format(
            "colour face size: {} is invalid; expected 2^n + 1 in [{}, {}], for example 1025, 2049 "
            "or 4097",
            size, colourTileCells + 1, most));
    }
    return std::countr_zero(static_cast<unsigned>((size - 1) / colourTileCells));
}

Result<ColourPyramid> bakeColour(const ColourSource& source, const ColourBakeSettings& settings, int threads,
                                 AtomicFile& file, const ColourProgress& progress) {
    TRY_ASSIGN(const auto leaf, colourLeafLevel(source, settings));
    LevelWriter writer(source, settings.format, threads, file, progress);
    std::vector<BlockLocation> below;
    for (int level = leaf; level >= 0; --level) {
        TRY_ASSIGN(below, writer.write(level, below));
    }
    ColourPyramid pyramid;
    pyramid.format = settings.format;
    pyramid.leafLevel = leaf;
    pyramid.source = source.description;
    std::copy(below.begin(), below.end(), pyramid.roots.begin());
    return pyramid;
}

}  // namespace planet
