#include "ui/model/text_filter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace worldy::ui {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TextFilter, eachWordMayBeInAnotherText) {
    EXPECT_TRUE(passes("z_pos EVICT", {"z_pos/3/1/2", "heights", "evicted"}));
    EXPECT_FALSE(passes("z_pos failed", {"z_pos/3/1/2", "heights", "evicted"}));
    EXPECT_TRUE(passes("", {"anything"}));
    EXPECT_TRUE(passes("   ", {"anything"}));
    EXPECT_FALSE(passes("a", {}));
}

TEST(TextFilter, hitsOfAllWordsAreInOrderAndDoNotOverlap) {
    EXPECT_THAT(hitsIn("Earth.chk is not earth", "earth"), ElementsAre(TextPart{0, 5}, TextPart{17, 5}));
    EXPECT_THAT(hitsIn("banana", "ana nan"), ElementsAre(TextPart{1, 5}));
    EXPECT_THAT(hitsIn("banana", "x"), IsEmpty());
    EXPECT_THAT(hitsIn("banana", ""), IsEmpty());
}

}  // namespace
}  // namespace worldy::ui
