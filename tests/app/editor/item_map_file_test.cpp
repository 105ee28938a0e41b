#include "app/editor/item_map_file.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

TEST(ItemMapFile, aSymbolicLinkIsWrittenThrough) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path target = folder.path() / "target.txt";
    const std::filesystem::path link = folder.path() / "link.txt";
    std::ofstream(target) << "old";
    std::filesystem::create_symlink("target.txt", link);
    const std::array counters = {Counter{"frame", "7"}};
    writeItemMap(link, {}, counters);
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(tests::contentOf(target), "counter/frame\t7\n");
}

TEST(ItemMapFile, aLinkToNothingMakesTheFileThatItNames) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path link = folder.path() / "link.txt";
    std::filesystem::create_symlink("dangling.txt", link);
    writeItemMap(link, {}, std::array{Counter{"frame", "7"}});
    EXPECT_TRUE(std::filesystem::is_symlink(link));
    EXPECT_EQ(tests::contentOf(folder.path() / "dangling.txt"), "counter/frame\t7\n");
}

TEST(ItemMapFile, theFileKeepsItsMode) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "map.txt";
    std::ofstream(file) << "old";
    std::filesystem::permissions(file,
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    writeItemMap(file, {}, std::array{Counter{"frame", "7"}});
    EXPECT_EQ(std::filesystem::status(file).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
}

TEST(ItemMapFile, aScriptAsksForFramesByTheirNumber) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path map = folder.path() / "map.txt", ask = folder.path() / "map.txt.ask";
    EXPECT_EQ(askedFrame(map), 0);
    std::ofstream(ask) << "123\n";
    EXPECT_EQ(askedFrame(map), 123);
    for (const char* const notANumber : {"", "soon", "99999999999999999999999"}) {
        std::ofstream(ask) << notANumber;
        EXPECT_EQ(askedFrame(map), 0) << notANumber;
    }
}

}  // namespace
}  // namespace worldy
