// A trace of an engine that nobody here wrote: CesiumJS over our Earth. tests/trace/cesium/README.md says how it was recorded.
// Cesium's own objects were counted beside it, into cesium.json, and the reader must find the same. Set WORLDY_CESIUM_TRACE to
// a folder with another recording to test that one.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "planet/trace/trace_faults.h"
#include "planet/trace/trace_index.h"
#include "planet/trace/trace_what_if.h"

namespace planet {
namespace {

constexpr std::uint64_t tileMask = (std::uint64_t{1} << 28) - 1;
constexpr double cesiumTauPx = 2;

std::filesystem::path recordingFolder() {
    const char* other = std::getenv("WORLDY_CESIUM_TRACE");
    return other != nullptr ? other : WORLDY_SOURCE_DIR "/tests/trace/cesium";
}

// Returns the name of a tile in Cesium: level/x/y. A face is one of the two roots, west and east.
std::string cesiumNameOf(const TraceNode& node) {
    const std::uint64_t x = (node.id >> 61 << node.level) + (node.id & tileMask);
    return std::to_string(node.level) + "/" + std::to_string(x) + "/" +
           std::to_string(node.id >> 28 & tileMask);
}

double cesiumCounterOf(const TraceState& state, std::string_view name) {
    for (const TraceCounted& counter : state.frame().counters)
        if (state.names()[counter.name] == name) return counter.value;
    ADD_FAILURE() << "no counter " << name;
    return 0;
}

class CesiumTrace : public testing::Test {
protected:
    void SetUp() override {
        std::ifstream(recordingFolder() / "cesium.json") >> counted_;
        ASSERT_EQ(counted_.at("frames"), 361);
        maxLevel_ = counted_.at("maxLevel");
    }
    // Calls visit at the end of each frame.
    template <class Visit>
    void eachFrame(Visit visit) {
        auto trace = TraceFile::open(recordingFolder() / "cesium.lodtrace");
        ASSERT_TRUE(trace) << trace.error().message;
        ASSERT_FALSE(trace->problem()) << *trace->problem();
        const auto sink = [&](const TraceEvent& event) {
            if (state_.add(event)) visit(state_.frame());
        };
        ASSERT_TRUE(trace->seek(0, sink));
        for (auto more = trace->next(sink); !more || *more; more = trace->next(sink))
            ASSERT_TRUE(more) << more.error().message;
    }
    const TraceNode& nodeOf(TraceNodeIndex node) const { return state_.nodes()[node].node; }

