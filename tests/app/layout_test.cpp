#include "ui/layout.h"

#include <gtest/gtest.h>

#include <array>

namespace ui {
namespace {

TEST(Layout, PartsFillTheWindowWithoutOverlap) {
    for (const float unit : {0.8f, 1.0f, 1.15f, 2.0f}) {
        const Layout layout = layoutOf(1280, 800, {}, unit);
        float area = 0;
        for (const Rect& part :
             {layout.viewport, layout.log, layout.lod, layout.lodSplitter, layout.logSplitter}) {
            area += part.width * part.height;
            EXPECT_LE(part.x + part.width, 1280);
            EXPECT_LE(part.y + part.height, 800);
        }
        EXPECT_EQ(area, 1280 * 800);
        EXPECT_EQ(layout.viewport.x + layout.viewport.width, layout.lodSplitter.x);
        EXPECT_EQ(layout.viewport.y + layout.viewport.height, layout.logSplitter.y);
    }
}

TEST(Layout, TheViewportKeepsItsShareHoweverLargeThePanelsAreAskedToBe) {
    const Layout layout = layoutOf(640, 400, {.lodWidth = 5000, .logHeight = 5000}, 2);
    EXPECT_GE(layout.viewport.width, 640 / 3.0f);
    EXPECT_GE(layout.viewport.height, 400 / 3.0f);
}

TEST(Layout, SizesFollowTheFont) {
    EXPECT_EQ(layoutOf(3000, 2000, {.lodWidth = 300, .logHeight = 100}, 2).lod.width, 600);
    EXPECT_EQ(layoutOf(3000, 2000, {.lodWidth = 300, .logHeight = 100}, 2).log.height, 200);
}

}  // namespace
}  // namespace ui
