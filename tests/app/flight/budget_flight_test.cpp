// The governor on flights over a baked planet: a cost model fitted on one flight, and a budget kept on another.
#include "app/flight/budget_figures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include "app/flight/flight_path.h"
#include "app/flight/flight_replay.h"
#include "app/flight/recorder.h"
#include "app/scene/governing.h"
#include "app/scene/scene_settings.h"
#include "planet/bake/bake.h"
#include "planet/base/percentile.h"
#include "planet/measure/lod_changes.h"
#include "planet/source/height_source.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

constexpr double budgetFrameS = 1.0 / 60;

// Returns the seconds from a step to the last frame over budget before untilS; 0 if none is.
double settlingTimeS(const std::vector<BudgetedFrame>& frames, double stepS, double untilS) {
    double last = 0;
    for (const BudgetedFrame& frame : frames) {
        if (frame.timeS >= stepS && frame.timeS < untilS && frame.use > 1) last = frame.timeS - stepS;
    }
    return last;
}

FlightKey keyAt(double timeS, double latitudeDeg, double longitudeDeg, double altitudeM, double headingDeg,
                double pitchDeg) {
    return {.timeS = timeS,
            .pose = {.latitudeDeg = latitudeDeg,
                     .longitudeDeg = longitudeDeg,
                     .altitudeM = altitudeM,
                     .headingDeg = headingDeg,
                     .pitchDeg = pitchDeg}};
}

// Down to the ground, along it, and up again, over a planet of 1000 km.
FlightPath flightA() {
    return {"A",
            {keyAt(0, 10, 0, 260e3, 60, -40), keyAt(8, 16, 10, 110e3, 60, -25),
             keyAt(16, 24, 24, 90e3, 50, -20), keyAt(24, 34, 40, 200e3, 40, -35)}};
}
// Elsewhere, with turns.
FlightPath flightB() {
    return {"B",
            {keyAt(0, -40, 100, 220e3, 0, -40), keyAt(7, -32, 104, 130e3, 20, -25),
             keyAt(14, -22, 112, 80e3, 60, -18), keyAt(22, -14, 130, 110e3, 90, -20),
             keyAt(30, -12, 150, 240e3, 70, -40)}};
}

// The CPU time of a frame. All chunks have the same number of triangles, so those stand for both.
struct CostModel {
    double fixedMs = 0;
    double msPerMillion = 0;  // triangles

    double ms(double triangles) const { return fixedMs + msPerMillion * 1e-6 * triangles; }
};

struct FlownFrame {
    double tauPx = 0;
    double triangles = 0;
    std::uint64_t thrash = 0;  // until this frame
};

struct CostStep {
    double timeS = 1e9;
    double factor = 1;
    double untilS = 1e9;

    double factorAt(double at) const { return at >= timeS && at < untilS ? factor : 1; }
};

struct Flown {
    std::vector<FlownFrame> frames;
    std::vector<BudgetedFrame> budgeted;
    std::uint64_t thrash = 0;

    // Returns the thrash without that of the second after a step. There, chunks that had just split must merge.
    std::uint64_t thrashWithoutStep(double stepS) const {
        const auto until = [&](double timeS) {
            return frames[static_cast<std::size_t>(timeS / budgetFrameS)].thrash;
        };
        return thrash - (until(stepS + 1) - until(stepS));
    }
    double medianTauPx() const {
        std::vector<double> taus;
        for (const FlownFrame& frame : frames) taus.push_back(frame.tauPx);
        return planet::percentileOf(taus, 0.5);
    }
};

// The use of the budgets without the median of times, which would hide a slow frame.
double useOf(const BudgetUse& use, double ms, const BudgetSettings& budget) {
    double most = budget.cpuMs > 0 ? ms / budget.cpuMs : 0;
    for (std::size_t b = 0; b < use.uses.size(); ++b) {
        const auto kind = static_cast<planet::GovernorBudget>(b);
        if (kind != planet::GovernorBudget::CpuTime) most = std::max(most, use.uses[b]);
    }
    return most;
}

