#include "planet/select/governor.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace planet {

namespace {

constexpr double mostLn = 20;       // of τ and of use, so that all numbers stay finite
constexpr double meanS = 0.5;       // over which bytes read are averaged
constexpr double backlashS = 1;     // in which a moving camera brings chunks back to the edge of splitting
constexpr double growthS = 0.4;     // over which the growth of a level is averaged
constexpr double foresightS = 0.1;  // by which growth is foreseen, about as long as a small rise takes
constexpr double creepForesightS = 0.3;
constexpr double mostGrowthPerS = 1;
constexpr double leastStep = 0.1;  // a larger change of a level in one frame is a step, which tells no growth
constexpr double forgetS = 30;     // of the changes from which elasticity is estimated
constexpr double priorWeight = 0.01;  // of the expected elasticity, as a sum of squares
// Part of any time does not follow the triangles. A rise that expected nothing of that would end above the budget after a
// large step, and the next one could begin only when this one had been measured.
constexpr double expectedAtRise = 0.9;
constexpr double leastChange = 0.05;  // of ln triangles that tells elasticity
// A time changes by up to twice the change of the triangles. If ln time changes by this more, the change is not theirs.
constexpr double ownChange = 0.15;
// A larger change counts as one of this size, because it tells the mean elasticity between two far ends, and not that
// near the budget.
constexpr double mostChange = 0.1;
constexpr double leastElasticity = 0.4;
constexpr double leastExponent = 0.25;
constexpr double mostExponent = 4;
constexpr double largeRise = 0.05;  // of ln τ; goes to the middle of the band, so that no second one follows
constexpr double fallS = 0.25;      // time constant of a fall
constexpr double holdS = 1;         // from a rise to a fall: a chunk that changes back within it thrashes
constexpr double longWayS = 60;     // "never" for the ages of rises and falls

// Returns 0 for what is not measured.
double measured(double value) {
    return std::isfinite(value) && value > 0 ? value : 0;
}

double within(double value, double otherwise, double least, double most) {
    return std::isfinite(value) ? std::clamp(value, least, most) : otherwise;
}

double lnTauOf(double tauPx, double otherwise) {
    return measured(tauPx) > 0 ? std::clamp(std::log(tauPx), -mostLn, mostLn) : otherwise;
}

// The share of a mean that the newest value has.
double newestShare(double elapsedS, double timeConstantS) {
    return 1 - std::exp(-elapsedS / timeConstantS);
}

// The settings within their ranges, as logarithms.
struct Rules {
    GovernorCosts budget;
    double leastX, mostX;  // ln τ
    double lnCeiling, lnMiddle, lnFloor;
    double exponent;
    double risePerS, fallPerS;
    double fadeS, mostFadeSpeed, morphRange, backlash;
    std::size_t gpuFramesLate;
};

Rules rulesOf(const GovernorSettings& s) {
    const GovernorSettings usual;
    Rules rules{};
    rules.budget = s.budget;
    rules.leastX = lnTauOf(s.leastTauPx, std::log(usual.leastTauPx));
    rules.mostX = std::max(lnTauOf(s.mostTauPx, std::log(usual.mostTauPx)), rules.leastX);
    const double ceiling = within(s.ceiling, usual.ceiling, 0.05, 1);
    const double hysteresis = within(s.hysteresis, usual.hysteresis, 0, 0.9 * ceiling);
    rules.lnCeiling = std::log(ceiling);
    rules.lnMiddle = std::log(ceiling - 0.5 * hysteresis);
    rules.lnFloor = std::log(ceiling - hysteresis);
    rules.exponent = within(s.exponent, usual.exponent, leastExponent, mostExponent);
    rules.risePerS = within(s.risePerS, usual.risePerS, 0, 100);
    rules.fallPerS = within(s.fallPerS, usual.fallPerS, 1e-3, 100);
    rules.fadeS = within(s.fadeS, usual.fadeS, 0, 10);
    rules.mostFadeSpeed = std::max(rules.fadeS / within(s.leastFadeS, usual.leastFadeS, 1e-3, 10), 1.0);
    rules.morphRange = within(s.morphRange, usual.morphRange, 0.01, 4);
    rules.backlash = -std::log(1 - within(s.lodHysteresis, usual.lodHysteresis, 0, 0.9));
    rules.gpuFramesLate = static_cast<std::size_t>(std::clamp(s.gpuFramesLate, 0, 6));
    return rules;
}

constexpr bool isTime(GovernorBudget budget) {
    return budget == GovernorBudget::CpuTime || budget == GovernorBudget::GpuTime;
}

double medianOf(const std::array<double, 3>& v) {
    return std::max(std::min(v[0], v[1]), std::min(std::max(v[0], v[1]), v[2]));
}

// Follows the τ by which chunks merge, and that to which they have morphed: a fall at once; a rise by ln(1 + morphRange) in
// fadeS, or by the level that has morphed in that time.
void followFade(GovernorState& state, double x, double elapsedS, const Rules& rules) {
    const double camera = (x - state.mergingLnTau) * newestShare(elapsedS, backlashS);
    const double merging =
        state.frames == 0 ? x : std::clamp(state.mergingLnTau + camera, x - rules.backlash, x);
    // The parts together are as long as an ordinary fade. Fades that catch up make time count more.
    const double fadedS = elapsedS * state.fadeSpeed;
    const double partS = rules.fadeS / static_cast<double>(GovernorState::fadeParts - 1);
    if (state.frames == 0 || partS <= 0) {
        state.parts.fill({merging, merging});
        state.mergingLnTau = state.shownLnTau = merging;
        state.partS = 0;
        return;
    }
    state.partS = std::min(state.partS + fadedS, 2 * rules.fadeS);
    while (state.partS >= partS) {
        std::shift_right(state.parts.begin(), state.parts.end(), 1);
        state.parts[0] = {state.mergingLnTau, state.shownLnTau};
        state.partS -= partS;
    }
    const auto lower = [](const GovernorState::Part& a, const GovernorState::Part& b) {
        return GovernorState::Part{std::min(a.mergingLnTau, b.mergingLnTau),
                                   std::min(a.shownLnTau, b.shownLnTau)};
    };
    GovernorState::Part least = state.parts[0] = lower(state.parts[0], {merging, merging});
    for (const GovernorState::Part& part : state.parts) least = lower(least, part);
    const double slid = state.shownLnTau + fadedS * std::log1p(rules.morphRange) / rules.fadeS;
    const double faded = std::min(least.mergingLnTau, least.shownLnTau + std::numbers::ln2);
    state.mergingLnTau = merging;
    state.shownLnTau = std::min(merging, std::max(slid, faded));
}

template <std::size_t Count>
void push(std::array<double, Count>& newestFirst, double value) {
    std::shift_right(newestFirst.begin(), newestFirst.end(), 1);
    newestFirst[0] = value;
}

// Follows how fast the camera makes the triangles more, whose count has no noise.
void followGrowth(GovernorState& state, double exponent, double elapsedS) {
    if (elapsedS <= 0) return;
    const double change =
        state.lnTriangles[0] - state.lnTriangles[1] + exponent * (state.lnTau[0] - state.lnTau[1]);
    const double perS = std::clamp(change / elapsedS, -mostGrowthPerS, mostGrowthPerS);
    state.growthPerS +=
        ((std::abs(change) > leastStep ? 0 : perS) - state.growthPerS) * newestShare(elapsedS, growthS);
}

double exponentIn(const GovernorSample& sample, const Rules& rules) {
    const double exponent = within(sample.exponent, 0, 0, mostExponent);
    return exponent > 0 ? std::max(exponent, leastExponent) : rules.exponent;
}

// Takes a sample that was selected with ln τ = x.
void takeSample(GovernorState& state, const GovernorSample& sample, double x, double elapsedS,
                const Rules& rules) {
    followFade(state, x, elapsedS, rules);
    const double lnTriangles = std::log(std::max(measured(sample.cost.triangles), 1.0));
    if (state.frames == 0) {
        state.lnTau.fill(x);
        state.lnTriangles.fill(lnTriangles);
        state.meanLnTau = x;
        state.sinceRiseS = state.sinceFallS = longWayS;
    }
    push(state.lnTau, state.shownLnTau);
    push(state.lnTriangles, lnTriangles);
    followGrowth(state, exponentIn(sample, rules), elapsedS);
    for (std::size_t b = 0; b < governorBudgetCount; ++b) {
        std::array<double, 3>& last = state.costs[b];
        push(last, measured(valueOf(sample.cost, static_cast<GovernorBudget>(b))));
        if (last[1] == 0 && last[2] == 0) last.fill(last[0]);
    }
    const double newest = newestShare(elapsedS, meanS);
    state.readBytesPerS +=
        (std::min(measured(sample.cost.readBytesPerS), 1e18) - state.readBytesPerS) * newest;
    state.meanLnTau += (state.shownLnTau - state.meanLnTau) * newest;
    ++state.frames;
}

// Returns the cost that is compared with the budget; 0: not measured.
double costOf(const GovernorState& state, GovernorBudget budget) {
    const std::array<double, 3>& last = state.costs[static_cast<std::size_t>(budget)];
    if (budget == GovernorBudget::Reading) return std::max(state.readBytesPerS, 1e-3);
    return isTime(budget) ? medianOf(last) : last[0];
}

// Notes by how much a time has changed since the triangles were last others.
void noteElasticity(GovernorState::Elasticity& known, double lnTriangles, double lnCost, double elapsedS) {
    const double kept = 1 - newestShare(elapsedS, forgetS);
    known.sumXX *= kept;
    known.sumXY *= kept;
    const double x = lnTriangles - known.lnTriangles;
    if (known.known && std::abs(x) < leastChange) return;
    // A larger change of the time has another reason. One that is larger by far is left out.
    const double most = 2 * std::abs(x);
    const double change = lnCost - known.lnCost;
    if (known.known && std::abs(change) < most + ownChange) {
        const double y = std::clamp(change, -most, most);
        const double share = std::min(mostChange / std::abs(x), 1.0);
        known.sumXX += share * share * x * x;
        known.sumXY += share * share * x * y;
    }
    known.lnTriangles = lnTriangles;
    known.lnCost = lnCost;
    known.known = true;
}

// Returns the elasticity by the changes so far; expected: before any.
double elasticityOf(const GovernorState::Elasticity& known, double expected) {
    return std::clamp((known.sumXY + priorWeight * expected) / (known.sumXX + priorWeight), leastElasticity,
                      1.0);
}

// How a cost follows τ, and the bounds of the ln τ that it belongs to.
struct Law {
    double exponent;
    double riseElasticity, fallElasticity;
    double leastX, mostX;
    double sinceThenLn;  // by how much ln triangles can have fallen since the cost was that, <= 0
    bool isLatest;       // not a mean over half a second, in which the triangles have changed
};

Law lawOf(GovernorState& state, GovernorBudget budget, double cost, const GovernorSample& sample,
          double elapsedS, const Rules& rules) {
    Law law{exponentIn(sample, rules), 1, 1, state.lnTau[0], state.lnTau[0], 0, true};
    if (budget == GovernorBudget::Reading) {
        law.leastX = law.mostX = state.meanLnTau;
        law.isLatest = false;
    }
    if (!isTime(budget)) return law;
    // A median of three is one frame late.
    const std::size_t late = (budget == GovernorBudget::GpuTime ? rules.gpuFramesLate : 0) + 1;
    const auto [least, most] =
        std::minmax_element(state.lnTau.begin(), state.lnTau.begin() + static_cast<std::ptrdiff_t>(late) + 1);
    law.leastX = *least;
    law.mostX = *most;
    law.sinceThenLn = state.lnTriangles[0] -
                      *std::max_element(state.lnTriangles.begin(),
                                        state.lnTriangles.begin() + static_cast<std::ptrdiff_t>(late) + 1);
    GovernorState::Elasticity& elasticity = state.elasticities[static_cast<std::size_t>(budget)];
    if (measured(sample.cost.triangles) > 0)
        noteElasticity(elasticity, state.lnTriangles[late], std::log(cost), elapsedS);
    law.riseElasticity = elasticityOf(elasticity, expectedAtRise);
    law.fallElasticity = elasticityOf(elasticity, 1);
    return law;
}

// Returns ln of the share of the triangles that is left when the cost changes by the factor exp(lnFactor).
double lnShareFor(double lnFactor, double elasticity) {
    constexpr double leastTriangles = 0.1;  // share that one move leaves
    return std::log(std::max((std::exp(lnFactor) - 1) / elasticity + 1, leastTriangles));
}

// Returns by how much ln τ must change for the cost to change by the factor exp(lnFactor).
double moveFor(double lnFactor, double elasticity, const Law& law) {
    return -lnShareFor(lnFactor, elasticity) / law.exponent;
}

// Returns the smallest ln τ at which at most exp(lnShare) of the triangles are left. x: ln τ of the selection.
double lnTauLeaving(double lnShare, const MergeCurve& merges, double x) {
    constexpr double step = std::numbers::ln2 / MergeCurve::perDoubling;
    const double first = x - std::numbers::ln2;
    for (std::size_t i = 1; i < MergeCurve::count; ++i) {
        const double before = static_cast<double>(merges.lnShare[i - 1]);
        const double here = static_cast<double>(merges.lnShare[i]);
        if (here > lnShare) continue;
        const double part = before > here ? (before - lnShare) / (before - here) : 1;
        return first + step * (static_cast<double>(i - 1) + std::clamp(part, 0.0, 1.0));
    }
    return first + step * static_cast<double>(MergeCurve::count - 1);
}

// A change by less than this share needs no curve.
constexpr double lnLargeShare = -0.4;

// Returns whether many chunks will merge even if τ stays.
bool isOnItsWay(const GovernorState& state, const GovernorSample& sample) {
    constexpr double lnMany = -0.1;
    // Fades that have begun to catch up go on until fewer chunks than these will merge.
    constexpr double lnFew = -0.02;
    return sample.merges.isKnown &&
           static_cast<double>(sample.merges.lnShareToCome) < (state.fadeSpeed > 1 ? lnFew : lnMany);
}

// Returns how many times as fast as ordinary ones fades should be.
double fadeSpeedFor(const GovernorState& state, const GovernorSample& sample, const Rules& rules) {
    if (!isOnItsWay(state, sample)) return 1;
    // Each level takes a frame or two more than its fade. The last levels keep the speed of the first.
    const int levels = sample.merges.levels;
    return std::clamp(std::max(state.fadeSpeed, levels > 1 ? levels + 1.0 : 1.0), 1.0, rules.mostFadeSpeed);
}

// Returns the ln τ that changes a cost by the factor exp(lnFactor), for a rise. x: ln τ of the selection.
double riseTo(double lnFactor, const GovernorState& state, const Law& law, const GovernorSample& sample,
              double x) {
    const double lnShare = lnShareFor(lnFactor, law.riseElasticity) - law.sinceThenLn;
    if (law.isLatest && sample.merges.isKnown && (lnShare < lnLargeShare || isOnItsWay(state, sample)))
        return lnTauLeaving(lnShare, sample.merges, x);
    return law.leastX + moveFor(lnFactor, law.riseElasticity, law);
}

// The ln τ that bring a cost to the ceiling, to the middle and to the floor of its band.
struct Demand {
    double ceiling, middle, floor;
};

Demand demandOf(GovernorState& state, GovernorBudget budget, double cost, double limit,
                const GovernorSample& sample, double x, double elapsedS, const Rules& rules) {
    const Law law = lawOf(state, budget, cost, sample, elapsedS, rules);
    const double growth = budget == GovernorBudget::Reading ? 0 : std::max(state.growthPerS, 0.0);
    const double lnUse = std::clamp(std::log(cost) - std::log(limit), -mostLn, mostLn);
    // Each chunk that waits becomes four.
    const double waiting = std::log1p(3 * within(sample.waitingShare, 0, 0, 1));
    return {
        riseTo(rules.lnCeiling - lnUse - foresightS * growth, state, law, sample, x),
        riseTo(rules.lnMiddle - lnUse - creepForesightS * growth, state, law, sample, x),
        law.mostX + moveFor(rules.lnFloor - lnUse - foresightS * growth - waiting, law.fallElasticity, law)};
}

// Follows the speed at which reading lets τ fall, and returns it.
double readFall(GovernorState& state, double use, double elapsedS, const Rules& rules) {
    constexpr double littleUse = 0.5, quickeningPerS2 = 0.2, halfLifeS = 0.1, mostPerS = 2;
    if (use > std::exp(rules.lnFloor))
        state.readFallPerS *= std::exp2(-elapsedS / halfLifeS);
    else if (use < littleUse)
        state.readFallPerS = std::min(state.readFallPerS + quickeningPerS2 * elapsedS, mostPerS);
    return use > std::exp(rules.lnCeiling) ? 0 : state.readFallPerS;
}

// The demands of all budgets together.
struct Demands {
    Demand largest;
    double fallPerS = std::numeric_limits<double>::infinity();
};

Demands demandsOf(Governed& result, const GovernorSample& sample, double x, double elapsedS,
                  const Rules& rules) {
    constexpr double none = -std::numeric_limits<double>::infinity();
    GovernorState& state = result.state;
    Demands all{{none, none, none}};
    for (std::size_t b = 0; b < governorBudgetCount; ++b) {
        const auto budget = static_cast<GovernorBudget>(b);
        const double limit = measured(valueOf(rules.budget, budget));
        const double cost = costOf(state, budget);
        if (limit == 0 || cost == 0) continue;
        const Demand demand = demandOf(state, budget, cost, limit, sample, x, elapsedS, rules);
        if (!result.governs || demand.floor > all.largest.floor) {
            result.binds = budget;
            result.use = cost / limit;
        }
        result.uses[b] = cost / limit;
        result.governs = true;
        all.largest.floor = std::max(all.largest.floor, demand.floor);
        const bool isReading = budget == GovernorBudget::Reading;
        if (isReading) all.fallPerS = readFall(state, cost / limit, elapsedS, rules);
        // A fall of τ reads blocks only for a short time, so it must not raise τ again.
        if (isReading && state.sinceFallS <= 2 * meanS) continue;
        all.largest.ceiling = std::max(all.largest.ceiling, demand.ceiling);
        all.largest.middle = std::max(all.largest.middle, demand.middle);
    }
    return all;
}

// Returns by how much ln τ falls if it is too large by gap. A wide gap closes faster, because chunks that split are far
// from the budget.
double fallOf(double gap, double mostPerS, double elapsedS, const Rules& rules) {
    constexpr double wideGap = 0.3;
    constexpr double leastFallPerS = 0.02;  // so that a fall ends
    const double perS = std::min(rules.fallPerS * std::max(gap / wideGap, 1.0), mostPerS);
    return std::min(
        {gap, std::max(gap * newestShare(elapsedS, fallS), leastFallPerS * elapsedS), perS * elapsedS});
}

// Returns the next ln τ, before its limits. x: now, within the limits. merging: that by which chunks merge.
double nextX(double x, double merging, const Demands& demands, const GovernorState& state, double elapsedS,
             const Rules& rules) {
    const Demand& to = demands.largest;
    if (to.ceiling > merging)
        return (to.ceiling > merging + largeRise ? to.middle : to.ceiling) + rules.backlash;
    if (to.middle > merging) {
        const double wholeBand = std::max(to.middle - to.ceiling, 1e-9);
        const double share = std::min(2 * (to.middle - merging) / wholeBand, 1.0);
        return x + std::min(to.middle + rules.backlash - x, rules.risePerS * elapsedS * share);
    }
    if (to.floor < std::min(x, state.shownLnTau) && state.sinceRiseS >= holdS)
        return x - fallOf(x - to.floor, demands.fallPerS, elapsedS, rules);
    return x;
}

}  // namespace

