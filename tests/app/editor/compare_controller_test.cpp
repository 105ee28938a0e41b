// The window's comparison, without a window.
#include "app/editor/compare_controller.h"

#include <gmock/gmock.h>

#include "tests/app/session_fixture.h"
#include "ui/model/font_symbols.h"
#include "ui/shell/compare_overlay.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using With = ui::StartCompare::With;

class CompareControllerTest : public test::SessionTest {
protected:
    CompareControllerTest() {
        settings_.lod.fadeS = 0;
        settings_.surface.detail = planet::gl::FeatureUse::Off;
        viewport_.main.rect = {0, 0, 200, 120};
    }

    Session sessionOfSlope() {
        Session session = sessionOf(bakeTo("slope.chk", {.faceSize = 129, .chunkSize = 17}));
        if (!advanceUntil(session, [&] { return session.open.has_value(); }))
            throw std::runtime_error("the planet does not open");
        return session;
    }
    planet::Result<void> start(Session& session, const ui::StartCompare& wanted = {}) {
        return startCompare(controller_, session, library_, settings_, wanted);
    }
    // A frame of the window, everything loaded.
    void frame(Session& session) {
        Scene& a = *shownScene(session);
        const planet::View view = planet::viewFromPose(
            {.longitudeDeg = 10, .altitudeM = 2e6, .pitchDeg = -60}, 6'371'000, 1.0, 200, 120);
        settleScene(a, view, settings_, 60);
        const CompareFrame now{a, settings_, view, view, timeS_ += 0.1, ++frames_};
        stepCompared(controller_, now, log_);
        if (controller_.other)
            settleScene(controller_.other->planet.scene, view, controller_.other->settings, 60);
        drawPicture(viewport_, viewport_.main, a, settings_, {.view = view}, log_);
        drawCompared(controller_, viewport_, settings_, {}, true, log_);
    }
    ui::CompareView shown(Session& session) {
        return compareViewOf(controller_, session, settings_, statsOf(*shownScene(session)),
                             viewport_.main.view);
    }
    std::vector<std::uint8_t> picture() const { return viewport_.main.shownTarget()->readRgb(); }

    PresetLibrary library_{{folder_ / "shipped", folder_ / "own"}};
    Viewport viewport_;
    CompareController controller_;
    double timeS_ = 0;
    std::uint64_t frames_ = 0;
};

TEST_F(CompareControllerTest, withEqualSettingsNoPixelDiffersInAnyMode) {
    Session session = sessionOfSlope();
    ASSERT_TRUE(start(session));
    settings_.compare.mode = CompareMode::Wipe;
    frame(session);
    ASSERT_TRUE(controller_.difference);
    EXPECT_EQ(controller_.difference->pixels, 0u);
    EXPECT_EQ(controller_.difference->largestSteps, 0);
    EXPECT_EQ(controller_.difference->of, 200u * 120u);
    EXPECT_EQ(picture(), viewport_.main.target->readRgb());
    settings_.compare.mode = CompareMode::Flip;
    settings_.compare.showB = true;
    frame(session);
    EXPECT_EQ(picture(), viewport_.main.target->readRgb());
    EXPECT_TRUE(shown(session).different.empty());
    EXPECT_EQ(sideNames(shown(session))[1], "B, equal settings");
}

TEST_F(CompareControllerTest, aChangedSettingChangesAAloneUntilTheyAreSwapped) {
    Session session = sessionOfSlope();
    settings_.lod.tauPx = 0.5;
    ASSERT_TRUE(start(session));
    settings_.lod.tauPx = 16;
    frame(session);
    const ui::CompareView view = shown(session);
    ASSERT_EQ(view.different.size(), 1u);
    EXPECT_EQ(view.different[0].setting, "lod.tau_px");
    EXPECT_EQ(sideNames(view)[0], "A  " + ui::inFont("Tolerance τ 16"));
    EXPECT_LT(*view.now[0].triangles, *view.now[1].triangles);
    EXPECT_GT(*view.now[0].worstEpsPx, *view.now[1].worstEpsPx);
    EXPECT_GT(controller_.difference->pixels, 0u);

    settings_ = swapCompared(controller_, session, settings_);
    EXPECT_EQ(settings_.lod.tauPx, 0.5);
    EXPECT_EQ(controller_.other->settings.lod.tauPx, 16);
    // The camera and how the two are shown stay as they are.
    settings_.compare.mode = CompareMode::Difference;
    settings_.camera.fovDeg = 77;
    settings_ = swapCompared(controller_, session, settings_);
    EXPECT_EQ(settings_.compare.mode, CompareMode::Difference);
    EXPECT_EQ(settings_.camera.fovDeg, 77);
}