// Flies as the window does, with the budgets of the settings. A frame takes the time of the model, and during the step
// that times its factor.
Flown fly(planet::Planet& planet, const FlightPath& path, ViewSettings settings, const CostModel& model,
          const CostStep& step = {}, Recorder* recorder = nullptr) {
    const auto viewAt = [&](double timeS) {
        return planet::viewFromPose(poseAt(path, timeS), planet.tree().shape.radiusM, 1.05, 1280, 720);
    };
    if (!recorder) planet.settle(viewAt(0), settings.lod, planet::noUpload, 60);
    planet::LodChanges changes;
    Governing governing;
    Flown flown;
    for (int i = 0; i * budgetFrameS < durationS(path); ++i) {
        const double timeS = i * budgetFrameS;
        const std::array views = {planet::ViewInput{.lodView = viewAt(timeS), .lod = settings.lod}};
        if (recorder) recorder->givenSettings(planet, settings, false);
        planet.step(views, planet::noUpload, budgetFrameS);
        constexpr std::array priorities = {1.0};
        if (recorder) recorder->stepped(planet, priorities);
        changes.add(planet.selection(), timeS);
        FrameStats stats;
        stats.tauPx = settings.lod.tauPx;
        stats.selection = planet.selection().counters;
        const auto triangles = static_cast<double>(stats.selection.triangles());
        stats.drawCpuMs = model.ms(triangles) * step.factorAt(timeS);
        flown.frames.push_back({settings.lod.tauPx, triangles, changes.thrashTotal()});
        governTau(governing, &stats, planet, budgetFrameS, settings);
        flown.budgeted.push_back(
            {timeS, useOf(governing.use, stats.drawCpuMs, settings.budget), governing.use.limit});
    }
    flown.thrash = changes.thrashTotal();
    return flown;
}

class BudgetFlights : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = new tests::TemporaryFolder;
        const auto source = planet::openHeightSource("noise:fbm,seed=6,gain=0.7", {});
        ASSERT_TRUE(source);
        ASSERT_TRUE(planet::bake(*source, {.faceSize = 1025, .chunkSize = 17, .radiusM = 1e6}, file()));
    }
    static void TearDownTestSuite() { delete folder_; }
    static std::filesystem::path file() { return folder_->path() / "planet.chk"; }

    static std::unique_ptr<planet::Planet> open() {
        planet::PagingSettings paging;
        paging.time = planet::PagingTime::Simulated;
        paging.badDisk = {.latencyMs = 4, .bandwidthMBs = 100};
        return planet::Planet::open(file(), paging).value();
    }
    static Flown flyAnew(const FlightPath& path, const ViewSettings& settings, const CostModel& model = {},
                         const CostStep& step = {}) {
        return fly(*open(), path, settings, model, step);
    }

    static ViewSettings settingsWith(const BudgetSettings& budget) {
        ViewSettings settings;
        settings.budget = budget;
        settings.budget.leastTauPx = 0.25;
        settings.paging.simulated = true;
        settings.paging.badDisk = {.latencyMs = 4, .bandwidthMBs = 100};
        return settings;
    }

    static void expectKept(const Flown& flown, std::optional<double> stepS = {}) {
        const BudgetFigures figures = budgetFiguresOf(flown.budgeted, stepS);
        EXPECT_GT(figures.frames, 1000);
        EXPECT_LE(figures.over, 0.001 * figures.frames)
            << figures.over << " frames, at most " << figures.mostUse;
        EXPECT_GE(figures.medianUse, 0.85);
        EXPECT_LT(figures.atLowerLimit, figures.frames / 2) << "the budget is hardly tried";
    }
    // The same flight with the median of the tolerances, fixed.
    static void expectNoMoreThrash(const Flown& flown, const FlightPath& path,
                                   std::optional<double> stepS = {}) {
        ViewSettings fixed = settingsWith({});
        fixed.lod.tauPx = flown.medianTauPx();
        EXPECT_LE(stepS ? flown.thrashWithoutStep(*stepS) : flown.thrash, flyAnew(path, fixed).thrash);
    }

    static inline tests::TemporaryFolder* folder_ = nullptr;
};

// The times of an engine, which no model knows better than to 3 %.
std::vector<double> timesOf(const std::vector<FlownFrame>& frames, std::uint32_t seed) {
    constexpr CostModel engine{.fixedMs = 0.8, .msPerMillion = 9};
    std::mt19937 random(seed);
    std::uniform_real_distribution error(0.97, 1.03);
    std::vector<double> times;
    for (const FlownFrame& frame : frames) times.push_back(engine.ms(frame.triangles) * error(random));
    return times;
}

