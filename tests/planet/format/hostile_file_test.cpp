// Chunk files that fuzzing, mutations and looking hard have shown to be more than the reader could take.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "planet/bake/colour_report.h"
#include "planet/bake/file_report.h"
#include "planet/base/little_endian.h"
#include "planet/format/height_codec.h"
#include "planet/planet.h"
#include "planet/source/height_source.h"
#include "tests/support/chunk_blocks.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using testing::HasSubstr;
using Bytes = std::vector<std::byte>;

Result<ChunkFile> opened(const Bytes& bytes) {
    return ChunkFile::open(
        "hostile.chk", bytes.size(), [&bytes](std::uint64_t offset, std::span<std::byte> out) {
            std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
            return Result<void>{};
        });
}

// A file of six flat roots, each of which tells of the blocks that it is given; all checksums are right.
struct HostileFile {
    ChunkFileInfo info;
    Bytes bytes = Bytes(chunkFileHeaderBytes);

    HostileFile() {
        info.shape.chunkCellsLog2 = 4;
        info.shape.faceCellsLog2 = maxFaceCellsLog2;
    }
    BlockLocation add(const Bytes& content) {
        const BlockLocation at{bytes.size(), static_cast<std::uint32_t>(content.size() + checksumBytes)};
        bytes.insert(bytes.end(), content.begin(), content.end());
        bytes.resize(bytes.size() + checksumBytes);
        return at;
    }
    void addRoots(const ChunkEntry& entry, std::int32_t step = 0) {
        const std::vector<std::int32_t> flat(static_cast<std::size_t>(chunkVertexCount(info.shape)), step);
        for (BlockLocation& root : info.roots) {
            Bytes content;
            putIndex(content, {&entry, 1}, bytes.size());
            encodeGrid(flat, chunkSize(info.shape), info.shape.fractionBits, content);
            root = add(content);
        }
    }
    void addColourRoots(const BlockLocation& children) {
        const Bytes packed = packColourTexels(ColourFormat::Bc1, checkerTexels(ColourFormat::Bc1));
        info.colour = ColourPyramid{ColourFormat::Bc1, maxColourLevel, {}, {}};
        for (BlockLocation& root : info.colour->roots) {
            Bytes content;
            putColourEntry(content, {children, static_cast<std::uint32_t>(packed.size())}, bytes.size());
            content.insert(content.end(), packed.begin(), packed.end());
            root = add(content);
        }
    }
    const Bytes& sealed() {
        const auto header = headerBytes(info, bytes.size());
        std::copy(header.begin(), header.end(), bytes.begin());
        test::reseal(bytes);
        return bytes;
    }
};

// Two blocks, each of which says that all of its children's lie in the other; returns the first.
template <class PutIndex>
BlockLocation addCircle(HostileFile& file, std::size_t indexBytes, const PutIndex& put) {
    const auto blockBytes = static_cast<std::uint32_t>(indexBytes + checksumBytes);
    const BlockLocation first{chunkFileHeaderBytes, blockBytes};
    const BlockLocation second{first.offset + first.size, first.size};
    for (const auto& [own, other] : {std::pair(first, second), std::pair(second, first)}) {
        Bytes content;
        put(content, other, own.offset);
        file.add(content);
    }
    return first;
}

// Each block says that all of its children's are the one before it. Followed from the roots they would be some 10^14
// blocks. Heights cannot go in circles, because their blocks name only earlier ones.
TEST(HostileFile, AnIndexThatNamesTheSameBlocksAgainAndAgainIsRefusedInAReport) {
    HostileFile file;
    BlockLocation last = file.add({std::byte{0}});
    for (int level = 1; level < deepestLevelOf(file.info.shape); ++level) {
        std::array<ChunkEntry, quadrantCount> entries;
        entries.fill({1, 1, 0, 0, last});
        Bytes content;
        putIndex(content, entries, file.bytes.size());
        last = file.add(content);
    }
    file.addRoots({1, 1, 0, 0, last});
    const auto chunks = opened(file.sealed());
    ASSERT_TRUE(chunks) << chunks.error().message;
    const auto report = reportFile(*chunks);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, ErrorKind::BadInput);
    EXPECT_THAT(report.error().message, HasSubstr("hostile.chk: the index is damaged"));
}

