#include "app/session/session.h"

#include <gmock/gmock.h>

#include "app/base/picture_file.h"
#include "tests/app/session_fixture.h"
#include "tests/support/sanitized.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SessionTest : public test::SessionTest {
protected:
    const planet::Planet* shownPlanet(Session& session) { return shownScene(session)->planet.get(); }

    // Everything that a view from a height asks for can be loaded, without a problem.
    void expectLoads(Scene& scene) {
        const double radiusM = scene.planet->tree().shape.radiusM;
        const planet::View view = planet::viewFromPose({.altitudeM = 200'000}, radiusM, 1.0, 640, 480);
        EXPECT_TRUE(settleScene(scene, view, settings_, 60));
        EXPECT_TRUE(scene.planet->takeProblems().empty());
        EXPECT_EQ(scene.planet->paging()[planet::BlockKind::Heights].failed, 0u);
    }
};

TEST_F(SessionTest, aChunkFileIsOpenInTheFirstFrame) {
    Session session = sessionOf(bakeTo("slope.chk", {.faceSize = 65, .chunkSize = 17, .radiusM = 2e6}));
    EXPECT_EQ(shownScene(session), nullptr);
    advanceSession(session, settings_, log_);
    ASSERT_NE(shownScene(session), nullptr);
    const ui::DataView data = dataViewOf(session, {});
    EXPECT_EQ(data.name, "slope.chk");
    EXPECT_EQ(data.problem, "");
    const ui::BakeView bake = bakeViewOf(session);
    EXPECT_EQ(bake.current.settings.chunkSize, 17);
    EXPECT_EQ(bake.current.settings.faceSize, 65);
    EXPECT_EQ(bake.current.settings.radiusM, 2e6);
    EXPECT_FALSE(bake.canBake);
    EXPECT_FALSE(bake.compressionKnown);
}

TEST_F(SessionTest, aPlanetFromNothingIsBakedAndItsFileTellsHowToMakeItAgain) {
    const std::string text = "noise:fbm,seed=6,octaves=2,feature_deg=90";
    Session session = sessionOf(text);
    ASSERT_TRUE(advanceUntilQuiet(session));
    ASSERT_NE(shownScene(session), nullptr);
    EXPECT_EQ(bakeViewOf(session).current.source, text);
    EXPECT_EQ(dataViewOf(session, {}).name, text);
    const fs::path moved = session.data.chunkFile.parent_path().parent_path() / "moved.chk";
    fs::copy_file(session.data.chunkFile, moved);
    Session again = sessionOf(moved);
    advanceSession(again, settings_, log_);
    const ui::BakeView bake = bakeViewOf(again);
    EXPECT_EQ(bake.current.source, text);
    EXPECT_TRUE(bake.canBake);
    // A bad text is told as such, and nothing changes.
    BakeRequest request = bake.current;
    request.source = "noise:fbm,octaves=99";
    startBake(again, request, log_);
    EXPECT_THAT(bakeViewOf(again).lastProblem, HasSubstr("octaves is 99"));
    EXPECT_FALSE(bakeViewOf(again).running);
}

TEST_F(SessionTest, aSourceIsBakedAndThenShown) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    EXPECT_TRUE(bakeViewOf(session).running);
    ASSERT_TRUE(advanceUntilQuiet(session));
    ASSERT_NE(shownScene(session), nullptr);
    const ui::BakeView bake = bakeViewOf(session);
    EXPECT_TRUE(bake.canBake);
    EXPECT_TRUE(bake.compressionKnown);
    EXPECT_TRUE(bake.lastReport);
    EXPECT_EQ(bake.current.source, source);
    EXPECT_FALSE(dataViewOf(session, {}).hasPreviousBake);
}

TEST_F(SessionTest, aLongBakeShowsAFirstLookAndThenTakesItsPlace) {
    Session session = sessionOf(writeSource(), {.faceSize = 2049});
    ASSERT_TRUE(advanceUntil(session, [&] { return shownScene(session) != nullptr; }));
    EXPECT_TRUE(bakeViewOf(session).running);
    EXPECT_TRUE(dataViewOf(session, {}).isFirstLook);
    EXPECT_EQ(planet::faceCells(shownScene(session)->planet->tree().shape), firstLookFaceSize - 1);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_FALSE(dataViewOf(session, {}).isFirstLook);
    EXPECT_FALSE(dataViewOf(session, {}).hasPreviousBake);
    EXPECT_EQ(planet::faceCells(shownScene(session)->planet->tree().shape), 2048);
    expectLoads(*shownScene(session));
}

