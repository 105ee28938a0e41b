// A tool reads from a trace of Worldy what Worldy's own panels show.
#include "app/flight/planet_trace.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <vector>

#include "app/flight/flight_path_file.h"
#include "app/trace/trace_history.h"
#include "app/trace/traced_frame.h"
#include "planet/measure/lod_changes.h"
#include "planet/planet_tools.h"
#include "planet/trace/trace_report.h"
#include "planet/trace/trace_what_if.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using planet::Planet;

constexpr int flownFrames = 600;
constexpr double stepS = 1.0 / 60;

struct ShownChunk {
    float morph = 0;
    float epsPx = 0;
    bool operator==(const ShownChunk&) const = default;
};

// The numbers that the panels show of a frame.
struct ShownFrame {
    std::map<std::uint64_t, ShownChunk> drawn;
    std::uint64_t loaded = 0;
    std::uint64_t evicted = 0;
    std::uint64_t failed = 0;
    std::uint64_t requested = 0;
    std::uint64_t waiting = 0;  // requests
    std::uint64_t loading = 0;
    double worstEpsPx = 0;
};

std::uint64_t idOf(const planet::ChunkId& id) {
    return planet::keyOf(id);
}

ShownFrame shownFrame(const Planet& planet) {
    ShownFrame frame;
    for (const planet::DrawItem& item : planet.selection().draw)
        frame.drawn[idOf(item.id)] = {item.morph, item.epsPx};
    const planet::BlockCounters& heights = planet.paging()[planet::BlockKind::Heights];
    frame.loaded = heights.loaded;
    frame.evicted = heights.evicted;
    frame.failed = heights.failed;
    frame.requested = planet.paging().requested;
    frame.waiting = planet.paging().queued;
    frame.loading = planet.paging().loading;
    frame.worstEpsPx = static_cast<double>(planet.selection().counters.worstEpsPx);
    return frame;
}

// Flies around the fake planet with a budget that is too small for it, so that blocks come and go.
class PlanetTraces : public testing::Test {
protected:
    using ViewAt = std::function<planet::View(double share)>;

    static planet::View around(double share) {
        return planet::viewAt(30 * std::sin(7 * share), 300 * share, 9000);
    }
    void fly(double tauPx = 1, double fadeS = planet::LodSettings{}.fadeS, const ViewAt& viewAt = around) {
        planet::PagingSettings settings;
        settings.budgetBytes = planet::bytesOf(180);
        settings.time = planet::PagingTime::Simulated;
        settings.badDisk.latencyMs = 40;
        planet_ = Planet::open(planet::fakePyramid().source(), settings).value();
        planet::LodSettings lod;
        lod.tauPx = tauPx;
        lod.fadeS = fadeS;
        auto trace = PlanetTrace::create(file_, *planet_, "around");
        ASSERT_TRUE(trace) << trace.error().message;
        const std::uint64_t requestedBefore = planet_->paging().requested;
        for (int i = 0; i < flownFrames; ++i) {
            const double share = static_cast<double>(i) / flownFrames;
            const planet::ViewInput view{viewAt(share), lod};
            planet_->step({&view, 1}, planet::noUpload, stepS);
            changes_.add(planet_->selection(), i * stepS);
            splits_ += newChanges(planet::LodChangeType::Split, i * stepS);
            merges_ += newChanges(planet::LodChangeType::Merge, i * stepS);
            frames_.push_back(shownFrame(*planet_));
            frames_.back().requested -= requestedBefore;
            trace->addFrame(*planet_, {i * stepS, 1.5, -1});
        }
        const auto finished = trace->finish(*planet_);
        ASSERT_TRUE(finished) << finished.error().message;
    }

    std::uint64_t newChanges(planet::LodChangeType type, double nowS) const {
        std::uint64_t count = 0;
        for (const planet::LodChange& change : changes_.recent())
            count += change.type == type && change.timeS == nowS;
        return count;
    }

