#include "planet/bake/colour_estimate.h"

#include <algorithm>
#include <vector>

#include "planet/bake/colour_bake.h"
#include "planet/bake/colour_tile_sampling.h"
#include "planet/bake/spread_places.h"
#include "planet/base/stopwatch.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"
#include "planet/format/colour_tile.h"

namespace planet {

namespace {

constexpr std::uint64_t leafTilesPacked = 12;
constexpr std::uint64_t upperTilesPacked = 6;
// The memory of a thread: linear colours, one channel of them, and the tile as sRGB, as texels and packed.
constexpr std::uint64_t bytesPerTexelAtWork = sizeof(glm::vec3) + sizeof(float) + 3 * 3;

struct PackedTiles {
    double readS = 0;        // loading the source's blocks
    double tileS = 0;        // of one tile, with these blocks loaded
    double packedBytes = 0;  // of one tile
};

// Reads the texel in the middle of a tile, so that the source loads its blocks there.
Result<void> readMiddle(const ColourSource& source, const ChunkId& id) {
    const int middle = colourTileCells / 2;
    glm::vec3 colour;
    return source.sample(
        {id.face, colourTileCells << id.level, static_cast<int>(id.x) * colourTileCells + middle,
         static_cast<int>(id.y) * colourTileCells + middle, 1, 1},
        {&colour, 1});
}

// Packs some tiles of a level, spread over it.
Result<PackedTiles> packTiles(const ColourSource& source, ColourFormat format, const ColourTree::Level& level,
                              std::uint64_t wanted, const std::function<bool()>& goOn) {
    PackedTiles sum;
    std::vector<std::uint8_t> rgb(colourTileBytes(ColourFormat::Lossless));
    const std::vector<std::uint64_t> places = spreadIndices(level.ids.size(), wanted);
    for (const std::uint64_t place : places) {
        const ChunkId& id = level.ids[place];
        if (goOn && !goOn()) return cancelled();
        const Stopwatch reading;
        TRY(readMiddle(source, id));
        sum.readS += reading.elapsedS();
        const Stopwatch packing;
        TRY(sampleColourTile(source, id, rgb));
        sum.packedBytes += static_cast<double>(packColourTexels(format, colourTexels(format, rgb)).size());
        sum.tileS += packing.elapsedS();
    }
    const auto count = static_cast<double>(places.size());
    return PackedTiles{sum.readS, sum.tileS / count, sum.packedBytes / count};
}

// The cost of all levels on one thread. A tile costs its packing and its share of reading the source. Each
// level reads the whole source, so that share is four times larger per coarser level. The bytes of a tile
// grow from level to level by the measured growth, up to the largest size of a tile.
struct AllTiles {
    double seconds = 0;
    double bytes = 0;
};
AllTiles allTiles(const PackedTiles& leaf, const PackedTiles& upper, const ColourTree& tree,
                  ColourFormat format) {
    AllTiles all;
    const double sourceS = std::clamp((upper.tileS - leaf.tileS) / 3, 0.0, leaf.tileS);
    const double packingS = leaf.tileS - sourceS;
    const double growth = upper.packedBytes - leaf.packedBytes;
    const auto most = static_cast<double>(largestPackedColourTile(format));
    double bytes = leaf.packedBytes;
    double sourceShare = 1;
    for (auto level = tree.levels.rbegin(); level != tree.levels.rend(); ++level) {
        const auto tiles = static_cast<double>(level->ids.size());
        all.seconds += tiles * (packingS + sourceShare * sourceS);
        const double blocks = level->ids[0].level == 0 ? tiles : tiles / quadrantCount;
        all.bytes += tiles * (bytes + static_cast<double>(colourEntryBytes)) +
                     blocks * static_cast<double>(checksumBytes);
        bytes = std::clamp(bytes + growth, 0.0, most);
        sourceShare *= 4;
    }
    return all;
}

}  // namespace

Result<ColourEstimate> estimateColours(const ColourSource& source, const ColourBakeSettings& settings,
                                       int threads, std::size_t cacheBytes,
                                       const std::function<bool()>& goOn) {
    TRY_ASSIGN(const auto tree, colourTreeOf(source, settings));
    const std::size_t leafLevel = tree.levels.size() - 1;
    TRY_ASSIGN(const auto leaf,
               packTiles(source, settings.format, tree.levels[leafLevel], leafTilesPacked, goOn));
    PackedTiles upper = leaf;
    if (leafLevel > 0) {
        TRY_ASSIGN(const auto packed,
                   packTiles(source, settings.format, tree.levels[leafLevel - 1], upperTilesPacked, goOn));
        upper = packed;
    }
    const AllTiles all = allTiles(leaf, upper, tree, settings.format);

    ColourEstimate estimate;
    estimate.faceSize = (colourTileCells << leafLevel) + 1;
    estimate.levels = static_cast<int>(leafLevel) + 1;
    estimate.tiles = tree.tileCount();
    estimate.fileBytes = all.bytes;
    estimate.seconds = leaf.readS + all.seconds / threads;
    const std::uint64_t texelsOfTile = std::uint64_t{colourTileTexels} * colourTileTexels;
    const std::uint64_t finestBlocks = tree.levels[leafLevel].ids.size() / quadrantCount + 1;
    estimate.bakeBytes = cacheBytes +
                         static_cast<std::uint64_t>(threads) * texelsOfTile * bytesPerTexelAtWork +
                         estimate.tiles * sizeof(ChunkId) + finestBlocks * sizeof(BlockLocation);
    estimate.residentBytes = estimate.tiles * colourTileBytes(settings.format);
    return estimate;
}

}  // namespace planet
