// Reads a whole chunk file: read_whole_file FILE.chk prints one hash over every height, error and texel as
// numbers, which must be the same on machines of either byte order. Exits with 1 if this machine would encode
// the header or a block's heights as other bytes than the file's.
#include <xxhash.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "planet/base/little_endian.h"
#include "planet/format/chunk_file.h"
#include "planet/format/chunk_file_format.h"
#include "planet/format/height_codec.h"

namespace {

using namespace planet;

struct Reading {
    const ChunkFile& file;
    std::vector<std::byte> bytes;      // the file's own
    std::vector<std::byte> numbers{};  // what was read, little-endian
    std::size_t blocks = 0;
    std::size_t rewrittenOtherwise = 0;
};

template <class T>
T valueOf(Result<T> read) {
    if (read) return *std::move(read);
    std::fprintf(stderr, "%s\n", read.error().message.c_str());
    std::exit(1);
}

std::vector<std::byte> bytesOf(const char* path) {
    std::ifstream stream(path, std::ios::binary);
    const std::vector<char> text{std::istreambuf_iterator<char>(stream), {}};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

void keep(Reading& reading, const ChunkData& chunk) {
    ByteWriter numbers(reading.numbers);
    numbers.put(chunk.deltaCM);
    numbers.put(chunk.deltaTightM);
    numbers.put(chunk.minStep);
    numbers.put(chunk.maxStep);
    for (const std::int32_t height : chunk.heights) numbers.put(height);
}

bool areAt(const Reading& reading, std::uint64_t offset, const std::vector<std::byte>& expected) {
    return offset + expected.size() <= reading.bytes.size() &&
           std::equal(expected.begin(), expected.end(),
                      reading.bytes.begin() + static_cast<std::ptrdiff_t>(offset));
}

// Joins the four quarters.
std::vector<std::int32_t> joined(const std::array<ChunkData, quadrantCount>& children, int cells) {
    const auto side = static_cast<std::size_t>(cells) + 1;
    const std::size_t fineSide = 2 * static_cast<std::size_t>(cells) + 1;
    std::vector<std::int32_t> fine(fineSide * fineSide);
    for (std::size_t q = 0; q < quadrantCount; ++q)
        for (std::size_t j = 0; j < side; ++j)
            children[q]
                .heights.view()
                .subspan(j * side, side)
                .copyTo(std::span(fine).subspan(((q / 2) * (side - 1) + j) * fineSide + (q % 2) * (side - 1),
                                                side));
    return fine;
}

void readBelow(Reading& reading, const ChunkData& parent) {
    if (!parent.children.exists()) return;
    const auto children = valueOf(reading.file.readChildren(parent.id, parent.children, parent.heights));
    ++reading.blocks;
    const int cells = chunkCells(reading.file.info().shape);
    std::vector<std::byte> coded;
    encodeRefinement(joined(children, cells), cells, defaultCompressionLevel,
                     reading.file.info().shape.fractionBits, coded);
    std::vector<std::byte> index;
    putIndex(index, valueOf(reading.file.readEntries(parent.id, parent.children)), parent.children.offset);
    reading.rewrittenOtherwise += !areAt(reading, parent.children.offset + index.size(), coded);
    for (const ChunkData& child : children) keep(reading, child);
    for (const ChunkData& child : children) readBelow(reading, child);
}

void readColoursBelow(Reading& reading, const TileData& parent) {
    reading.numbers.insert(reading.numbers.end(), parent.texels.begin(), parent.texels.end());
    if (!parent.children.exists()) return;
    ++reading.blocks;
    for (const TileData& tile : valueOf(reading.file.readColourChildren(parent.id, parent.children)))
        readColoursBelow(reading, tile);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: read_whole_file FILE.chk\n"), 2;
    const ChunkFile file = valueOf(ChunkFile::open(argv[1]));
    Reading reading{file, bytesOf(argv[1])};
    const auto header = headerBytes(file.info(), file.sizeBytes());
    reading.rewrittenOtherwise += !areAt(reading, 0, {header.begin(), header.end()});
    for (const Face face : allFaces) {
        const ChunkData root = valueOf(file.readRoot(face));
        keep(reading, root);
        readBelow(reading, root);
        if (file.info().colour) readColoursBelow(reading, valueOf(file.readColourRoot(face)));
    }
    const XXH64_hash_t hash = XXH3_64bits(reading.numbers.data(), reading.numbers.size());
    std::printf("%zu blocks, %zu bytes of numbers, hash %016llx, %zu written otherwise\n", reading.blocks,
                reading.numbers.size(), static_cast<unsigned long long>(hash), reading.rewrittenOtherwise);
    return reading.rewrittenOtherwise == 0 ? 0 : 1;
}
