#include "ui/model/palette_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "ui/model/key_names.h"

namespace worldy::ui {
namespace {

using testing::ElementsAre;

const std::vector<PaletteEntry> entries = {
    {.kind = PaletteKind::Command, .title = "Freeze LOD", .also = "freeze_lod"},
    {.kind = PaletteKind::Panel, .title = "LOD"},
    {.kind = PaletteKind::Setting, .title = "Tolerance τ", .also = "lod.tau_px"},
    {.kind = PaletteKind::Setting, .title = "Fade", .also = "lod.fade_s"}};

std::vector<std::string> titles(std::string_view query, const std::vector<std::string>& recent = {}) {
    std::vector<std::string> shown;
    for (const PaletteRow& row : paletteRows(query, entries, recent))
        shown.push_back(entries[row.entry].title);
    return shown;
}

TEST(PaletteSearch, theEmptyQueryListsRecentChoicesFirst) {
    EXPECT_THAT(titles(""), ElementsAre("Freeze LOD", "LOD", "Tolerance τ", "Fade"));
    EXPECT_THAT(titles("", {"setting/lod.fade_s", "panel/LOD"}),
                ElementsAre("Fade", "LOD", "Freeze LOD", "Tolerance τ"));
}

TEST(PaletteSearch, hiddenNamesAreSearchedAfterTitles) {
    EXPECT_THAT(titles("tau"), ElementsAre("Tolerance τ"));
    EXPECT_THAT(titles("lod"), ElementsAre("LOD", "Freeze LOD", "Tolerance τ", "Fade"));
}

TEST(PaletteSearch, theMatchBeatsWhatIsRecent) {
    EXPECT_EQ(titles("lod", {"setting/lod.tau_px"}).front(), "LOD");
}

TEST(PaletteSearch, whatIsTypedOutIsTheFirst) {
    std::vector<PaletteEntry> typed = entries;
    typed.push_back({.kind = PaletteKind::Chunk, .title = "y_pos/4/6/13", .isTyped = true});
    const auto rows = paletteRows("lod", typed, {});
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows.front().entry, 4u);
}

TEST(PaletteSearch, onlyLettersOfTheTitleAreMarked) {
    const auto rows = paletteRows("tau", entries, {});
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_TRUE(rows[0].matched.empty());
    EXPECT_THAT(paletteRows("tol", entries, {})[0].matched, ElementsAre(TextPart{0, 3}));
}

TEST(PaletteSearch, aRecentChoiceMovesToTheFrontAndTheOldestLeaves) {
    std::vector<std::string> recent;
    for (int i = 0; i < 12; ++i) remember(recent, std::to_string(i));
    EXPECT_EQ(recent.size(), mostRecent);
    EXPECT_EQ(recent.front(), "11");
    remember(recent, "5");
    EXPECT_EQ(recent.front(), "5");
    EXPECT_EQ(recent.size(), mostRecent);
}

TEST(KeyNames, aTextNamesTheKeyThatTheCommandHas) {
    setKeyNames({{"freeze_lod", "F3"}, {"overlay.cube", "F4"}});
    EXPECT_EQ(withKey("Freeze", "freeze_lod"), "Freeze (F3)");
    EXPECT_EQ(keyOf("overlay.cube"), "F4");
    EXPECT_EQ(withKey("Quit", "quit"), "Quit");
    setKeyNames({});
    EXPECT_EQ(withKey("Freeze", "freeze_lod"), "Freeze");
}

}  // namespace
}  // namespace worldy::ui
