#include "ui/model/docking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace worldy::ui {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr float dockingUnitPx = 1.15f;

Layout layoutIn(float width, float height, const Workspace& workspace) {
    return layoutOf(width, height, workspace, 22, 24, dockingUnitPx);
}

// A workspace that shows only these panels, all in one dock.
Workspace holding(Dock dock, const std::vector<PanelId>& panels) {
    Workspace workspace;
    for (PanelPlace& place : workspace.panels) place.shown = false;
    for (std::size_t i = 0; i < panels.size(); ++i) dockPanel(panels[i], dock, i, workspace);
    return workspace;
}

bool holdsEachPanelOnce(const PanelOrder& order) {
    return std::set<PanelId>(order.begin(), order.end()).size() == panelCount;
}

// Tabs of 50 x 20 pixels, three in a row.
TabRow tabsOf(Dock dock, const Layout& layout, const Workspace& workspace) {
    TabRow row{dock, panelsIn(dock, workspace), {}};
    const Rect& rect = layout.docks[static_cast<std::size_t>(dock)];
    for (std::size_t i = 0; i < row.panels.size(); ++i) {
        row.tabs.push_back({rect.x + 8 + 52 * static_cast<float>(i % 3),
                            rect.y + 6 + 22 * static_cast<float>(i / 3), 50, 20});
    }
    return row;
}

DropTarget targetAt(Point pointer, PanelId panel, const Workspace& workspace) {
    const Layout layout = layoutIn(1280, 800, workspace);
    std::vector<TabRow> rows;
    for (const Dock dock : {Dock::Left, Dock::Right, Dock::Bottom}) {
        if (!panelsIn(dock, workspace).empty()) rows.push_back(tabsOf(dock, layout, workspace));
    }
    return dropTarget(pointer, panel, layout, rows, workspace, dockingUnitPx);
}

TEST(Docking, panelsThatWerePutAwayComeBackAsTheyWere) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod, PanelId::Chunk});
    floatPanel(PanelId::Pops, {.x = 0.2}, workspace);
    const Workspace before = workspace;
    toggleAllPanels(workspace);
    const Layout away = layoutIn(1280, 800, workspace);
    EXPECT_EQ(away.viewport.width, 1280);
    EXPECT_EQ(away.viewport.height, away.area.height);
    EXPECT_THAT(floatingPanels(workspace), IsEmpty());
    EXPECT_FALSE(isVisible(PanelId::Lod, workspace));
    toggleAllPanels(workspace);
    EXPECT_EQ(workspace, before);
}

TEST(Docking, showingOnePanelBringsBackTheOthersThatWerePutAway) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod, PanelId::Chunk});
    toggleAllPanels(workspace);
    togglePanel(PanelId::Lod, workspace);
    EXPECT_TRUE(isVisible(PanelId::Lod, workspace));
    EXPECT_THAT(panelsIn(Dock::Left, workspace), ElementsAre(PanelId::Lod, PanelId::Chunk));
    toggleAllPanels(workspace);
    floatPanel(PanelId::Chunk, {}, workspace);
    EXPECT_TRUE(isVisible(PanelId::Chunk, workspace));
}

TEST(Docking, withoutAShownPanelTheDefaultOnesAreShown) {
    Workspace workspace = holding(Dock::Left, {});
    toggleAllPanels(workspace);
    EXPECT_EQ(workspace.panels, firstPlaces());
}

TEST(Docking, aPanelIsDockedBeforeThePositionAndInFront) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod, PanelId::Chunk, PanelId::Log});
    dockPanel(PanelId::Bake, Dock::Left, 1, workspace);
    EXPECT_THAT(panelsIn(Dock::Left, workspace),
                ElementsAre(PanelId::Lod, PanelId::Bake, PanelId::Chunk, PanelId::Log));
    EXPECT_EQ(frontPanel(Dock::Left, workspace), PanelId::Bake);
    dockPanel(PanelId::Pops, Dock::Left, 99, workspace);
    EXPECT_EQ(panelsIn(Dock::Left, workspace).back(), PanelId::Pops);
    EXPECT_TRUE(holdsEachPanelOnce(workspace.order));
}

