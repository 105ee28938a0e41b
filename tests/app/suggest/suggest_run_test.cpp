// Suggestions over a baked planet: what is measured, verified and written.
#include "app/suggest/suggest_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/flight/recorder.h"
#include "app/scene/scene_settings.h"
#include "app/settings/region_file.h"
#include "app/settings/settings_text.h"
#include "app/suggest/suggest_files.h"
#include "app/suggest/suggest_meter.h"
#include "app/suggest/suggest_plans.h"
#include "app/suggest/suggest_report.h"
#include "planet/bake/bake.h"
#include "planet/format/chunk_file.h"
#include "planet/measure/true_error.h"
#include "planet/paging/finest_heights.h"
#include "planet/planet.h"
#include "planet/source/height_source.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using testing::Not;

class SuggestPlanet : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = new tests::TemporaryFolder;
        const auto source = planet::openHeightSource("noise:fbm,seed=6,gain=0.7", {});
        ASSERT_TRUE(source);
        ASSERT_TRUE(planet::bake(*source, {.faceSize = 257, .chunkSize = 17, .radiusM = 1e6}, chunkFile()));
        std::ofstream(flight())
            << "name = \"Down\"\n"
               "[[key]]\ntime_s = 0\nlatitude_deg = 10\nlongitude_deg = 0\naltitude_m = 600e3\n"
               "heading_deg = 60\npitch_deg = -50\n"
               "[[key]]\ntime_s = 4\nlatitude_deg = 20\nlongitude_deg = 30\naltitude_m = 150e3\n"
               "heading_deg = 60\npitch_deg = -30\n";
    }
    static void TearDownTestSuite() { delete folder_; }
    static std::filesystem::path chunkFile() { return folder_->path() / "planet.chk"; }
    static std::filesystem::path flight() { return folder_->path() / "down.toml"; }

    static SuggestRequest requestOf(const std::string& budget) {
        SuggestRequest request;
        request.file = chunkFile();
        request.budget = suggestBudgetFromText(budget).value();
        request.flights = {flight()};
        request.drawsPictures = false;
        request.size = {640, 400};
        return request;
    }
    static SuggestWatcher patient() {
        return {.progress = [](const SuggestProgress&) { return true; }};
    }
    static SuggestOutcome suggest(const SuggestRequest& request) {
        auto outcome = runSuggest(request, patient());
        EXPECT_TRUE(outcome) << outcome.error().message;
        return outcome ? *std::move(outcome) : SuggestOutcome{};
    }
    static double valueOf(const SuggestMeasured& measured, SuggestLimit limit) {
        return measured.figures.values[static_cast<std::size_t>(limit)];
    }
    // Figures that were not measured are no numbers, which are not equal.
    static SuggestFigures known(SuggestFigures figures) {
        for (double& value : figures.values) value = std::isnan(value) ? -1 : value;
        return figures;
    }
    static std::unique_ptr<planet::Planet> openSimulated() {
        return planet::Planet::open(chunkFile(), pagingSettingsOf({}, false, planet::PagingTime::Simulated))
            .value();
    }

    static inline tests::TemporaryFolder* folder_ = nullptr;
};