    nlohmann::json counted_;
    TraceState state_;
    std::uint32_t maxLevel_ = 0;  // the finest for which the provider has heights
};

TEST_F(CesiumTrace, drawsAndCullsTheTilesThatCesiumCounted) {
    std::size_t frame = 0;
    std::array<std::uint64_t, 4> culled{};
    eachFrame([&](const TraceFrame& now) {
        ASSERT_EQ(now.number, frame + 1);
        ASSERT_TRUE(now.isComplete());
        ASSERT_EQ(now.views.size(), 1u);
        int deepest = -1;
        for (const TraceDrawn& drawn : now.views[0].drawn)
            deepest = std::max(deepest, static_cast<int>(nodeOf(drawn.node).level));
        for (const TraceCulled& one : now.views[0].culled) ++culled.at(static_cast<std::size_t>(one.reason));
        const nlohmann::json& counted = counted_["perFrame"];
        ASSERT_EQ(now.views[0].drawn.size(), counted["drawn"][frame]);
        ASSERT_EQ(deepest, counted["deepest"][frame]);
        ASSERT_EQ(cesiumCounterOf(state_, "fill_tiles"), counted["fills"][frame]);
        ++frame;
    });
    EXPECT_EQ(frame, counted_["frames"]);
    EXPECT_EQ(culled[0], counted_["culled"]["frustum"]);
    EXPECT_EQ(culled[1], counted_["culled"]["horizon"]);
    EXPECT_EQ(culled[3], counted_["culled"]["fog"]);
    EXPECT_EQ(state_.description()->ids, TraceIds::Quadtree);
    EXPECT_NEAR(state_.description()->radius, 6371008.77, 0.01);
}

TEST_F(CesiumTrace, tellsTheStepsOfLoadingThatCesiumTook) {
    constexpr std::array steps = {"requested", "started", "arrived", "cancelled", "failed", "evicted"};
    std::map<std::string, int> found;
    eachFrame([&](const TraceFrame& now) {
        for (const TracePagedStep& step : now.paged)
            ++found[state_.description()->kinds.at(step.event.kind) + " " +
                    steps.at(static_cast<std::size_t>(step.event.step))];
    });
    EXPECT_EQ(found, (counted_["steps"].get<std::map<std::string, int>>()));
}

TEST_F(CesiumTrace, everyDrawnTileHangsInTheQuadtreeOfTwoRoots) {
    // Cesium's estimate for a heightmap: a quarter of a sample's width at the equator.
    const double rootError = 6378137.0 * 2 * std::numbers::pi * 0.25 / (65 * 2);
    eachFrame([&](const TraceFrame& now) {
        for (const TraceDrawn& drawn : now.views[0].drawn) {
            TraceNodeIndex at = drawn.node;
            for (std::uint32_t level = nodeOf(drawn.node).level;; --level) {
                const TraceNode& node = nodeOf(at);
                ASSERT_TRUE(node.isTold);
                ASSERT_EQ(node.level, level);
                ASSERT_EQ(node.id >> 56 & 31, level);
                ASSERT_LT(node.id >> 61, 2u);
                ASSERT_EQ(node.bounds.shape, TraceBoundsShape::Box);
                ASSERT_DOUBLE_EQ(node.error, std::ldexp(rootError, -static_cast<int>(level)));
                if (level == 0) break;
                const std::uint64_t x = node.id & tileMask, y = node.id >> 28 & tileMask;
                ASSERT_EQ(node.parent,
                          node.id >> 61 << 61 | std::uint64_t{level - 1} << 56 | y / 2 << 28 | x / 2);
                at = state_.nodes()[at].parent;
                ASSERT_NE(at, noTraceNode);
            }
        }
    });
}

// Cesium's height / sseDenominator is our K'. From its error it subtracts up to 2 px by fog.
TEST_F(CesiumTrace, errorsAreOurFormulaWithCesiumsDistanceAndFog) {
    std::size_t compared = 0;
    eachFrame([&](const TraceFrame& now) {
        const auto sample = counted_["tilesOf"].find(std::to_string(now.number));
        if (sample == counted_["tilesOf"].end()) return;
        std::map<std::string, nlohmann::json> tiles;
        for (const nlohmann::json& tile : *sample) tiles[tile["tile"]] = tile;
        const TraceFrameView& view = now.views[0];
        ASSERT_EQ(tiles.size(), view.drawn.size());
        const double scalePx = view.info->projection[0][0] * view.info->width / 2;
        const double density = cesiumCounterOf(state_, "fog_density"),
                     fogPx = *state_.setting("fog_sse_factor", 0);
        for (const TraceDrawn& drawn : view.drawn) {
            const auto tile = tiles.find(cesiumNameOf(nodeOf(drawn.node)));
            ASSERT_NE(tile, tiles.end());
            const double distance = tile->second["distance"];
            const double fog = 1 - std::exp(-distance * distance * density * density);
            const double errorPx = nodeOf(drawn.node).error * scalePx / distance - fog * fogPx;
            EXPECT_NEAR(drawn.errorPx, errorPx, 1e-5 * std::max(1.0, std::abs(errorPx)));
            EXPECT_NEAR(drawn.errorPx, tile->second["errorPx"], 1e-5);
            ++compared;
        }
    });
    EXPECT_GT(compared, 50u);
}

// Cesium measures to a region of longitude, latitude and height, and at least to the box that it tells.
TEST_F(CesiumTrace, noErrorExceedsWhatTheBoxesGive) {
    eachFrame([&](const TraceFrame& now) {
        for (const TraceDrawn& drawn : now.views[0].drawn) {
            const double errorPx =
                traceErrorPx(*state_.description(), nodeOf(drawn.node), *now.views[0].info);
            ASSERT_LE(drawn.errorPx, errorPx * (1 + 1e-5))
                << cesiumNameOf(nodeOf(drawn.node)) << " in " << now.number;
        }
    });
}

TEST_F(CesiumTrace, tilesExceedTauOnlyIfTheyWaitOrHaveNoFinerData) {
    std::uint64_t waiting = 0, withoutData = 0, unknown = 0, coarse = 0;
    std::vector<char> wasResident;  // at the end of the frame before, as the selection saw it
    const std::function<bool(TraceNodeIndex)> lacksBelow = [&](TraceNodeIndex node) {
        return std::ranges::any_of(state_.nodes()[node].children, [&](TraceNodeIndex child) {
            return child >= wasResident.size() || !wasResident[child] || lacksBelow(child);
        });
    };
    eachFrame([&](const TraceFrame& now) {
        waiting += static_cast<std::uint64_t>(cesiumCounterOf(state_, "coarse_waiting"));
        withoutData += static_cast<std::uint64_t>(cesiumCounterOf(state_, "coarse_without_data"));
        unknown += static_cast<std::uint64_t>(cesiumCounterOf(state_, "coarse_unknown_children"));
        for (const TraceDrawn& drawn : now.views[0].drawn) {
            if (drawn.errorPx < cesiumTauPx) continue;
            ++coarse;
            const bool hasData = nodeOf(drawn.node).level < maxLevel_;
            EXPECT_TRUE(!hasData || lacksBelow(drawn.node))
                << cesiumNameOf(nodeOf(drawn.node)) << " in " << now.number;
        }
        wasResident.assign(state_.nodes().size(), 0);
        for (TraceNodeIndex node = 0; node < state_.nodes().size(); ++node)
            wasResident[node] = state_.isResident(node);
    });
    EXPECT_EQ(coarse, waiting + withoutData + unknown);
    EXPECT_EQ(waiting, counted_["coarse"]["waits"]);
    EXPECT_EQ(withoutData, counted_["coarse"]["withoutData"]);
    EXPECT_EQ(unknown, counted_["coarse"]["unknownChildren"]);
}

// Where one of a tile's children is culled, Cesium does not notice that none of them has data of its own.
TEST_F(CesiumTrace, itsChoiceContradictsItsNumbersOnlyWhereItSplitsTilesWithoutFinerData) {
    auto trace = TraceFile::open(recordingFolder() / "cesium.lodtrace");
    ASSERT_TRUE(trace) << trace.error().message;
    std::uint64_t atLargest = 0, beyond = 0;
    const auto watch = [&](const TraceState& state, int, int row, const TraceSelection& selection) {
        if (row != -2) return;  // what Cesium drew
        for (const TraceNodeIndex node : selection.split) {
            atLargest += state.nodes()[node].node.level == maxLevel_;
            beyond += state.nodes()[node].node.level > maxLevel_;
        }
    };
    const auto report = whatIfOfTrace(*trace, {}, {}, watch);
    ASSERT_TRUE(report) << report.error().message;
    std::uint64_t listed = 0;
    for (const TraceDisagreement& found : report->disagreements) {
        EXPECT_EQ(found.kind, TraceDisagreementKind::TooFine) << found.sentence;
        EXPECT_EQ(found.node >> 56 & 31, maxLevel_) << found.sentence;
        EXPECT_NE(found.sentence.find("expected no split from max_level"), std::string::npos)
            << found.sentence;
        listed += found.frames;
    }
    EXPECT_EQ(listed, atLargest);
    EXPECT_EQ(atLargest + beyond, counted_["refinedBeyondData"]);
    EXPECT_GT(listed, 0u);
}

TEST_F(CesiumTrace, hasTheLevelStepsThatCesiumDrewAndNoHoles) {
    TraceFaultFinder finder;
    eachFrame([&](const TraceFrame&) { finder.add(state_); });
    finder.finish(state_);
    std::uint64_t steps = 0;
    for (const TraceFault& fault : finder.faults()) {
        EXPECT_NE(fault.kind, TraceFaultKind::Hole) << fault.sentence;
        EXPECT_NE(fault.kind, TraceFaultKind::DrawnTwice) << fault.sentence;
        EXPECT_NE(fault.kind, TraceFaultKind::TooCoarse) << fault.sentence;
        EXPECT_NE(fault.kind, TraceFaultKind::TooFine) << fault.sentence;
        if (fault.kind == TraceFaultKind::LevelStep) steps += fault.frames;
    }
    EXPECT_EQ(finder.unlisted(), 0u);
    EXPECT_EQ(steps, counted_["levelSteps"]);
    EXPECT_EQ(counted_["holes"], 0);
}

// A child that is culled is never requested, so it is not what a tile waits for.
TEST_F(CesiumTrace, starvedTilesWaitForTilesThatWereRequested) {
    TraceFaultFinder finder;
    std::vector<char> wasRequested;
    eachFrame([&](const TraceFrame& now) {
        finder.add(state_);
        wasRequested.resize(state_.nodes().size());
        for (const TracePagedStep& step : now.paged) wasRequested[step.event.node] = 1;
    });
    std::size_t starved = 0;
    for (const TraceFault& fault : finder.faults()) {
        if (fault.kind != TraceFaultKind::Starvation) continue;
        ++starved;
        EXPECT_TRUE(wasRequested[state_.find(fault.other)]) << fault.sentence;
    }
    EXPECT_GT(starved, 0u);
}

}  // namespace
}  // namespace planet
