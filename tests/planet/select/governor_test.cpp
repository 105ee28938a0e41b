// The governor against engines whose cost is known: it settles, keeps to the budget, and does not hunt.
#include "planet/select/governor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "planet/select/lod_select.h"
#include "planet/sphere/view.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/fake_selection.h"

namespace planet {
namespace {

constexpr double frameS = 1.0 / 60;

// An engine with the morphs and the hysteresis of lod_select.h: groups of chunks that merge once τ is large enough and
// they have morphed, and that split at once. Unmerged, the groups together cost τ^-exponent at τ = 1 px and above.
class Engine {
public:
    explicit Engine(double exponent = 1) {
        constexpr double step = 0.005;
        constexpr int count = 2000;
        for (int i = 0; i < count; ++i) {
            const double lnTau = -4 + step * i;
            groups_.push_back({lnTau, exponent * step * std::exp(-exponent * lnTau)});
        }
    }

    // Returns the triangles, relative to those at τ = 1 px. fadeS: of a whole morph.
    double step(double tauPx, double fadeS) {
        const double x = std::log(tauPx);
        double sum = 0;
        for (Group& group : groups_) {
            const double natural = std::clamp(1 - (group.lnParentEps - x) / std::log(1.3), 0.0, 1.0);
            if (group.merged && group.lnParentEps > x) {
                group.merged = false;
                group.morph = 1;
            }
            const double most = fadeS > 0 ? frameS / fadeS : 1;
            group.morph += std::clamp(natural - group.morph, -most, most);
            if (group.morph >= 1 && group.lnParentEps <= x + std::log(0.9)) group.merged = true;
            if (!group.merged) sum += group.cost;
        }
        return sum;
    }

private:
    struct Group {
        double lnParentEps;
        double cost;
        bool merged = false;
        double morph = 0;
    };
    std::vector<Group> groups_;
};

// Simulates an engine whose frames have planted costs.
struct Plant {
    GovernorSettings settings{};
    Engine engine{};
    double tauPx = 2;
    double trianglesAt1 = 1e6;
    double msPerTriangle = 4e-6;
    double fixedMs = 0;
    double factor = 1;    // of all costs
    double slowdown = 1;  // of times alone
    double noise = 0;     // of times
    bool knowsExponent = false;
    std::size_t gpuFramesLate = 3;

    GovernorState state{};
    Governed last{};
    std::deque<double> gpuMs{};
    std::uint32_t seed = 1;
    std::mt19937 random{seed};

    double triangles = 0;
    double ms = 0;