TEST_F(SuggestPlanet, meetsABudgetThatTheSettingsExceedAndWritesWhatItMeasured) {
    SuggestRequest request = requestOf("8 k triangles, 64 MiB");
    const std::filesystem::path folder = folder_->path() / "written";
    const SuggestFiles files = suggestFilesIn(folder, "good");
    request.presetFile = files.preset;
    request.regionsFile = files.regions;
    const SuggestOutcome outcome = suggest(request);
    EXPECT_GT(valueOf(outcome.beforeMeasured, SuggestLimit::Triangles), 8000);
    EXPECT_TRUE(outcome.isMet);
    EXPECT_LE(valueOf(outcome.measured, SuggestLimit::Triangles), 8000);
    EXPECT_LE(outcome.settings.paging.budgetMB, 64);
    // The measurement of what is read back is the one that the search saw.
    EXPECT_EQ(known(outcome.measured.figures), known(outcome.found.best.figures));

    ASSERT_TRUE(writeSuggestion(outcome, request, folder, "good"));
    ViewSettings read = loadViewSettings(files.preset, request.view).value();
    read.regions = outcome.settings.regions;
    EXPECT_EQ(read, outcome.settings);
    EXPECT_EQ(std::filesystem::exists(files.regions), !outcome.regionsText.empty());
    if (!outcome.regionsText.empty()) {
        EXPECT_EQ(loadRegions(files.regions).value(), outcome.settings.regions.all());
    }
    EXPECT_TRUE(std::filesystem::exists(files.page));
    EXPECT_THAT(tests::contentOf(files.report), HasSubstr("The suggested settings meet the budget"));
    EXPECT_THAT(tests::contentOf(files.report), HasSubstr("worldy shot "));
}

TEST_F(SuggestPlanet, regionsOfAnEarlierSuggestionAreRemovedAndThoseOfTheUserAreKept) {
    const SuggestRequest request = requestOf("10 M triangles");
    const SuggestOutcome outcome = suggest(request);
    ASSERT_EQ(outcome.regionsText, "");
    const std::filesystem::path folder = folder_->path() / "again";
    const SuggestFiles files = suggestFilesIn(folder, "good");
    std::filesystem::create_directory(folder);
    const auto write = [&](const std::string& name) {
        std::ofstream(files.regions) << "[[region]]\nname = \"" << name << "\"\ntau_factor = 2\n";
        ASSERT_TRUE(writeSuggestion(outcome, request, folder, "good"));
    };
    for (const char* const suggested : {"suggested places", "suggested heights 2"}) {
        write(suggested);
        EXPECT_FALSE(std::filesystem::exists(files.regions)) << suggested;
    }
    for (const char* const own : {"suggested", "suggested placeship", "peaks"}) {
        write(own);
        EXPECT_TRUE(std::filesystem::exists(files.regions)) << own;
    }
}

TEST_F(SuggestPlanet, settingsThatMeetTheirBudgetAreReportedAsSuch) {
    const SuggestOutcome outcome = suggest(requestOf("10 M triangles"));
    EXPECT_TRUE(outcome.isMet);
    EXPECT_TRUE(outcome.found.isUnchanged);
    EXPECT_TRUE(outcome.changes.empty());
    EXPECT_EQ(outcome.settings, ViewSettings{});
    EXPECT_EQ(known(outcome.measured.figures), known(outcome.beforeMeasured.figures));
    EXPECT_THAT(verdictText(outcome), HasSubstr("Nothing needs to change"));
}

TEST_F(SuggestPlanet, aBudgetThatCannotBeMetIsNeverSaidToBe) {
    const SuggestOutcome outcome = suggest(requestOf("6 k triangles, 0.2 px"));
    EXPECT_FALSE(outcome.isMet);
    EXPECT_THAT(verdictText(outcome), HasSubstr("is not met"));
    EXPECT_THAT(verdictText(outcome), HasSubstr("binds"));
    EXPECT_THAT(verdictText(outcome), HasSubstr("would have to allow"));
    for (const SuggestRow& row : rowsOf(outcome)) {
        if (row.budget && row.after > *row.budget) {
            EXPECT_THAT(row.verdict, HasSubstr("exceeded by"));
        }
    }
}

