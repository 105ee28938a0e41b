#include "ui/panels/log/log_links.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace worldy::ui {
namespace {

TEST(LogLinks, aChunkIsFoundWhereverItStands) {
    const planet::ChunkId id{planet::Face::PosZ, 3, 1, 2};
    EXPECT_EQ(chunkNamedIn("z_pos/3/1/2"), id);
    EXPECT_EQ(chunkNamedIn("earth.chk: chunk z_pos/3/1/2: the checksum is wrong"), id);
    EXPECT_EQ(chunkNamedIn("(z_pos/3/1/2)"), id);
}

TEST(LogLinks, whatIsNoChunkIsNotTakenForOne) {
    EXPECT_FALSE(chunkNamedIn(""));
    EXPECT_FALSE(chunkNamedIn("opened /data/earth.chk"));
    EXPECT_FALSE(chunkNamedIn("z_pos/3/8/2"));  // level 3 has 8 columns
    EXPECT_FALSE(chunkNamedIn("xz_pos/3/1/2"));
    EXPECT_FALSE(chunkNamedIn("z_pos/3/1"));
}

TEST(LogLinks, aTileOfColourIsNoChunk) {
    const planet::ChunkId id{planet::Face::PosZ, 3, 1, 2};
    constexpr const char* text = "earth.chk: the block of colour tile z_pos/3/1/2 is damaged";
    EXPECT_FALSE(chunkNamedIn(text));
    EXPECT_EQ(colourTileNamedIn(text), id);
    EXPECT_FALSE(colourTileNamedIn("earth.chk: the block of chunk z_pos/3/1/2 is damaged"));
    EXPECT_EQ(chunkNamedIn("colour tile y_pos/0/0/0 and chunk z_pos/3/1/2"), id);
}

TEST(LogLinks, theFirstOfTwoChunksCounts) {
    EXPECT_EQ(chunkNamedIn("w_pos/1/0/0 beside x_neg/1/0/1 and y_pos/0/0/0"),
              (planet::ChunkId{planet::Face::NegX, 1, 0, 1}));
}

TEST(LogLinks, aFileIsFoundWithBlanksInItsName) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "two words.chk";
    std::ofstream(file) << "x";
    EXPECT_EQ(fileNamedIn("opened " + file.string() + ", 5 MiB"), file);
    EXPECT_EQ(fileNamedIn(file.string() + ": broken"), file);
    EXPECT_EQ(fileNamedIn("wrote '" + file.string() + "'"), file);
}

TEST(LogLinks, aFileThatIsNotThereIsNoLink) {
    const tests::TemporaryFolder folder;
    EXPECT_FALSE(fileNamedIn(""));
    EXPECT_FALSE(fileNamedIn("/"));
    EXPECT_FALSE(fileNamedIn("cannot open " + (folder.path() / "gone.chk").string()));
    EXPECT_FALSE(fileNamedIn("chunk z_pos/3/1/2 took 1/2 s"));
}

}  // namespace
}  // namespace worldy::ui