TEST(Docking, aTabIsReorderedAmongTheOthersOfItsDock) {
    Workspace workspace = holding(Dock::Bottom, {PanelId::Lod, PanelId::Chunk, PanelId::Log});
    dockPanel(PanelId::Lod, Dock::Bottom, 2, workspace);
    EXPECT_THAT(panelsIn(Dock::Bottom, workspace), ElementsAre(PanelId::Chunk, PanelId::Log, PanelId::Lod));
    dockPanel(PanelId::Log, Dock::Bottom, 0, workspace);
    EXPECT_THAT(panelsIn(Dock::Bottom, workspace), ElementsAre(PanelId::Log, PanelId::Chunk, PanelId::Lod));
    EXPECT_TRUE(holdsEachPanelOnce(workspace.order));
}

TEST(Docking, theOrderOfTheOtherPanelsStaysInEveryDock) {
    std::mt19937 random(5);
    Workspace workspace;
    for (int step = 0; step < 2000; ++step) {
        const PanelId panel = panelInfos[random() % panelCount].id;
        const auto dock = static_cast<Dock>(random() % dockCount);
        const std::size_t position = random() % 8;
        PanelOrder before = workspace.order;
        dockPanel(panel, dock, position, workspace);
        PanelOrder after = workspace.order;
        ASSERT_TRUE(holdsEachPanelOnce(after));
        // Only the moved panel may have another place among the others.
        ASSERT_TRUE(std::equal(before.begin(), std::remove(before.begin(), before.end(), panel),
                               after.begin(), std::remove(after.begin(), after.end(), panel)));
        const std::size_t tabs = panelsIn(dock, workspace).size();
        ASSERT_EQ(positionIn(dock, panel, workspace), std::min(position, tabs - 1));
    }
}

TEST(Docking, aFloatingPanelTakesNoRoomInItsDockAndReturnsThere) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod});
    floatPanel(PanelId::Lod, {}, workspace);
    EXPECT_EQ(layoutIn(1280, 800, workspace).docks[0].width, 0);
    EXPECT_THAT(panelsIn(Dock::Left, workspace), IsEmpty());
    EXPECT_THAT(floatingPanels(workspace), ElementsAre(PanelId::Lod));
    EXPECT_TRUE(isVisible(PanelId::Lod, workspace));
    dockPanel(PanelId::Lod, Dock::Left, 0, workspace);
    EXPECT_THAT(floatingPanels(workspace), IsEmpty());
    EXPECT_GT(layoutIn(1280, 800, workspace).docks[0].width, 0);
}

TEST(Docking, aMaximisedDockFillsTheAreaAndTheViewportKeepsItsSize) {
    Workspace workspace;
    const Layout before = layoutIn(1280, 800, workspace);
    toggleMaximised(Dock::Bottom, workspace);
    const Layout layout = layoutIn(1280, 800, workspace);
    EXPECT_TRUE(layout.viewportCovered);
    EXPECT_EQ(layout.docks[2].width, 1280);
    EXPECT_EQ(layout.docks[2].height, 800 - 22 - 24);
    EXPECT_EQ(layout.docks[0].width, 0);
    EXPECT_EQ(layout.viewport.width, before.viewport.width);
    EXPECT_EQ(layout.viewport.height, before.viewport.height);
    EXPECT_TRUE(isVisible(PanelId::Paging, workspace));
    EXPECT_FALSE(isVisible(PanelId::Lod, workspace));
    toggleMaximised(Dock::Bottom, workspace);
    EXPECT_FALSE(layoutIn(1280, 800, workspace).viewportCovered);
}

TEST(Docking, aMaximisedDockWithoutPanelsCoversNothing) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod});
    workspace.maximised = MaximisedDock::Right;
    EXPECT_FALSE(layoutIn(1280, 800, workspace).viewportCovered);
    EXPECT_GT(layoutIn(1280, 800, workspace).docks[0].width, 0);
}