TEST_F(SuggestPlanet, aGivenCostOfFramesIsPredictedAndSaidToBe) {
    SuggestRequest request = requestOf("0.7 ms");
    // 0.7 ms are 8,000 triangles.
    request.cost = frameCostFromText("0.5 ms + 25 ms per million triangles").value();
    const SuggestOutcome outcome = suggest(request);
    EXPECT_TRUE(outcome.isMet);
    EXPECT_NEAR(valueOf(outcome.measured, SuggestLimit::FrameMs),
                0.5 + 25e-6 * valueOf(outcome.measured, SuggestLimit::Triangles), 1e-9);
    EXPECT_LE(valueOf(outcome.measured, SuggestLimit::Triangles), 8000);
    EXPECT_THAT(verdictText(outcome), HasSubstr("predicted and not measured"));
    EXPECT_EQ(rowsOf(outcome).front().verdict, "predicted to be met");
}

TEST_F(SuggestPlanet, cancellingEndsTheSearchWherever) {
    const SuggestRequest request = requestOf("8 k triangles");
    for (const int after : {0, 1, 100, 400}) {
        int calls = 0;
        const auto outcome =
            runSuggest(request, {.progress = [&](const SuggestProgress&) { return calls++ < after; }});
        ASSERT_FALSE(outcome) << after;
        EXPECT_EQ(outcome.error().kind, planet::ErrorKind::Cancelled);
        EXPECT_EQ(calls, after + 1);
    }
}

TEST_F(SuggestPlanet, onlyWhatMayVaryDoes) {
    SuggestRequest request = requestOf("8 k triangles");
    request.vary = suggestVaryFromTexts({"tau"}).value();
    const SuggestOutcome outcome = suggest(request);
    ASSERT_EQ(outcome.changes.size(), 1u);
    EXPECT_EQ(outcome.changes[0].setting, "lod.tau_px");
    EXPECT_THAT(suggestVaryFromTexts({"tau", "colour"}).error().message, HasSubstr("colour is unknown"));
    EXPECT_THAT(suggestVaryFromTexts({"tau", "tau"}).error().message, HasSubstr("given twice"));
}

TEST_F(SuggestPlanet, aRecordingIsMeasuredWithItsOwnViews) {
    const std::filesystem::path file = folder_->path() / "recorded.flight";
    std::vector<planet::View> views;
    {
        const auto planet = openSimulated();
        Recorder recorder(*planet, "Recorded");
        for (int i = 0; i < 40; ++i) {
            const planet::View view =
                planet::viewFromPose({.latitudeDeg = 10.0 + i, .altitudeM = 400e3}, 1e6, 0.9, 500, 300);
            recorder.givenSettings(*planet, {}, false);
            const planet::ViewInput input{.lodView = view, .lod = {}};
            planet->step({&input, 1}, planet::noUpload, 0.1);
            recorder.stepped(*planet, std::vector{1.0});
            views.push_back(view);
        }
        ASSERT_TRUE(recorder.write(file));
    }
    SuggestRequest request = requestOf("10 M triangles");
    request.flights.clear();
    request.recordings = {file};
    const SuggestOutcome outcome = suggest(request);
    EXPECT_EQ(outcome.frames, std::vector<std::size_t>{40});
    for (const SuggestWorst& worst : outcome.measured.worst[1]) EXPECT_EQ(worst.view, views[worst.frame]);

    // A recording among the flights is measured along its path, or with its views if the request says so.
    SuggestRequest flown = requestOf("10 M triangles");
    flown.flights = {file};
    EXPECT_NE(suggest(flown).frames, std::vector<std::size_t>{40});
    flown.viewsOfRecordings = true;
    const SuggestOutcome asRecorded = suggest(flown);
    EXPECT_EQ(asRecorded.legs, std::vector<std::string>{"Recorded (as recorded)"});
    EXPECT_TRUE(asRecorded.hasRecordings);
    EXPECT_EQ(known(asRecorded.measured.figures), known(outcome.measured.figures));

    const auto other = planet::openHeightSource("noise:fbm,seed=7", {});
    request.file = folder_->path() / "other.chk";
    ASSERT_TRUE(planet::bake(*other, {.faceSize = 129, .chunkSize = 17, .radiusM = 1e6}, request.file));
    const auto refused = runSuggest(request, patient());
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("recorded.flight"));
    flown.file = request.file;
    const SuggestOutcome onOther = suggest(flown);
    EXPECT_EQ(onOther.legs, std::vector<std::string>{"Recorded"});
    EXPECT_FALSE(onOther.hasRecordings);
}