    planet::TraceReport report() const {
        auto file = planet::TraceFile::open(file_);
        return planet::reportOfTrace(*file, 16).value();
    }

    planet::TraceWhatIfReport whatIf(const std::vector<planet::TraceSelectorSettings>& settings,
                                     const planet::TraceWhatIf::Watch& watch = {}) const {
        auto file = planet::TraceFile::open(file_);
        return planet::whatIfOfTrace(*file, settings, {}, watch).value();
    }

    const tests::TemporaryFolder folder_;
    const fs::path file_ = folder_.path() / "worldy.lodtrace";
    std::unique_ptr<Planet> planet_;
    planet::LodChanges changes_;
    std::vector<ShownFrame> frames_;
    std::uint64_t splits_ = 0;
    std::uint64_t merges_ = 0;
};

TEST_F(PlanetTraces, everyFrameIsTheOneThatWasShown) {
    fly();
    auto file = planet::TraceFile::open(file_);
    ASSERT_TRUE(file) << file.error().message;
    planet::TraceState state;
    std::size_t frame = 0;
    std::uint64_t loaded = 0, evicted = 0, failed = 0, requested = 0;
    double largestDifference = 0;
    const auto check = [&] {
        ASSERT_LT(frame, frames_.size());
        const ShownFrame& shown = frames_[frame++];
        const planet::TraceFrameView* const view = state.frame().view(0);
        ASSERT_NE(view, nullptr);
        std::map<std::uint64_t, ShownChunk> drawn;
        for (const planet::TraceDrawn& each : view->drawn) {
            const planet::TraceNode& node = state.nodes()[each.node].node;
            ASSERT_TRUE(node.isTold);
            drawn[node.id] = {each.morph, each.errorPx};
            const double computedPx = planet::traceErrorPx(*state.description(), node, *view->info);
            const auto epsPx = static_cast<double>(each.errorPx);
            largestDifference =
                std::max(largestDifference, std::abs(computedPx - epsPx) / std::max(epsPx, 1e-9));
        }
        EXPECT_EQ(drawn, shown.drawn) << "frame " << frame;
        for (const planet::TracePagedStep& step : state.frame().paged) {
            loaded += step.event.step == planet::TraceStep::Arrived;
            evicted += step.event.step == planet::TraceStep::Evicted;
            failed += step.event.step == planet::TraceStep::Failed;
            requested += step.event.step == planet::TraceStep::Requested;
        }
        EXPECT_EQ(loaded, shown.loaded) << "frame " << frame;
        EXPECT_EQ(evicted, shown.evicted) << "frame " << frame;
        EXPECT_EQ(failed, shown.failed) << "frame " << frame;
        EXPECT_EQ(requested, shown.requested) << "frame " << frame;
    };
    const planet::TraceDecoder::Sink sink = [&](const planet::TraceEvent& event) {
        if (state.add(event) && !HasFatalFailure()) check();
    };
    ASSERT_TRUE(file->seek(0, sink));
    for (auto more = file->next(sink); more && *more; more = file->next(sink)) {
    }
    EXPECT_EQ(frame, frames_.size());
    EXPECT_LT(largestDifference, 1e-6);
    EXPECT_GT(loaded, 100u);
    EXPECT_GT(evicted, 20u);
}

TEST_F(PlanetTraces, reportCountsTheChangesThatThePanelCounts) {
    fly();
    const planet::TraceReport report = this->report();
    EXPECT_EQ(report.frames, frames_.size());
    ASSERT_EQ(report.views.size(), 1u);
    EXPECT_EQ(report.views[0].splits, splits_);
    EXPECT_EQ(report.views[0].merges, merges_);
    EXPECT_EQ(report.views[0].thrashes, changes_.thrashTotal());
    EXPECT_GT(report.views[0].splits, 100u);
    double worst = 0;
    for (const ShownFrame& frame : frames_) worst = std::max(worst, frame.worstEpsPx);
    EXPECT_EQ(report.views[0].worstErrorPx, worst);
    EXPECT_EQ(report.views[0].tauPx, 1);
    EXPECT_EQ(report.description->name, "around");
}

