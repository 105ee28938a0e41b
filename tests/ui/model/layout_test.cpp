#include "ui/model/layout.h"

#include <gtest/gtest.h>

#include <vector>

namespace worldy::ui {
namespace {

const Rect& dockOf(const Layout& layout, Dock dock) {
    return layout.docks[static_cast<std::size_t>(dock)];
}

std::vector<Rect> partsOf(const Layout& layout) {
    std::vector<Rect> parts = {layout.viewport, layout.menuBar, layout.statusBar};
    parts.insert(parts.end(), layout.docks.begin(), layout.docks.end());
    parts.insert(parts.end(), layout.splitters.begin(), layout.splitters.end());
    return parts;
}

bool overlap(const Rect& a, const Rect& b) {
    return a.width > 0 && b.width > 0 && a.height > 0 && b.height > 0 && a.x < b.x + b.width &&
           b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

Workspace only(Dock dock) {
    Workspace workspace;
    for (PanelPlace& place : workspace.panels) place.shown = place.shown && place.dock == dock;
    return workspace;
}

TEST(Layout, PartsFillTheWindowWithoutOverlap) {
    for (const float unit : {0.8f, 1.0f, 1.15f, 2.0f}) {
        const Layout layout = layoutOf(1280, 800, {}, 22, 24, unit);
        const std::vector<Rect> parts = partsOf(layout);
        float area = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            area += parts[i].width * parts[i].height;
            EXPECT_LE(parts[i].x + parts[i].width, 1280);
            EXPECT_LE(parts[i].y + parts[i].height, 800);
            for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(parts[i], parts[j])) << i << " " << j;
        }
        EXPECT_EQ(area, 1280 * 800);
    }
}

TEST(Layout, TheViewportKeepsItsShareHoweverLargeTheDocksAreAskedToBe) {
    Workspace workspace;
    workspace.leftWidth = workspace.rightWidth = workspace.bottomHeight = 5000;
    for (const float unit : {1.0f, 2.0f}) {
        const Layout layout = layoutOf(640, 400, workspace, 20, 20, unit);
        EXPECT_GE(layout.viewport.width, 640 / 3.0f);
        EXPECT_GE(layout.viewport.height, 360 / 3.0f);
        EXPECT_GT(dockOf(layout, Dock::Left).width, 0);
        EXPECT_GT(dockOf(layout, Dock::Right).width, 0);
    }
}

TEST(Layout, ADockWithoutPanelsTakesNoRoom) {
    const Layout layout = layoutOf(1280, 800, only(Dock::Right), 22, 24, 1);
    EXPECT_EQ(dockOf(layout, Dock::Left).width, 0);
    EXPECT_EQ(dockOf(layout, Dock::Bottom).height, 0);
    EXPECT_EQ(layout.viewport.x, 0);
    EXPECT_EQ(layout.viewport.height, 800 - 22 - 24);
    EXPECT_GT(dockOf(layout, Dock::Right).width, 0);
}

TEST(Layout, SizesFollowTheFont) {
    Workspace workspace;
    workspace.leftWidth = 300;
    workspace.bottomHeight = 100;
    EXPECT_EQ(dockOf(layoutOf(3000, 2000, workspace, 20, 20, 2), Dock::Left).width, 600);
    EXPECT_EQ(dockOf(layoutOf(3000, 2000, workspace, 20, 20, 2), Dock::Bottom).height, 200);
}

TEST(Layout, textGrowsNoFurtherThanTheWindowCanShow) {
    EXPECT_EQ(fittingScale(1.2, 1600, 1000, 15), 1.2);
    EXPECT_EQ(fittingScale(0.5, 640, 400, 15), 0.5);
    const double most = fittingScale(3, 1024, 640, 15);
    EXPECT_NEAR(most, 1.52, 0.01);
    EXPECT_GE(1024 / (15 * most), 45 - 1e-3);
    EXPECT_GE(640 / (15 * most), 28 - 1e-3);
    // The monitor's own scale stays.
    EXPECT_EQ(fittingScale(3, 640, 400, 30), 1);
    EXPECT_EQ(fittingScale(0.8, 640, 400, 30), 0.8);
}

TEST(Layout, AMinimisedWindowHasALayoutToo) {
    const Layout layout = layoutOf(0, 0, {}, 22, 24, 1);
    EXPECT_GT(layout.viewport.width, 0);
    EXPECT_GT(layout.viewport.height, 0);
}

}  // namespace
}  // namespace worldy::ui