TEST_F(SessionTest, aFirstLookStaysIfTheWholeBakeIsCancelledAndIsNotBakedAgain) {
    const fs::path source = writeSource();
    const planet::BakeSettings settings{.faceSize = 16385, .chunkSize = 17};
    {
        Session session = sessionOf(source, settings);
        ASSERT_TRUE(advanceUntil(session, [&] { return shownScene(session) != nullptr; }));
        cancelBake(session);
        ASSERT_TRUE(advanceUntilQuiet(session));
        EXPECT_TRUE(dataViewOf(session, {}).isFirstLook);
        EXPECT_EQ(dataViewOf(session, {}).problem, "");
    }
    EXPECT_EQ(filesInCache(), 1u);
    Session again = sessionOf(source, settings);
    advanceSession(again, settings_, log_);
    EXPECT_NE(shownScene(again), nullptr);
    EXPECT_TRUE(bakeViewOf(again).running);
}

TEST_F(SessionTest, exaggerationIsNoPartOfWhatTheFileWasBakedWith) {
    settings_.surface.exaggeration = 5;
    Session session = sessionOf(bakeTo("slope.chk", {.faceSize = 65, .chunkSize = 17, .quantumM = 2.0}));
    advanceSession(session, settings_, log_);
    EXPECT_EQ(bakeViewOf(session).current.settings.quantumM, 2.0);
}

TEST_F(SessionTest, aFileThatIsNotThereLeavesThePlanet) {
    Session session = sessionOf(bakeTo("slope.chk", {.faceSize = 65, .chunkSize = 17}));
    advanceSession(session, settings_, log_);
    const planet::Planet* before = shownPlanet(session);
    EXPECT_FALSE(openFile(session, "/nonexistent/moon.chk", settings_, log_));
    advanceSession(session, settings_, log_);
    EXPECT_EQ(shownPlanet(session), before);
    EXPECT_THAT(dataViewOf(session, {}).problem, HasSubstr("/nonexistent/moon.chk"));
    EXPECT_EQ(dataViewOf(session, {}).name, "slope.chk");
}

TEST_F(SessionTest, aBrokenFileLeavesThePlanetAndAGoodOneClearsTheMessage) {
    Session session = sessionOf(bakeTo("slope.chk", {.faceSize = 65, .chunkSize = 17}));
    advanceSession(session, settings_, log_);
    const planet::Planet* before = shownPlanet(session);
    std::ofstream(folder_ / "broken.chk") << "this is no chunk file";
    EXPECT_FALSE(openFile(session, folder_ / "broken.chk", settings_, log_));
    EXPECT_EQ(shownPlanet(session), before);
    EXPECT_THAT(dataViewOf(session, {}).problem, HasSubstr("broken.chk"));
    EXPECT_TRUE(openFile(session, bakeTo("other.chk", {.faceSize = 65, .chunkSize = 33}), settings_, log_));
    EXPECT_EQ(dataViewOf(session, {}).problem, "");
    EXPECT_EQ(dataViewOf(session, {}).name, "other.chk");
    EXPECT_FALSE(dataViewOf(session, {}).hasPreviousBake);
}

TEST_F(SessionTest, aBrokenImageIsToldOnceItsBakeHasFailed) {
    Session session = sessionOf(bakeTo("slope.chk", {.faceSize = 65, .chunkSize = 17}));
    advanceSession(session, settings_, log_);
    const planet::Planet* before = shownPlanet(session);
    std::ofstream(folder_ / "broken.tif") << "this is no image";
    EXPECT_TRUE(openFile(session, folder_ / "broken.tif", settings_, log_));
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(shownPlanet(session), before);
    EXPECT_THAT(dataViewOf(session, {}).problem, HasSubstr("broken.tif"));
    EXPECT_THAT(bakeViewOf(session).lastProblem, HasSubstr("broken.tif"));
}

TEST_F(SessionTest, anotherSourceIsBakedWhileTheOldPlanetFlies) {
    Session session = sessionOf(bakeTo("slope.chk", {.faceSize = 65, .chunkSize = 17}));
    advanceSession(session, settings_, log_);
    const planet::Planet* before = shownPlanet(session);
    const fs::path other = writeSource("other.pgm", 3);
    EXPECT_TRUE(openFile(session, other, settings_, log_));
    EXPECT_TRUE(bakeViewOf(session).running);
    EXPECT_EQ(shownPlanet(session), before);
    EXPECT_EQ(dataViewOf(session, {}).name, "slope.chk");
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(dataViewOf(session, {}).name, "other.pgm");
    EXPECT_FALSE(dataViewOf(session, {}).hasPreviousBake);
}