// The flight of a file, or around the planet if it is empty.
class PlanetTracesOfFlights : public PlanetTraces, public testing::WithParamInterface<const char*> {
protected:
    void flyFile() {
        if (!*GetParam()) return fly();
        const auto path = loadFlightPath(fs::path(WORLDY_SOURCE_DIR) / "data/flights" / GetParam());
        ASSERT_TRUE(path) << path.error().message;
        fly(1, planet::LodSettings{}.fadeS, [&](double share) {
            planet::CameraPose pose = poseAt(*path, path->keys.front().timeS + share * durationS(*path));
            // The fake planet is smaller than the Earth, and its mountains are up to 4 km high.
            pose.altitudeM = 4500 + pose.altitudeM * planet::fakePyramid().shape.radiusM / 6'371'000;
            return planet::viewFromPose(pose, planet::fakePyramid().shape.radiusM, 1.1, 1280, 720);
        });
    }
};

INSTANTIATE_TEST_SUITE_P(, PlanetTracesOfFlights,
                         testing::Values("", "andes_low_fast.toml", "orbit_to_ground.toml",
                                         "vancouver_coast.toml"));

// The trace panels read TracedFrame and TraceHistory, and the panels of a planet read its counters.
TEST_P(PlanetTracesOfFlights, tracePanelsShowTheNumbersOfThePlanetsPanels) {
    flyFile();
    auto file = planet::TraceFile::open(file_);
    ASSERT_TRUE(file) << file.error().message;
    planet::TraceState state;
    TracedFrameBuilder builder;
    TraceHistorian historian;
    std::size_t frame = 0;
    std::uint64_t mostWaiting = 0;
    const planet::TraceDecoder::Sink sink = [&](const planet::TraceEvent& event) {
        if (!state.add(event) || HasFatalFailure()) return;
        ASSERT_LT(frame, frames_.size());
        const ShownFrame& shown = frames_[frame++];
        builder.add(state);
        historian.add(state);
        const auto traced = builder.build(state);
        ASSERT_EQ(traced->views.size(), 1u);
        const TracedView& view = traced->views[0];
        EXPECT_EQ(view.drawn, shown.drawn.size());
        EXPECT_EQ(traced->queued, shown.waiting + shown.loading);
        const auto started =
            static_cast<std::uint64_t>(std::ranges::count(traced->queue, true, &TracedRequest::isStarted));
        EXPECT_EQ(started, shown.loading) << "frame " << frame;
        EXPECT_EQ(traced->queue.size() - started, shown.waiting) << "frame " << frame;
        mostWaiting = std::max(mostWaiting, shown.waiting);
        EXPECT_NEAR(view.worstErrorPx, shown.worstEpsPx, 1e-6 * shown.worstEpsPx);
        for (const TracedNode& node : view.nodes) {
            const auto drawn = shown.drawn.find(node.node.id);
            ASSERT_EQ(node.place == TracedPlace::Drawn, drawn != shown.drawn.end());
            if (drawn == shown.drawn.end()) continue;
            EXPECT_EQ(node.morph, drawn->second.morph);
            const auto epsPx = static_cast<double>(drawn->second.epsPx);
            EXPECT_NEAR(node.errorPx, epsPx, 1e-6 * epsPx);
        }
    };
    ASSERT_TRUE(file->seek(0, sink));
    for (auto more = file->next(sink); more && *more; more = file->next(sink)) {
    }
    ASSERT_EQ(frame, frames_.size());
    EXPECT_GT(mostWaiting, 0u);
    const auto history = historian.history(state, true);
    const std::vector<TracedViewSample>& samples = history->views.at(0);
    ASSERT_EQ(samples.size(), frames_.size());
    double splits = 0, merges = 0, arrived = 0, evicted = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        EXPECT_EQ(samples[i].drawn, static_cast<float>(frames_[i].drawn.size()));
        EXPECT_FLOAT_EQ(samples[i].worstErrorPx, static_cast<float>(frames_[i].worstEpsPx));
        splits += static_cast<double>(samples[i].splits);
        merges += static_cast<double>(samples[i].merges);
        arrived += static_cast<double>(history->samples[i].arrived);
        evicted += static_cast<double>(history->samples[i].evicted);
    }
    EXPECT_EQ(splits, static_cast<double>(splits_));
    EXPECT_EQ(merges, static_cast<double>(merges_));
    EXPECT_EQ(arrived, static_cast<double>(frames_.back().loaded));
    EXPECT_EQ(evicted, static_cast<double>(frames_.back().evicted));
    EXPECT_EQ(history->switches.size(), splits_ + merges_);
}