TEST(HostileFile, AnIndexOfColoursThatGoesInCirclesIsRefusedInAReport) {
    HostileFile file;
    const BlockLocation first = addCircle(file, quadrantCount * colourEntryBytes,
                                          [](Bytes& content, const BlockLocation& other, std::uint64_t own) {
                                              for (int q = 0; q < quadrantCount; ++q)
                                                  putColourEntry(content, {other, 0}, own);
                                          });
    file.addRoots({1, 1, 0, 0, first});
    file.addColourRoots(first);
    const auto chunks = opened(file.sealed());
    ASSERT_TRUE(chunks) << chunks.error().message;
    const auto report = reportColours(*chunks);
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message, HasSubstr("hostile.chk: the index is damaged"));
}

TEST(HostileFile, AnIndexOfBlocksTooSmallForOneIsRefused) {
    HostileFile file;
    // One byte less than the shortest entry.
    const BlockLocation small{chunkFileHeaderBytes, 1 + 16 + checksumBytes};
    Bytes content(200);
    content[0] = std::byte{0b1111};
    file.add(content);
    file.addRoots({1, 1, 0, 0, small});
    const auto chunks = opened(file.sealed());
    ASSERT_TRUE(chunks) << chunks.error().message;
    const auto entries = chunks->readEntries({Face::PosX, 0, 0, 0}, small);
    ASSERT_FALSE(entries);
    EXPECT_THAT(entries.error().message, HasSubstr("too small"));
}

TEST(HostileFile, AnIndexOfMoreThanFourChunksIsRefused) {
    HostileFile file;
    Bytes content(200);
    content[0] = std::byte{0b10001};
    const BlockLocation block = file.add(content);
    file.addRoots({1, 1, 0, 0, block});
    const auto chunks = opened(file.sealed());
    ASSERT_TRUE(chunks) << chunks.error().message;
    const auto entries = chunks->readEntries({Face::PosX, 0, 0, 0}, block);
    ASSERT_FALSE(entries);
    EXPECT_THAT(entries.error().message, HasSubstr("names chunks that it does not hold"));
}

// With such numbers, an index would be longer than the part of a block that readEntries reads.
TEST(HostileFile, NumbersThatAreLongerThanTheyNeedToBeAreRefusedByBothReaders) {
    HostileFile file;
    const BlockLocation children = file.add(Bytes(200));
    const auto zeroOfTenBytes = [](Bytes& to) {
        to.insert(to.end(), 9, std::byte{0x80});
        to.push_back(std::byte{0});
    };
    Bytes content = {std::byte{0b1111}};
    ByteWriter out(content);
    for (int q = 0; q < quadrantCount; ++q) {
        out.put(1.0f);
        out.put(1.0f);
        zeroOfTenBytes(content);  // lowest step
        zeroOfTenBytes(content);  // range of steps
        out.putVariable(children.size);
        out.put(static_cast<std::uint32_t>(file.bytes.size() - children.offset));
        out.put(std::uint16_t{0});
    }
    const std::vector<std::int32_t> flat(static_cast<std::size_t>(chunkVertexCount(file.info.shape)));
    const auto side = static_cast<std::size_t>(2 * chunkCells(file.info.shape) + 1);
    encodeRefinement(std::vector<std::int32_t>(side * side), chunkCells(file.info.shape), 1, 0, content);
    ASSERT_GT(content.size(), largestIndexBytes);
    const BlockLocation block = file.add(content);
    file.addRoots({1, 1, 0, 0, block});
    const auto chunks = opened(file.sealed());
    ASSERT_TRUE(chunks) << chunks.error().message;
    const ChunkId root{Face::NegZ, 0, 0, 0};  // the last one, whose key seals the block that all share
    const auto read = chunks->readChildren(root, block, flat);
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("its index entry is out of range"));
    const auto entries = chunks->readEntries(root, block);
    ASSERT_FALSE(entries);
    EXPECT_EQ(entries.error().message, read.error().message);
}