TEST_F(SessionTest, aBakeAtAnotherChunkSizeIsSwappedInAndTheOldOneKept) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    const planet::Planet* before = shownPlanet(session);
    startBake(session, requestFor(source, 17, 129), log_);
    ASSERT_TRUE(bakeViewOf(session).running);
    EXPECT_EQ(bakeViewOf(session).running->settings.chunkSize, 17);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(planet::chunkSize(shownScene(session)->planet->tree().shape), 17);
    EXPECT_EQ(bakeViewOf(session).current.settings.chunkSize, 17);
    ui::DataView data = dataViewOf(session, {});
    EXPECT_TRUE(data.hasPreviousBake);
    EXPECT_THAT(data.previousName, HasSubstr("33 vertices"));

    showPreviousBake(session, true);
    EXPECT_EQ(shownPlanet(session), before);
    EXPECT_TRUE(dataViewOf(session, {}).showsPreviousBake);
    EXPECT_EQ(bakeViewOf(session).current.settings.chunkSize, 33);
    expectLoads(*shownScene(session));
    showPreviousBake(session, false);
    EXPECT_NE(shownPlanet(session), before);
    showPreviousBake(session, true);
    dismissPreviousBake(session);
    EXPECT_FALSE(dataViewOf(session, {}).hasPreviousBake);
    EXPECT_EQ(planet::chunkSize(shownScene(session)->planet->tree().shape), 17);
}

TEST_F(SessionTest, twoBakesAfterEachOtherKeepTheOneBeforeTheLast) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    for (const int chunkSize : {17, 65}) {
        startBake(session, requestFor(source, chunkSize, 129), log_);
        ASSERT_TRUE(advanceUntilQuiet(session));
        showPreviousBake(session, true);
    }
    EXPECT_EQ(planet::chunkSize(session.open->scene.planet->tree().shape), 65);
    EXPECT_EQ(planet::chunkSize(session.previous->scene.planet->tree().shape), 17);
}

TEST_F(SessionTest, aSecondBakeIsRefusedWhileOneRuns) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    startBake(session, requestFor(source, 17, 8193), log_);
    startBake(session, requestFor(source, 65), log_);
    EXPECT_EQ(bakeViewOf(session).running->settings.chunkSize, 17);
}

TEST_F(SessionTest, aCancelledBakeChangesNothing) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    const planet::Planet* before = shownPlanet(session);
    const std::size_t files = filesInCache();
    startBake(session, requestFor(source, 17, 16385), log_);
    ASSERT_TRUE(advanceUntil(session, [&] { return bakeViewOf(session).progress.bake.samplesDone > 0; }));
    cancelBake(session);
    EXPECT_TRUE(bakeViewOf(session).stopping);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(shownPlanet(session), before);
    EXPECT_EQ(filesInCache(), files);
    EXPECT_THAT(bakeViewOf(session).lastProblem, HasSubstr("cancelled"));
    EXPECT_EQ(dataViewOf(session, {}).problem, "");
    EXPECT_FALSE(dataViewOf(session, {}).hasPreviousBake);
}

TEST_F(SessionTest, aBakeMayBeginAgainWhileTheCancelledOneStillEnds) {
    constexpr int faceSize = tests::sanitized ? 513 : 2049;
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    for (int i = 0; i < 3; ++i) {
        startBake(session, requestFor(source, 17, faceSize), log_);
        advanceSession(session, settings_, log_);
        cancelBake(session);
    }
    startBake(session, requestFor(source, 17, faceSize), log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(bakeViewOf(session).lastProblem, "");
    EXPECT_EQ(planet::faceCells(shownScene(session)->planet->tree().shape), faceSize - 1);
}

TEST_F(SessionTest, aFirstBakeThatIsCancelledCanBeBegunAgain) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    cancelBake(session);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(shownScene(session), nullptr);
    EXPECT_THAT(dataViewOf(session, {}).problem, HasSubstr("cancelled"));
    EXPECT_TRUE(bakeViewOf(session).canBake);
    startBake(session, log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_NE(shownScene(session), nullptr);
    EXPECT_EQ(dataViewOf(session, {}).problem, "");
}

TEST_F(SessionTest, aBakeIntoTheOpenFileLeavesBothReadable) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    const fs::path file = session.open->data.chunkFile;
    BakeRequest same;
    same.source = source;
    startBake(session, same, log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(session.open->data.chunkFile, file);
    ASSERT_TRUE(session.previous);
    expectLoads(session.open->scene);
    expectLoads(session.previous->scene);
}

TEST_F(SessionTest, aBakeCopiesFromTheOpenFileOrFromTheCache) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    ASSERT_TRUE(bakeViewOf(session).lastReport);
    EXPECT_GT(bakeViewOf(session).lastReport->sampledCells, 0u);
    // A planet of one level has no blocks to copy, but its heights are taken.
    const auto copiesAll = [&](Session& baked) {
        const auto report = bakeViewOf(baked).lastReport;
        return report && report->sampledCells == 0;
    };
    startBake(session, bakeViewOf(session).current, log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_TRUE(copiesAll(session)) << "from the open file";
    // The file is touched, so its bake has another name, but its heights are the same.
    fs::last_write_time(source, fs::last_write_time(source) + std::chrono::seconds(5));
    Session other = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(other));
    EXPECT_TRUE(copiesAll(other)) << "from the cache";
}

