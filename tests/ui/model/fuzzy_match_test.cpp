#include "ui/model/fuzzy_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace worldy::ui {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

int scoreOf(const char* query, const char* text) {
    const auto match = fuzzyMatch(query, text);
    return match ? match->score : -1'000'000;
}

TEST(FuzzyMatch, lettersMustComeInTheirOrder) {
    EXPECT_TRUE(fuzzyMatch("frl", "Freeze LOD"));
    EXPECT_FALSE(fuzzyMatch("lfr", "Freeze LOD"));
    EXPECT_FALSE(fuzzyMatch("freezes", "Freeze LOD"));
    EXPECT_FALSE(fuzzyMatch("a", ""));
}

TEST(FuzzyMatch, theEmptyQueryMatchesAll) {
    EXPECT_EQ(scoreOf("", "Freeze LOD"), 0);
    EXPECT_THAT(fuzzyMatch("  ", "Freeze LOD")->parts, IsEmpty());
}

TEST(FuzzyMatch, wordStartsRankHigher) {
    EXPECT_GT(scoreOf("hp", "Highlight pairs"), scoreOf("hp", "Sharpen"));
    EXPECT_GT(scoreOf("tp", "lod.tau_px"), scoreOf("tp", "lod.tapped"));
}

TEST(FuzzyMatch, consecutiveLettersRankHigher) {
    EXPECT_GT(scoreOf("mor", "Morph range"), scoreOf("mor", "Mean of rays"));
    EXPECT_GT(scoreOf("log", "Log"), scoreOf("log", "Level of a gap"));
}

TEST(FuzzyMatch, shorterTextsRankHigher) {
    EXPECT_GT(scoreOf("trace", "Trace"), scoreOf("trace", "Trace findings and more"));
}

TEST(FuzzyMatch, theBestPlaceIsMarkedNotTheFirst) {
    // The first l is in "Tolerance", but "level" begins a word.
    EXPECT_THAT(fuzzyMatch("level", "Tolerance level")->parts, ElementsAre(TextPart{10, 5}));
    EXPECT_THAT(fuzzyMatch("fl", "Freeze LOD")->parts, ElementsAre(TextPart{0, 1}, TextPart{7, 1}));
}

TEST(FuzzyMatch, partsAreWholeCharacters) {
    EXPECT_THAT(fuzzyMatch("τ", "Tolerance τ")->parts, ElementsAre(TextPart{10, 2}));
    EXPECT_THAT(fuzzyMatch("eτ", "Tolerance τ")->parts, ElementsAre(TextPart{8, 1}, TextPart{10, 2}));
}

TEST(FuzzyMatch, spacesOfTheQueryDoNotMatter) {
    EXPECT_EQ(scoreOf("freeze lod", "Freeze LOD"), scoreOf("freezelod", "Freeze LOD"));
}

TEST(FuzzyMatch, distantLettersStillMatch) {
    const std::string text = "a" + std::string(200, '.') + "z";
    EXPECT_TRUE(fuzzyMatch("az", text));
}

TEST(FuzzyMatch, longTextsAreCut) {
    EXPECT_FALSE(fuzzyMatch("z", std::string(100'000, 'a') + "z"));
    EXPECT_TRUE(fuzzyMatch(std::string(100'000, 'a'), std::string(100'000, 'a')));
    EXPECT_FALSE(fuzzyMatch("\xff", "\xfe\x80"));
}

}  // namespace
}  // namespace worldy::ui
