#include "ui/panels/log/log_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace worldy::ui {
namespace {

using testing::ElementsAre;

const std::deque<LogLine> lines = {{LogLevel::Info, "14:03:22", "opened Earth.chk"},
                                   {LogLevel::Warning, "14:03:23", "slow disk"},
                                   {LogLevel::Error, "14:03:24", "earth.chk: chunk z_pos/1/0/0 is broken"},
                                   {LogLevel::Debug, "14:03:25", "done"}};
constexpr std::array allLevels{true, true, true, true};

TEST(LogFilter, anEmptyFilterShowsAllLines) {
    EXPECT_THAT(filteredLines(lines, "", allLevels), ElementsAre(0u, 1u, 2u, 3u));
}

TEST(LogFilter, caseDoesNotMatter) {
    EXPECT_THAT(filteredLines(lines, "EARTH", allLevels), ElementsAre(0u, 2u));
}

TEST(LogFilter, levelsAreShownOneByOne) {
    EXPECT_THAT(filteredLines(lines, "", std::array{false, false, true, false}), ElementsAre(1u));
    EXPECT_THAT(filteredLines(lines, "e", std::array{true, true, false, false}), ElementsAre(0u, 3u));
}

TEST(LogFilter, whatNoLineHoldsShowsNone) {
    EXPECT_TRUE(filteredLines(lines, "mars", allLevels).empty());
}

TEST(LogFilter, aCopiedLineSaysTimeAndLevel) {
    EXPECT_EQ(lineText(lines[1]), "14:03:23 warning  slow disk");
}

}  // namespace
}  // namespace worldy::ui
