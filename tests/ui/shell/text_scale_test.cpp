#include "ui/shell/text_scale.h"

#include <gtest/gtest.h>

namespace worldy::ui {
namespace {

TEST(TextScale, growsNoFurtherThanWhatIsShownAndShrinksFromThere) {
    Workspace workspace;
    setShownTextScale(1);
    zoomText(1.1, workspace);
    EXPECT_DOUBLE_EQ(workspace.preferences.scale, 1.1);
    setShownTextScale(1.05);  // the window is too small for 1.1
    EXPECT_TRUE(isTextLimited(workspace));
    zoomText(1.1, workspace);
    EXPECT_DOUBLE_EQ(workspace.preferences.scale, 1.1);
    zoomText(1 / 1.1, workspace);
    EXPECT_DOUBLE_EQ(workspace.preferences.scale, 1.05 / 1.1);
    setShownTextScale(3);
    EXPECT_FALSE(isTextLimited(workspace));
    for (int i = 0; i < 30; ++i) zoomText(1.1, workspace);
    EXPECT_EQ(workspace.preferences.scale, 3);
    for (int i = 0; i < 30; ++i) zoomText(0.5, workspace);
    EXPECT_EQ(workspace.preferences.scale, 0.5);
}

}  // namespace
}  // namespace worldy::ui