TEST(HostileFile, ChildrenBelowTheDeepestLevelAreRefused) {
    HostileFile file;
    file.info.shape.faceCellsLog2 = file.info.shape.chunkCellsLog2 + 1;
    std::array<ChunkEntry, quadrantCount> entries;
    entries[2] = {1, 1, 0, 0, {chunkFileHeaderBytes, 100}};
    Bytes content;
    putIndex(content, entries, 1000);
    content.resize(2000);
    const BlockLocation block = file.add(content);
    file.addRoots({1, 1, 0, 0, block});
    const auto chunks = opened(file.sealed());
    ASSERT_TRUE(chunks) << chunks.error().message;
    const ChunkId root{Face::NegZ, 0, 0, 0};  // the last one, whose key seals the block that all share
    const std::vector<std::int32_t> flat(static_cast<std::size_t>(chunkVertexCount(file.info.shape)));
    const auto children = chunks->readChildren(root, block, flat);
    ASSERT_FALSE(children);
    EXPECT_THAT(children.error().message, HasSubstr("children below the deepest level"));
    const auto index = chunks->readEntries(root, block);
    ASSERT_FALSE(index);
    EXPECT_THAT(index.error().message, HasSubstr("children below the deepest level"));
}

TEST(HostileFile, CountsOfChunksThatNoTreeOfTheShapeHasAreRefused) {
    for (const auto& [chunks, coarsestLeafLevel] : std::vector<std::pair<std::uint64_t, int>>{
             {0, 0}, {7, 0}, {6, 1}, {26, 2}, {34, 0}, {~std::uint64_t{0}, 0}, {30, 3}}) {
        HostileFile file;
        file.info.shape.faceCellsLog2 = file.info.shape.chunkCellsLog2 + 1;  // at most 30 chunks
        file.info.chunks = chunks;
        file.info.coarsestLeafLevel = coarsestLeafLevel;
        file.addRoots({});
        const auto read = opened(file.sealed());
        ASSERT_FALSE(read) << chunks;
        EXPECT_THAT(read.error().message, HasSubstr("hostile.chk: invalid header")) << chunks;
    }
    HostileFile file;
    file.info.shape.faceCellsLog2 = file.info.shape.chunkCellsLog2 + 1;
    file.info.chunks = 22;
    file.addRoots({});
    EXPECT_TRUE(opened(file.sealed()));
}

// The checksums match, so the error that names the file comes from the check of the blocks' contents.
TEST(HostileFile, RootsThatContradictThemselvesAreRefusedInTheFilesName) {
    HostileFile file;
    file.info.maxStep = 10;
    const BlockLocation children = file.add(Bytes(200));
    file.addRoots({1, 1, 0, 5, children}, 7);
    auto chunks = opened(file.sealed());
    ASSERT_TRUE(chunks) << chunks.error().message;
    auto source = planetSource(*std::move(chunks));
    ASSERT_TRUE(source) << source.error().message;
    const auto planet = Planet::open(*std::move(source), {});
    ASSERT_FALSE(planet);
    EXPECT_THAT(planet.error().message, HasSubstr("hostile.chk: chunk x_pos/0/0/0: heights"));
}

// Reading from some of them would wait for ever, or never end.
TEST(HostileFile, RawFacesThatAreNoFilesAreRefused) {
    const tests::TemporaryFolder folder;
    for (const Face face : allFaces)
        std::ofstream(folder / fmt::format("face_{}.raw", faceName(face))) << std::string(25, 'a');
    const auto path = folder / "face_z_pos.raw";
    ASSERT_TRUE(openHeightSource(path, {}));
    const std::vector<std::function<void()>> replacements = {
        [&] { ASSERT_EQ(mkfifo(path.c_str(), 0600), 0); },
        [&] { std::filesystem::create_directory(path); },
        [&] { std::filesystem::create_symlink("/dev/zero", path); },
        [&] { std::filesystem::create_symlink(path, path); },
        [&] { std::ofstream(path).close(); },
    };
    for (std::size_t i = 0; i < replacements.size(); ++i) {
        std::filesystem::remove(path);
        replacements[i]();
        const auto source = openHeightSource(path, {});
        ASSERT_FALSE(source) << i;
        EXPECT_THAT(source.error().message, HasSubstr("face_z_pos.raw")) << i;
    }
}

}  // namespace
}  // namespace planet
