#include "planet/format/chunk_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "planet/bake/bake.h"
#include "planet/bake/file_report.h"
#include "planet/base/little_endian.h"
#include "planet/format/chunk_file_format.h"
#include "tests/support/open_bytes.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using test::openBytes;

using Bytes = std::vector<std::byte>;

Bytes bakedBytes() {
    const tests::TemporaryFolder folder;
    const auto path = folder / "hills.chk";
    EXPECT_TRUE(bake(test::hillsSource(), BakeSettings{.chunkSize = 17}, path));
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    Bytes bytes(text.size());
    std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

// A baked file in memory, to be damaged; baked once.
class ChunkFileTest : public testing::Test {
protected:
    static void SetUpTestSuite() { whole_ = new Bytes(bakedBytes()); }
    static void TearDownTestSuite() { delete whole_; }
    static const Bytes& whole() { return *whole_; }

private:
    static Bytes* whole_;
};
Bytes* ChunkFileTest::whole_ = nullptr;

std::string messageOf(const Bytes& bytes) {
    const auto file = openBytes(bytes);
    return file ? "" : file.error().message;
}

// The whole file's header, changed and given a right checksum again.
Bytes withHeader(const Bytes& bytes, const std::function<void(ChunkFileInfo&)>& change) {
    auto info = openBytes(bytes)->info();
    change(info);
    Bytes changed = bytes;
    const auto header = headerBytes(info, bytes.size());
    std::copy(header.begin(), header.end(), changed.begin());
    return changed;
}

TEST_F(ChunkFileTest, emptyAndTinyFilesAreRefusedBySize) {
    EXPECT_NE(messageOf({}).find("test.chk"), std::string::npos);
    EXPECT_NE(messageOf({}).find("empty"), std::string::npos);
    EXPECT_NE(messageOf(Bytes(100)).find("truncated"), std::string::npos);
}

TEST_F(ChunkFileTest, wrongMagicIsRefused) {
    Bytes bytes = whole();
    bytes[0] = std::byte{'X'};
    EXPECT_NE(messageOf(bytes).find("not a chunk file"), std::string::npos);
}

TEST_F(ChunkFileTest, newerVersionSaysToUpdateTheProgramOrBakeAgain) {
    Bytes bytes = whole();
    bytes[8] = std::byte{7};
    EXPECT_NE(messageOf(bytes).find("version: 7 is not supported; expected 6: update"), std::string::npos);
    EXPECT_NE(messageOf(bytes).find("bake the source again"), std::string::npos);
}

TEST_F(ChunkFileTest, olderVersionsSayToBakeAgain) {
    Bytes bytes = whole();
    for (std::uint8_t version = 1; version < chunkFileVersion; ++version) {
        bytes[8] = std::byte{version};
        EXPECT_NE(messageOf(bytes).find("is not supported; expected 6: bake the source again"),
                  std::string::npos)
            << version;
    }
}

TEST_F(ChunkFileTest, everyFlippedBitOfTheHeaderIsSeen) {
    Bytes bytes = whole();
    for (std::size_t bit = 0; bit < 8 * chunkFileHeaderBytes; ++bit) {
        const std::byte mask{static_cast<unsigned char>(1u << (bit % 8))};
        bytes[bit / 8] ^= mask;
        EXPECT_FALSE(openBytes(bytes)) << "bit " << bit;
        bytes[bit / 8] ^= mask;
    }
    EXPECT_TRUE(openBytes(bytes));
}

TEST_F(ChunkFileTest, aWorldFileIsSaidToNeedABake) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path world = folder.path() / "earth.toml";
    std::ofstream(world) << "[heights]\n";
    const auto opened = ChunkFile::open(world);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().message,
              world.string() +
                  ": is a .toml file; expected a chunk file (.chk). A world file must "
                  "be baked first: worldy bake " +
                  world.string() + " -o FILE.chk");
}

