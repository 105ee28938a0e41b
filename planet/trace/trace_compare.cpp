#include "planet/trace/trace_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <map>
#include <utility>

#include "planet/base/try.h"
#include "planet/trace/trace_reading.h"

namespace planet {

namespace {

struct ComparedView {
    TraceSelection selection;
    std::uint64_t worstNode = 0;     // id
    std::vector<std::uint64_t> ids;  // of the drawn nodes, ascending
};

struct ComparedFrame {
    std::uint64_t number = 0;
    double timeS = 0;
    double cpuMs = -1, gpuMs = -1;
    bool isComplete = false;
    std::map<int, ComparedView> views;
};

// The frames of a trace, one after another.
class ComparedTrace {
public:
    explicit ComparedTrace(TraceFile& file) : blocks_(file) {}

    Result<void> begin() { return blocks_.begin(sink_); }
    // Returns the next frame, or null at the end.
    const ComparedFrame* front() {
        while (frames_.empty() && !isAtEnd_) isAtEnd_ = !blocks_.next(sink_);
        return frames_.empty() ? nullptr : &frames_.front();
    }
    void pop() { frames_.pop_front(); }
    const std::optional<TraceDescription>& description() const { return state_.description(); }
    const TraceEnd& end() const { return blocks_.end(); }

private:
    void add() {
        const TraceFrame& frame = state_.frame();
        ComparedFrame& made = frames_.emplace_back();
        made.number = frame.number;
        made.timeS = frame.timeS;
        made.cpuMs = frame.cpuMs;
        made.gpuMs = frame.gpuMs;
        made.isComplete = frame.isComplete();
        for (const TraceFrameView& view : frame.views) {
            auto& [engine, counter] = views_[view.view];
            engine.take(state_, view);
            ComparedView& compared = made.views[view.view];
            compared.selection = engineSelection(state_, engine);
            counter.count(state_, engine.hasBefore(), compared.selection);
            for (const TraceNodeIndex node : compared.selection.drawn)
                compared.ids.push_back(state_.nodes()[node].node.id);
            std::ranges::sort(compared.ids);
            if (compared.selection.worstNode != noTraceNode)
                compared.worstNode = state_.nodes()[compared.selection.worstNode].node.id;
        }
    }

    TraceBlocks blocks_;
    TraceState state_;
    TraceDecoder::Sink sink_ = [this](const TraceEvent& event) {
        if (state_.add(event)) add();
    };
    std::map<int, std::pair<TraceEngineFrame, TraceLevelCounter>> views_;
    std::deque<ComparedFrame> frames_;  // of the last block
    bool isAtEnd_ = false;
};

// Adds up the frames that both traces have.
class Comparer {
public:
    Comparer(const TraceCompareSettings& settings, TraceComparison& found)
        : settings_(settings), found_(found) {}

    void add(const ComparedFrame& a, const ComparedFrame& b) {
        ++found_.frames;
        if (!a.isComplete || !b.isComplete) {
            ++found_.skippedFrames;
            return;
        }
        const auto keep = [](double ms, std::vector<float>& list) {
            if (ms >= 0) list.push_back(static_cast<float>(ms));
        };
        keep(a.cpuMs, cpuMsA_), keep(b.cpuMs, cpuMsB_), keep(a.gpuMs, gpuMsA_), keep(b.gpuMs, gpuMsB_);
        bool differs = false;
        for (const auto& [view, shown] : a.views) {
            const auto other = b.views.find(view);
            differs |= add(a, b, view, shown, other == b.views.end() ? ComparedView{} : other->second);
        }
        for (const auto& [view, shown] : b.views)
            if (!a.views.contains(view)) differs |= add(a, b, view, ComparedView{}, shown);
        found_.framesThatDiffer += differs;
    }

    void finish() {
        found_.cpuMsA = spreadOf(cpuMsA_);
        found_.cpuMsB = spreadOf(cpuMsB_);
        found_.gpuMsA = spreadOf(gpuMsA_);
        found_.gpuMsB = spreadOf(gpuMsB_);
        for (auto& [view, sums] : views_) {
            sums.found.a = sums.a.totals();
            sums.found.b = sums.b.totals();
            found_.views.push_back(sums.found);
        }
    }

private:
    struct Sums {
        TraceViewComparison found;
        TraceSelectionTally a, b;
    };