    void frame(double elapsedS = frameS) {
        triangles = factor * trianglesAt1 * engine.step(tauPx, last.governs ? last.fadeS : settings.fadeS);
        const double spread = std::uniform_real_distribution(-noise, noise)(random);
        ms = slowdown * (factor * fixedMs + msPerTriangle * triangles) * (1 + spread);
        gpuMs.push_back(ms);
        while (gpuMs.size() > gpuFramesLate + 1) gpuMs.pop_front();
        GovernorSample sample{.cost = {.cpuMs = ms, .gpuMs = gpuMs.front(), .triangles = triangles},
                              .tauPx = tauPx,
                              .elapsedS = elapsedS};
        last = govern(state, sample, settings);
        state = last.state;
        tauPx = last.tauPx;
    }
    void run(double seconds) {
        for (int i = 0; i < static_cast<int>(std::lround(seconds / frameS)); ++i) frame();
    }
};

// The frames after a step until the cost stays within the budget for a second.
template <class Cost>
double settledAfterS(Plant& plant, const Cost& cost, double budget) {
    double overS = 0;
    for (int i = 1; i <= 90; ++i) {
        plant.frame();
        if (cost(plant) > budget) overS = i * frameS;
    }
    return overS;
}

TEST(Governor, settlesWithinHalfASecondOfAStepOfTheTriangles) {
    for (const double exponent : {0.7, 1.0, 1.3}) {
        Plant plant{.settings = {.budget = {.triangles = 4e5}}, .engine = Engine(exponent)};
        plant.run(8);
        ASSERT_LT(plant.triangles, 4e5);
        plant.factor = 2;
        const double settledS = settledAfterS(
            plant, [](const Plant& p) { return p.triangles; }, 4e5);
        EXPECT_GT(settledS, 0) << exponent;
        EXPECT_LT(settledS, 0.5) << exponent;
    }
}

TEST(Governor, settlesWithinHalfASecondOfAStepOfATimeThatArrivesLate) {
    for (const double noise : {0.0, 0.03}) {
        Plant plant{.settings = {.budget = {.gpuMs = 4}}, .fixedMs = 0.5, .noise = noise};
        plant.run(8);
        ASSERT_LT(plant.ms, 4);
        plant.factor = 1.7;
        const double settledS = settledAfterS(
            plant, [](const Plant& p) { return p.ms; }, 4);
        EXPECT_GT(settledS, 0) << noise;
        EXPECT_LT(settledS, 0.5) << noise;
    }
}

// Tells a plant, the factor that steps, and the cost that has a budget.
struct Step {
    const char* name;
    Plant plant;
    double Plant::*stepped;
    double Plant::*cost;
    double budget;
};
std::vector<Step> stepsOfCost() {
    std::vector<Step> steps = {
        {"triangles", {.settings = {.budget = {.triangles = 4e5}}}, &Plant::factor, &Plant::triangles, 4e5},
        {"GPU time", {.settings = {.budget = {.gpuMs = 4}}, .fixedMs = 0.3}, &Plant::factor, &Plant::ms, 4},
        {"slowdown", {.settings = {.budget = {.cpuMs = 4}}, .fixedMs = 0.3}, &Plant::slowdown, &Plant::ms, 4},
        {"noisy time",
         {.settings = {.budget = {.gpuMs = 4}}, .fixedMs = 0.3, .noise = 0.02},
         &Plant::slowdown,
         &Plant::ms,
         4}};
    // The step may need a larger tolerance than by default.
    for (Step& step : steps) step.plant.settings.mostTauPx = 64;
    return steps;
}

TEST(Governor, settlesAfterLargeStepsAndTheWayBackStaysWithinTheBudget) {
    for (const double factor : {3.0, 5.0}) {
        for (auto& [name, plant, stepped, cost, budget] : stepsOfCost()) {
            const auto costOf = [member = cost](const Plant& p) { return p.*member; };
            plant.run(8);
            ASSERT_LT(plant.*cost, budget) << name;
            plant.*stepped = factor;
            const double upS = settledAfterS(plant, costOf, budget);
            EXPECT_GT(upS, 0) << name << factor;
            EXPECT_LT(upS, 0.5) << name << factor;
            plant.run(6);
            EXPECT_GT(plant.*cost, 0.8 * budget) << name << factor;
            plant.*stepped = 1;
            int over = 0;
            for (int i = 0; i < 480; ++i) {
                plant.frame();
                over += plant.*cost > budget;
            }
            EXPECT_EQ(over, 0) << name << factor;
            EXPECT_GT(plant.*cost, 0.8 * budget) << name << factor;
        }
    }
}

// Nothing is known any more of which share of the time follows the triangles.
TEST(Governor, settlesAfterALargeStepThatFollowsALongRest) {
    for (const double factor : {3.0, 5.0}) {
        Plant plant{.settings = {.budget = {.gpuMs = 4}, .mostTauPx = 64}, .fixedMs = 0.3};
        plant.run(8);
        for (int i = 0; i < 300; ++i) plant.frame(1);
        plant.factor = factor;
        const double settledS = settledAfterS(
            plant, [](const Plant& p) { return p.ms; }, 4);
        EXPECT_GT(settledS, 0) << factor;
        EXPECT_LT(settledS, 0.5) << factor;
    }
}

TEST(Governor, aStepIsFollowedByNoOscillation) {
    for (const double factor : {1.5, 5.0}) {
        for (auto& [name, plant, stepped, cost, budget] : stepsOfCost()) {
            plant.run(8);
            for (const double now : {factor, 1.0}) {
                plant.*stepped = now;
                plant.run(6);
                double least = std::log(plant.tauPx), most = least;
                for (int i = 0; i < 300; ++i) {
                    plant.frame();
                    least = std::min(least, std::log(plant.tauPx));
                    most = std::max(most, std::log(plant.tauPx));
                }
                EXPECT_LE(most - least, plant.settings.hysteresis) << name << now;
            }
        }
    }
}

// Half of the time does not follow the triangles, so they must become fewer than a power law of the whole says.
TEST(Governor, learnsWhichShareOfATimeFollowsTheTriangles) {
    GovernorState state;
    GovernorSample sample{.tauPx = 2, .elapsedS = frameS};
    for (int i = 0; i < 1200; ++i) {
        sample.cost.triangles = 1e6 * (1 + 0.3 * std::sin(i * frameS));
        sample.cost.cpuMs = 2 + 2e-6 * sample.cost.triangles;
        state = govern(state, sample, {.budget = {.cpuMs = 1000}}).state;
    }
    sample.cost.triangles = 1e6;
    for (int i = 0; i < 120; ++i) {
        sample.cost.cpuMs = 4;
        state = govern(state, sample, {.budget = {.cpuMs = 1000}}).state;
    }
    const double keptTriangles =
        2 / govern(state, sample, {.budget = {.cpuMs = 3}, .lodHysteresis = 0}).tauPx;
    EXPECT_NEAR(keptTriangles, (0.915 * 3 - 2) / 2, 0.05);
}

TEST(Governor, aCostThatGrowsSlowlyNeverPassesTheBudget) {
    Plant plant{.settings = {.budget = {.triangles = 4e5}}};
    for (int i = 0; i < 3600; ++i) {
        plant.trianglesAt1 = 1e6 * std::exp(0.5 * std::sin(0.5 * i * frameS));
        plant.frame();
        if (i < 600) continue;
        EXPECT_LE(plant.triangles, 4e5) << i;
        EXPECT_GE(plant.triangles, 0.7 * 4e5) << i;
    }
}

TEST(Governor, usesMostOfTheBudgetAfterAStep) {
    Plant plant{.settings = {.budget = {.gpuMs = 4}}, .fixedMs = 0.5};
    plant.run(8);
    for (const double factor : {2.0, 1.0}) {
        plant.factor = factor;
        plant.run(4);
        EXPECT_LT(plant.ms, 4) << factor;
        EXPECT_GT(plant.ms, 0.8 * 4) << factor;
    }
}

// A rise that is asked for again before it has shown would end far too high.
TEST(Governor, doesNotOvershootWhileMorphsAndQueriesAreLate) {
    Plant plant{.settings = {.budget = {.gpuMs = 4}}};
    plant.run(8);
    plant.factor = 1.6;
    double leastMs = plant.ms;
    for (int i = 0; i < 60; ++i) {
        plant.frame();
        leastMs = std::min(leastMs, plant.ms);
    }
    EXPECT_GT(leastMs, 0.75 * 4);
}

TEST(Governor, isStillWhileTheCostIs) {
    Plant plant{.settings = {.budget = {.gpuMs = 4, .triangles = 1e6}}, .fixedMs = 0.5};
    plant.run(8);
    const double tauPx = plant.tauPx;
    for (int i = 0; i < 1200; ++i) {
        plant.frame();
        ASSERT_EQ(plant.tauPx, tauPx) << i;
    }
}

TEST(Governor, noiseOfTimesMovesTauByFarLessThanItsHysteresis) {
    Plant plant{.settings = {.budget = {.gpuMs = 4}}, .fixedMs = 0.5, .noise = 0.02};
    plant.run(8);
    const double tauPx = plant.tauPx;
    for (int i = 0; i < 3600; ++i) {
        plant.frame();
        ASSERT_NEAR(std::log(plant.tauPx / tauPx), 0, plant.settings.hysteresis / 4) << i;
    }
}

// A cost that swings by less than the still half of the band, after a first swing, is no reason to move.
TEST(Governor, swingsWithinTheBandMoveNothing) {
    Plant plant{.settings = {.budget = {.triangles = 4e5}}};
    double tauPx = 0;
    for (int i = 0; i < 1800; ++i) {
        plant.factor = 1 + 0.02 * std::sin(2 * 3.14159265 * i * frameS / 3);
        plant.frame();
        if (i == 900) tauPx = plant.tauPx;
        if (i > 900) {
            ASSERT_EQ(plant.tauPx, tauPx) << i;
        }
    }
}

TEST(Governor, oneSlowFrameMovesNothing) {
    Plant plant{.settings = {.budget = {.cpuMs = 4}}};
    plant.run(8);
    const double tauPx = plant.tauPx;
    plant.factor = 5;
    plant.frame();
    plant.factor = 1;
    plant.run(1);
    EXPECT_EQ(plant.tauPx, tauPx);
}

// The chunks that a small rise should merge stay split up to the hysteresis of the selection.
TEST(Governor, aRiseCrossesTheBacklashOfTheSelection) {
    GovernorSample sample{.cost = {.triangles = 9e5}, .tauPx = 2, .elapsedS = frameS};
    const GovernorSettings settings{.budget = {.triangles = 1e6}};
    GovernorState state;
    for (int i = 0; i < 120; ++i) state = govern(state, sample, settings).state;
    EXPECT_EQ(govern(state, sample, settings).tauPx, 2);
    sample.cost.triangles = 9.9e5;
    EXPECT_NEAR(govern(state, sample, settings).tauPx, 2 * (0.99 / 0.975) / 0.9, 0.02);
}

TEST(Governor, keepsTauWithinItsLimitsAndTellsSo) {
    Plant cheap{.settings = {.budget = {.triangles = 1e9}, .leastTauPx = 0.75}};
    cheap.run(10);
    EXPECT_EQ(cheap.last.limit, GovernorLimit::LeastTau);
    EXPECT_EQ(cheap.tauPx, 0.75);
    EXPECT_LT(cheap.last.use, 0.1);

    Plant dear{.settings = {.budget = {.triangles = 1000}, .mostTauPx = 9}};
    dear.run(2);
    EXPECT_EQ(dear.last.limit, GovernorLimit::MostTau);
    EXPECT_EQ(dear.tauPx, 9);
    EXPECT_GT(dear.last.use, 1);

    Plant between{.settings = {.budget = {.triangles = 4e5}}};
    between.run(3);
    EXPECT_EQ(between.last.limit, GovernorLimit::None);
}

// No τ reaches these budgets: the largest one does what it can, and the costs that remain say what binds.
TEST(Governor, restsAtTheUpperLimitBelowWhatTheCoarsestTauCosts) {
    struct Small {
        GovernorCosts budget;
        GovernorBudget binds;
    };
    for (const Small& small :
         {Small{{.triangles = 100}, GovernorBudget::Triangles},
          Small{{.triangles = 1}, GovernorBudget::Triangles}, Small{{.gpuMs = 0.01}, GovernorBudget::GpuTime},
          Small{{.cpuMs = 1e-6, .triangles = 1e5}, GovernorBudget::CpuTime}}) {
        Plant plant{.settings = {.budget = small.budget}, .fixedMs = 0.5, .noise = 0.05};
        plant.run(2);
        for (int i = 0; i < 600; ++i) {
            plant.frame();
            ASSERT_EQ(plant.tauPx, 16) << i;
            ASSERT_EQ(plant.last.limit, GovernorLimit::MostTau) << i;
            ASSERT_EQ(plant.last.binds, small.binds) << i;
            ASSERT_GT(plant.last.use, 1) << i;
        }
        // A budget that can be kept is kept again.
        plant.settings.budget = {.triangles = 4e5};
        plant.run(12);
        EXPECT_EQ(plant.last.limit, GovernorLimit::None);
        EXPECT_LT(plant.triangles, 4e5);
        EXPECT_GT(plant.triangles, 0.8 * 4e5);
    }
}

TEST(Governor, restsAtTheUpperLimitWhileMemoryOrReadingIsOverABudgetThatNoTauReaches) {
    for (const GovernorBudget budget : {GovernorBudget::Memory, GovernorBudget::Reading}) {
        GovernorSettings settings;
        (budget == GovernorBudget::Memory ? settings.budget.memoryBytes : settings.budget.readBytesPerS) =
            1e3;
        GovernorSample sample{
            .cost = {.memoryBytes = 1e6, .readBytesPerS = 1e6}, .tauPx = 2, .elapsedS = frameS};
        GovernorState state;
        for (int i = 0; i < 600; ++i) {
            const Governed governed = govern(state, sample, settings);
            state = governed.state;
            sample.tauPx = governed.tauPx;
            if (i < 120) continue;
            ASSERT_EQ(governed.tauPx, 16) << i;
            ASSERT_EQ(governed.limit, GovernorLimit::MostTau) << i;
            ASSERT_EQ(governed.binds, budget) << i;
        }
    }
}

TEST(Governor, theBudgetThatNeedsTheLargestTauBinds) {
    GovernorSample sample{
        .cost = {.cpuMs = 4, .gpuMs = 6, .triangles = 1e6, .memoryBytes = 1e8, .readBytesPerS = 1e6},
        .tauPx = 2,
        .elapsedS = frameS};
    const GovernorCosts roomy{
        .cpuMs = 8, .gpuMs = 12, .triangles = 2e6, .memoryBytes = 2e8, .readBytesPerS = 1e8};
    const auto bindsWith = [&](const GovernorCosts& budget) {
        GovernorState state;
        Governed governed;
        for (int i = 0; i < 60; ++i) {
            governed = govern(state, sample, {.budget = budget, .mostTauPx = 1e5});
            state = governed.state;
        }
        EXPECT_TRUE(governed.governs);
        EXPECT_NEAR(governed.use, 0.9, 0.15);
        return governed.binds;
    };
    GovernorCosts budget = roomy;
    budget.cpuMs = 4.4;
    EXPECT_EQ(bindsWith(budget), GovernorBudget::CpuTime);
    budget = roomy;
    budget.gpuMs = 6.6;
    EXPECT_EQ(bindsWith(budget), GovernorBudget::GpuTime);
    budget = roomy;
    budget.triangles = 1.1e6;
    EXPECT_EQ(bindsWith(budget), GovernorBudget::Triangles);
    budget = roomy;
    budget.memoryBytes = 1.1e8;
    EXPECT_EQ(bindsWith(budget), GovernorBudget::Memory);
    budget = roomy;
    budget.readBytesPerS = 1e6;
    EXPECT_EQ(bindsWith(budget), GovernorBudget::Reading);
}

TEST(Governor, tauStaysWithoutABudget) {
    const GovernorSample sample{.cost = {.cpuMs = 100}, .tauPx = 0.123456789, .elapsedS = frameS};
    const Governed off = govern({}, sample, {});
    EXPECT_FALSE(off.governs);
    EXPECT_EQ(off.tauPx, sample.tauPx);
    // Nor with one whose cost is not measured, as without timer queries.
    const Governed unmeasured = govern({}, sample, {.budget = {.gpuMs = 1}});
    EXPECT_FALSE(unmeasured.governs);
    EXPECT_EQ(unmeasured.tauPx, sample.tauPx);
}

TEST(Governor, aTauThatStaysKeepsItsBits) {
    for (int i = 0; i < 300; ++i) {
        const double tauPx = 0.6 * std::pow(1.01, i);
        const GovernorSample sample{.cost = {.triangles = 0.88e6}, .tauPx = tauPx, .elapsedS = frameS};
        const Governed governed = govern({}, sample, {.budget = {.triangles = 1e6}});
        ASSERT_TRUE(governed.governs);
        ASSERT_EQ(governed.tauPx, tauPx);
    }
}

TEST(Governor, theSameSamplesGiveTheSameTau) {
    const auto taus = [] {
        Plant plant{.settings = {.budget = {.gpuMs = 4, .triangles = 5e5}}, .fixedMs = 0.7, .noise = 0.1};
        std::vector<double> all;
        for (int i = 0; i < 600; ++i) {
            if (i == 200) plant.factor = 2;
            if (i == 400) plant.factor = 0.5;
            // A copy of the state in the middle changes nothing.
            if (i == 300) plant.state = GovernorState(plant.state);
            plant.frame();
            all.push_back(plant.tauPx);
        }
        return all;
    };
    const std::vector<double> a = taus(), b = taus();
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0);
    EXPECT_NE(a.front(), a.back());
}

TEST(Governor, tauDoesNotFallWhileChunksWait) {
    GovernorSample sample{.cost = {.triangles = 5e5}, .tauPx = 2, .elapsedS = frameS, .waitingShare = 0.4};
    const GovernorSettings settings{.budget = {.triangles = 1e6}};
    GovernorState state;
    const auto run = [&](int frames) {
        for (int i = 0; i < frames; ++i) {
            const Governed governed = govern(state, sample, settings);
            state = governed.state;
            sample.tauPx = governed.tauPx;
        }
    };
    run(120);
    EXPECT_EQ(sample.tauPx, 2);  // with all of them split, there would be 1.1e6
    sample.waitingShare = 0;
    run(1);
    EXPECT_LT(sample.tauPx, 2);
}

// A view that rests reads only because τ falls.
TEST(Governor, aFallReadsNoMoreThanTheBudget) {
    const GovernorSettings settings{.budget = {.readBytesPerS = 2e6}, .leastTauPx = 0.5};
    GovernorState state;
    double tauPx = 8, resident = 2e7 / tauPx;
    for (int i = 0; i < 60 * 60; ++i) {
        const double read = std::max(2e7 / tauPx - resident, 0.0);
        resident += read;
        const Governed governed = govern(
            state, {.cost = {.readBytesPerS = read / frameS}, .tauPx = tauPx, .elapsedS = frameS}, settings);
        ASSERT_LE(governed.tauPx, tauPx) << i;
        ASSERT_LE(governed.use, 1) << i;
        state = governed.state;
        tauPx = governed.tauPx;
    }
    EXPECT_EQ(tauPx, 0.5);
}

// A governor that takes what its fall reads for the cost of τ goes up and down for ever.
TEST(Governor, readingRaisesTauOnlyIfItGoesOnAfterAFall) {
    const GovernorSettings settings{.budget = {.readBytesPerS = 2e6}};
    GovernorState state;
    GovernorSample sample{.tauPx = 4, .elapsedS = frameS};
    const auto run = [&](int frames, double bytesPerS) {
        sample.cost.readBytesPerS = bytesPerS;
        for (int i = 0; i < frames; ++i) {
            const Governed governed = govern(state, sample, settings);
            state = governed.state;
            sample.tauPx = governed.tauPx;
        }
    };
    run(90, 1);
    const double fallenPx = sample.tauPx;
    EXPECT_LT(fallenPx, 4);
    run(50, 6e6);
    EXPECT_LE(sample.tauPx, fallenPx);
    run(30, 6e6);
    EXPECT_GT(sample.tauPx, 2 * fallenPx);
}

TEST(Governor, readingOfAFastCameraRaisesTau) {
    const GovernorSettings settings{.budget = {.readBytesPerS = 2e6}};
    GovernorState state;
    double tauPx = 2;
    for (int i = 0; i < 600; ++i) {
        const Governed governed = govern(
            state, {.cost = {.readBytesPerS = 1.2e7 / tauPx}, .tauPx = tauPx, .elapsedS = frameS}, settings);
        state = governed.state;
        tauPx = governed.tauPx;
        if (i < 240) continue;
        EXPECT_LE(governed.use, 1) << i;
        EXPECT_GE(governed.use, 0.75) << i;
        EXPECT_EQ(governed.binds, GovernorBudget::Reading);
    }
}

TEST(Governor, survivesHostileNumbers) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::vector<double> hostile = {
        0, -1, 1e-300, 1e300, infinity, -infinity, std::numeric_limits<double>::quiet_NaN(), 1, 5, 1e9};
    std::uint32_t seed = 7;
    std::mt19937 random(seed);
    const auto any = [&] {
        return hostile[std::uniform_int_distribution<std::size_t>(0, hostile.size() - 1)(random)];
    };
    const auto costs = [&] { return GovernorCosts{any(), any(), any(), any(), any()}; };
    GovernorState state;
    GovernorSettings settings;
    for (int i = 0; i < 20000; ++i) {
        if (i % 50 == 0) {
            settings = {.budget = costs(),
                        .leastTauPx = any(),
                        .mostTauPx = any(),
                        .ceiling = any(),
                        .hysteresis = any(),
                        .exponent = any(),
                        .risePerS = any(),
                        .fallPerS = any(),
                        .fadeS = any(),
                        .leastFadeS = any(),
                        .morphRange = any(),
                        .lodHysteresis = any(),
                        .gpuFramesLate = i % 3 == 0 ? -1000000 : i % 1000000};
        }
        GovernorSample sample{costs(), any(), any(), any(), {}, any()};
        for (float& share : sample.merges.lnShare) share = static_cast<float>(any());
        sample.merges.lnShareToCome = static_cast<float>(any());
        sample.merges.isKnown = i % 2 == 0;
        const Governed governed = govern(state, sample, settings);
        state = governed.state;
        if (!governed.governs) continue;
        ASSERT_TRUE(std::isfinite(governed.tauPx)) << i;
        ASSERT_GT(governed.tauPx, 0) << i;
        ASSERT_FALSE(std::isnan(governed.use)) << i;
        ASSERT_TRUE(std::isfinite(governed.fadeS)) << i;
        ASSERT_GE(governed.fadeS, 0) << i;
    }
    // It recovers.
    Plant plant{.settings = {.budget = {.triangles = 4e5}}, .state = state};
    plant.run(60);
    EXPECT_LT(plant.triangles, 4e5);
    EXPECT_GT(plant.triangles, 0.8 * 4e5);
}