TEST_F(PlanetTraces, selectionOfWorldyHasNoFaultOfItsOwn) {
    fly(1, 0);  // a fade holds a split back for longer than the finder allows a selection to wait
    for (const planet::TraceFault& fault : report().faults) {
        EXPECT_TRUE(fault.kind == planet::TraceFaultKind::Starvation ||
                    fault.kind == planet::TraceFaultKind::LatePage ||
                    fault.kind == planet::TraceFaultKind::LevelStep ||
                    fault.kind == planet::TraceFaultKind::Thrash)
            << fault.sentence;
    }
}

// Worldy waits with splits and merges while it fades, so only without fades is each frame decided by errors alone.
TEST_F(PlanetTraces, whatIfAtTheEnginesOwnSettingsDrawsWhatItDrew) {
    fly(1, 0);
    const planet::TraceWhatIfReport report = whatIf({});
    EXPECT_EQ(report.frames, frames_.size());
    EXPECT_EQ(report.skippedFrames, 0u);
    ASSERT_EQ(report.views.size(), 1u);
    const planet::TraceSelectionTotals &engine = report.views[0].engine, &own = report.views[0].own.totals;
    EXPECT_EQ(own.frames, frames_.size());
    EXPECT_EQ(report.views[0].own.framesThatDiffer, 0u);
    EXPECT_EQ(report.views[0].own.nodesThatDiffer, 0u);
    EXPECT_TRUE(report.disagreements.empty());
    EXPECT_EQ(own.mostTriangles, engine.mostTriangles);
    EXPECT_EQ(own.meanBytes, engine.meanBytes);
    EXPECT_EQ(own.worstErrorPx, engine.worstErrorPx);
    EXPECT_EQ(own.splits, engine.splits);
    EXPECT_EQ(own.merges, engine.merges);
    EXPECT_EQ(engine.splits, splits_);
    EXPECT_EQ(engine.merges, merges_);
    EXPECT_GT(splits_, 100u);
    EXPECT_GT(own.waiting, 0u);
}

TEST_F(PlanetTraces, onlyFadesMakeWorldyDisagreeWithItsOwnErrors) {
    fly();
    const planet::TraceWhatIfReport report = whatIf({});
    EXPECT_GT(report.disagreements.size(), 0u);
    for (const planet::TraceDisagreement& each : report.disagreements)
        EXPECT_TRUE(each.isFade) << each.sentence;
    EXPECT_EQ(report.framesThatDisagree, 0u);
}

TEST_F(PlanetTraces, fileThatIsNoTraceIsKept) {
    std::ofstream(file_) << "my notes";
    planet_ = Planet::open(planet::fakePyramid().source(), {}).value();
    const auto trace = PlanetTrace::create(file_, *planet_, "around");
    ASSERT_FALSE(trace);
    EXPECT_NE(trace.error().message.find(file_.string()), std::string::npos) << trace.error().message;
    EXPECT_EQ(fs::file_size(file_), 8u);
}

}  // namespace
}  // namespace worldy