TEST(Docking, showingAPanelOfAnotherDockEndsTheMaximising) {
    Workspace workspace;
    toggleMaximised(Dock::Bottom, workspace);
    showPanel(PanelId::Log, workspace);
    EXPECT_EQ(maximisedDock(workspace), Dock::Bottom);
    showPanel(PanelId::Chunk, workspace);
    EXPECT_FALSE(maximisedDock(workspace));
    EXPECT_TRUE(isVisible(PanelId::Chunk, workspace));
}

TEST(Docking, toggleHidesAVisiblePanelAndShowsAnyOther) {
    Workspace workspace;
    togglePanel(PanelId::Seams, workspace);  // behind another tab
    EXPECT_EQ(frontPanel(Dock::Right, workspace), PanelId::Seams);
    togglePanel(PanelId::Seams, workspace);
    EXPECT_FALSE(isShown(workspace, PanelId::Seams));
    toggleMaximised(Dock::Bottom, workspace);
    togglePanel(PanelId::Quadtree, workspace);  // covered by the maximised dock
    EXPECT_TRUE(isVisible(PanelId::Quadtree, workspace));
    floatPanel(PanelId::Log, {}, workspace);
    togglePanel(PanelId::Log, workspace);
    EXPECT_FALSE(isShown(workspace, PanelId::Log));
    togglePanel(PanelId::Log, workspace);
    EXPECT_THAT(floatingPanels(workspace), ElementsAre(PanelId::Log));
}

TEST(FloatingPanel, liesInsideEveryWindowAtEveryScale) {
    std::mt19937 random(7);
    const auto share = [&] { return static_cast<double>(random() % 1001) / 1000; };
    for (int i = 0; i < 2000; ++i) {
        const FloatingPlace place{share(), share(), 160 + 1840 * share(), 100 + 1900 * share()};
        const Rect area{0, 22, 64 + 3000 * static_cast<float>(share()),
                        64 + 2000 * static_cast<float>(share())};
        const Rect rect = floatingRect(place, area, 0.5f + 3 * static_cast<float>(share()));
        ASSERT_GE(rect.x, area.x - 0.5f);
        ASSERT_GE(rect.y, area.y - 0.5f);
        ASSERT_LE(rect.x + rect.width, area.x + area.width + 1);
        ASSERT_LE(rect.y + rect.height, area.y + area.height + 1);
        ASSERT_GT(rect.width, 0);
    }
}

TEST(FloatingPanel, keepsItsSizeAndItsEdgeWhenTheWindowChanges) {
    const Rect large{0, 22, 1600, 950}, small{0, 22, 600, 400};
    const FloatingPlace place = floatingPlace({1200, 572, 400, 400}, large, 1, {});
    EXPECT_EQ(place.x, 1);
    EXPECT_EQ(place.y, 1);
    const Rect moved = floatingRect(place, small, 1);
    EXPECT_EQ(moved.x + moved.width, 600);
    EXPECT_EQ(moved.width, 400);
    const Rect again = floatingRect(place, large, 1);
    EXPECT_EQ(again.x, 1200);
    EXPECT_EQ(again.y, 572);
    // A small window does not shrink the stored size: reading the place back keeps it.
    const Rect tight = floatingRect({0.5, 0.5, 1000, 800}, small, 1);
    EXPECT_EQ(tight.width, 600);
    const FloatingPlace back = floatingPlace(tight, small, 1, {0.5, 0.5, 1000, 800});
    EXPECT_EQ(back.width, 1000);
    EXPECT_EQ(back.height, 800);
    EXPECT_EQ(back.x, 0.5);
}

TEST(FloatingPanel, aRectangleOutsideTheAreaIsMovedInside) {
    const Rect area{0, 22, 1000, 600};
    for (const Rect& rect : {Rect{-5000, -5000, 300, 300}, Rect{9000, 9000, 300, 300}}) {
        const Rect inside = floatingRect(floatingPlace(rect, area, 1, {}), area, 1);
        EXPECT_EQ(inside.width, 300);
        EXPECT_TRUE(contains({-1, 21, 1002, 602}, {inside.x, inside.y}));
        EXPECT_LE(inside.x + inside.width, 1000);
        EXPECT_LE(inside.y + inside.height, 622);
    }
}