TEST_F(CompareControllerTest, anotherFileAsBIsSwappedWithItsSettings) {
    Session session = sessionOfSlope();
    const auto coarse = bakeTo("coarse.chk", {.faceSize = 33, .chunkSize = 33});
    ASSERT_TRUE(start(session, {With::File, {}, coarse}));
    frame(session);
    EXPECT_EQ(shown(session).fileB, coarse);
    EXPECT_EQ(shown(session).names, (std::array<std::string, 2>{"slope.chk", "coarse.chk"}));
    // The chunk file of a source lies in the cache, and its name says nothing.
    const std::filesystem::path source = std::exchange(controller_.other->planet.data.source, "hills.tif");
    EXPECT_EQ(sideNames(shown(session))[1].substr(0, 12), "B  hills.tif");
    controller_.other->planet.data.source = source;
    const planet::Planet* before = session.open->scene.planet.get();
    settings_ = swapCompared(controller_, session, settings_);
    EXPECT_EQ(session.data.chunkFile, coarse);
    EXPECT_EQ(controller_.other->planet.scene.planet.get(), before);
    frame(session);
    EXPECT_TRUE(controller_.other);
    EXPECT_EQ(shown(session).fileA, coarse);
}

TEST_F(CompareControllerTest, aComparisonIsResumedWithItsFileAndItsSettings) {
    Session session = sessionOfSlope();
    const auto coarse = bakeTo("coarse.chk", {.faceSize = 33, .chunkSize = 33});
    settings_.lod.tauPx = 5;
    ASSERT_TRUE(start(session, {With::File, {}, coarse}));
    const LastComparison other = lastComparisonOf(*controller_.other, *shownPlanet(session));
    EXPECT_EQ(other.file, coarse);
    ASSERT_TRUE(start(session));
    const LastComparison snapshot = lastComparisonOf(*controller_.other, *shownPlanet(session));
    EXPECT_TRUE(snapshot.file.empty()) << "it is A's";
    stopCompare(controller_);

    settings_.lod.tauPx = 2;
    ASSERT_TRUE(resumeCompare(controller_, session, other, settings_));
    frame(session);
    EXPECT_EQ(shown(session).fileB, coarse);
    EXPECT_EQ(controller_.other->settings.lod.tauPx, 5);
    EXPECT_EQ(controller_.other->origin, "another file");
    ASSERT_TRUE(resumeCompare(controller_, session, snapshot, settings_));
    frame(session);
    EXPECT_EQ(shown(session).fileB, shown(session).fileA);
    EXPECT_EQ(controller_.other->origin, "snapshot");

    LastComparison gone = other;
    gone.file = folder_ / "gone.chk";
    stopCompare(controller_);
    EXPECT_FALSE(resumeCompare(controller_, session, gone, settings_));
    EXPECT_FALSE(controller_.other);
    EXPECT_THAT(controller_.problem, HasSubstr("gone.chk"));
}

TEST_F(CompareControllerTest, whatCannotBeBIsToldAndNothingChanges) {
    Session session = sessionOfSlope();
    const auto problemOf = [&](const ui::StartCompare& wanted) {
        const auto started = start(session, wanted);
        EXPECT_FALSE(started);
        EXPECT_FALSE(controller_.other);
        EXPECT_EQ(shown(session).problem, controller_.problem);
        frame(session);
        EXPECT_EQ(viewport_.main.instead, nullptr);
        return controller_.problem;
    };
    EXPECT_THAT(problemOf({With::File, {}, folder_ / "none.chk"}), HasSubstr("none.chk"));
    EXPECT_THAT(problemOf({With::Preset, "nobody", {}}), HasSubstr("nobody"));
    EXPECT_THAT(problemOf({With::PreviousBake, {}, {}}), HasSubstr("no previous bake"));
    EXPECT_THAT(
        problemOf({With::File, {}, bakeTo("moon.chk", {.faceSize = 33, .chunkSize = 33, .radiusM = 1e6})}),
        HasSubstr("radius"));
    std::ofstream(folder_ / "junk.chk") << "no chunk file";
    EXPECT_THAT(problemOf({With::File, {}, folder_ / "junk.chk"}), HasSubstr("junk.chk"));
    // What is compared already goes on.
    ASSERT_TRUE(start(session));
    EXPECT_EQ(controller_.problem, "");
    EXPECT_FALSE(start(session, {With::Preset, "nobody", {}}));
    EXPECT_TRUE(controller_.other);
}

TEST_F(CompareControllerTest, endingGivesEverythingBack) {
    Session session = sessionOfSlope();
    ASSERT_TRUE(start(session));
    frame(session);
    EXPECT_NE(viewport_.main.instead, nullptr);
    EXPECT_GT(gpuBytes(controller_), 200u * 120u * 4u);
    stopCompare(controller_);
    frame(session);
    EXPECT_EQ(viewport_.main.instead, nullptr);
    EXPECT_EQ(gpuBytes(controller_), 0u);
    EXPECT_FALSE(shown(session).on);
}

TEST_F(CompareControllerTest, aPlanetOfAnotherRadiusEndsIt) {
    Session session = sessionOfSlope();
    ASSERT_TRUE(start(session));
    frame(session);
    ASSERT_TRUE(openFile(session, bakeTo("moon.chk", {.faceSize = 33, .chunkSize = 33, .radiusM = 1e6}),
                         settings_, log_));
    frame(session);
    EXPECT_FALSE(controller_.other);
    EXPECT_THAT(controller_.problem, HasSubstr("radius"));
}

