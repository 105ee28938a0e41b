#include "app/base/new_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "app/base/picture.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using tests::contentOf;

std::tm someTime() {
    std::tm time{};
    time.tm_year = 126;
    time.tm_mon = 10;
    time.tm_mday = 26;
    time.tm_hour = 16;
    time.tm_min = 5;
    time.tm_sec = 9;
    return time;
}

TEST(NewFile, isNamedByTheTimeAndNeverTakesAnother) {
    const tests::TemporaryFolder folder;
    const auto first = newTimedFile(folder.path(), someTime(), "edge gaps", "csv");
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_EQ(first->filename(), "worldy 2026-11-26 16.05.09 edge gaps.csv");
    std::ofstream(*first) << "kept";
    const auto second = newTimedFile(folder.path(), someTime(), "edge gaps", "csv");
    ASSERT_TRUE(second);
    EXPECT_EQ(second->filename(), "worldy 2026-11-26 16.05.09 edge gaps 2.csv");
    EXPECT_EQ(contentOf(*first), "kept");
}

TEST(NewFile, aFolderIsNewToo) {
    const tests::TemporaryFolder folder;
    const auto first = newTimedFolder(folder.path(), someTime(), "report");
    const auto second = newTimedFolder(folder.path(), someTime(), "report");
    ASSERT_TRUE(first && second);
    EXPECT_TRUE(std::filesystem::is_directory(*second));
    EXPECT_NE(*first, *second);
}

TEST(NewFile, aMissingFolderIsAnErrorThatNamesIt) {
    const tests::TemporaryFolder folder;
    const auto file = writeNewTextFile(folder / "none", "x", "csv", "text");
    ASSERT_FALSE(file);
    EXPECT_NE(file.error().message.find("none"), std::string::npos);
}

TEST(PartOfPicture, isCutOffAtTheBorders) {
    Picture picture{3, 2, {}};
    for (std::uint8_t i = 0; i < 18; ++i) picture.rgb.push_back(i);
    const Picture part = partOf(picture, 1, 1, 5, 5);
    EXPECT_EQ(part.width, 2);
    EXPECT_EQ(part.height, 1);
    EXPECT_EQ(part.rgb, (std::vector<std::uint8_t>{12, 13, 14, 15, 16, 17}));
    EXPECT_TRUE(partOf(picture, 4, 0, 2, 2).rgb.empty());
    EXPECT_EQ(partOf(picture, -1, -1, 2, 2).rgb, (std::vector<std::uint8_t>{0, 1, 2}));
}

}  // namespace
}  // namespace worldy