TEST(DropTarget, liesBetweenTheNearestTabs) {
    const Workspace workspace =
        holding(Dock::Left, {PanelId::Lod, PanelId::Chunk, PanelId::Log, PanelId::Bake});
    const auto position = [&](float x, float y) {
        const DropTarget target = targetAt({x, y}, PanelId::Pops, workspace);
        EXPECT_EQ(target.dock, Dock::Left);
        return target.position;
    };
    // Tabs begin at x = 8, 60 and 112; the second row at y = 22 + 28.
    EXPECT_EQ(position(10, 40), 0u);
    EXPECT_EQ(position(50, 40), 1u);
    EXPECT_EQ(position(100, 40), 2u);
    EXPECT_EQ(position(200, 40), 3u);
    EXPECT_EQ(position(10, 60), 3u);
    EXPECT_EQ(position(50, 60), 4u);
    EXPECT_EQ(position(250, 23), 3u);  // above the tabs
    // The mark stands in the row of the pointer, also at its end.
    EXPECT_EQ(targetAt({200, 40}, PanelId::Pops, workspace).mark->y, 28);
    EXPECT_EQ(targetAt({10, 60}, PanelId::Pops, workspace).mark->y, 50);
}

TEST(DropTarget, doesNotCountTheDraggedPanelItself) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod, PanelId::Chunk, PanelId::Log});
    const DropTarget target = targetAt({100, 40}, PanelId::Lod, workspace);
    EXPECT_EQ(target.position, 1u);
    dockPanel(PanelId::Lod, *target.dock, target.position, workspace);
    EXPECT_THAT(panelsIn(Dock::Left, workspace), ElementsAre(PanelId::Chunk, PanelId::Lod, PanelId::Log));
}

TEST(DropTarget, isTheEndOfADockOverItsPanelAndItsOwnPlaceOverItsOwnDock) {
    const Workspace workspace = holding(Dock::Left, {PanelId::Lod, PanelId::Chunk});
    EXPECT_EQ(targetAt({100, 300}, PanelId::Pops, workspace).position, 2u);
    const DropTarget own = targetAt({100, 300}, PanelId::Lod, workspace);
    EXPECT_EQ(own.dock, Dock::Left);
    EXPECT_EQ(own.position, 0u);
}

TEST(DropTarget, opensAnEmptyDockAtItsEdgeAndFloatsElsewhere) {
    const Workspace workspace = holding(Dock::Left, {PanelId::Lod});
    EXPECT_EQ(targetAt({1275, 300}, PanelId::Lod, workspace).dock, Dock::Right);
    EXPECT_EQ(targetAt({700, 770}, PanelId::Lod, workspace).dock, Dock::Bottom);
    EXPECT_FALSE(targetAt({700, 300}, PanelId::Lod, workspace).dock);
    EXPECT_FALSE(targetAt({700, 5}, PanelId::Lod, workspace).dock);  // over the menu bar
}

TEST(DropTarget, isTheSecondWindowOutsideOfTheWindows) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod, PanelId::Chunk});
    for (const Point outside : {Point{-4000, 300}, Point{1281, 300}, Point{600, -1}, Point{600, 801}})
        EXPECT_EQ(targetAt(outside, PanelId::Lod, workspace).dock, Dock::Second);
    EXPECT_EQ(dropText({Dock::Second, panelCount}, PanelId::Lod, workspace), "Second window");
    dockPanel(PanelId::Log, Dock::Second, 0, workspace);
    EXPECT_EQ(dropText({Dock::Second, panelCount}, PanelId::Lod, workspace), "Second window, after Log");
}