TEST(Governor, limitsThatCrossAreTheLeastTau) {
    Plant plant{.settings = {.budget = {.triangles = 4e5}, .leastTauPx = 3, .mostTauPx = 1}};
    plant.run(1);
    EXPECT_NEAR(plant.tauPx, 3, 1e-12);
}

// A planet with enough chunks for triangles to follow τ over several levels.
const ChunkTree& deepTree() {
    static const ChunkTree tree = [] {
        const FakePyramid pyramid = makeFakePyramid(6);
        return residentTree(pyramid, deepestLevelOf(pyramid.shape));
    }();
    return tree;
}

// A still view of that planet, selected by the settings that the governor chooses.
struct Selected {
    View view;
    GovernorSettings settings{};
    LodSettings lod{};
    double msPerTriangle = 0, fixedMs = 0;
    double factor = 1;  // of all costs
    GovernorState state{};
    Selection selection{};
    double triangles = 0, ms = 0;
    std::deque<double> gpuMs{};

    void frame() {
        selectChunks(deepTree(), view, lod, selection, frameS);
        triangles = factor * static_cast<double>(selection.counters.triangles());
        ms = factor * fixedMs + msPerTriangle * triangles;
        gpuMs.push_back(ms);
        constexpr std::size_t framesLate = 3;
        while (gpuMs.size() > framesLate + 1) gpuMs.pop_front();
        const GovernorSample sample{.cost = {.gpuMs = gpuMs.front(), .triangles = triangles},
                                    .tauPx = lod.tauPx,
                                    .elapsedS = frameS,
                                    .exponent = exponentOf(selection, lod.tauPx),
                                    .merges = mergeCurveOf(selection, lod.hysteresis)};
        const Governed governed = govern(state, sample, settings);
        state = governed.state;
        lod.tauPx = governed.tauPx;
        lod.fadeS = governed.fadeS;
    }
};

