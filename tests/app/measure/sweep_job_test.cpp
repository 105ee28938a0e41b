// A sweep on its own thread: the same points as without one, cancelled promptly, and what the window keeps.
#include "app/measure/sweep_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/base/picture_file.h"
#include "app/editor/sweep_controller.h"
#include "tests/app/session_fixture.h"
#include "tests/support/job_result.h"

namespace worldy {
namespace {

using planet::ErrorMetric;
using testing::HasSubstr;

class Sweeping : public test::SessionTest {
protected:
    Sweeping() {
        flight_ = folder_ / "down.toml";
        std::ofstream(flight_) << "name = \"Down\"\n"
                                  "[[key]]\ntime_s = 0\nlatitude_deg = 10\nlongitude_deg = 20\n"
                                  "altitude_m = 5e6\nheading_deg = 0\npitch_deg = -90\n"
                                  "[[key]]\ntime_s = 4\nlatitude_deg = 12\nlongitude_deg = 22\n"
                                  "altitude_m = 1e5\nheading_deg = 30\npitch_deg = -40\n";
    }

    SweepRequest request() const {
        SweepRequest request;
        request.flight = flight_;
        request.tausPx = {1, 4};
        request.metrics = {ErrorMetric::Additive, ErrorMetric::Tight};
        request.frames = 3;
        request.widthPx = 160;
        request.heightPx = 120;
        return request;
    }

    void openChunks(const SweepController& controller, int chunkSize, Session& session) {
        openSwept(controller.swept, controller.sourceSettings, chunkSize, session, settings_, log_);
    }

    SweepPlan planOver(const std::filesystem::path& chunkFile, int chunkSize) const {
        SweepPlan plan;
        plan.files = {{chunkSize, chunkFile, false, {}}};
        plan.flight = flight_;
        plan.tausPx = {1, 4};
        plan.metrics = {ErrorMetric::Additive, ErrorMetric::Tight};
        plan.frames = 3;
        plan.size = {160, 120};
        return plan;
    }

    // False if it does not end.
    bool advanceUntilDone(SweepController& controller) const {
        for (int i = 0; i < 60'000 && controller.job; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            advanceSweep(controller, log_);
        }
        return !controller.job;
    }

    // With a planet of 17 vertices a side that is open.
    Session openSession(const std::filesystem::path& file) {
        Session session = sessionOf(file);
        advanceUntilQuiet(session);
        advanceSession(session, settings_, log_);
        return session;
    }

    std::filesystem::path flight_;
};

// Times are those of the machine.
std::vector<SweepPoint> withoutTimes(std::vector<SweepPoint> points) {
    for (SweepPoint& point : points) point.figures.medianFrameMs = 0;
    return points;
}

TEST_F(Sweeping, BringsTheSamePointsOnAThreadAsWithoutOne) {
    const SweepPlan plan = planOver(bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17}), 17);
    SweepJob job(plan);
    const planet::Result<void> result = tests::resultOf(job);
    ASSERT_TRUE(result) << result.error().message;
    const std::vector<SweepPoint> inJob = job.takePoints();
    EXPECT_TRUE(job.takePoints().empty());
    EXPECT_EQ(job.progress().flown, 4u);
    EXPECT_EQ(job.progress().flights, 4u);

    std::vector<SweepPoint> directly;
    SweepWatcher watcher;
    watcher.flying = [](const SweepLeg&, int) { return true; };
    watcher.flown = [&](const SweepPoint& point) { directly.push_back(point); };
    ASSERT_TRUE(runSweepPlan(plan, watcher));
    ASSERT_EQ(inJob.size(), 4u);
    EXPECT_EQ(withoutTimes(inJob), withoutTimes(directly));
    EXPECT_EQ(inJob[1].tauPx, 4);
    EXPECT_EQ(inJob[2].metric, ErrorMetric::Tight);
    EXPECT_GT(inJob[0].figures.meanTriangles, inJob[1].figures.meanTriangles);
    EXPECT_GT(inJob[1].figures.worstMeasuredPx, 0);
}