// The second window stands 100 pixels right of a main window of 1280 x 800, and 50 lower.
TEST(DropTarget, aPointerIsOverTheWindowThatIsThereWhereverItsButtonWentDown) {
    Workspace workspace = holding(Dock::Second, {PanelId::Lod});
    Layout layout = layoutIn(1280, 800, workspace);
    const auto over = [&](Point pointer) {
        const Point at = pointerOverWindows(pointer, layout);
        return std::pair(at.x, at.y);
    };
    EXPECT_EQ(over({1400, 60}), std::pair(1400.0f, 60.0f)) << "there is no second window";
    layout.docks[static_cast<std::size_t>(Dock::Second)] = {secondWindowX, 0, 500, 600};
    layout.secondLeft = 1380;
    layout.secondTop = 50;
    EXPECT_EQ(over({700, 300}), std::pair(700.0f, 300.0f));
    EXPECT_EQ(over({1400, 60}), std::pair(secondWindowX + 20, 10.0f));
    EXPECT_EQ(over({1400, 49}), std::pair(1400.0f, 49.0f)) << "above the second window";
    EXPECT_EQ(over({secondWindowX + 20, 10}), std::pair(secondWindowX + 20, 10.0f));
    EXPECT_EQ(over({secondWindowX - 680, 250}), std::pair(700.0f, 300.0f)) << "back over the main window";
    // Over both, it is in the window that holds the button.
    layout.secondLeft = 1000;
    EXPECT_EQ(over({1100, 60}), std::pair(1100.0f, 60.0f));
    EXPECT_EQ(over({secondWindowX + 100, 10}), std::pair(secondWindowX + 100, 10.0f));
}

TEST(Docking, theSecondWindowIsNeitherMaximisedNorCovered) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod});
    dockPanel(PanelId::Log, Dock::Second, 0, workspace);
    toggleMaximised(Dock::Second, workspace);
    EXPECT_EQ(maximisedDock(workspace), std::nullopt);
    toggleMaximised(Dock::Left, workspace);
    EXPECT_TRUE(isVisible(PanelId::Log, workspace));
    showPanel(PanelId::Log, workspace);
    EXPECT_EQ(maximisedDock(workspace), Dock::Left) << "nothing has to make room";
}

TEST(Docking, thePanelsOfAClosedSecondWindowReturnToTheirOwnDocks) {
    Workspace workspace = holding(Dock::Second, {PanelId::Lod, PanelId::Log, PanelId::Chunk});
    placeOf(PanelId::Chunk, workspace).shown = false;
    leaveSecondWindow(workspace);
    EXPECT_THAT(panelsIn(Dock::Second, workspace), IsEmpty());
    EXPECT_THAT(panelsIn(Dock::Right, workspace), ElementsAre(PanelId::Lod));
    EXPECT_THAT(panelsIn(Dock::Bottom, workspace), ElementsAre(PanelId::Log));
    EXPECT_EQ(placeOf(PanelId::Chunk, workspace).dock, Dock::Left) << "it would open the window again";
}

TEST(DropTarget, overAMaximisedDockOnlyItsTabsCount) {
    Workspace workspace = holding(Dock::Left, {PanelId::Lod, PanelId::Chunk});
    toggleMaximised(Dock::Left, workspace);
    EXPECT_EQ(targetAt({100, 40}, PanelId::Lod, workspace).dock, Dock::Left);
    EXPECT_FALSE(targetAt({600, 400}, PanelId::Lod, workspace).dock);
    EXPECT_FALSE(targetAt({1275, 300}, PanelId::Lod, workspace).dock);
}

TEST(DropTarget, isNamedForTheUser) {
    const Workspace workspace = holding(Dock::Left, {PanelId::Lod, PanelId::Chunk});
    EXPECT_EQ(dropText({}, PanelId::Log, workspace), "Float");
    EXPECT_EQ(dropText({Dock::Right}, PanelId::Log, workspace), "Right dock");
    EXPECT_EQ(dropText({Dock::Left, 0, {}}, PanelId::Log, workspace), "Left dock, before LOD");
    EXPECT_EQ(dropText({Dock::Left, 2, {}}, PanelId::Log, workspace), "Left dock, after Chunk");
    EXPECT_EQ(dropText({Dock::Left, 1, {}}, PanelId::Lod, workspace), "Left dock, after Chunk");
}

}  // namespace
}  // namespace worldy::ui