    // Returns whether the two draw different nodes.
    bool add(const ComparedFrame& frameA, const ComparedFrame& frameB, int view, const ComparedView& a,
             const ComparedView& b) {
        Sums& sums = views_[view];
        sums.found.view = view;
        ++sums.found.frames;
        sums.a.add(frameA.number, a.selection, a.worstNode);
        sums.b.add(frameB.number, b.selection, b.worstNode);
        if (a.ids == b.ids) return false;
        std::vector<std::uint64_t> onlyInA, onlyInB;
        std::ranges::set_difference(a.ids, b.ids, std::back_inserter(onlyInA));
        std::ranges::set_difference(b.ids, a.ids, std::back_inserter(onlyInB));
        ++sums.found.framesThatDiffer;
        sums.found.onlyInA += onlyInA.size();
        sums.found.onlyInB += onlyInB.size();
        if (found_.differences.size() >= settings_.maxFrames) {
            ++found_.unlistedDifferences;
            return true;
        }
        TraceFrameDifference& made = found_.differences.emplace_back();
        made.frameA = frameA.number;
        made.frameB = frameB.number;
        made.timeS = frameA.timeS;
        made.view = view;
        made.drawnA = a.ids.size();
        made.drawnB = b.ids.size();
        made.trianglesA = a.selection.triangles;
        made.trianglesB = b.selection.triangles;
        made.worstErrorPxA = a.selection.worstErrorPx;
        made.worstErrorPxB = b.selection.worstErrorPx;
        made.onlyInA = onlyInA.size();
        made.onlyInB = onlyInB.size();
        onlyInA.resize(std::min(onlyInA.size(), settings_.maxNodes));
        onlyInB.resize(std::min(onlyInB.size(), settings_.maxNodes));
        made.nodesA = std::move(onlyInA);
        made.nodesB = std::move(onlyInB);
        return true;
    }

    const TraceCompareSettings& settings_;
    TraceComparison& found_;
    std::map<int, Sums> views_;
    std::vector<float> cpuMsA_, cpuMsB_, gpuMsA_, gpuMsB_;
};

// Returns a negative number if a comes before b, 0 if they are the same frame.
int orderOf(const ComparedFrame& a, const ComparedFrame& b, const TraceCompareSettings& settings) {
    if (settings.match == TraceMatch::Number) return a.number < b.number ? -1 : a.number > b.number;
    if (std::abs(a.timeS - b.timeS) <= settings.withinS) return 0;
    return a.timeS < b.timeS ? -1 : 1;
}

// Refuses times that do not ascend, because then no frame can be found by its time.
class AscendingTimes {
public:
    Result<void> check(const ComparedFrame& frame, const char* which) {
        if (!(frame.timeS >= lastS_))
            return badInput(
                fmt::format("trace {}: the time of frame {} is {} s after {} s; expected ascending "
                            "times. Frames can be matched by number instead",
                            which, frame.number, frame.timeS, lastS_));
        lastS_ = frame.timeS;
        return {};
    }

private:
    double lastS_ = -std::numeric_limits<double>::infinity();
};

}  // namespace

Result<TraceComparison> compareTraces(TraceFile& a, TraceFile& b, const TraceCompareSettings& settings,
                                      const std::function<bool()>& goOn) {
    TraceComparison found;
    found.match = settings.match;
    ComparedTrace traceA(a), traceB(b);
    Comparer comparer(settings, found);
    AscendingTimes timesA, timesB;
    TRY(traceA.begin());
    TRY(traceB.begin());
    const bool byTime = settings.match == TraceMatch::Time;
    const auto next = [&](ComparedTrace& trace, AscendingTimes& times, const char* which) -> Result<void> {
        const ComparedFrame* const frame = trace.front();
        if (byTime && frame) return times.check(*frame, which);
        return {};
    };
    TRY(next(traceA, timesA, "A"));
    TRY(next(traceB, timesB, "B"));
    while (traceA.front() || traceB.front()) {
        if (goOn && !goOn()) return cancelled();
        const ComparedFrame* const frameA = traceA.front();
        const ComparedFrame* const frameB = traceB.front();
        const int order = !frameA ? 1 : !frameB ? -1 : orderOf(*frameA, *frameB, settings);
        if (order == 0) comparer.add(*frameA, *frameB);
        found.framesOnlyInA += order < 0;
        found.framesOnlyInB += order > 0;
        if (order <= 0) {
            traceA.pop();
            TRY(next(traceA, timesA, "A"));
        }
        if (order >= 0) {
            traceB.pop();
            TRY(next(traceB, timesB, "B"));
        }
    }
    comparer.finish();
    found.descriptionA = traceA.description();
    found.descriptionB = traceB.description();
    found.problemA = traceA.end().problem;
    found.problemB = traceB.end().problem;
    found.isDamagedA = traceA.end().isDamaged;
    found.isDamagedB = traceB.end().isDamaged;
    return found;
}

}  // namespace planet