// Views in which a hundred chunks or more are drawn, with a budget of the triangles, or of a time that follows them.
std::vector<Selected> selectedViews(bool budgetIsTime) {
    std::vector<Selected> all;
    for (int i = 0; i < 8; ++i) {
        const CameraPose pose{
            .latitudeDeg = -60.0 + 15 * i, .longitudeDeg = 37.0 * i, .altitudeM = 60e3, .pitchDeg = -60};
        Selected one{.view = viewFromPose(pose, deepTree().shape.radiusM, 1.1, 1280, 720)};
        one.lod.tauPx = 0.1;
        selectChunks(deepTree(), one.view, one.lod, one.selection);
        if (one.selection.draw.size() < 100) continue;
        const auto triangles = static_cast<double>(one.selection.counters.triangles());
        one.msPerTriangle = 3.6 / triangles;
        one.fixedMs = 0.3;
        one.settings.leastTauPx = 0.05;
        one.settings.mostTauPx = 64;
        if (budgetIsTime)
            one.settings.budget.gpuMs = 4;
        else
            one.settings.budget.triangles = 0.8 * triangles;
        all.push_back(std::move(one));
    }
    return all;
}

// Plants a step of the cost, and returns the seconds until it stays within the budget.
double settledAfterStepS(Selected& selected, double factor) {
    const GovernorCosts& budget = selected.settings.budget;
    for (int i = 0; i < 480; ++i) selected.frame();
    selected.factor = factor;
    double overS = 0;
    for (int i = 1; i <= 120; ++i) {
        selected.frame();
        const bool isOver =
            budget.gpuMs > 0 ? selected.ms > budget.gpuMs : selected.triangles > budget.triangles;
        if (isOver) overS = i * frameS;
    }
    return overS;
}

