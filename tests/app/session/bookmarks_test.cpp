#include "app/session/bookmarks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

std::vector<std::string> namesOf(const Bookmarks& bookmarks, bool shipped) {
    std::vector<std::string> names;
    for (const ui::Bookmark& bookmark : bookmarks.list) {
        if (bookmark.shipped == shipped) names.push_back(bookmark.name);
    }
    return names;
}

void writeBookmarks(const fs::path& file, const char* text) {
    std::ofstream(file) << text;
}

constexpr std::size_t shippedCount = 9;

TEST(Bookmarks, withoutAFileThereAreTheShippedOnes) {
    const tests::TemporaryFolder folder;
    const Bookmarks bookmarks = loadBookmarks(folder / "none.toml");
    EXPECT_EQ(bookmarks.problem, "");
    EXPECT_THAT(namesOf(bookmarks, true),
                testing::ElementsAre("Aconcagua", "Vancouver", "Himalaya", "Andes", "Grand Canyon",
                                     "Mariana Trench", "North Pole", "South Pole", "Cube corner"));
    EXPECT_TRUE(namesOf(bookmarks, false).empty());
}

TEST(Bookmarks, whatIsAddedIsThereTheNextTime) {
    const tests::TemporaryFolder folder;
    const fs::path file = folder / "new folder/bookmarks.toml";
    Bookmarks bookmarks = loadBookmarks(file);
    const planet::CameraPose pose{46.123456789, -6.9, 4321.5, 123, -7};
    ASSERT_TRUE(addBookmark(bookmarks, "  Mont \"Blanc\" \u00e9 ", pose));
    const Bookmarks again = loadBookmarks(file);
    EXPECT_EQ(again.problem, "");
    ASSERT_EQ(namesOf(again, false), std::vector<std::string>{"Mont \"Blanc\" \u00e9"});
    const planet::CameraPose& kept = again.list.back().pose;
    EXPECT_EQ(kept.latitudeDeg, pose.latitudeDeg);
    EXPECT_EQ(kept.longitudeDeg, pose.longitudeDeg);
    EXPECT_EQ(kept.altitudeM, pose.altitudeM);
    EXPECT_EQ(kept.headingDeg, pose.headingDeg);
    EXPECT_EQ(kept.pitchDeg, pose.pitchDeg);
}

TEST(Bookmarks, theSameNameReplacesAndRemovingForgets) {
    const tests::TemporaryFolder folder;
    const fs::path file = folder / "bookmarks.toml";
    Bookmarks bookmarks = loadBookmarks(file);
    ASSERT_TRUE(addBookmark(bookmarks, "one", {.latitudeDeg = 1}));
    ASSERT_TRUE(addBookmark(bookmarks, "two", {.latitudeDeg = 2}));
    ASSERT_TRUE(addBookmark(bookmarks, "one", {.latitudeDeg = 3}));
    EXPECT_THAT(namesOf(bookmarks, false), testing::ElementsAre("one", "two"));
    const auto again = loadBookmarks(file);
    ASSERT_EQ(namesOf(again, false)[0], "one");
    EXPECT_EQ(again.list[again.list.size() - 2].pose.latitudeDeg, 3);
    ASSERT_TRUE(removeBookmark(bookmarks, "one"));
    EXPECT_THAT(namesOf(loadBookmarks(file), false), testing::ElementsAre("two"));
}

TEST(Bookmarks, shippedOnesStayAsTheyAre) {
    const tests::TemporaryFolder folder;
    Bookmarks bookmarks = loadBookmarks(folder / "bookmarks.toml");
    const planet::Result<void> added = addBookmark(bookmarks, "Andes", {});
    ASSERT_FALSE(added);
    EXPECT_THAT(added.error().message, HasSubstr("is built-in"));
    EXPECT_FALSE(removeBookmark(bookmarks, "Andes"));
    EXPECT_FALSE(removeBookmark(bookmarks, "no such"));
    EXPECT_FALSE(addBookmark(bookmarks, "   ", {}));
    EXPECT_FALSE(addBookmark(bookmarks, std::string(61, 'x'), {}));
    EXPECT_FALSE(fs::exists(folder / "bookmarks.toml"));
}

TEST(Bookmarks, aBadFileIsToldAndNeverWrittenOver) {
    const tests::TemporaryFolder folder;
    const fs::path file = folder / "bookmarks.toml";
    const char* good =
        "[[bookmark]]\nname = \"a\"\nlatitude_deg = 1\nlongitude_deg = 2\naltitude_m = 3\nheading_deg = 4\n";
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"[[bookmark]\n", "line 1: not TOML"},
        {good, "line 1: pitch_deg is missing; expected a number in [-90, 90]°"},
        {std::string(good) + "pitch_deg = 95\n", "line 7: pitch_deg is 95; expected a number in [-90, 90]°"},
        {std::string(good) + "pitch_deg = nan\n", "line 7: pitch_deg is nan"},
        {std::string(good) + "pitch_deg = 5\nroll_deg = 1\n",
         "line 8: roll_deg is unknown; expected name, latitude_deg"},
        {"[[bookmark]]\nlatitude_deg = 1\n", "name is missing"},
        {"bookmark = [1]\n", "line 1: not a table"},
        {"places = 1\n", "line 1: places is unknown; expected [[bookmark]] tables"},
    };
    for (const auto& [text, message] : cases) {
        writeBookmarks(file, text.c_str());
        Bookmarks bookmarks = loadBookmarks(file);
        EXPECT_THAT(bookmarks.problem, HasSubstr(file.string()));
        EXPECT_THAT(bookmarks.problem, HasSubstr(message));
        EXPECT_EQ(bookmarks.list.size(), shippedCount);
        EXPECT_FALSE(addBookmark(bookmarks, "mine", {}));
        EXPECT_EQ(tests::contentOf(file), text);
    }
}

TEST(Bookmarks, aFileThatCannotBeWrittenChangesNothing) {
    Bookmarks bookmarks = loadBookmarks("/proc/none/bookmarks.toml");
    const planet::Result<void> added = addBookmark(bookmarks, "mine", {});
    ASSERT_FALSE(added);
    EXPECT_THAT(added.error().message, HasSubstr("/proc/none/bookmarks.toml"));
    EXPECT_EQ(bookmarks.list.size(), shippedCount);
}

}  // namespace
}  // namespace worldy
