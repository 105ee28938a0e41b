#include "app/settings/undo.h"

#include <gtest/gtest.h>

namespace worldy {
namespace {

ViewSettings withTau(double tauPx) {
    ViewSettings settings;
    settings.lod.tauPx = tauPx;
    return settings;
}

ViewSettings withOutlines(ViewSettings settings) {
    settings.overlay.outlines = true;
    return settings;
}

TEST(Undo, GoesBackAndForthThroughSteps) {
    UndoHistory history;
    EXPECT_EQ(history.undo(), std::nullopt);
    EXPECT_EQ(history.undoName(), "");
    history.record(withTau(2), withTau(3), false, 1);
    history.record(withTau(3), withOutlines(withTau(3)), false, 2);
    EXPECT_EQ(history.undoName(), "Outlines on");
    EXPECT_EQ(history.undo(), withTau(3));
    EXPECT_EQ(history.undoName(), "Tolerance τ 2 -> 3 px");
    EXPECT_EQ(history.redoName(), "Outlines on");
    EXPECT_EQ(history.undo(), withTau(2));
    EXPECT_EQ(history.undo(), std::nullopt);
    EXPECT_EQ(history.redo(), withTau(3));
    EXPECT_EQ(history.redo(), withOutlines(withTau(3)));
    EXPECT_EQ(history.redo(), std::nullopt);
    EXPECT_EQ(history.redoName(), "");
}

TEST(Undo, TakesBackWhatWasDoneToARegion) {
    const auto with = [](std::vector<planet::Region> list) {
        ViewSettings settings;
        settings.regions.list = std::make_shared<const std::vector<planet::Region>>(std::move(list));
        return settings;
    };
    planet::Region valley;
    valley.name = "Valley";
    planet::Region painted = valley;
    UndoHistory history;
    history.record(ViewSettings{}, with({valley}), false, 1);
    EXPECT_EQ(history.undoName(), "Region \"Valley\" added");
    // A stroke of the brush, while the button is held.
    ViewSettings before = with({valley});
    for (int i = 0; i < 20; ++i) {
        painted.circles.push_back({{0, i * 1.0}, 1000});
        history.record(before, with({painted}), true, 3 + i);
        before = with({painted});
    }
    history.record(before, before, false, 30);
    EXPECT_EQ(history.undoName(), "Region \"Valley\"");
    EXPECT_EQ(history.undo(), with({valley}));
    history.record(with({valley}), with({}), false, 40);
    EXPECT_EQ(history.undoName(), "Region \"Valley\" deleted");
    EXPECT_EQ(history.undo(), with({valley}));
    EXPECT_EQ(history.undo(), ViewSettings{});
}

TEST(Undo, NamesRoundNumbers) {
    UndoHistory history;
    history.record(withTau(2), withTau(19.630435466766357), false, 1);
    EXPECT_EQ(history.undoName(), "Tolerance τ 2 -> 19.63 px");
}

TEST(Undo, AllChangesWhileAControlIsHeldAreOneStep) {
    UndoHistory history;
    for (int i = 0; i < 100; ++i) history.record(withTau(2 + i), withTau(3 + i), true, 10.0 * i);
    EXPECT_EQ(history.undoName(), "Tolerance τ 2 -> 102 px");
    // Let go, with a last change in that frame.
    history.record(withTau(102), withTau(103), false, 1000);
    history.record(withTau(103), withTau(104), true, 1000.1);
    EXPECT_EQ(history.undo(), withTau(103));
    EXPECT_EQ(history.undo(), withTau(2));
    EXPECT_EQ(history.undo(), std::nullopt);
}

TEST(Undo, TakesBackWhatWasDoneToALayer) {
    UndoHistory history;
    const ViewSettings before;
    ViewSettings muted = before;
    muted.surface.layers.set.layers[2].muted = true;
    ViewSettings removed = muted;
    removed.surface.layers.set.layers.pop_back();
    history.record(before, muted, false, 1);
    history.record(muted, removed, false, 2);
    EXPECT_EQ(history.undoName(), "Layer stack");
    EXPECT_EQ(history.undo(), muted);
    EXPECT_EQ(history.undo(), before);
    EXPECT_EQ(history.redo(), muted);
}

TEST(Undo, AControlThatIsHeldWithoutAChangeKeepsItsStepOpen) {
    UndoHistory history;
    history.record(withTau(2), withTau(3), true, 0);
    history.record(withTau(3), withTau(3), true, 60);
    history.record(withTau(3), withTau(4), true, 120);
    history.record(withTau(4), withTau(4), false, 121);
    EXPECT_EQ(history.undo(), withTau(2));
}

TEST(Undo, WhatEndsWhereItBeganIsNoStepAndLeavesWhatCanBeRedone) {
    UndoHistory history;
    history.record(withTau(2), withTau(9), false, 0);
    history.undo();
    history.record(withTau(2), withTau(3), true, 10);
    EXPECT_EQ(history.redoName(), "");
    history.record(withTau(3), withTau(2), true, 11);
    history.record(withTau(2), withTau(2), false, 12);
    EXPECT_EQ(history.undoName(), "");
    EXPECT_EQ(history.redoName(), "Tolerance τ 2 -> 9 px");
    EXPECT_EQ(history.redo(), withTau(9));
}

TEST(Undo, QuickChangesOfOneSettingAreOneStepAndOthersAreNot) {
    UndoHistory history;
    history.record(withTau(2), withTau(3), false, 0);
    history.record(withTau(3), withTau(4), false, 0.3);
    history.record(withTau(4), withTau(5), false, 0.6);
    history.record(withTau(5), withOutlines(withTau(5)), false, 0.7);
    EXPECT_EQ(history.undo(), withTau(5));
    EXPECT_EQ(history.undo(), withTau(2));
    history.record(withTau(2), withTau(3), false, 10);
    history.record(withTau(3), withTau(4), false, 11);
    EXPECT_EQ(history.undo(), withTau(3));
}

TEST(Undo, ANewEditClearsWhatCouldBeRedone) {
    UndoHistory history;
    history.record(withTau(2), withTau(3), false, 0);
    history.undo();
    history.record(withTau(2), withTau(4), false, 10);
    EXPECT_EQ(history.redoName(), "");
    EXPECT_EQ(history.redo(), std::nullopt);
    EXPECT_EQ(history.undo(), withTau(2));
}

TEST(Undo, AnUndoWhileAControlIsHeldTakesBackWhatItHasDone) {
    UndoHistory history;
    history.record(withTau(2), withTau(3), true, 0);
    EXPECT_EQ(history.undo(), withTau(2));
    // The settings have gone back; the control is still held and moves on.
    history.record(withTau(2), withTau(4), true, 1);
    history.record(withTau(4), withTau(4), false, 2);
    EXPECT_EQ(history.undo(), withTau(2));
    EXPECT_EQ(history.undo(), std::nullopt);
}

TEST(Undo, TheOldestOfTooManyStepsAreForgotten) {
    UndoHistory history;
    for (int i = 0; i < 250; ++i) history.record(withTau(i), withTau(i + 1), false, i);
    std::size_t steps = 0;
    while (const std::optional<ViewSettings> settings = history.undo()) {
        ++steps;
        EXPECT_EQ(*settings, withTau(250 - static_cast<double>(steps)));
    }
    EXPECT_EQ(steps, maxUndoSteps);
    for (std::size_t i = 0; i < steps; ++i) EXPECT_TRUE(history.redo());
    EXPECT_EQ(history.redo(), std::nullopt);
}

TEST(Undo, AStepMayHaveANameOfItsOwn) {
    UndoHistory history;
    history.add(withTau(2), withTau(2), "preset that changes nothing");
    EXPECT_EQ(history.undoName(), "");
    history.record(withTau(2), withTau(3), true, 0);
    history.add(withTau(3), withOutlines(withTau(7)), "preset crack hunting");
    EXPECT_EQ(history.undoName(), "preset crack hunting");
    EXPECT_EQ(history.undo(), withTau(3));
    EXPECT_EQ(history.redoName(), "preset crack hunting");
    EXPECT_EQ(history.undo(), withTau(2));
}

TEST(ChangeName, IsShortAndHasTheUnit) {
    ViewSettings after;
    after.lod.morphRange = 0.5;
    EXPECT_EQ(changeName({}, after), "Morph range 0.3 -> 0.5");
    after = {};
    after.paging.budgetMB = 512;
    EXPECT_EQ(changeName({}, after), "Budget 256 -> 512 MiB");
    after = {};
    after.paging.badDisk.bandwidthMBs = 10;
    EXPECT_EQ(changeName({}, after), "Bandwidth 0 -> 10 MB/s");
    after = {};
    after.overlay.colourBy = ColourBy::Error;
    EXPECT_EQ(changeName({}, after), "Colour by none -> error");
    after = {};
    after.surface.sea = false;
    EXPECT_EQ(changeName({}, after), "Sea off");
    after = {};
    after.surface.sunDate.hour = 20.28;
    EXPECT_EQ(changeName({}, after), "Hour 12:00 -> 20:17");  // as the slider
    after = {};
    after.surface.ramp = {{0, {1, 1, 1}}};
    EXPECT_EQ(changeName({}, after), "Height ramp");
    after.surface.sea = false;
    EXPECT_EQ(changeName({}, after), "2 settings");
}

}  // namespace
}  // namespace worldy