// Least squares of the times of frames.
CostModel fitted(const std::vector<FlownFrame>& frames, const std::vector<double>& times) {
    double sumX = 0, sumY = 0, sumXX = 0, sumXY = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const double x = 1e-6 * frames[i].triangles;
        sumX += x;
        sumY += times[i];
        sumXX += x * x;
        sumXY += x * times[i];
    }
    const auto count = static_cast<double>(frames.size());
    CostModel model;
    model.msPerMillion = (count * sumXY - sumX * sumY) / (count * sumXX - sumX * sumX);
    model.fixedMs = (sumY - model.msPerMillion * sumX) / count;
    return model;
}

// Flies A with several tolerances, and fits the times of all its frames.
CostModel modelOfFlightA(planet::Planet& planet) {
    std::vector<FlownFrame> frames;
    for (const double tauPx : {0.8, 1.6, 3.2}) {
        ViewSettings settings;
        settings.lod.tauPx = tauPx;
        const Flown flown = fly(planet, flightA(), settings, {});
        frames.insert(frames.end(), flown.frames.begin(), flown.frames.end());
    }
    return fitted(frames, timesOf(frames, 1));
}

TEST_F(BudgetFlights, aTimeBudgetIsKeptOnAFlightThatTheModelWasNotFittedOn) {
    const CostModel model = modelOfFlightA(*open());
    for (const double budgetMs : {1.8, 2.2}) {
        const Flown flown = flyAnew(flightB(), settingsWith({.cpuMs = budgetMs}), model);
        expectKept(flown);
        expectNoMoreThrash(flown, flightB());
    }
}

TEST_F(BudgetFlights, aStepOfTheTimesIsSettledWithinHalfASecond) {
    const CostModel model = modelOfFlightA(*open());
    constexpr CostStep step{.timeS = 12, .factor = 1.5};
    const Flown flown = flyAnew(flightB(), settingsWith({.cpuMs = 2.2}), model, step);
    expectKept(flown, step.timeS);
    const double settledS = settlingTimeS(flown.budgeted, step.timeS, step.timeS + 5);
    EXPECT_GT(settledS, 0);
    EXPECT_LT(settledS, 0.5);
    expectNoMoreThrash(flown, flightB(), step.timeS);
}

// Returns the median use from one time to another.
double medianUseOf(const std::vector<BudgetedFrame>& frames, double fromS, double untilS) {
    std::vector<double> uses;
    for (const BudgetedFrame& frame : frames) {
        if (frame.timeS >= fromS && frame.timeS < untilS) uses.push_back(frame.use);
    }
    return planet::percentileOf(uses, 0.5);
}

// Chunks merge over several levels, and fades catch up.
TEST_F(BudgetFlights, largeStepsOfTheTimesAreSettledWithinHalfASecondToo) {
    constexpr CostModel model{.fixedMs = 0.2, .msPerMillion = 10};
    for (const double factor : {3.0, 5.0}) {
        const CostStep step{.timeS = 10, .factor = factor, .untilS = 20};
        ViewSettings settings = settingsWith({.cpuMs = 2});
        settings.budget.mostTauPx = 64;
        const Flown flown = flyAnew(flightB(), settings, model, step);
        const auto tauAt = [&](double timeS) {
            return flown.frames[static_cast<std::size_t>(timeS / budgetFrameS)].tauPx;
        };
        EXPECT_GT(tauAt(step.timeS + 0.5), 3 * tauAt(step.timeS - 0.1)) << factor;
        const double settledS = settlingTimeS(flown.budgeted, step.timeS, step.untilS);
        EXPECT_GT(settledS, 0) << factor;
        EXPECT_LT(settledS, 0.5) << factor;
        EXPECT_GE(medianUseOf(flown.budgeted, step.timeS + 2, step.untilS), 0.85) << factor;
        EXPECT_EQ(settlingTimeS(flown.budgeted, step.untilS, 30), 0) << factor;
        EXPECT_GE(medianUseOf(flown.budgeted, step.untilS + 4, 30), 0.85) << factor;
        expectNoMoreThrash(flown, flightB(), step.timeS);
    }
}