TEST_F(Sweeping, DrawsBesideTheContextOfAnotherThread) {
    SweepPlan plan = planOver(bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17}), 17);
    plan.tausPx = {4};
    plan.metrics = {ErrorMetric::Additive};
    Session session = openSession(folder_ / "own.chk");
    ASSERT_TRUE(shownScene(session));
    SweepJob job(plan);
    const planet::View view = planet::viewFromPose({.altitudeM = 5e6}, 6'371'000, 1, 16, 16);
    auto target = planet::gl::RenderTarget::create(16, 16);
    ASSERT_TRUE(target);
    // Both draw at the same time.
    int frames = 0;
    std::optional<planet::Result<void>> result;
    while (!(result = job.takeResult())) {
        stepScene(*shownScene(session), view, settings_);
        target->bind();
        drawScene(*shownScene(session), view, settings_);
        ++frames;
    }
    ASSERT_TRUE(*result) << result->error().message;
    EXPECT_GT(frames, 0);
    EXPECT_GT(shownScene(session)->drawn.triangles(), 0u);
}

TEST_F(Sweeping, SuggestsATauThatKeepsTheGoal) {
    SweepPlan plan = planOver(bakeTo("own.chk", {.faceSize = 129, .chunkSize = 17}), 17);
    plan.goal = TauGoal{.limitsError = true, .limit = 0.5};
    SweepJob job(plan);
    const planet::Result<void> result = tests::resultOf(job);
    ASSERT_TRUE(result) << result.error().message;
    const std::vector<SweepSuggestion> found = job.takeSuggestions();
    ASSERT_EQ(found.size(), 2u);
    for (const SweepSuggestion& suggestion : found) {
        EXPECT_TRUE(suggestion.found.met);
        EXPECT_LE(suggestion.found.value, 0.5);
        EXPECT_LE(suggestion.found.flown, mostSuggestFlights());
        EXPECT_EQ(suggestion.chunkSize, 17);
    }
    // What is promised is there, and a tau a little larger breaks it.
    plan.goal.reset();
    plan.metrics = {ErrorMetric::Additive};
    plan.tausPx = {found[0].found.tauPx, std::min(found[0].found.tauPx * 1.05, 64.0)};
    SweepJob check(plan);
    ASSERT_TRUE(tests::resultOf(check));
    const std::vector<SweepPoint> points = check.takePoints();
    ASSERT_EQ(points.size(), 2u);
    EXPECT_EQ(points[0].figures.worstMeasuredPx, found[0].found.value);
    if (found[0].found.tauPx < 60) {
        EXPECT_GE(points[1].figures.worstMeasuredPx, found[0].found.value);
    }
}

TEST_F(Sweeping, CancelledEndsSoonAndLeavesNothingUnfinishedBehind) {
    SweepPlan plan = planOver(folder_ / "big.chk", 17);
    plan.source = writeSource();
    plan.files[0].needsBake = true;
    plan.files[0].bake = {.faceSize = 16385, .chunkSize = 17};
    {
        SweepJob job(plan);
        job.cancel();
        EXPECT_TRUE(job.cancelling());
        const planet::Result<void> result = tests::resultOf(job);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error().kind, planet::ErrorKind::Cancelled);
    }
    { const SweepJob outOfScope(plan); }
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        EXPECT_THAT(entry.path().string(), testing::Not(HasSubstr("big"))) << entry.path();
}

TEST_F(Sweeping, ThatCannotBeFlownSaysWhichFile) {
    const auto file = bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17});
    std::ofstream(folder_ / "bad.toml") << "name = 3\n";
    for (const auto& [plan, name] : {std::pair(planOver(folder_ / "gone.chk", 17), "gone.chk"),
                                     std::pair(planOver(file, 33), "own.chk")}) {
        SweepJob job(plan);
        const planet::Result<void> result = tests::resultOf(job);
        ASSERT_FALSE(result);
        EXPECT_THAT(result.error().message, HasSubstr(name));
    }
    SweepPlan plan = planOver(file, 17);
    plan.flight = folder_ / "bad.toml";
    SweepJob job(plan);
    const planet::Result<void> result = tests::resultOf(job);
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("bad.toml"));
}