TEST(Governor, settlesWithinHalfASecondOfAStepOverSeveralLevelsOfDetail) {
    for (const bool budgetIsTime : {false, true}) {
        for (const double factor : {2.0, 3.0, 5.0}) {
            std::vector<Selected> views = selectedViews(budgetIsTime);
            ASSERT_GE(views.size(), 4u);
            for (Selected& selected : views) {
                Selected patient = selected;
                const double settledS = settledAfterStepS(selected, factor);
                EXPECT_GT(settledS, 0) << factor;
                EXPECT_LT(settledS, 0.5) << factor;
                if (factor < 5) continue;
                // The same without fades that catch up takes longer.
                patient.settings.leastFadeS = patient.settings.fadeS;
                EXPECT_GT(settledAfterStepS(patient, factor), 0.5);
                EXPECT_GT(patient.lod.tauPx, 4 * 0.1);
            }
        }
    }
}

TEST(Governor, fadesAreShorterWhileChunksHaveSeveralLevelsToMerge) {
    std::vector<Selected> views = selectedViews(false);
    ASSERT_FALSE(views.empty());
    Selected& selected = views.front();
    for (int i = 0; i < 480; ++i) selected.frame();
    EXPECT_EQ(selected.lod.fadeS, selected.settings.fadeS);
    selected.factor = 3;
    for (int i = 0; i < 2; ++i) selected.frame();
    EXPECT_LT(selected.lod.fadeS, selected.settings.fadeS / 2);
    for (int i = 0; i < 120; ++i) selected.frame();
    EXPECT_EQ(selected.lod.fadeS, selected.settings.fadeS);

    GovernorSample sample{.cost = {.triangles = 1e6}, .tauPx = 2, .elapsedS = frameS};
    sample.merges.isKnown = true;
    sample.merges.levels = 3;
    const auto fadeS = [&](double leastFadeS) {
        return govern({}, sample, {.budget = {.triangles = 1e5}, .fadeS = 0.8, .leastFadeS = leastFadeS})
            .fadeS;
    };
    EXPECT_EQ(fadeS(0.01), 0.8) << "nothing is merging";
    sample.merges.lnShareToCome = -1;
    EXPECT_EQ(fadeS(0.01), 0.2);
    EXPECT_EQ(fadeS(0.4), 0.4);
    EXPECT_EQ(fadeS(0.8), 0.8);
    EXPECT_EQ(govern({}, sample, {.fadeS = 0.8}).fadeS, 0.8) << "no budget is on";
}