TEST_F(SessionTest, openingAnotherFileDuringABakeCancelsIt) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    const fs::path other = bakeTo("other.chk", {.faceSize = 65, .chunkSize = 65});
    startBake(session, requestFor(source, 17, 8193), log_);
    advanceSession(session, settings_, log_);
    EXPECT_TRUE(openFile(session, other, settings_, log_));
    EXPECT_FALSE(bakeViewOf(session).running);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(dataViewOf(session, {}).name, "other.chk");
    EXPECT_EQ(filesInCache(), 1u);
}

TEST_F(SessionTest, aBrokenFileDuringABakeLetsItGoOn) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    startBake(session, requestFor(source, 17, 1025), log_);
    EXPECT_FALSE(openFile(session, "/nonexistent/moon.chk", settings_, log_));
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(planet::faceCells(shownScene(session)->planet->tree().shape), 1024);
}

TEST_F(SessionTest, openingASourceThatIsBeingBakedWaitsForThatBake) {
    const fs::path source = writeSource();
    Session session = sessionOf(source);
    advanceSession(session, settings_, log_);
    const BakeJob* job = session.bake->job.get();
    ASSERT_NE(job, nullptr);
    EXPECT_TRUE(openFile(session, source, settings_, log_));
    ASSERT_TRUE(session.bake);
    EXPECT_EQ(session.bake->job.get(), job);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_NE(shownScene(session), nullptr);
}

TEST_F(SessionTest, leavingDuringABakeLeavesNoFile) {
    const fs::path source = writeSource();
    {
        Session session = sessionOf(source);
        ASSERT_TRUE(advanceUntilQuiet(session));
        startBake(session, requestFor(source, 17, 16385), log_);
        ASSERT_TRUE(advanceUntil(session, [&] { return bakeViewOf(session).progress.bake.samplesDone > 0; }));
    }
    EXPECT_EQ(filesInCache(), 1u);
}