TEST_F(Sweeping, BakesOtherChunkSizesIntoTheCacheAndOpensThemAtOnce) {
    Session session = openSession(writeSource());
    ASSERT_TRUE(shownPlanet(session));
    ASSERT_EQ(planet::chunkSize(shownScene(session)->planet->tree().shape), 33);
    SweepController controller;
    SweepRequest asked = request();
    asked.chunkSizes = {17, 33};
    startSweep(controller, shownPlanet(session), asked, settings_, log_);
    ASSERT_TRUE(controller.job) << controller.problem;
    EXPECT_TRUE(sweepViewOf(controller).running);
    ASSERT_TRUE(advanceUntilDone(controller));
    EXPECT_EQ(controller.problem, "");
    ASSERT_TRUE(controller.table);
    EXPECT_TRUE(controller.table->whole);
    ASSERT_EQ(controller.table->points.size(), 8u);
    EXPECT_EQ(controller.table->points[0].chunkSize, 17);
    EXPECT_EQ(filesInCache(), 2u);
    // By the name that the command line knows it by.
    const auto usual = findDataSet(folder_ / "slope.pgm", {.chunkSize = 17});
    ASSERT_TRUE(usual);
    EXPECT_FALSE(usual->needsBake);

    openChunks(controller, 17, session);
    EXPECT_FALSE(session.bake);
    EXPECT_EQ(planet::chunkSize(shownScene(session)->planet->tree().shape), 17);
    EXPECT_TRUE(session.previous);
    EXPECT_TRUE(bakeViewOf(session).canBake);
    openChunks(controller, 33, session);
    EXPECT_FALSE(session.bake);
    EXPECT_EQ(planet::chunkSize(shownScene(session)->planet->tree().shape), 33);
    // A bake that is gone is baked again.
    std::filesystem::remove(usual->chunkFile);
    openChunks(controller, 17, session);
    EXPECT_TRUE(session.bake);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(planet::chunkSize(shownScene(session)->planet->tree().shape), 17);
}

TEST_F(Sweeping, AFileOfUnknownSourceIsSweptInItsOwnChunksAlone) {
    Session session = openSession(bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17}));
    SweepController controller;
    SweepRequest asked = request();
    asked.chunkSizes = {33};
    startSweep(controller, shownPlanet(session), asked, settings_, log_);
    EXPECT_FALSE(controller.job);
    EXPECT_THAT(sweepViewOf(controller).problem, HasSubstr("own.chk"));
    EXPECT_THAT(sweepViewOf(controller).problem, HasSubstr("its own chunk size of 17"));
    asked.chunkSizes = {17};
    startSweep(controller, shownPlanet(session), asked, settings_, log_);
    EXPECT_TRUE(controller.job);
    EXPECT_EQ(controller.problem, "");
}

TEST_F(Sweeping, GoesOnWhenItsPlanetIsClosedAndItsFileIsGone) {
    const auto file = bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17});
    SweepController controller;
    {
        Session session = openSession(file);
        startSweep(controller, shownPlanet(session), request(), settings_, log_);
        ASSERT_TRUE(controller.job);
        while (controller.job && controller.job->progress().tauPx == 0 && controller.table->points.empty())
            advanceSweep(controller, log_);
    }
    std::filesystem::remove(file);
    ASSERT_TRUE(advanceUntilDone(controller));
    EXPECT_EQ(controller.problem, "");
    EXPECT_EQ(controller.table->points.size(), 4u);
}

