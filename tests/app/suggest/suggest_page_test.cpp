// The page of a suggestion, as a picture.
#include "app/suggest/suggest_page.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

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

// Returns whether a rectangle of a page is white.
bool isWhite(const Picture& page, int left, int top) {
    for (int row = top; row < page.height; ++row) {
        for (int i = 3 * (row * page.width + left); i < 3 * (row + 1) * page.width; ++i)
            if (page.rgb[static_cast<std::size_t>(i)] != 255) return false;
    }
    return true;
}

TEST(SuggestPages, longNotesStayAboveTheMargin) {
    SuggestPage page;
    for (int i = 0; i < 400; ++i) page.notes += "measured ";
    const auto picture = drawSuggestPage(page);
    ASSERT_TRUE(picture);
    EXPECT_TRUE(isWhite(*picture, 0, picture->height - 60));
    EXPECT_FALSE(isWhite(*picture, 0, picture->height - 100));
}

TEST(SuggestPages, whatFindsNoRoomIsLeftOut) {
    SuggestPage page;
    page.title = std::string(500, 'W');
    for (int i = 0; i < 900; ++i) page.notes += "measured ";
    page.paragraphs = {page.notes};
    page.tables = {{100, {"limit", std::string(300, 'm')}}};
    EXPECT_TRUE(drawSuggestPage(page));
}

TEST(SuggestPages, aLabelAtTheEndOfThePlotStaysInThePlot) {
    SuggestPage page;
    page.limitsCosts = true;
    page.points = {{2, 5, true, false, true}, {49.9, 2, true, true, false}};
    const auto picture = drawSuggestPage(page);
    ASSERT_TRUE(picture);
    EXPECT_TRUE(isWhite(*picture, picture->width - 55, 200));
    EXPECT_FALSE(isWhite(*picture, picture->width - 90, 200));
}

TEST(SuggestPages, otherLettersAndBytesThatAreNoTextAreDrawnAsQuestionMarks) {
    EXPECT_EQ(pageTitled("\u6771\u4eac.chk"), pageTitled("??.chk"));
    EXPECT_EQ(pageTitled("a\xff"
                         "b"),
              pageTitled("a?b"));
}

}  // namespace
}  // namespace worldy