TEST_F(CompareControllerTest, aMeasuredViewHasErrorsAndCracksOfBothUntilItIsAnother) {
    Session session = sessionOfSlope();
    ASSERT_TRUE(start(session));
    settings_.lod.tauPx = 16;
    frame(session);
    EXPECT_FALSE(shown(session).now[0].worstErrorPx);
    ASSERT_TRUE(measureCompared(controller_, *shownScene(session), settings_, viewport_.main.view));
    ASSERT_TRUE(advanceUntil(session, [&] {
        frame(session);
        return !shown(session).measuring;
    }));
    const ui::CompareView view = shown(session);
    EXPECT_FALSE(view.stale);
    EXPECT_EQ(view.measured, 1);
    EXPECT_GT(*view.now[0].worstErrorPx, *view.now[1].worstErrorPx);
    EXPECT_TRUE(view.now[0].crackPx && view.now[1].crackPx);
    settings_.lod.tauPx = 8;
    EXPECT_TRUE(shown(session).stale);
}

TEST_F(CompareControllerTest, aFlightIsMeasuredBesideItAndCanBeCancelled) {
    Session session = sessionOfSlope();
    ASSERT_TRUE(start(session));
    settings_.lod.tauPx = 16;
    frame(session);
    const auto missing =
        compareFlight(controller_, session, settings_, viewport_.main.view, {folder_ / "none.toml", 2});
    EXPECT_FALSE(missing);
    EXPECT_THAT(shown(session).flight.problem, HasSubstr("none.toml"));
    std::ofstream(folder_ / "down.toml")
        << "name = \"Down\"\n[[key]]\ntime_s = 0\nlatitude_deg = 0\nlongitude_deg = 10\naltitude_m = 3e6\n"
           "heading_deg = 0\npitch_deg = -80\n[[key]]\ntime_s = 0.2\nlatitude_deg = 0\nlongitude_deg = 10\n"
           "altitude_m = 2e6\nheading_deg = 0\npitch_deg = -80\n";
    const ui::CompareOverFlight wanted{folder_ / "down.toml", 2};
    ASSERT_TRUE(compareFlight(controller_, session, settings_, viewport_.main.view, wanted));
    EXPECT_TRUE(shown(session).flight.running);
    ASSERT_TRUE(advanceUntil(session, [&] {
        frame(session);
        return !controller_.flight.job;
    }));
    ASSERT_TRUE(controller_.flight.last) << controller_.flight.problem;
    EXPECT_LT(*(*controller_.flight.last)[0].triangles, *(*controller_.flight.last)[1].triangles);
    EXPECT_THAT(shown(session).flight.lastName,
                HasSubstr("Down, 2 sample frames. A: Tolerance τ 16. B: Tolerance τ 2"));

    ASSERT_TRUE(compareFlight(controller_, session, settings_, viewport_.main.view,
                              {folder_ / "down.toml", 100'000}));
    controller_.flight.job->cancel();
    EXPECT_TRUE(shown(session).flight.stopping);
    ASSERT_TRUE(advanceUntil(session, [&] {
        frame(session);
        return !controller_.flight.job;
    }));
    EXPECT_FALSE(controller_.flight.last);
    EXPECT_EQ(shown(session).flight.problem, "Cancelled.");
}

TEST(CompareOverlay, theShownPartsMeetAtTheDividerAndLieWhereTheirPixelsDo) {
    const ui::Rect viewport{100, 50, 400, 300};
    ui::CompareView compare;
    CompareSettings shown;
    ASSERT_EQ(ui::shownParts(compare, shown, viewport).size(), 1u);
    compare.on = true;
    std::vector<ui::ShownPart> parts = ui::shownParts(compare, shown, viewport);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_FALSE(parts[0].isB);
    EXPECT_TRUE(parts[1].isB);
    EXPECT_EQ(parts[0].part.x + parts[0].part.width, parts[1].part.x);
    // As the mixed picture has them: its first column shows column 100 of A.
    const planet::gl::PictureMix mix = planet::gl::sideBySideMix(400);
    EXPECT_EQ(parts[0].whole.x, viewport.x - static_cast<float>(planet::gl::pictureColumn(mix, 0)));
    EXPECT_EQ(parts[1].whole.x, viewport.x + 200 - static_cast<float>(planet::gl::pictureColumn(mix, 200)));
    shown.mode = CompareMode::Wipe;
    shown.wipe = 0.25;
    parts = ui::shownParts(compare, shown, viewport);
    EXPECT_EQ(parts[1].part.x, 200);
    EXPECT_EQ(parts[1].part.width, 300);
    EXPECT_EQ(parts[1].whole.x, viewport.x);
    shown.mode = CompareMode::Flip;
    shown.showB = true;
    parts = ui::shownParts(compare, shown, viewport);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_TRUE(parts[0].isB);
}

}  // namespace
}  // namespace worldy