TEST_F(SessionTest, aFileOfUnknownSourceIsBakedFromOneThatTheUserNames) {
    Session session = sessionOf(bakeTo("slope.chk", {.faceSize = 65, .chunkSize = 17}));
    advanceSession(session, settings_, log_);
    startBake(session, requestFor("/nonexistent/slope.tif", 33), log_);
    EXPECT_FALSE(bakeViewOf(session).running);
    EXPECT_THAT(bakeViewOf(session).lastProblem, HasSubstr("/nonexistent/slope.tif: no such source"));
    const fs::path source = writeSource("named.pgm");
    startBake(session, requestFor(source, 33), log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_TRUE(dataViewOf(session, {}).hasPreviousBake);
    EXPECT_TRUE(bakeViewOf(session).canBake);
    EXPECT_EQ(bakeViewOf(session).current.source, source);
}

TEST_F(SessionTest, theColourImageStaysOverBakes) {
    const fs::path source = writeSource();
    ASSERT_TRUE(writePicture({2, 1, {255, 0, 0, 0, 255, 0}}, folder_ / "colour.png"));
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_TRUE(dataViewOf(session, {}).hasColourImage);
    startBake(session, requestFor(source, 17), log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_TRUE(dataViewOf(session, {}).hasColourImage);
}

TEST_F(SessionTest, theSourcesOwnImageIsStreamedAndABakeOfTheSamePlanetKeepsIt) {
    const fs::path source = writeSource();
    ASSERT_TRUE(writePicture({2, 1, {255, 0, 0, 0, 255, 0}}, folder_ / "colour.png"));
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    ASSERT_TRUE(shownPlanet(session)->colour());
    ui::BakeView bake = bakeViewOf(session);
    EXPECT_EQ(bake.current.colour, folder_ / "colour.png");
    EXPECT_EQ(bake.current.settings.colour.faceSize, 257);
    EXPECT_EQ(bake.lostColours, "");

    BakeRequest request = bake.current;
    request.settings.chunkSize = 17;
    request.settings.colour.format = planet::ColourFormat::Lossless;
    startBake(session, request, log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    ASSERT_TRUE(shownPlanet(session)->colour());
    EXPECT_EQ(shownPlanet(session)->colour()->format, planet::ColourFormat::Lossless);
    EXPECT_EQ(bakeViewOf(session).current.colour, folder_ / "colour.png");
    EXPECT_EQ(bakeViewOf(session).lastReport->colourTiles, 6u);
    expectLoads(*shownScene(session));

    request.colour.clear();
    startBake(session, request, log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_FALSE(shownPlanet(session)->colour());
    EXPECT_TRUE(bakeViewOf(session).current.colour.empty());
    showPreviousBake(session, true);
    EXPECT_TRUE(shownPlanet(session)->colour());
    EXPECT_EQ(bakeViewOf(session).current.colour, folder_ / "colour.png");
}

TEST_F(SessionTest, anOwnImageThatCannotBeReadIsLeftOutAndOneThatIsNamedIsAnError) {
    const fs::path source = writeSource();
    std::ofstream(folder_ / "colour.png") << "no picture";
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    ASSERT_NE(shownScene(session), nullptr);
    const planet::Planet* before = shownPlanet(session);
    EXPECT_FALSE(before->colour());
    EXPECT_TRUE(bakeViewOf(session).current.colour.empty());
    BakeRequest request = requestFor(source, 17);
    request.colour = folder_ / "colour.png";
    startBake(session, request, log_);
    ASSERT_TRUE(advanceUntilQuiet(session));
    EXPECT_EQ(shownPlanet(session), before);
    EXPECT_THAT(bakeViewOf(session).lastProblem, HasSubstr((folder_ / "colour.png").string()));
    request.colour = "/nonexistent/map.png";
    startBake(session, request, log_);
    EXPECT_FALSE(bakeViewOf(session).running);
    EXPECT_THAT(bakeViewOf(session).lastProblem, HasSubstr("/nonexistent/map.png: no such colour image"));
}

TEST_F(SessionTest, aFileThatIsMovedKnowsItsImageByNameOrSaysWhatItWas) {
    const fs::path source = writeSource();
    ASSERT_TRUE(writePicture({2, 1, {255, 0, 0, 0, 255, 0}}, folder_ / "colour.png"));
    Session session = sessionOf(source);
    ASSERT_TRUE(advanceUntilQuiet(session));
    const fs::path beside = folder_ / "moved.chk";
    fs::create_directories(folder_ / "away");
    const fs::path away = folder_ / "away" / "moved.chk";
    for (const fs::path& file : {beside, away}) fs::copy_file(session.open->data.chunkFile, file);
    EXPECT_TRUE(openFile(session, beside, settings_, log_));
    EXPECT_EQ(bakeViewOf(session).current.colour, folder_ / "colour.png");
    EXPECT_TRUE(openFile(session, away, settings_, log_));
    EXPECT_TRUE(shownPlanet(session)->colour());
    EXPECT_TRUE(bakeViewOf(session).current.colour.empty());
    EXPECT_THAT(bakeViewOf(session).lostColours, HasSubstr("colour.png, 2 x 1"));
}

// As when several are dropped onto the window at once: the planet of the last may lie where that of the first
// has lain.
TEST_F(SessionTest, FilesOpenedInARowAreToldFromWhatWasThereBefore) {
    const std::array files = {bakeTo("a.chk", {.faceSize = 65, .chunkSize = 17}),
                              bakeTo("b.chk", {.faceSize = 65, .chunkSize = 33})};
    Session session = sessionOf(files[0]);
    ASSERT_TRUE(advanceUntil(session, [&] { return session.open.has_value(); }));
    for (int i = 0; i < 8; ++i) {
        const std::shared_ptr<const int> seen = shownScene(session)->identity;
        ASSERT_TRUE(openFile(session, files[1], settings_, log_));
        ASSERT_TRUE(openFile(session, files[0], settings_, log_));
        EXPECT_NE(shownScene(session)->identity, seen);
    }
}

}  // namespace
}  // namespace worldy