// Bytes read are a mean, during which chunks merge, so shares of the triangles of now do not fit it.
TEST(Governor, readingIsNotAnsweredByTheMergeCurve) {
    const auto tauPxFor = [](const GovernorCosts& budget, bool knowsMerges) {
        GovernorState state;
        GovernorSample sample{
            .cost = {.triangles = 1e6, .readBytesPerS = 4e7}, .tauPx = 2, .elapsedS = frameS};
        sample.merges.isKnown = knowsMerges;
        for (std::size_t i = 0; i < MergeCurve::count; ++i)
            sample.merges.lnShare[i] = -0.01f * static_cast<float>(i);
        for (int i = 0; i < 5; ++i) {
            const Governed governed = govern(state, sample, {.budget = budget, .mostTauPx = 1e5});
            state = governed.state;
            sample.tauPx = governed.tauPx;
        }
        return sample.tauPx;
    };
    EXPECT_EQ(tauPxFor({.readBytesPerS = 1e6}, true), tauPxFor({.readBytesPerS = 1e6}, false));
    EXPECT_NE(tauPxFor({.triangles = 2e5}, true), tauPxFor({.triangles = 2e5}, false));
}

// Without culling, each split that is merged takes away three chunks.
TEST(Governor, theMergeCurveIsWhatLargerTolerancesDraw) {
    const View view = selectedViews(false).front().view;
    LodSettings lod = withoutCulling(0.2);
    const Selection now = select(deepTree(), view, lod);
    const MergeCurve curve = mergeCurveOf(now, lod.hysteresis);
    ASSERT_TRUE(curve.isKnown);
    for (std::size_t i = 0; i < MergeCurve::count; ++i) {
        lod.tauPx = 0.2 * std::exp2(static_cast<double>(i) / MergeCurve::perDoubling - 1);
        const std::size_t drawn =
            lod.tauPx < 0.2 ? now.draw.size() : select(deepTree(), view, lod).draw.size();
        const double share = static_cast<double>(drawn) / static_cast<double>(now.draw.size());
        EXPECT_NEAR(curve.lnShare[i], std::log(share), 1e-4) << i;
    }
    EXPECT_LT(curve.lnShare.back(), -1);
    EXPECT_EQ(curve.levels, 0);
    EXPECT_FALSE(mergeCurveOf({}, 0.1).isKnown);
}