double exponentOf(const Selection& selection, double tauPx) {
    const auto merges =
        std::count_if(selection.draw.begin(), selection.draw.end(), [&](const DrawItem& item) {
            return item.id.level > 0 &&
                   static_cast<double>(item.parentEpsPx) <= 2 * tauPx * static_cast<double>(item.tauFactor);
        });
    if (selection.draw.empty()) return 0;
    const auto drawn = static_cast<double>(selection.draw.size());
    return -std::log2(1 - 0.75 * static_cast<double>(merges) / drawn);
}

MergeCurve mergeCurveOf(const Selection& selection, double lodHysteresis) {
    MergeCurve curve;
    if (selection.draw.empty() || selection.splits.empty()) return curve;
    curve.isKnown = true;
    const double mergesAt = 1 - lodHysteresis;
    // A split whose children are being visited.
    struct Open {
        const ChildrenRequest* split = nullptr;
        int childrenAhead = quadrantCount;
        int visible = 0;
        int levels = 0;  // the most below that will merge
    };
    std::vector<Open> open;                       // from a root to the node before
    std::array<int, MergeCurve::count> merged{};  // chunks fewer at each τ
    int coming = 0;                               // chunks fewer if τ stays
    const auto close = [&] {
        const Open done = open.back();
        open.pop_back();
        if (done.split->isBelowLeastLevel) return;
        const int fewer = std::max(done.visible - 1, 0);
        const auto overTau = static_cast<double>(done.split->priority);
        const double doublings = 1 + std::log2(std::max(overTau, 1e-9));
        const double place = std::ceil(std::max(doublings, 0.0) * MergeCurve::perDoubling);
        if (place < static_cast<double>(MergeCurve::count)) merged[static_cast<std::size_t>(place)] += fewer;
        if (overTau > mergesAt) return;
        coming += fewer;
        curve.levels = std::max(curve.levels, done.levels + 1);
        if (!open.empty()) open.back().levels = std::max(open.back().levels, done.levels + 1);
    };
    auto next = selection.splits.begin();
    for (const VisitedNode& node : selection.touched) {
        while (!open.empty() && open.back().childrenAhead == 0) close();
        if (!open.empty()) {
            --open.back().childrenAhead;
            open.back().visible += node.fate == NodeFate::Drawn || node.fate == NodeFate::Split;
        }
        if (node.fate != NodeFate::Split) continue;
        assert(next != selection.splits.end() && next->parent == node.node);
        open.push_back({&*next++});
    }
    while (!open.empty()) close();

    const auto drawn = static_cast<double>(selection.draw.size());
    const auto lnShareWithout = [&](int chunks) {
        return static_cast<float>(std::log(std::max(1 - chunks / drawn, 1e-3)));
    };
    int fewer = 0;
    for (std::size_t i = 0; i < MergeCurve::count; ++i) {
        fewer += merged[i];
        curve.lnShare[i] = lnShareWithout(fewer);
    }
    curve.lnShareToCome = lnShareWithout(coming);
    return curve;
}