TEST_F(BudgetFlights, aBudgetOfTrianglesIsKept) {
    for (const FlightPath& path : {flightA(), flightB()}) {
        const Flown flown = flyAnew(path, settingsWith({.triangles = 150'000}));
        expectKept(flown);
        expectNoMoreThrash(flown, path);
    }
}

TEST_F(BudgetFlights, aBudgetOfMemoryIsKept) {
    const Flown flown = flyAnew(flightB(), settingsWith({.memoryMB = 1}));
    expectKept(flown);
    expectNoMoreThrash(flown, flightB());
}

TEST_F(BudgetFlights, aBudgetOfReadingIsNeverExceeded) {
    const Flown flown = flyAnew(flightB(), settingsWith({.readMBs = 0.1}));
    const BudgetFigures figures = budgetFiguresOf(flown.budgeted);
    EXPECT_EQ(figures.over, 0);
    EXPECT_GT(figures.mostUse, 0.3);
    expectNoMoreThrash(flown, flightB());
}

TEST_F(BudgetFlights, aFlightThatIsTooExpensiveIsOverBudgetAtTheUpperLimit) {
    BudgetSettings budget{.triangles = 2000};
    budget.mostTauPx = 4;
    const BudgetFigures figures = budgetFiguresOf(flyAnew(flightB(), settingsWith(budget)).budgeted);
    EXPECT_EQ(figures.over, figures.frames);
    EXPECT_EQ(figures.atUpperLimit, figures.frames);
}

TEST_F(BudgetFlights, aRecordingHoldsTheTolerancesAndReplaysExactly) {
    const auto planet = open();
    const ViewSettings settings = settingsWith({.triangles = 150'000});
    ASSERT_TRUE(planet->setPaging(pagingSettingsOf(settings)));
    Recorder recorder(*planet, "governed");
    const Flown flown = fly(*planet, flightA(), settings, {}, {}, &recorder);
    const std::filesystem::path flight = folder_->path() / "governed.flight";
    ASSERT_TRUE(recorder.write(flight));

    const auto record = std::make_shared<const FlightRecord>(loadFlightRecord(flight).value());
    ASSERT_EQ(record->frames.size(), flown.frames.size());
    FlightReplay replay = FlightReplay::create(record, ReplayPaging::AsRecorded).value();
    const auto other = planet::Planet::open(file(), replay.pagingAtStart()).value();
    replay.rewind(*other);
    std::set<double> taus;
    while (!replay.atEnd()) {
        ASSERT_TRUE(replay.step(headless(*other)));
        ASSERT_EQ(other->views()[0].input.lod.tauPx, flown.frames[replay.next() - 1].tauPx);
        taus.insert(other->views()[0].input.lod.tauPx);
    }
    EXPECT_EQ(replay.framesDifferent(), 0u);
    EXPECT_GT(taus.size(), 100u);
}

TEST(BudgetFigures, leaveOutTheFirstSecondAndHalfASecondAfterAStep) {
    std::vector<BudgetedFrame> frames;
    for (int i = 0; i < 100; ++i) {
        const double timeS = i * 0.1;
        const bool isExcused = timeS < 0.95 || (timeS > 4.95 && timeS < 5.45);
        frames.push_back({timeS, isExcused ? 2.0 : 0.9});
    }
    const BudgetFigures figures = budgetFiguresOf(frames, 4.99);
    EXPECT_EQ(figures.frames, 100 - 10 - 5);
    EXPECT_EQ(figures.over, 0);
    EXPECT_EQ(figures.medianUse, 0.9);
    EXPECT_NEAR(settlingTimeS(frames, 4.99, 8), 0.41, 1e-9);
    frames[80].use = 1.5;
    frames[81].limit = planet::GovernorLimit::LeastTau;
    frames[81].use = 0.1;
    EXPECT_EQ(budgetFiguresOf(frames, 4.99).over, 1);
    EXPECT_EQ(budgetFiguresOf(frames, 4.99).mostUse, 1.5);
    EXPECT_EQ(budgetFiguresOf(frames, 4.99).atLowerLimit, 1);
    EXPECT_EQ(budgetFiguresOf(frames, 4.99).medianUse, 0.9);
}

}  // namespace
}  // namespace worldy