TEST_F(SuggestPlanet, otherChunkSizesAreBakedAndMeasured) {
    SuggestRequest request = requestOf("8 k triangles");
    request.vary = {.metric = false, .morph = false, .memory = false, .regions = false};
    const std::filesystem::path other = folder_->path() / "other chunks.chk";
    request.bakes.source = "noise:fbm,seed=6,gain=0.7";
    request.bakes.files = {{33, other, true, {.faceSize = 257, .chunkSize = 33, .radiusM = 1e6}}};

    // A search that is cancelled while it bakes leaves no file.
    const auto cancelled = runSuggest(request, {.progress = [](const SuggestProgress& progress) {
                                          return progress.stage != SuggestStage::Baking;
                                      }});
    ASSERT_FALSE(cancelled);
    EXPECT_EQ(cancelled.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_FALSE(std::filesystem::exists(other));

    int baked = 0;
    const auto outcome = runSuggest(request, {.progress = [&](const SuggestProgress& progress) {
                                        if (progress.stage == SuggestStage::Baking)
                                            baked = progress.candidate.chunkSize;
                                        return true;
                                    }});
    ASSERT_TRUE(outcome) << outcome.error().message;
    EXPECT_EQ(baked, 33);
    EXPECT_EQ(planet::chunkSize(planet::ChunkFile::open(other)->info().shape), 33);
    EXPECT_TRUE(std::ranges::any_of(
        outcome->found.trials, [](const SuggestTrial& trial) { return trial.candidate.chunkSize == 33; }));
    EXPECT_EQ(outcome->file, outcome->found.best.candidate.chunkSize == 33 ? other : chunkFile());
}

TEST_F(SuggestPlanet, viewpointsOfTheWholePlanetMustAllBeWithinTheBudget) {
    SuggestRequest request = requestOf("25 k triangles");
    request.flights.clear();
    request.survey = planet::AtlasGrid{.altitudesM = {100e3}, .headings = 2, .most = 40};
    const SuggestOutcome outcome = suggest(request);
    EXPECT_TRUE(outcome.isMet);
    const auto& worst = outcome.measured.worst[static_cast<std::size_t>(SuggestLimit::Triangles)];
    EXPECT_EQ(worst.front().value, valueOf(outcome.measured, SuggestLimit::Triangles));
    EXPECT_EQ(outcome.frames.front(), outcome.measured.figures.frames);
}

TEST_F(SuggestPlanet, viewsThatTheDiskNeverLoadsMeetNoBudget) {
    SuggestRequest request = requestOf("12 k triangles");
    request.flights.clear();
    request.survey = planet::AtlasGrid{.altitudesM = {100e3}, .headings = 1, .most = 24};
    request.view.lod.tauPx = 0.1;
    request.view.paging.badDisk.bandwidthMBs = 0.00005;
    request.vary = suggestVaryFromTexts({"tau"}).value();
    const SuggestOutcome outcome = suggest(request);
    EXPECT_GT(outcome.beforeMeasured.figures.unsettled, 0u);
    EXPECT_TRUE(std::isnan(valueOf(outcome.beforeMeasured, SuggestLimit::Triangles)));
    EXPECT_FALSE(outcome.found.isUnchanged);
    EXPECT_THAT(verdictText(outcome), Not(HasSubstr("already meet")));
    if (outcome.isMet) {
        EXPECT_EQ(outcome.measured.figures.unsettled, 0u);
        EXPECT_EQ(outcome.measured.figures.lateShare, 0);
    } else {
        EXPECT_THAT(verdictText(outcome), HasSubstr("not loaded within 120 s of the simulated disk"));
    }
    // The whole disk is simulated, so a flight that begins there is not known either.
    request.flights = {flight()};
    request.survey.reset();
    request.vary.tau = false;
    const SuggestOutcome flown = suggest(request);
    EXPECT_FALSE(flown.isMet);
    EXPECT_EQ(flown.measured.figures.unsettled, 1u);
    EXPECT_THAT(verdictText(flown), HasSubstr("1 view was not loaded"));
    EXPECT_TRUE(suggestJson(flown, request)["suggested"]["triangles"].is_null());
    EXPECT_EQ(suggestJson(flown, request)["suggested"]["unsettled"], 1);
    for (const SuggestRow& row : rowsOf(flown)) EXPECT_EQ(row.verdict, "not measured");

    SuggestMeter meter(openSimulated(), request.view, {}, {});
    const auto ground = meter.groundIn(candidateOf(request.view),
                                       planet::viewFromPose({.altitudeM = 100e3}, 1e6, 1, 640, 400));
    ASSERT_FALSE(ground);
    EXPECT_THAT(ground.error().message, HasSubstr("not loaded within 120 s"));
}

TEST_F(SuggestPlanet, aFastDiskSettlesEveryView) {
    SuggestRequest request = requestOf("10 M triangles");
    request.view.paging.badDisk.latencyMs = 1;
    const SuggestOutcome outcome = suggest(request);
    EXPECT_TRUE(outcome.isMet);
    EXPECT_EQ(outcome.measured.figures.unsettled, 0u);
    EXPECT_THAT(verdictText(outcome), Not(HasSubstr("not loaded")));
}

TEST_F(SuggestPlanet, theCommandInTheReportNamesTheSuggestedBakeAndQuotesNames) {
    SuggestRequest request = requestOf("10 M triangles");
    SuggestOutcome outcome = suggest(request);
    outcome.file = "/out/planet of 17.chk";
    EXPECT_THAT(
        suggestMarkdown(outcome, request, "my best", false),
        HasSubstr("`worldy shot '/out/planet of 17.chk' --settings 'my best.toml' -o shot.png` draws"));
    outcome.regionsText = "regions";
    EXPECT_THAT(suggestMarkdown(outcome, request, "best", false),
                HasSubstr("`worldy shot '/out/planet of 17.chk' --settings best.toml --regions "
                          "best.regions.toml -o shot.png` draws"));
    request.presetFile = "/a b/best.toml";
    request.regionsFile = "/a b/best.regions.toml";
    EXPECT_THAT(
        suggestMarkdown(outcome, request, "best", false),
        HasSubstr("--settings '/a b/best.toml' --regions '/a b/best.regions.toml' -o shot.png` draws"));
}

TEST_F(SuggestPlanet, theReportStatesSizeAndFieldOfViewAndItsPathsWorkInAnyFolder) {
    SuggestRequest request = requestOf("10 M triangles");
    request.view.camera.fovDeg = 50;
    SuggestOutcome outcome = suggest(request);
    nameSuggestFiles(request, "a b/best.toml", "a b/best.regions.toml", outcome);
    const std::string report = suggestMarkdown(outcome, request, "my best", true);
    EXPECT_THAT(report, HasSubstr("640x400 pixels with a field of view of 50\u00b0"));
    EXPECT_THAT(report, HasSubstr("](my%20best.png)"));
    const std::string preset = (std::filesystem::current_path() / "a b/best.toml").string();
    ASSERT_FALSE(outcome.places.empty());
    for (const SuggestPlace& place : outcome.places) EXPECT_THAT(place.line, HasSubstr(preset));
    EXPECT_THAT(report, Not(HasSubstr("--settings 'a b")));
}

// The budget is 16 ms.
SuggestOutcome timedOutcome(double beforeMs, double afterMs) {
    SuggestOutcome outcome;
    outcome.budget[SuggestLimit::FrameMs] = 16;
    outcome.found.best.candidate.tauPx = 20;
    outcome.beforeMeasured.figures.values = {beforeMs, 1e5, 1e6, 6};
    outcome.measured.figures.values = {afterMs, 5e4, 1e6, 80};
    return outcome;
}

TEST(SuggestOutcomes, settingsThatMissTheBudgetByMoreThanThoseOfNowAreNoBetter) {
    EXPECT_TRUE(isNoBetter(timedOutcome(45.4, 49.6)));
    EXPECT_TRUE(isNoBetter(timedOutcome(45.4, 45.4)));
    EXPECT_FALSE(isNoBetter(timedOutcome(45.4, 30)));
    EXPECT_FALSE(isNoBetter(timedOutcome(45.4, 15)));
}

TEST(SuggestOutcomes, theReportSaysThatNothingIsBetter) {
    SuggestOutcome outcome = timedOutcome(45.4, 45.4);
    EXPECT_FALSE(keepsSettings(outcome));
    EXPECT_THAT(verdictText(outcome), HasSubstr("the closest settings have 45.4 ms"));
    outcome.found.best = outcome.found.before;
    EXPECT_TRUE(keepsSettings(outcome));
    EXPECT_THAT(verdictText(outcome), HasSubstr("the settings of now have 45.4 ms of 16 ms"));
    EXPECT_THAT(verdictText(outcome), HasSubstr("Nothing that was found is better, so no setting changes."));
}

TEST(SuggestOutcomes, aLargeExcessIsAFactor) {
    EXPECT_EQ(rowsOf(timedOutcome(45, 24))[0].verdict, "predicted to be exceeded by 50 %");
    EXPECT_EQ(rowsOf(timedOutcome(45, 184'000))[0].verdict, "predicted to be exceeded 11.5 k-fold");
}

TEST_F(SuggestPlanet, aFlightWithoutANameIsCalledAsItsFile) {
    SuggestRequest request = requestOf("10 M triangles");
    const std::filesystem::path unnamed = folder_->path() / "low_pass.toml";
    std::ofstream(unnamed) << tests::contentOf(flight()).substr(std::string("name = \"Down\"\n").size());
    request.flights = {flight(), unnamed};
    const SuggestOutcome outcome = suggest(request);
    EXPECT_EQ(outcome.legs, (std::vector<std::string>{"Down", "low pass"}));
}

TEST(SuggestBudgets, anErrorListsEveryUnitThatIsKnown) {
    const auto wrong = suggestBudgetFromText("3 furlongs");
    ASSERT_FALSE(wrong);
    EXPECT_THAT(wrong.error().message,
                HasSubstr("ms, triangles, k triangles, M triangles, KiB, MiB, GiB, MB, GB or px"));
}

TEST_F(SuggestPlanet, theDrawnErrorBoundsTheTrueErrorForBothMetrics) {
    planet::FinestHeights heights(
        std::make_shared<const planet::ChunkFile>(planet::ChunkFile::open(chunkFile()).value()));
    for (const planet::ErrorMetric metric : {planet::ErrorMetric::Additive, planet::ErrorMetric::Tight}) {
        const auto planet = openSimulated();
        const planet::LodSettings lod{.metric = metric, .tauPx = 4};
        const planet::View view =
            planet::viewFromPose({.latitudeDeg = 10, .altitudeM = 250e3, .pitchDeg = -40}, 1e6, 1, 640, 400);
        ASSERT_TRUE(planet->settle(view, lod, planet::noUpload, 60));
        const double boundPx = drawnErrorPx(planet->tree(), planet->selection(), view, lod);
        const auto report = planet::measureTrueError(
            planet::snapshotOf(planet->tree(), planet->selection().draw, view, false), heights);
        EXPECT_GT(report->worstFacingPx, 0.1);
        EXPECT_GE(boundPx, report->worstFacingPx);
        // It is no looser than the bound by the metric that has selected.
        EXPECT_LE(boundPx, static_cast<double>(planet->selection().counters.worstDrawnBoundPx) * 1.0001);
    }
}

TEST(SuggestPlans, aCircleAndABandCoverTheGround) {
    std::vector<SuggestGround> ground;
    for (int i = 0; i < 100; ++i) {
        const double angle = 0.001 * (i - 50);
        ground.push_back({{std::cos(angle), std::sin(angle), 0}, 0.0001, 10.0 * i});
    }
    const planet::RegionCircle circle = circleOver(ground, 1e6);
    EXPECT_NEAR(circle.centre.latitudeDeg, 0, 0.1);
    EXPECT_NEAR(circle.radiusM, 0.04 * 1e6, 1000);
    const planet::HeightBand band = bandOver(ground);
    EXPECT_NEAR(band.lowestM, 200, 20);
    EXPECT_NEAR(band.highestM, 800, 20);

    const planet::Region taken{.name = "suggested places"};
    const std::vector<std::vector<SuggestGround>> frames = {ground, {}};
    const auto plans = plansOver(frames, 1e6, {&taken, 1});
    ASSERT_EQ(plans.size(), 2u);
    EXPECT_EQ(plans[0].regions[0].name, "suggested places 2");
    EXPECT_EQ(plans[0].regions[0].circles.size(), 1u);
    for (const SuggestPlan& plan : plans) EXPECT_TRUE(planet::checkRegions(plan.regions));
    EXPECT_TRUE(plansOver({}, 1e6, {}).empty());
}

TEST(FrameCost, aPlantedCostIsFitted) {
    std::vector<TimedFrame> frames;
    for (const double triangles : {1e4, 5e4, 2e5, 4e5}) frames.push_back({triangles, 0.8 + 9e-6 * triangles});
    const FrameCost cost = fittedFrameCost(frames);
    EXPECT_NEAR(cost.fixedMs, 0.8, 1e-9);
    EXPECT_NEAR(cost.msPerMillion, 9, 1e-9);
    EXPECT_LT(cost.worstOff, 1e-9);
    EXPECT_EQ(frameCostText(cost), "0.8 ms + 9 ms per million triangles");
    const FrameCost raised = raisedAbove(cost, std::vector<TimedFrame>{{1e5, 1.7 * 1.5}, {2e5, 1}});
    EXPECT_NEAR(raised.ms(1e5), 1.7 * 1.5, 1e-9);
    EXPECT_NEAR(raised.ms(2e5), 2.6 * 1.5, 1e-9);
    const FrameCost flat = fittedFrameCost(std::vector<TimedFrame>{{1e4, 2}, {2e4, 1}});
    EXPECT_EQ(flat.msPerMillion, 0);
    EXPECT_GT(flat.fixedMs, 0);
    const FrameCost steep = fittedFrameCost(std::vector<TimedFrame>{{1e4, 0.1}, {1e5, 10}});
    EXPECT_EQ(steep.fixedMs, 0);
    EXPECT_GT(steep.msPerMillion, 0);
}

TEST(FrameCost, itsTextIsReadStrictly) {
    const auto cost = frameCostFromText(" 0.8 ms +9 ms per million triangles");
    ASSERT_TRUE(cost);
    EXPECT_EQ(cost->fixedMs, 0.8);
    EXPECT_EQ(cost->msPerMillion, 9);
    EXPECT_FALSE(cost->isMeasured);
    for (const char* text :
         {"", "1 ms", "1 + 2", "-1 ms + 2 ms per million triangles", "0 ms + 0 ms per million triangles",
          "1 ms + 2 ms per million triangles, or so", "x ms + 2 ms per million triangles"}) {
        const auto wrong = frameCostFromText(text);
        ASSERT_FALSE(wrong) << text;
        EXPECT_THAT(wrong.error().message, HasSubstr("expected for example"));
    }
}

}  // namespace
}  // namespace worldy
