// The page of a suggestion, as a picture.
#include "app/suggest/suggest_page.h"

#include <gtest/gtest.h>

#include <string>

namespace worldy {
namespace {

// Returns the pixels of a page with a title.
std::vector<std::uint8_t> pageTitled(const std::string& title) {
    SuggestPage page;
    page.title = title;
    const auto picture = drawSuggestPage(page);
    EXPECT_TRUE(picture) << picture.error().message;
    return picture ? picture->rgb : std::vector<std::uint8_t>();
}

TEST(SuggestPages, lettersThatTheFontCannotDrawAreDrawnAsThoseThatTheyAreMadeOf) {
    EXPECT_NE(pageTitled("Zurich.chk"), pageTitled("Z<rich.chk"));
    EXPECT_EQ(pageTitled("Z\u00fcrich.chk"), pageTitled("Zurich.chk"));
    EXPECT_EQ(pageTitled("\u03c4 = 3 px at 4\u00b0"), pageTitled("tau = 3 px at 4 deg"));
}

TEST(SuggestPages, otherLettersAndBytesThatAreNoTextAreDrawnAsQuestionMarks) {
    EXPECT_EQ(pageTitled("\u6771\u4eac.chk"), pageTitled("??.chk"));
    EXPECT_EQ(pageTitled("a\xff"
                         "b"),
              pageTitled("a?b"));
}

}  // namespace
}  // namespace worldy
