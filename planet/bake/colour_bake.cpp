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

// Makes the tiles of a level in quadtree order, some at a time, and writes their blocks.
class LevelWriter {
public:
    LevelWriter(const ColourSource& source, ColourFormat format, int threads, AtomicFile& file,
                const ColourProgress& progress)
        : source_(source), format_(format), threads_(threads), file_(file), progress_(progress) {}

    // Writes a level. below: the locations of the blocks of the next finer level, in order. Returns the location of
    // each block.
    Result<std::vector<BlockLocation>> write(const ColourTree::Level& level,
                                             const std::vector<BlockLocation>& below) {
        const std::size_t count = level.ids.size();
        const std::size_t perBlock = level.ids[0].level == 0 ? 1 : quadrantCount;
        const std::size_t batch = std::max<std::size_t>(4, static_cast<std::size_t>(threads_) * 2) / 4 * 4;
        std::vector<BlockLocation> locations;
        locations.reserve(count / perBlock);
        std::size_t nextBelow = 0;
        for (std::size_t first = 0; first < count; first += batch) {
            const std::size_t now = std::min(batch, count - first);
            TRY_ASSIGN(auto tiles, make(std::span(level.ids).subspan(first, now)));
            for (std::size_t i = 0; i < now; ++i) {
                if (level.hasChildren[first + i]) tiles[i].entry.children = below[nextBelow++];
            }
            for (std::size_t i = 0; i < now; i += perBlock) {
                TRY_ASSIGN(const auto location,
                           append(level.ids[first + i], std::span(tiles).subspan(i, perBlock)));
                locations.push_back(location);
            }
            if (progress_ && !progress_(now)) return cancelled();
        }
        return locations;
    }

private:
    Result<std::vector<PackedColourTile>> make(std::span<const ChunkId> ids) const {
        std::vector<Result<PackedColourTile>> made(ids.size(), PackedColourTile{});
        parallelFor(threads_, ids.size(),
                    [&](std::size_t i) { made[i] = packColourTile(source_, format_, ids[i]); });
        std::vector<PackedColourTile> tiles;
        for (Result<PackedColourTile>& result : made) {
            TRY_ASSIGN(auto tile, std::move(result));
            tiles.push_back(std::move(tile));
        }
        return tiles;
    }

    Result<BlockLocation> append(const ChunkId& firstTile, std::span<const PackedColourTile> tiles) {
        const std::uint64_t offset = file_.size();
        const std::vector<std::byte> block = colourBlock(firstTile, tiles, offset);
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

Result<PackedColourTile> packColourTile(const ColourSource& source, ColourFormat format, const ChunkId& id) {
    std::vector<std::uint8_t> rgb(colourTileBytes(ColourFormat::Lossless));
    TRY(sampleColourTile(source, id, rgb));
    PackedColourTile tile;
    tile.bytes = packColourTexels(format, colourTexels(format, rgb));
    tile.entry.packedBytes = static_cast<std::uint32_t>(tile.bytes.size());
    return tile;
}

std::vector<std::byte> colourBlock(const ChunkId& firstTile, std::span<const PackedColourTile> tiles,
                                   std::uint64_t offset) {
    std::vector<std::byte> block;
    for (const PackedColourTile& tile : tiles) putColourEntry(block, tile.entry, offset);
    for (const PackedColourTile& tile : tiles)
        block.insert(block.end(), tile.bytes.begin(), tile.bytes.end());
    const std::uint64_t sum = firstTile.level == 0 ? colourRootChecksum(block, firstTile.face)
                                                   : colourSiblingChecksum(block, parentOf(firstTile));
    ByteWriter(block).put(sum);
    return block;
}

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

std::uint64_t ColourTree::tileCount() const {
    std::uint64_t count = 0;
    for (const Level& level : levels) count += level.ids.size();
    return count;
}

Result<ColourTree> colourTreeOf(const ColourSource& source, const ColourBakeSettings& settings) {
    TRY_ASSIGN(const auto leaf, colourLeafLevel(source, settings));
    const auto isFiner = [&](const ChunkId& tile) {
        return !source.finestCells || source.finestCells(tile) > colourTileCells << tile.level;
    };
    ColourTree tree;
    tree.levels.emplace_back();
    for (const Face face : allFaces) tree.levels[0].ids.push_back({face, 0, 0, 0});
    for (int level = 0;; ++level) {
        ColourTree::Level& here = tree.levels.back();
        std::vector<ChunkId> children;
        for (const ChunkId& tile : here.ids) {
            here.hasChildren.push_back(level < leaf && isFiner(tile));
            for (int q = 0; q < quadrantCount && here.hasChildren.back(); ++q)
                children.push_back(childOf(tile, q));
        }
        if (children.empty()) return tree;
        tree.levels.push_back({std::move(children), {}});
    }
}

Result<ColourPyramid> bakeColour(const ColourSource& source, const ColourTree& tree, ColourFormat format,
                                 int threads, AtomicFile& file, const ColourProgress& progress) {
    LevelWriter writer(source, format, threads, file, progress);
    std::vector<BlockLocation> below;
    for (auto level = tree.levels.rbegin(); level != tree.levels.rend(); ++level) {
        TRY_ASSIGN(below, writer.write(*level, below));
    }
    ColourPyramid pyramid;
    pyramid.format = format;
    pyramid.leafLevel = static_cast<int>(tree.levels.size()) - 1;
    pyramid.source = source.description;
    std::copy(below.begin(), below.end(), pyramid.roots.begin());
    return pyramid;
}

}  // namespace planet
