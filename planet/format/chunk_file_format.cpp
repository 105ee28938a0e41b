#include "planet/format/chunk_file_format.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <limits>

#include "planet/base/little_endian.h"
#include "planet/base/try.h"

namespace planet {

namespace {

constexpr std::array<char, 8> magic = {'W', 'O', 'R', 'L', 'D', 'Y', 'C', 'H'};
constexpr std::size_t maxSourceBytes = 200;
constexpr std::size_t maxColourSourceBytes = 60;
constexpr std::uint64_t rootSeed = std::uint64_t{1} << 63;
// No key has these bits: y is below 2^maxLevel.
constexpr std::uint64_t colourSeed = std::uint64_t{1} << 55;
constexpr std::uint64_t colourRootSeed = std::uint64_t{3} << 54;
constexpr std::uint64_t recordSeed = std::uint64_t{7} << 53;
static_assert(maxLevel <= 25);

std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

// Cuts the text at a character boundary, so that it remains valid UTF-8.
std::string_view cutUtf8(std::string_view text, std::size_t maxBytes) {
    if (text.size() <= maxBytes) return text;
    std::size_t end = maxBytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    return text.substr(0, end);
}

// Returns the distance back to a block from the block whose entry names it; 0 for none. The reader rejects a
// distance beyond the start of the file, because it wraps to an offset outside the file.
std::uint64_t distanceTo(const BlockLocation& location, std::uint64_t blockOffset) {
    return location.exists() ? blockOffset - location.offset : 0;
}
std::uint64_t offsetAt(std::uint64_t distance, std::uint64_t blockOffset) {
    return distance == 0 ? 0 : blockOffset - distance;
}

constexpr std::int64_t widestRange = (std::int64_t{1} << 32) - 1;

bool isInt32(std::int64_t value) {
    return value >= std::numeric_limits<std::int32_t>::min() &&
           value <= std::numeric_limits<std::int32_t>::max();
}

void putText(ByteWriter& out, std::string_view text, std::size_t maxBytes) {
    const std::string_view kept = cutUtf8(text, maxBytes);
    out.put(static_cast<std::uint16_t>(kept.size()));
    for (const char c : kept) out.put(c);
}

// Returns false if the text is longer than maxBytes.
bool readText(ByteReader& in, std::size_t maxBytes, std::string& text) {
    const auto bytes = in.get<std::uint16_t>();
    if (bytes > maxBytes) return false;
    const auto taken = in.take(bytes);
    text.assign(reinterpret_cast<const char*>(taken.data()), taken.size());
    return true;
}

void putColour(ByteWriter& out, const std::optional<ColourPyramid>& colour) {
    out.put(static_cast<std::uint8_t>(colour ? static_cast<int>(colour->format) + 1 : 0));
    if (!colour) return;
    out.put(static_cast<std::uint8_t>(colour->leafLevel));
    for (const BlockLocation& root : colour->roots) {
        out.put(root.offset);
        out.put(root.size);
    }
    putText(out, colour->source, maxColourSourceBytes);
}

// Decodes the description of colours. The Error does not name the file.
Result<std::optional<ColourPyramid>> readColour(ByteReader& in) {
    const auto kind = in.get<std::uint8_t>();
    if (kind == 0) return std::nullopt;
    ColourPyramid colour;
    colour.format = static_cast<ColourFormat>(kind - 1);
    colour.leafLevel = in.get<std::uint8_t>();
    for (BlockLocation& root : colour.roots) {
        root.offset = in.get<std::uint64_t>();
        root.size = in.get<std::uint32_t>();
    }
    if (kind > 2) return badInput(fmt::format("unknown colour format {}", kind));
    if (colour.leafLevel > maxColourLevel)
        return badInput(
            fmt::format("{} colour levels; expected at most {}", colour.leafLevel + 1, maxColourLevel + 1));
    if (!readText(in, maxColourSourceBytes, colour.source)) return badInput("colour source name too long");
    return colour;
}

// Returns an empty text if the root blocks of colours are inside the file and overlap no other root block.
std::string colourRootsProblem(const ChunkFileInfo& info, std::uint64_t fileBytes) {
    struct Place {
        BlockLocation block;
        std::string name;
    };
    std::vector<Place> places;
    for (const Face face : allFaces) {
        const BlockLocation block = info.colour->roots[static_cast<std::size_t>(face)];
        const std::string name = fmt::format("colour tile {}", toString({face, 0, 0, 0}));
        if (block.size == 0 || block.offset < chunkFileHeaderBytes || block.offset > fileBytes ||
            block.size > fileBytes - block.offset) {
            return fmt::format("root block of {}: {} bytes at {}; the file has {} bytes", name, block.size,
                               block.offset, fileBytes);
        }
        places.push_back({block, name});
    }
    for (const Face face : allFaces) {
        places.push_back(
            {info.roots[static_cast<std::size_t>(face)], fmt::format("chunk {}", toString({face, 0, 0, 0}))});
    }
    for (std::size_t i = 0; i < faceCount; ++i) {
        for (std::size_t j = i + 1; j < places.size(); ++j) {
            const BlockLocation a = places[i].block;
            const BlockLocation b = places[j].block;
            const bool apart =
                a.offset < b.offset ? b.offset - a.offset >= a.size : a.offset - b.offset >= b.size;
            if (!apart)
                return fmt::format("root blocks of {} and {} overlap", places[i].name, places[j].name);
        }
    }
    return {};
}

// Returns an empty text if the shape is within the limits of a bake.
std::string shapeProblem(const PlanetShape& shape) {
    if (!(shape.radiusM >= leastRadiusM && shape.radiusM <= mostRadiusM)) {
        return fmt::format("radius {} m; expected {} to {:g} m", shape.radiusM, leastRadiusM, mostRadiusM);
    }
    if (shape.fractionBits > maxFractionBits) {
        return fmt::format("quantum of 2^{} steps; expected at most 2^{}", shape.fractionBits,
                           maxFractionBits);
    }
    const double quantumM = fileQuantumM(shape);
    if (!(shape.quantumM > 0 && quantumM <= 1e6)) return fmt::format("quantum {} m", quantumM);
    if (!(std::abs(shape.baseHeightM) <= 1e9)) return fmt::format("base height {} m", shape.baseHeightM);
    if (shape.chunkCellsLog2 < 4 || shape.chunkCellsLog2 > 7) {
        return fmt::format("chunks of 2^{} cells per side; expected 2^4 to 2^7", shape.chunkCellsLog2);
    }
    if (shape.faceCellsLog2 < shape.chunkCellsLog2 || shape.faceCellsLog2 > maxFaceCellsLog2) {
        return fmt::format("faces of 2^{} cells per side; expected 2^{} to 2^{}", shape.faceCellsLog2,
                           shape.chunkCellsLog2, maxFaceCellsLog2);
    }
    return {};
}

// Returns an empty text if a tree of the shape can have that many chunks and that coarsest leaf.
std::string treeProblem(const ChunkFileInfo& info) {
    if (info.coarsestLeafLevel > deepestLevelOf(info.shape)) {
        return fmt::format("coarsest leaf level {}; expected [0, {}]", info.coarsestLeafLevel,
                           deepestLevelOf(info.shape));
    }
    PlanetShape above = info.shape;  // of the levels that are complete
    above.faceCellsLog2 = info.shape.chunkCellsLog2 + info.coarsestLeafLevel;
    const std::uint64_t least = chunkCountOf(above);
    const std::uint64_t most = chunkCountOf(info.shape);
    if (info.chunks < least || info.chunks > most || (info.chunks - faceCount) % quadrantCount != 0)
        return fmt::format("{} chunks; expected 6 and a multiple of 4, in [{}, {}]", info.chunks, least,
                           most);
    return {};
}

constexpr std::size_t distanceBytes = 6;

void putDistance(ByteWriter& out, std::uint64_t distance) {
    assert(distance >> (8 * distanceBytes) == 0);
    for (std::size_t i = 0; i < distanceBytes; ++i) out.put(static_cast<std::uint8_t>(distance >> (8 * i)));
}

std::uint64_t distanceFrom(std::span<const std::byte> bytes) {
    std::uint64_t distance = 0;
    for (std::size_t i = 0; i < distanceBytes; ++i)
        distance |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
    return distance;
}

// Reads the entry of a chunk that has children.
Result<ChunkEntry> entryFrom(ByteReader& in, std::uint64_t blockOffset) {
    const auto tooSmall = [] { return badInput("it is too small for its index"); };
    const auto outOfRange = [] { return badInput("its index entry is out of range"); };
    const auto unread = [&](VariableProblem problem) {
        return problem == VariableProblem::Truncated ? tooSmall() : outOfRange();
    };
    ChunkEntry entry;
    if (in.rest().size() < 2 * sizeof(float)) return tooSmall();
    entry.deltaCM = in.get<float>();
    entry.deltaTightM = in.get<float>();
    // Each number is checked before the next one is read, so that no entry needs more than largestEntryBytes to be refused.
    const auto lowest = in.getVariableSigned();
    if (!lowest) return unread(lowest.error());
    if (!isInt32(*lowest)) return outOfRange();
    const auto range = in.getVariableSigned();
    if (!range) return unread(range.error());
    if (*range < -widestRange || *range > widestRange || !isInt32(*lowest + *range)) return outOfRange();
    const auto size = in.getVariable();
    if (!size) return unread(size.error());
    if (*size > std::numeric_limits<std::uint32_t>::max()) return outOfRange();
    if (in.rest().size() < distanceBytes) return tooSmall();
    entry.minStep = static_cast<std::int32_t>(*lowest);
    entry.maxStep = static_cast<std::int32_t>(*lowest + *range);
    entry.children.size = static_cast<std::uint32_t>(*size);
    entry.children.offset = offsetAt(distanceFrom(in.take(distanceBytes)), blockOffset);
    if (!entry.children.exists()) return outOfRange();
    return entry;
}

}  // namespace

void putIndex(std::vector<std::byte>& block, std::span<const ChunkEntry> entries, std::uint64_t blockOffset) {
    assert(entries.size() <= quadrantCount);
    unsigned withChildren = 0;
    for (std::size_t i = 0; i < entries.size(); ++i)
        withChildren |= static_cast<unsigned>(entries[i].children.exists()) << i;
    ByteWriter out(block);
    out.put(static_cast<std::uint8_t>(withChildren));
    for (const ChunkEntry& entry : entries) {
        if (!entry.children.exists()) continue;
        out.put(entry.deltaCM);
        out.put(entry.deltaTightM);
        out.putVariableSigned(entry.minStep);
        out.putVariableSigned(std::int64_t{entry.maxStep} - entry.minStep);
        out.putVariable(entry.children.size);
        putDistance(out, distanceTo(entry.children, blockOffset));
    }
}

Result<BlockIndex> indexFrom(std::span<const std::byte> block, int chunks, bool mayHaveChildren,
                             std::uint64_t blockOffset) {
    if (block.empty()) return badInput("it is too small for its index");
    ByteReader in(block);
    const unsigned withChildren = in.get<std::uint8_t>();
    if (withChildren >> chunks != 0) return badInput("its index names chunks that it does not hold");
    if (withChildren != 0 && !mayHaveChildren)
        return badInput("its index names children below the deepest level");
    BlockIndex index;
    for (std::size_t q = 0; q < static_cast<std::size_t>(chunks); ++q) {
        if ((withChildren >> q & 1) == 0) continue;
        TRY_ASSIGN(index.entries[q], entryFrom(in, blockOffset));
    }
    index.bytes = block.size() - in.rest().size();
    return index;
}

void putColourEntry(std::vector<std::byte>& block, const ColourEntry& entry, std::uint64_t blockOffset) {
    ByteWriter out(block);
    out.put(distanceTo(entry.children, blockOffset));
    out.put(entry.children.size);
    out.put(entry.packedBytes);
}

ColourEntry colourEntryFrom(std::span<const std::byte, colourEntryBytes> bytes, std::uint64_t blockOffset) {
    ByteReader in(bytes);
    ColourEntry entry;
    entry.children.offset = offsetAt(in.get<std::uint64_t>(), blockOffset);
    entry.children.size = in.get<std::uint32_t>();
    entry.packedBytes = in.get<std::uint32_t>();
    return entry;
}

std::uint64_t rootChecksum(std::span<const std::byte> bytes, Face face) {
    return checksum(bytes, rootSeed | keyOf({face, 0, 0, 0}));
}

std::uint64_t siblingChecksum(std::span<const std::byte> bytes, const ChunkId& parent) {
    return checksum(bytes, keyOf(parent));
}

std::uint64_t colourRootChecksum(std::span<const std::byte> bytes, Face face) {
    return checksum(bytes, colourRootSeed | keyOf({face, 0, 0, 0}));
}

std::uint64_t colourSiblingChecksum(std::span<const std::byte> bytes, const ChunkId& parent) {
    return checksum(bytes, colourSeed | keyOf(parent));
}

std::uint64_t headerChecksum(std::span<const std::byte> bytes) {
    return checksum(bytes, 0);
}

std::uint64_t sourceRecordChecksum(std::span<const std::byte> bytes) {
    return checksum(bytes, recordSeed);
}

std::array<std::byte, chunkFileHeaderBytes> headerBytes(const ChunkFileInfo& info, std::uint64_t fileBytes) {
    std::vector<std::byte> bytes;
    ByteWriter out(bytes);
    for (const char c : magic) out.put(c);
    out.put(chunkFileVersion);
    out.put(static_cast<std::uint32_t>(chunkFileHeaderBytes));
    out.put(fileBytes);
    out.put(info.shape.radiusM);
    out.put(fileQuantumM(info.shape));
    out.put(info.shape.baseHeightM);
    out.put(static_cast<std::uint8_t>(info.shape.faceCellsLog2));
    out.put(static_cast<std::uint8_t>(info.shape.chunkCellsLog2));
    out.put(static_cast<std::uint8_t>(info.coarsestLeafLevel));
    out.put(static_cast<std::uint8_t>(info.hasSourceRecord));
    out.put(static_cast<std::uint8_t>(info.shape.fractionBits));
    for (int i = 0; i < 3; ++i) out.put(std::uint8_t{0});
    out.put(info.minStep);
    out.put(info.maxStep);
    out.put(info.missingSamples);
    out.put(info.chunks);
    for (const BlockLocation& root : info.roots) {
        out.put(root.offset);
        out.put(root.size);
    }
    putText(out, info.source, maxSourceBytes);
    putColour(out, info.colour);

    std::array<std::byte, chunkFileHeaderBytes> header{};
    assert(bytes.size() <= header.size() - checksumBytes);
    std::copy(bytes.begin(), bytes.end(), header.begin());
    std::vector<std::byte> sum;
    ByteWriter(sum).put(headerChecksum(std::span(header).first<chunkFileHeaderBytes - checksumBytes>()));
    std::copy(sum.begin(), sum.end(), header.end() - checksumBytes);
    return header;
}

Result<ChunkFileInfo> infoFromHeader(std::span<const std::byte, chunkFileHeaderBytes> header,
                                     const std::string& name, std::uint64_t fileBytes) {
    ByteReader in(header);
    if (std::memcmp(in.take(magic.size()).data(), magic.data(), magic.size()) != 0) {
        return badInput(
            fmt::format("{}: not a chunk file: it does not begin with \"WORLDYCH\"; bake one with "
                        "`worldy bake SOURCE -o OUT.chk`",
                        name));
    }
    const auto version = in.get<std::uint32_t>();
    if (version != chunkFileVersion) {
        return badInput(fmt::format(
            "{}: chunk file version: {} is not supported; expected {}: {}bake the source again with `worldy "
            "bake SOURCE -o OUT.chk`",
            name, version, chunkFileVersion, version > chunkFileVersion ? "update this program, or " : ""));
    }
    const std::uint64_t expected = headerChecksum(header.first<chunkFileHeaderBytes - checksumBytes>());
    if (ByteReader(header.last<checksumBytes>()).get<std::uint64_t>() != expected) {
        return badInput(
            fmt::format("{}: the header is damaged: its checksum does not match; bake it again", name));
    }
    const auto headerSize = in.get<std::uint32_t>();
    const auto recordedBytes = in.get<std::uint64_t>();
    if (headerSize != chunkFileHeaderBytes) {
        return badInput(fmt::format("{}: header of {} bytes; expected {}; bake it again", name, headerSize,
                                    chunkFileHeaderBytes));
    }
    if (recordedBytes != fileBytes) {
        return badInput(
            fmt::format("{}: {} bytes long, but was baked with {}: it is {}; copy or bake it again", name,
                        fileBytes, recordedBytes, fileBytes < recordedBytes ? "truncated" : "too long"));
    }
    ChunkFileInfo info;
    info.shape.radiusM = in.get<double>();
    const auto quantumM = in.get<double>();
    info.shape.baseHeightM = in.get<double>();
    info.shape.faceCellsLog2 = in.get<std::uint8_t>();
    info.shape.chunkCellsLog2 = in.get<std::uint8_t>();
    info.coarsestLeafLevel = in.get<std::uint8_t>();
    info.hasSourceRecord = in.get<std::uint8_t>() == 1;
    info.shape.fractionBits = in.get<std::uint8_t>();
    in.take(3);
    info.shape.quantumM = quantumM;
    if (info.shape.fractionBits <= maxFractionBits)
        info.shape.quantumM = std::ldexp(quantumM, -info.shape.fractionBits);
    if (const std::string problem = shapeProblem(info.shape); !problem.empty()) {
        return badInput(fmt::format("{}: invalid header: {}; bake it again", name, problem));
    }
    info.minStep = in.get<std::int32_t>();
    info.maxStep = in.get<std::int32_t>();
    info.missingSamples = in.get<std::uint64_t>();
    info.chunks = in.get<std::uint64_t>();
    if (const std::string problem = treeProblem(info); !problem.empty())
        return badInput(fmt::format("{}: invalid header: {}; bake it again", name, problem));
    for (BlockLocation& root : info.roots) {
        root.offset = in.get<std::uint64_t>();
        root.size = in.get<std::uint32_t>();
    }
    const bool hasText = readText(in, maxSourceBytes, info.source);
    if (info.shape.radiusM + heightM(info.shape, info.minStep) <= 0) {
        return badInput(
            fmt::format("{}: invalid header: heights below the planet's centre; bake it again", name));
    }
    if (!hasText || info.minStep > info.maxStep || info.minStep < lowestStepOf(info.shape.fractionBits) ||
        info.maxStep > highestStepOf(info.shape.fractionBits)) {
        return badInput(fmt::format("{}: the header is inconsistent; bake it again", name));
    }
    auto colour = readColour(in);
    if (!colour)
        return badInput(fmt::format("{}: invalid header: {}; bake it again", name, colour.error().message));
    info.colour = *std::move(colour);
    if (!info.colour) return info;
    if (const std::string problem = colourRootsProblem(info, fileBytes); !problem.empty())
        return badInput(fmt::format("{}: invalid header: {}; bake it again", name, problem));
    return info;
}

}  // namespace planet