std::size_t neededChunks(const Selection& selection) {
    return selection.touched.size() + quadrantCount * selection.requests.size();
}

double valueOf(const GovernorCosts& costs, GovernorBudget budget) {
    switch (budget) {
        case GovernorBudget::CpuTime:
            return costs.cpuMs;
        case GovernorBudget::GpuTime:
            return costs.gpuMs;
        case GovernorBudget::Triangles:
            return costs.triangles;
        case GovernorBudget::Memory:
            return costs.memoryBytes;
        case GovernorBudget::Reading:
            return costs.readBytesPerS;
    }
    return 0;
}

Governed govern(const GovernorState& before, const GovernorSample& sample, const GovernorSettings& settings) {
    const Rules rules = rulesOf(settings);
    const double elapsedS = within(sample.elapsedS, 0, 0, 1);
    Governed result{.state = before, .tauPx = sample.tauPx};
    GovernorState& state = result.state;

    // 1. Follow what the sample says.
    const double x = lnTauOf(sample.tauPx, before.frames > 0 ? before.lnTau[0] : rules.mostX);
    takeSample(state, sample, x, elapsedS, rules);

    // 2. Ask each budget for its τ.
    const Demands demands = demandsOf(result, sample, x, elapsedS, rules);
    state.fadeSpeed = result.governs ? fadeSpeedFor(state, sample, rules) : 1;
    result.fadeS = rules.fadeS / state.fadeSpeed;
    if (!result.governs) return result;

    // 3. Move.
    const double now = std::clamp(x, rules.leastX, rules.mostX);
    const double wanted = nextX(now, state.mergingLnTau + now - x, demands, state, elapsedS, rules);
    const double next = std::clamp(wanted, rules.leastX, rules.mostX);
    constexpr double atLimit = 0.005;
    if (demands.largest.ceiling > rules.mostX) result.limit = GovernorLimit::MostTau;
    if (demands.largest.floor < rules.leastX && next - rules.leastX < atLimit)
        result.limit = GovernorLimit::LeastTau;
    // Chunks that are still merging must not split again at once.
    const bool rises = next > x || isOnItsWay(state, sample);
    state.sinceRiseS = rises ? 0 : std::min(state.sinceRiseS + elapsedS, longWayS);
    state.sinceFallS = next < x ? 0 : std::min(state.sinceFallS + elapsedS, longWayS);
    // A τ that stays keeps its bits.
    if (next != x || measured(sample.tauPx) == 0) {
        const double limitPx = next == rules.leastX ? settings.leastTauPx : settings.mostTauPx;
        result.tauPx = lnTauOf(limitPx, -mostLn) == next ? limitPx : std::exp(next);
    }
    return result;
}

}  // namespace planet
