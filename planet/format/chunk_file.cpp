#include "planet/format/chunk_file.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <memory>

#include "planet/base/little_endian.h"
#include "planet/base/open_file.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file_format.h"
#include "planet/format/height_codec.h"
#include "planet/spans/span_recorder.h"

namespace planet {

namespace {

// Returns an upper bound of the size of valid blocks: the codec never needs more than 4 bytes per sample.
std::uint64_t largestBlockBytes(const PlanetShape& shape) {
    const auto side = static_cast<std::uint64_t>(2 * chunkCells(shape) + 1);
    return side * side * 4 + 1024;
}

// Returns one of the four quarters of a refined grid.
Steps cutQuarter(const StepsView& fine, int cells, int quadrant) {
    const auto side = static_cast<std::size_t>(cells) + 1;
    const auto fineSide = static_cast<std::size_t>(cells) * 2 + 1;
    const std::size_t column = (quadrant & 1) != 0 ? side - 1 : 0;
    const std::size_t row = (quadrant & 2) != 0 ? side - 1 : 0;
    if (fine.isWide()) {
        std::vector<std::int32_t> quarter(side * side);
        for (std::size_t j = 0; j < side; ++j)
            fine.subspan((row + j) * fineSide + column, side)
                .copyTo(std::span(quarter).subspan(j * side, side));
        return Steps(std::span<const std::int32_t>(quarter));
    }
    return Steps(fine.narrow().subspan(row * fineSide + column), fineSide, side, fine.base(), fine.scale());
}

// Returns whether the values of a chunk with children are in range.
bool isSane(const ChunkEntry& entry, int fractionBits) {
    return std::isfinite(entry.deltaCM) && entry.deltaCM >= 0 && entry.deltaTightM >= 0 &&
           entry.deltaTightM <= entry.deltaCM && entry.minStep <= entry.maxStep &&
           entry.minStep >= lowestStepOf(fractionBits) && entry.maxStep <= highestStepOf(fractionBits) &&
           entry.children.size > 0;
}

void describeLeaf(ChunkData& chunk) {
    const auto [lowest, highest] = lowestAndHighest(chunk.heights);
    chunk.minStep = lowest;
    chunk.maxStep = highest;
}

// Returns false if the entry is out of range.
bool describe(ChunkData& chunk, const ChunkEntry& entry, int fractionBits) {
    if (!entry.children.exists()) {
        describeLeaf(chunk);
        return true;
    }
    if (!isSane(entry, fractionBits)) return false;
    chunk.deltaCM = entry.deltaCM;
    chunk.deltaTightM = entry.deltaTightM;
    chunk.minStep = entry.minStep;
    chunk.maxStep = entry.maxStep;
    chunk.children = entry.children;
    return true;
}

std::uint64_t checksumOf(std::span<const std::byte> content, const BlockId& id, bool isRoot) {
    const ChunkId& key = id.parent;
    if (id.kind == BlockKind::Colours)
        return isRoot ? colourRootChecksum(content, key.face) : colourSiblingChecksum(content, key);
    return isRoot ? rootChecksum(content, key.face) : siblingChecksum(content, key);
}

// Returns the name of a block for messages.
std::string nameOf(const BlockId& id) {
    return (id.kind == BlockKind::Colours ? "colour tile " : "chunk ") + toString(id.parent);
}

}  // namespace

Result<ChunkFile> ChunkFile::open(const std::filesystem::path& path, const FileCalls& calls) {
    // Without O_NONBLOCK, opening a pipe would wait for a writer.
    TRY_ASSIGN(auto opened, OpenFile::open(path, O_RDONLY | O_NONBLOCK, calls));
    const auto file = std::make_shared<const OpenFile>(std::move(opened));
    struct stat status {};
    if (uninterrupted([&] { return calls.fstat(file->descriptor(), &status); }) != 0)
        return ioError(fmt::format("{}: cannot be read: {}", file->name(), lastSystemError()));
    if (!S_ISREG(status.st_mode))
        return badInput(fmt::format("{}: is not a file; expected a baked chunk file", file->name()));
    Result<ChunkFile> chunks =
        open(file->name(), static_cast<std::uint64_t>(status.st_size),
             [file](std::uint64_t offset, std::span<std::byte> out) { return file->read(offset, out); });
    if (!chunks && path.extension() == ".toml") {
        return badInput(fmt::format(
            "{}: is a .toml file; expected a chunk file (.chk). A world file must be baked first: "
            "worldy bake {} -o FILE.chk",
            file->name(), file->name()));
    }
    return chunks;
}

Result<ChunkFile> ChunkFile::open(std::string name, std::uint64_t sizeBytes, ReadAt readAt) {
    if (sizeBytes < chunkFileHeaderBytes) {
        return badInput(
            fmt::format("{}: {} bytes are too few for a chunk file, whose header alone is {}: it is {}", name,
                        sizeBytes, chunkFileHeaderBytes, sizeBytes == 0 ? "empty" : "truncated"));
    }
    std::array<std::byte, chunkFileHeaderBytes> header{};
    TRY(readAt(0, header));
    ChunkFile file;
    TRY_ASSIGN(file.info_, infoFromHeader(header, name, sizeBytes));
    file.name_ = std::move(name);
    file.sizeBytes_ = sizeBytes;
    file.readAt_ = std::move(readAt);
    return file;
}

Result<std::vector<std::byte>> ChunkFile::readBlock(const BlockId& id, BlockLocation location,
                                                    const BlockBytes& bytes) const {
    if (location.offset < chunkFileHeaderBytes || location.size > bytes.most ||
        location.offset > sizeBytes_ || location.size > sizeBytes_ - location.offset ||
        location.size < bytes.least) {
        return badInput(fmt::format(
            "{}: the block of {} is recorded as {} bytes at {}, which exceeds the file size, {} bytes; "
            "bake it again",
            name_, nameOf(id), location.size, location.offset, sizeBytes_));
    }
    const SpanScope span("read", id);
    std::vector<std::byte> block(location.size);
    TRY(readAt_(location.offset, block));
    return block;
}

Result<std::vector<std::byte>> ChunkFile::readContent(const BlockId& id, bool isRoot, BlockLocation location,
                                                      const BlockBytes& bytes) const {
    TRY_ASSIGN(auto block, readBlock(id, location, bytes));
    TRY_ASSIGN(const auto content, checkedContent(id, isRoot, block));
    block.resize(content.size());
    return block;
}

Result<std::span<const std::byte>> ChunkFile::checkedContent(const BlockId& id, bool isRoot,
                                                             std::span<const std::byte> block) const {
    const std::size_t size = block.size() - checksumBytes;
    const auto content = block.first(size);
    if (readLittleEndian<std::uint64_t>(block.data() + size) == checksumOf(content, id, isRoot))
        return content;
    return badInput(fmt::format("{}: the block of {} is damaged: its checksum does not match; bake it again",
                                name_, nameOf(id)));
}

tl::unexpected<Error> ChunkFile::invalid(const BlockId& id, std::string_view what) const {
    return badInput(
        fmt::format("{}: the block of {} is invalid: {}; bake it again", name_, nameOf(id), what));
}

Result<ChunkData> ChunkFile::readRoot(Face face) const {
    const BlockLocation location = info_.roots[static_cast<std::size_t>(face)];
    ChunkData root;
    root.id = {face, 0, 0, 0};
    TRY_ASSIGN(const auto block,
               readContent(root.id, true, location, {1 + checksumBytes, largestBlockBytes(info_.shape)}));
    const std::span content(block);
    const auto index = indexFrom(content, 1, deepestLevelOf(info_.shape) > 0, location.offset);
    if (!index) return invalid(root.id, index.error().message);
    auto decoded =
        decodeGrid(content.subspan(index->bytes), chunkSize(info_.shape), info_.shape.fractionBits);
    if (!decoded) return invalid(root.id, decoded.error().message);
    root.heights = *std::move(decoded);
    if (!describe(root, index->entries[0], info_.shape.fractionBits))
        return invalid(root.id, "its errors, extremes or children are out of range");
    return root;
}

Result<std::array<ChunkData, quadrantCount>> ChunkFile::readChildren(const ChunkId& parent,
                                                                     BlockLocation location,
                                                                     StepsView parentHeights) const {
    assert(parent.level < deepestLevelOf(info_.shape));
    TRY_ASSIGN(const auto block,
               readContent(parent, false, location, {1 + checksumBytes, largestBlockBytes(info_.shape)}));
    const SpanScope span("decode", parent);
    const std::span content(block);
    const bool aboveDeepest = parent.level + 1 < deepestLevelOf(info_.shape);
    const auto index = indexFrom(content, quadrantCount, aboveDeepest, location.offset);
    if (!index) return invalid(parent, index.error().message);
    const int cells = chunkCells(info_.shape);
    const auto fine =
        decodeRefinement(content.subspan(index->bytes), parentHeights, cells, info_.shape.fractionBits);
    if (!fine) return invalid(parent, fine.error().message);
    std::array<ChunkData, quadrantCount> children;
    for (int quadrant = 0; quadrant < quadrantCount; ++quadrant) {
        const auto q = static_cast<std::size_t>(quadrant);
        ChunkData& child = children[q];
        child.id = childOf(parent, quadrant);
        child.heights = cutQuarter(*fine, cells, quadrant);
        if (!describe(child, index->entries[q], info_.shape.fractionBits))
            return invalid(child.id, "its errors, extremes or children are out of range");
    }
    return children;
}

Result<std::array<ChunkEntry, quadrantCount>> ChunkFile::readEntries(const ChunkId& parent,
                                                                     BlockLocation location) const {
    assert(parent.level < deepestLevelOf(info_.shape));
    if (location.size < 1 + checksumBytes) return invalid(parent, "it is too small for its index");
    const auto size =
        static_cast<std::uint32_t>(std::min<std::size_t>(largestIndexBytes, location.size - checksumBytes));
    TRY_ASSIGN(const auto bytes, readBlock(parent, {location.offset, size}, {1, largestIndexBytes}));
    return entriesFrom(parent, location, bytes);
}

Result<std::array<ChunkEntry, quadrantCount>> ChunkFile::entriesFrom(const ChunkId& parent,
                                                                     BlockLocation location,
                                                                     std::span<const std::byte> bytes) const {
    const bool aboveDeepest = parent.level + 1 < deepestLevelOf(info_.shape);
    const auto index = indexFrom(bytes, quadrantCount, aboveDeepest, location.offset);
    if (!index) return invalid(parent, index.error().message);
    for (std::size_t q = 0; q < index->entries.size(); ++q) {
        const ChunkEntry& entry = index->entries[q];
        if (entry.children.exists() && !isSane(entry, info_.shape.fractionBits))
            return invalid(childOf(parent, static_cast<int>(q)), "its index entry is out of range");
    }
    return index->entries;
}

Result<std::array<ChunkEntry, quadrantCount>> ChunkFile::checkedEntries(
    const ChunkId& parent, BlockLocation location, std::span<const std::byte> block) const {
    assert(parent.level < deepestLevelOf(info_.shape));
    if (block.size() < 1 + checksumBytes) return invalid(parent, "it is too small for its index");
    TRY_ASSIGN(const auto content, checkedContent(parent, false, block));
    return entriesFrom(parent, location, content);
}

Result<std::vector<ColourEntry>> ChunkFile::checkedColourEntries(const ChunkId& firstTile,
                                                                 BlockLocation location,
                                                                 std::span<const std::byte> block) const {
    assert(info_.colour);
    const bool isRoot = firstTile.level == 0;
    const BlockId id(isRoot ? firstTile : parentOf(firstTile), BlockKind::Colours);
    const std::size_t tiles = isRoot ? 1 : quadrantCount;
    if (block.size() < tiles * colourEntryBytes + checksumBytes)
        return invalid(id, "it is too small for its index");
    TRY_ASSIGN(const auto content, checkedContent(id, isRoot, block));
    std::vector<ColourEntry> entries;
    for (std::size_t i = 0; i < tiles; ++i) {
        entries.push_back(colourEntryFrom(content.subspan(i * colourEntryBytes).first<colourEntryBytes>(),
                                          location.offset));
        if (entries.back().children.exists() && firstTile.level >= info_.colour->leafLevel)
            return invalid(id, "its index entry is out of range");
    }
    return entries;
}

Result<void> ChunkFile::readBytes(std::uint64_t offset, std::span<std::byte> out) const {
    if (offset <= sizeBytes_ && out.size() <= sizeBytes_ - offset) return readAt_(offset, out);
    return badInput(fmt::format("{}: {} bytes at {} are recorded, but the file has {}; bake it again", name_,
                                out.size(), offset, sizeBytes_));
}

Result<std::optional<SourceRecord>> ChunkFile::readSourceRecord() const {
    if (!info_.hasSourceRecord) return std::nullopt;
    const auto named = [&](const Error& error) {
        return badInput(fmt::format("{}: {}; bake it again", name_, error.message));
    };
    std::array<std::byte, sourceRecordTailBytes> tail{};
    TRY(readAt_(sizeBytes_ - tail.size(), tail));  // the header alone is larger
    const auto length = sourceRecordLength(tail);
    if (!length) return named(length.error());
    if (*length + tail.size() > sizeBytes_ - chunkFileHeaderBytes)
        return named(Error{ErrorKind::BadInput, "its record of its source is larger than the file"});
    std::vector<std::byte> bytes(*length + tail.size());
    TRY(readAt_(sizeBytes_ - bytes.size(), bytes));
    auto record = sourceRecordFrom(bytes);
    if (!record) return named(record.error());
    return *std::move(record);
}

Result<std::vector<TileData>> ChunkFile::readColourBlock(const ChunkId& block, BlockLocation location,
                                                         std::span<const ChunkId> tiles) const {
    const ColourPyramid& pyramid = *info_.colour;
    const BlockId id(block, BlockKind::Colours);
    const std::size_t entriesBytes = tiles.size() * colourEntryBytes;
    const std::size_t least = entriesBytes + checksumBytes;
    const std::size_t most = least + tiles.size() * largestPackedColourTile(pyramid.format);
    TRY_ASSIGN(const auto bytes, readContent(id, tiles[0].level == 0, location, {least, most}));
    const SpanScope span("decode", id);
    const std::span content(bytes);
    std::vector<TileData> read;
    std::span<const std::byte> packed = content.subspan(entriesBytes);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const ColourEntry entry =
            colourEntryFrom(content.subspan(i * colourEntryBytes).first<colourEntryBytes>(), location.offset);
        const BlockId tile(tiles[i], BlockKind::Colours);
        const bool hasChildren = entry.children.exists();
        if ((hasChildren && tiles[i].level >= pyramid.leafLevel) || entry.packedBytes > packed.size())
            return invalid(tile, "its children or size are out of range");
        // Blocks of children precede those of their parents in the file.
        if (hasChildren && entry.children.size > location.offset - entry.children.offset)
            return invalid(tile, "its children's block overlaps its own");
        auto texels = unpackColourTexels(pyramid.format, packed.first(entry.packedBytes));
        if (!texels) return invalid(tile, texels.error().message);
        packed = packed.subspan(entry.packedBytes);
        read.push_back({tiles[i], entry.children, *std::move(texels)});
    }
    if (!packed.empty()) return invalid(id, "it is followed by other bytes");
    return read;
}