// Chunks that hysteresis keeps split, however wide, are not on their way.
TEST(Governor, theMergeCurveLeavesOutWhatHysteresisKeeps) {
    const View view = selectedViews(false).front().view;
    LodSettings lod = withoutCulling(0.2);
    lod.hysteresis = 0.8;
    Selection selection = select(deepTree(), view, lod);
    lod.tauPx = 0.6;
    selectChunks(deepTree(), view, lod, selection, frameS);
    const MergeCurve curve = mergeCurveOf(selection, lod.hysteresis);
    EXPECT_EQ(curve.lnShareToCome, 0);
    EXPECT_EQ(curve.levels, 0);
    EXPECT_LT(curve.lnShare[MergeCurve::perDoubling], -0.1);
}

// A region's least level keeps its chunks split at any τ.
TEST(Governor, theMergeCurveLeavesOutWhatALeastLevelSplits) {
    const View view = selectedViews(false).front().view;
    const LodSettings lod = withoutCulling(0.2);
    Selection selection = select(deepTree(), view, lod);
    for (ChildrenRequest& split : selection.splits) split.isBelowLeastLevel = split.parentId.level < 2;
    const MergeCurve curve = mergeCurveOf(selection, lod.hysteresis);
    const double share = 6 * 16 / static_cast<double>(selection.draw.size());
    EXPECT_NEAR(curve.lnShare.back(), std::log(share), 1e-4);
}

