// Fuzzes the chunk file's reader: it refuses a file, or its tree is valid. Most inputs get correct checksums, so
// that corrupt content passes them.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "planet/bake/bake_reuse.h"
#include "planet/bake/colour_report.h"
#include "planet/bake/file_report.h"
#include "planet/tree/chunk_tree.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/chunk_blocks.h"

namespace {

using namespace planet;
using fuzz::isRead;
using fuzz::require;

constexpr std::size_t mostSamples = 15'000;  // read of a file, so that an input takes some milliseconds

Result<ChunkFile> openBytes(std::span<const std::byte> bytes) {
    return ChunkFile::open("fuzzed.chk", bytes.size(), [=](std::uint64_t offset, std::span<std::byte> out) {
        require(offset <= bytes.size() && out.size() <= bytes.size() - offset, "reads stay in the file");
        const auto from = bytes.subspan(static_cast<std::size_t>(offset), out.size());
        std::copy(from.begin(), from.end(), out.begin());
        return Result<void>{};
    });
}

std::size_t blocksToRead(const PlanetShape& shape) {
    return std::max<std::size_t>(mostSamples / static_cast<std::size_t>(chunkVertexCount(shape)), 2);
}

void checkNode(const ChunkNode& node) {
    require(std::isfinite(node.deltaCM) && node.deltaCM >= 0, "errors are finite");
    require(node.deltaTightM >= 0 && node.deltaTightM <= node.deltaCM, "the tight metric is the smaller");
    require(node.minHeightM <= node.maxHeightM, "extremes are in order");
    for (int axis = 0; axis < 3; ++axis)
        require(std::isfinite(node.bounds.box.centreM[axis]), "bounds are finite");
}

// Grows a tree as a planet does, from the chunks that checkHeights and checkChildren accept. Returns false if there is no tree.
bool growTree(const ChunkFile& file) {
    std::array<ChunkData, faceCount> roots;
    for (const Face face : allFaces) {
        auto root = file.readRoot(face);
        if (!isRead(root)) return false;
        roots[static_cast<std::size_t>(face)] = std::move(*root);
    }
    const ChunkFileInfo& info = file.info();
    Result<ChunkTree> tree = makeChunkTree(info.shape, info.minStep, info.maxStep, std::move(roots));
    if (!isRead(tree)) return false;
    tree->allChunks = info.chunks;
    std::uint32_t slot = faceCount;
    std::size_t left = blocksToRead(file.info().shape);
    for (NodeIndex at = 0; at < tree->nodes.size() && left > 0; ++at) {
        const ChunkNode node = tree->nodes[at];
        checkNode(node);
        if (node.childrenState != ChildrenState::Absent) continue;
        --left;
        static_cast<void>(isRead(file.readEntries(node.id, node.children)));
        auto children = file.readChildren(node.id, node.children, *node.heights);
        if (!isRead(children) || !std::ranges::all_of(*children, [&](const ChunkData& child) {
                return isRead(checkHeights(info.shape, child));
            }))
            continue;
        if (!isRead(checkChildren(*tree, at, *children))) continue;
        addChildren(*tree, at, std::move(*children), {slot, slot + 1, slot + 2, slot + 3});
        slot += quadrantCount;
    }
    setExaggeration(*tree, largestExaggeration(*tree));
    forEachNode(*tree, [](NodeIndex, const ChunkNode& node) { checkNode(node); });
    require(std::isfinite(residentHeightM(*tree, {0.3, -0.5, 0.8})), "heights are finite");
    return true;
}

// Reads the readable blocks of a file without a valid tree.
void readHeights(const ChunkFile& file) {
    std::vector<ChunkData> open;
    for (const Face face : allFaces) {
        auto root = file.readRoot(face);
        if (isRead(root)) open.push_back(std::move(*root));
    }
    const std::size_t most = blocksToRead(file.info().shape);
    for (std::size_t i = 0; i < open.size() && i < most; ++i) {
        const ChunkData chunk = open[i];
        if (!chunk.children.exists()) continue;
        auto children = file.readChildren(chunk.id, chunk.children, chunk.heights);
        if (!isRead(children)) continue;
        for (ChunkData& child : *children) open.push_back(std::move(child));
    }
}

void readColours(const ChunkFile& file) {
    const ColourPyramid& colour = *file.info().colour;
    std::vector<TileData> open;
    for (const Face face : allFaces) {
        auto root = file.readColourRoot(face);
        if (isRead(root)) open.push_back(std::move(*root));
    }
    constexpr std::size_t mostTiles = 7;
    for (std::size_t i = 0; i < open.size() && i < mostTiles; ++i) {
        const TileData tile = open[i];
        require(tile.texels.size() == colourTileBytes(colour.format), "tiles are whole");
        if (tile.id.level == colour.leafLevel) continue;
        if (tile.id.level + 1 < colour.leafLevel)
            static_cast<void>(isRead(file.readColourEntries(tile.id, tile.children)));
        auto children = file.readColourChildren(tile.id, tile.children);
        if (!isRead(children)) continue;
        for (TileData& child : *children) open.push_back(std::move(child));
    }
}

// Copies from a file, as a bake does that finds nothing changed. Where the file is damaged, heights are 0.
void copyChunks(const ChunkFile& file) {
    const Result<std::optional<SourceRecord>> record = file.readSourceRecord();
    const PlanetShape& shape = file.info().shape;
    constexpr int mostCells = 128;  // along a face
    if (!isRead(record) || !*record || faceCells(shape) > mostCells) return;
    HeightSource source;
    source.sample = [](const SampleTile&, std::span<float> out) {
        std::ranges::fill(out, 0.0f);
        return Result<void>{};
    };
    std::string notice;
    const auto earlier = EarlierBake::make(file, source, shape, **record, notice);
    require(earlier && earlier->difference().empty(), "a file is like itself");
    const BakeContext bake{source, shape, 1};
    BakeScratch scratch;
    BakeWalk walk(source, shape, deepestLevelOf(shape) - tileLevelOf(shape, {}), &*earlier);
    std::uint64_t cells = 0;
    while (const auto step = walk.next()) {
        const auto made = runStep(bake, &*earlier, *step, scratch);
        if (!isRead(made)) return;
        cells += made->cells;
        require(made->problem.empty() || made->copiedChunks == 0, "a damaged subtree is not copied");
        for (const BakedTile& tile : made->tiles) {
            const BlockLocation block = tile.root.entry.children;
            require(!block.exists() || block.offset + block.size == provisionalOrigin + tile.blocks.size(),
                    "the last block of a subtree is that of its root");
        }
    }
    require(cells == faceCount * std::uint64_t(faceCells(shape)) * std::uint64_t(faceCells(shape)),
            "every place is copied or baked");
}

// Changes the bytes of one block or of the header in place; else any bytes, and their number.
std::size_t mutatedPart(std::span<std::uint8_t> file, std::size_t maxSize, std::minstd_rand& random) {
    const auto bytes = std::as_writable_bytes(file);
    const Result<ChunkFileInfo> info = test::infoOf(bytes);
    const unsigned kind = random() % 8;
    if (!info || kind == 0) return LLVMFuzzerMutate(file.data(), file.size(), maxSize);
    std::span<std::uint8_t> part = file.first(chunkFileHeaderBytes);
    constexpr std::size_t mostRecordBytes = 256;
    if (kind == 2 && info->hasSourceRecord) {
        part = file.last(std::min(file.size(), mostRecordBytes));
    } else if (kind > 1) {
        std::vector<test::FileBlock> blocks;
        test::forEachBlock(bytes, *info, 200, [&](const test::FileBlock& one) { blocks.push_back(one); });
        if (!blocks.empty()) {
            const test::FileBlock& block = blocks[random() % blocks.size()];
            part = file.subspan(static_cast<std::size_t>(block.at.offset), block.at.size);
            if (kind > 5 && block.entriesBytes > 0) part = part.first(block.entriesBytes);
        }
    }
    std::vector<std::uint8_t> changed(part.begin(), part.end());
    changed.resize(LLVMFuzzerMutate(changed.data(), changed.size(), changed.size()));
    std::copy(changed.begin(), changed.end(), part.begin());
    return file.size();
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t maxSize,
                                               unsigned seed) {
    std::minstd_rand random(seed);
    const std::size_t now = mutatedPart({data, size}, maxSize, random);
    if (random() % 4 != 0) test::reseal(std::as_writable_bytes(std::span(data, now)));
    return now;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Result<ChunkFile> file = openBytes(fuzz::bytesOf(data, size));
    if (!isRead(file)) return 0;
    static_cast<void>(isRead(reportFile(*file)));
    if (!growTree(*file)) readHeights(*file);
    copyChunks(*file);
    if (file->info().colour) {
        static_cast<void>(isRead(reportColours(*file)));
        readColours(*file);
    }
    return 0;
}