Result<TileData> ChunkFile::readColourRoot(Face face) const {
    assert(info_.colour);
    const ChunkId root{face, 0, 0, 0};
    TRY_ASSIGN(auto tiles,
               readColourBlock(root, info_.colour->roots[static_cast<std::size_t>(face)], {&root, 1}));
    return std::move(tiles.front());
}

Result<std::array<TileData, quadrantCount>> ChunkFile::readColourChildren(const ChunkId& parent,
                                                                          BlockLocation location) const {
    assert(info_.colour && parent.level < info_.colour->leafLevel);
    std::array<ChunkId, quadrantCount> ids;
    for (int quadrant = 0; quadrant < quadrantCount; ++quadrant)
        ids[static_cast<std::size_t>(quadrant)] = childOf(parent, quadrant);
    TRY_ASSIGN(auto tiles, readColourBlock(parent, location, ids));
    std::array<TileData, quadrantCount> children;
    std::move(tiles.begin(), tiles.end(), children.begin());
    return children;
}

Result<std::array<ColourEntry, quadrantCount>> ChunkFile::readColourEntries(const ChunkId& parent,
                                                                            BlockLocation location) const {
    assert(info_.colour && parent.level + 1 < info_.colour->leafLevel);
    constexpr std::size_t entriesBytes = quadrantCount * colourEntryBytes;
    if (location.size < entriesBytes + checksumBytes)
        return invalid({parent, BlockKind::Colours}, "it is too small for its index");
    TRY_ASSIGN(const auto bytes, readBlock({parent, BlockKind::Colours}, {location.offset, entriesBytes},
                                           {entriesBytes, entriesBytes}));
    std::array<ColourEntry, quadrantCount> entries;
    for (std::size_t q = 0; q < entries.size(); ++q) {
        entries[q] = colourEntryFrom(std::span(bytes).subspan(q * colourEntryBytes).first<colourEntryBytes>(),
                                     location.offset);
        const BlockLocation& children = entries[q].children;
        if (children.exists() && children.size > location.offset - children.offset) {
            return invalid({childOf(parent, static_cast<int>(q)), BlockKind::Colours},
                           "its index entry is out of range");
        }
    }
    return entries;
}

Result<void> spendOn(const ChunkFile& file, BlockLocation block, std::uint64_t& bytesLeft) {
    if (block.size > bytesLeft) {
        return badInput(
            fmt::format("{}: the index is damaged: it tells of more blocks than the file's {} bytes can "
                        "hold; bake it again",
                        file.name(), file.sizeBytes()));
    }
    bytesLeft -= block.size;
    return {};
}

}  // namespace planet
