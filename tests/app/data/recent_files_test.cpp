#include "app/data/recent_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::TemporaryFolder;
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
namespace fs = std::filesystem;

TEST(RecentFiles, TheNewestComesFirstAndNoneTwice) {
    std::vector<fs::path> recent;
    for (const char* file : {"/a", "/b", "/c", "/a", "/x/../b"}) addRecentFile(recent, file);
    EXPECT_THAT(recent, ElementsAre("/b", "/a", "/c"));
    addRecentFile(recent, "here.chk");
    EXPECT_EQ(recent.front(), fs::current_path() / "here.chk");
}

TEST(RecentFiles, OnlyTheLastTenAreKept) {
    std::vector<fs::path> recent;
    for (int i = 0; i < 25; ++i) addRecentFile(recent, "/" + std::to_string(i));
    ASSERT_EQ(recent.size(), maxRecentFiles);
    EXPECT_EQ(recent.front(), "/24");
    EXPECT_EQ(recent.back(), "/15");
}

TEST(RecentFiles, WhatIsSavedIsLoadedAgain) {
    const TemporaryFolder folder;
    const std::vector<fs::path> recent = {"/with space/Erde ä.chk", "/caf\xe9.tif", "/c"};
    EXPECT_TRUE(saveRecentFiles(recent, folder / "new/recent.txt"));
    EXPECT_EQ(loadRecentFiles(folder / "new/recent.txt"), recent);
}

TEST(RecentFiles, APathWithALineBreakIsNotMistakenForTwo) {
    const TemporaryFolder folder;
    EXPECT_TRUE(saveRecentFiles({"/a\n/etc/passwd", "/b"}, folder / "recent.txt"));
    EXPECT_THAT(loadRecentFiles(folder / "recent.txt"), ElementsAre("/b"));
}

TEST(RecentFiles, HostileContentIsLeftOut) {
    const TemporaryFolder folder;
    EXPECT_THAT(loadRecentFiles(folder / "none.txt"), IsEmpty());
    EXPECT_THAT(loadRecentFiles(folder.path()), IsEmpty());
    const std::string nul("/with\0nul", 9);
    std::ofstream(folder / "bad.txt", std::ios::binary) << "relative\n\n"
                                                        << nul << "\n--option\n/good\n/good\n"
                                                        << std::string(1u << 20, '/');
    const std::vector<fs::path> bad = loadRecentFiles(folder / "bad.txt");
    ASSERT_FALSE(bad.empty());
    EXPECT_EQ(bad.front(), "/good");
    EXPECT_LE(bad.size(), 2u);
    std::ofstream many(folder / "many.txt");
    for (int i = 0; i < 1000; ++i) many << "/" << i << "\n";
    many.close();
    EXPECT_EQ(loadRecentFiles(folder / "many.txt").size(), maxRecentFiles);
}

TEST(RecentFiles, GoneFilesAreNotShownAndComeBackWhenTheyDo) {
    const TemporaryFolder folder;
    std::ofstream(folder / "there.chk").close();
    std::ofstream(folder / "faces_x_pos.raw").close();
    const std::vector<fs::path> recent = {folder / "gone.chk", folder / "there.chk", folder / "faces",
                                          folder.path(), "/nonexistent/folder/file"};
    EXPECT_THAT(shownRecentFiles(recent), ElementsAre(folder / "there.chk", folder / "faces"));
    std::ofstream(folder / "gone.chk").close();
    EXPECT_EQ(shownRecentFiles(recent).size(), 3u);
}

}  // namespace
}  // namespace worldy