TEST_F(Sweeping, CancelledKeepsItsPointsButPassesForNoWholeTable) {
    Session session = openSession(bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17}));
    SweepController controller;
    SweepRequest asked = request();
    asked.tausPx.assign(30, 1.0);
    startSweep(controller, shownPlanet(session), asked, settings_, log_);
    while (controller.table->points.empty()) advanceSweep(controller, log_);
    EXPECT_FALSE(saveSweep(controller, SweepCost::Triangles, folder_.path())) << "while it runs";
    cancelSweep(controller);
    ASSERT_TRUE(advanceUntilDone(controller));
    EXPECT_EQ(controller.problem, "The sweep was cancelled.");
    EXPECT_FALSE(controller.table->whole);
    EXPECT_LT(controller.table->points.size(), 60u);
    EXPECT_FALSE(saveSweep(controller, SweepCost::Triangles, folder_.path()));
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
        EXPECT_NE(entry.path().extension(), ".csv");
}

TEST_F(Sweeping, AWholeTableIsSavedThreeTimesUnderOneName) {
    Session session = openSession(bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17}));
    SweepController controller;
    startSweep(controller, shownPlanet(session), request(), settings_, log_);
    ASSERT_TRUE(advanceUntilDone(controller));
    auto saved = saveSweep(controller, SweepCost::MemoryMiB, folder_.path());
    ASSERT_TRUE(saved) << saved.error().message;
    EXPECT_TRUE(readPicture(*saved));
    std::filesystem::path table = *saved;
    std::ifstream csv(table.replace_extension(".csv"));
    EXPECT_EQ(std::count(std::istreambuf_iterator(csv), {}, '\n'), 5);
    EXPECT_TRUE(std::filesystem::exists(table.replace_extension(".json")));
    EXPECT_FALSE(saveSweep(controller, SweepCost::MemoryMiB, folder_ / "no such folder"));
}

TEST_F(Sweeping, HasNoPartInOverlaysNorInABadDisk) {
    const std::filesystem::path file = bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17});
    SweepPlan plan = planOver(file, 17);
    plan.tausPx = {4};
    const auto pointsOf = [&] {
        std::vector<SweepPoint> points;
        SweepWatcher watcher;
        watcher.flying = [](const SweepLeg&, int) { return true; };
        watcher.flown = [&](const SweepPoint& point) { points.push_back(point); };
        const planet::Result<void> result = runSweepPlan(plan, watcher);
        EXPECT_TRUE(result) << result.error().message;
        return withoutTimes(points);
    };
    const std::vector<SweepPoint> undisturbed = pointsOf();
    ASSERT_EQ(undisturbed.size(), 2u);
    plan.view.overlay.colourBy = ColourBy::Measured;
    plan.view.paging.badDisk.failureRate = 1;
    plan.view.paging.simulated = true;
    EXPECT_EQ(pointsOf(), undisturbed);
}

TEST_F(Sweeping, KeepsTheWindowsOtherSettingsAndItsChunkSize) {
    Session session = openSession(bakeTo("own.chk", {.faceSize = 65, .chunkSize = 17}));
    ViewSettings settings;
    settings.lod.morph = false;
    const auto plan = sweepPlanOf(*shownPlanet(session), request(), settings);
    ASSERT_TRUE(plan);
    EXPECT_FALSE(plan->view.lod.morph);
    EXPECT_EQ(plan->files[0].chunkSize, 17);
}

TEST(SecondsLeft, AreThoseOfTheSameTauOrElseTheMean) {
    const std::vector<LegTime> flown = {{0.5, 10}, {1, 4}};
    // Half of the third has taken 1 s; then 0.5 again, 1 again, and one of an unknown tau.
    const std::vector<double> ahead = {0.5, 1, 0};
    EXPECT_DOUBLE_EQ(*secondsLeft(flown, {2, 1}, 0.5, ahead), 1 + 10 + 4 + 7);
    EXPECT_DOUBLE_EQ(*secondsLeft(flown, {1, 3}, 0, {}), 1);
    EXPECT_DOUBLE_EQ(*secondsLeft(flown, {0, 0}, 1, {}), 0);
    EXPECT_FALSE(secondsLeft({}, {2, 1}, 0, ahead));
    EXPECT_DOUBLE_EQ(*secondsLeft({}, {2, 1}, 0.25, ahead), 3 + 3 * 4);
}

}  // namespace
}  // namespace worldy
