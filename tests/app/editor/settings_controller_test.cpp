// Budgets govern the settings of the frames that step; what is saved and undone is the user's own.
#include "app/editor/settings_controller.h"

#include <gtest/gtest.h>

#include "tests/support/planet_fixture.h"

namespace worldy {
namespace {

TEST(SettingsController, aBudgetGovernsTheFramesThatStep) {
    const auto planet = planet::openFake();
    planet->step(planet::viewAt(10, 20), {}, planet::noUpload);
    FrameStats stats;
    stats.tauPx = 2;
    stats.selection = planet->selection().counters;
    FrameController frames;
    SettingsController controller;
    ViewSettings& view = controller.settings.view;
    view.budget.triangles = 1;
    const auto tauOfNextFrame = [&] {
        governFrame(controller, frames, *planet, 1.0 / 60);
        return view.lod.tauPx;
    };
    EXPECT_EQ(tauOfNextFrame(), 2) << "no frame was drawn yet";
    finishFrame(frames, stats);
    frames.paused = true;
    EXPECT_EQ(tauOfNextFrame(), 2);
    frames.stepOnce = true;
    EXPECT_EQ(tauOfNextFrame(), view.budget.mostTauPx);
    EXPECT_EQ(ungoverned(controller, view).lod.tauPx, 2);
}

}  // namespace
}  // namespace worldy