// A selection that fades keeps its splits when τ rises, and its curve then says what is on its way.
TEST(Governor, theMergeCurveCountsTheLevelsThatAreOnTheirWay) {
    const View view = selectedViews(false).front().view;
    LodSettings lod;
    lod.hysteresis = 0;
    lod.frustumCulling = lod.horizonCulling = false;
    lod.tauPx = 0.2;
    Selection selection = select(deepTree(), view, lod);
    const std::uint32_t deepest = selection.counters.deepestLevel;
    const auto before = static_cast<double>(selection.draw.size());
    lod.tauPx = 3.2;
    const Selection settled = select(deepTree(), view, lod);
    selectChunks(deepTree(), view, lod, selection, frameS);
    const MergeCurve curve = mergeCurveOf(selection, lod.hysteresis);
    EXPECT_GE(curve.levels, static_cast<int>(deepest - settled.counters.deepestLevel));
    EXPECT_LE(curve.levels, static_cast<int>(deepest));
    const double share = static_cast<double>(settled.draw.size()) / before;
    EXPECT_NEAR(curve.lnShareToCome, std::log(share), 1e-4);
}

TEST(Governor, exponentIsThatOfTheChunksThatWouldMerge) {
    Selection selection;
    EXPECT_EQ(exponentOf(selection, 2), 0);
    const auto add = [&](int count, std::uint8_t level, float parentEpsPx) {
        for (int i = 0; i < count; ++i) {
            DrawItem item;
            item.id.level = level;
            item.parentEpsPx = parentEpsPx;
            selection.draw.push_back(item);
        }
    };
    add(8, 3, 3);  // become two
    EXPECT_DOUBLE_EQ(exponentOf(selection, 2), 2);
    add(6, 5, 100);
    EXPECT_DOUBLE_EQ(exponentOf(selection, 2), std::log2(14.0 / 8));
    add(2, 0, 0);  // whole faces do not merge
    EXPECT_DOUBLE_EQ(exponentOf(selection, 2), std::log2(16.0 / 10));
}

TEST(Governor, neededChunksAreThoseVisitedAndRequested) {
    Selection selection;
    selection.touched.resize(7);
    selection.requests.resize(2);
    EXPECT_EQ(neededChunks(selection), 15u);
}

}  // namespace
}  // namespace planet