TEST_F(ChunkFileTest, truncatedFileIsRefusedAtEveryLength) {
    for (std::size_t size = 0; size < whole().size(); size += 977) {
        const Bytes cut(whole().begin(), whole().begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_NE(messageOf(cut).find("truncated") != std::string::npos || size == 0, false) << size;
    }
}

TEST_F(ChunkFileTest, absurdShapesAreRefusedThoughTheChecksumIsRight) {
    const std::vector<std::function<void(ChunkFileInfo&)>> absurdities = {
        [](ChunkFileInfo& info) { info.shape.faceCellsLog2 = 60; },
        [](ChunkFileInfo& info) { info.shape.faceCellsLog2 = 3; },
        [](ChunkFileInfo& info) { info.shape.chunkCellsLog2 = 30; },
        [](ChunkFileInfo& info) { info.shape.chunkCellsLog2 = 0; },
        [](ChunkFileInfo& info) { info.shape.radiusM = -1; },
        [](ChunkFileInfo& info) { info.shape.radiusM = std::numeric_limits<double>::quiet_NaN(); },
        [](ChunkFileInfo& info) { info.shape.radiusM = std::numeric_limits<double>::infinity(); },
        [](ChunkFileInfo& info) { info.shape.quantumM = 0; },
        [](ChunkFileInfo& info) { info.shape.baseHeightM = std::numeric_limits<double>::quiet_NaN(); },
        [](ChunkFileInfo& info) { info.shape.baseHeightM = -9e6; },
        [](ChunkFileInfo& info) { info.minStep = 100, info.maxStep = -100; },
    };
    for (std::size_t i = 0; i < absurdities.size(); ++i) {
        const std::string message = messageOf(withHeader(whole(), absurdities[i]));
        EXPECT_NE(message.find("test.chk"), std::string::npos) << "absurdity " << i;
    }
    EXPECT_TRUE(openBytes(withHeader(whole(), [](ChunkFileInfo&) {})));
}

TEST_F(ChunkFileTest, absurdRootLocationsAreRefusedWhenRead) {
    for (const BlockLocation location :
         {BlockLocation{0, 10}, BlockLocation{511, 10}, BlockLocation{512, 0}, BlockLocation{512, 0xFFFFFFFF},
          BlockLocation{~std::uint64_t{0}, 100}, BlockLocation{~std::uint64_t{0} - 50, 100},
          BlockLocation{whole().size(), 1}, BlockLocation{whole().size() - 5, 100}}) {
        const Bytes bytes = withHeader(whole(), [&](ChunkFileInfo& info) { info.roots[2] = location; });
        const auto file = openBytes(bytes);
        ASSERT_TRUE(file);
        const auto root = file->readRoot(Face::PosY);
        ASSERT_FALSE(root);
        EXPECT_EQ(root.error().kind, ErrorKind::BadInput);
        EXPECT_NE(root.error().message.find("y_pos/0/0/0"), std::string::npos);
        EXPECT_TRUE(file->readRoot(Face::PosX));
    }
}

TEST_F(ChunkFileTest, flippedBitAnywhereInTheBlocksIsFoundByVerify) {
    Bytes bytes = whole();
    std::mt19937 random(3);
    std::uniform_int_distribution<std::size_t> position(chunkFileHeaderBytes, bytes.size() - 1);
    for (int i = 0; i < 40; ++i) {
        const std::size_t at = position(random);
        bytes[at] ^= std::byte{0x10};
        const auto report = verifyFile(*openBytes(bytes), nullptr);
        ASSERT_TRUE(report);
        EXPECT_GT(report->problemCount, 0u) << "byte " << at;
        bytes[at] ^= std::byte{0x10};
    }
    EXPECT_EQ(verifyFile(*openBytes(bytes), nullptr)->problemCount, 0u);
}

TEST_F(ChunkFileTest, blockReadForAnotherChunkIsRefused) {
    const auto file = openBytes(whole());
    const auto root = file->readRoot(Face::PosX);
    ASSERT_TRUE(root);
    EXPECT_TRUE(file->readChildren(root->id, root->children, root->heights));
    const auto stray = file->readChildren({Face::NegX, 0, 0, 0}, root->children, root->heights);
    ASSERT_FALSE(stray);
    EXPECT_NE(stray.error().message.find("checksum"), std::string::npos);
}

TEST_F(ChunkFileTest, childPointingForwardOrAtItselfIsRefused) {
    // A root block whose entry says that its children lie at a wrapped distance, with a right checksum.
    const auto file = openBytes(whole());
    const BlockLocation location = file->info().roots[0];
    for (const std::uint64_t distance : {std::uint64_t{0}, location.offset + 1, ~std::uint64_t{0}}) {
        Bytes bytes = whole();
        const auto at = static_cast<std::size_t>(location.offset);
        for (std::size_t i = 0; i < 8; ++i) bytes[at + 17 + i] = static_cast<std::byte>(distance >> (8 * i));
        const std::span block(bytes.data() + at, location.size);
        std::vector<std::byte> sum;
        ByteWriter(sum).put(rootChecksum(block.first(block.size() - checksumBytes), Face::PosX));
        std::copy(sum.begin(), sum.end(), block.end() - checksumBytes);
        const auto root = openBytes(bytes)->readRoot(Face::PosX);
        EXPECT_TRUE(!root || !openBytes(bytes)->readChildren(root->id, root->children, root->heights))
            << distance;
    }
}

TEST_F(ChunkFileTest, readErrorsAreHandedOnNotSwallowed) {
    const auto file = ChunkFile::open("bad.chk", whole().size(),
                                      [](std::uint64_t offset, std::span<std::byte> out) -> Result<void> {
                                          if (offset > 0)
                                              return ioError("bad.chk: reading failed: disk on fire");
                                          static const Bytes bytes = bakedBytes();
                                          std::copy_n(bytes.begin(), out.size(), out.begin());
                                          return {};
                                      });
    ASSERT_TRUE(file);
    const auto root = file->readRoot(Face::PosX);
    ASSERT_FALSE(root);
    EXPECT_EQ(root.error().kind, ErrorKind::Io);
}

TEST(ChunkFileOnDisk, missingFileAndFolderAreErrorsThatNameThem) {
    const tests::TemporaryFolder folder;
    const auto missing = ChunkFile::open(folder / "none.chk");
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("none.chk"), std::string::npos);
    EXPECT_FALSE(ChunkFile::open(folder.path()));
}

TEST(ChunkFileFormat, longSourceNamesAreCutBetweenCharacters) {
    ChunkFileInfo info;
    info.source = std::string(199, 'a') + "\xC3\xA9\xC3\xA9";  // the 200th byte starts a two-byte letter
    const auto header = headerBytes(info, 4096);
    const auto read = infoFromHeader(header, "x", 4096);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->source, std::string(199, 'a'));
}

}  // namespace
}  // namespace planet
