#include "app/measure/frame_timeline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

namespace worldy {

namespace {

constexpr std::size_t mostRows = 8;  // per lane; no thread nests deeper

bool fits(const TimelineRow& row, const TimelineRow::const_iterator& after, const planet::Span& span) {
    return (after == row.begin() || std::prev(after)->endNs <= span.beginNs) &&
           (after == row.end() || span.endNs <= after->beginNs);
}

// Returns the first span of a row that begins after a time. Nearly all spans arrive in order.
TimelineRow::const_iterator firstAfter(const TimelineRow& row, std::int64_t ns) {
    if (row.empty() || row.back().beginNs <= ns) return row.end();
    return std::ranges::upper_bound(row, ns, {}, &planet::Span::beginNs);
}

// Sorts "loader 2" and "loader 2 (2)" before "loader 10".
std::tuple<int, std::string, int, std::string> laneRank(const std::string& name) {
    const std::size_t digit = std::min(name.find_first_of("0123456789"), name.size());
    int number = 0;
    std::from_chars(name.data() + digit, name.data() + name.size(), number);
    return {name == "main" ? 0 : name == "GPU" ? 1 : 2, name.substr(0, digit), number, name};
}

}  // namespace

void FrameTimeline::noteOrigin(std::int64_t ns) {
    originNs_ = std::min(originNs_.value_or(ns), ns);
}

void FrameTimeline::beginFrame(std::uint64_t number, std::int64_t nowNs, std::int64_t lastEndNs) {
    noteOrigin(nowNs);
    if (begun_) {
        begun_->endNs = lastEndNs;
        frames_.push_back(*begun_);
    }
    begun_ = {number, nowNs, nowNs};
    trim();
}

void FrameTimeline::add(ChunkChangeKind kind, const planet::BlockId& block, double value) {
    if (begun_) changes_.push_back({begun_->number, kind, block, static_cast<float>(value)});
}

void FrameTimeline::add(const planet::SpanBatch& batch) {
    if (lanes_.size() <= batch.lane) lanes_.resize(batch.lane + 1);
    TimelineLane& lane = lanes_[batch.lane];
    if (lane.name.empty()) {
        // Two planets have loaders of the same numbers.
        const auto isTaken = [&](const std::string& name) {
            return std::ranges::any_of(lanes_, [&](const TimelineLane& other) { return other.name == name; });
        };
        std::string name(batch.name);
        for (int copy = 2; isTaken(name); ++copy) name = fmt::format("{} ({})", batch.name, copy);
        lane.name = std::move(name);
    }
    lane.dropped += batch.dropped;
    for (const planet::Span& span : batch.spans) insert(lane, span);
    trim();
}

void FrameTimeline::insert(TimelineLane& lane, const planet::Span& span) {
    noteOrigin(span.beginNs);
    for (std::size_t row = span.depth; row < mostRows; ++row) {
        if (lane.rows.size() <= row) lane.rows.resize(row + 1);
        const auto after = firstAfter(lane.rows[row], span.beginNs);
        if (!fits(lane.rows[row], after, span)) continue;
        lane.rows[row].insert(after, span);
        lane.nests = lane.nests && row == span.depth;
        ++spanCount_;
        return;
    }
    ++lane.dropped;
}

// Discards the oldest spans of all lanes, and the oldest frames with their changes.
void FrameTimeline::trim() {
    const auto noteDiscarded = [&](std::int64_t endNs) {
        completeFromNs_ = std::max(completeFromNs_.value_or(endNs), endNs);
    };
    while (spanCount_ > limits_.spans) {
        TimelineRow* oldest = nullptr;
        for (TimelineLane& lane : lanes_)
            for (TimelineRow& row : lane.rows)
                if (!row.empty() && (!oldest || row.front().endNs < oldest->front().endNs)) oldest = &row;
        noteDiscarded(oldest->front().endNs);
        oldest->pop_front();
        --spanCount_;
        ++discarded_;
    }
    while (frames_.size() > limits_.frames || (changes_.size() > limits_.changes && !frames_.empty())) {
        noteDiscarded(frames_.front().endNs);
        while (!changes_.empty() && changes_.front().frame <= frames_.front().number) changes_.pop_front();
        frames_.pop_front();
    }
}

TimeRange FrameTimeline::extent() const {
    TimeRange all{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()};
    const auto include = [&](std::int64_t beginNs, std::int64_t endNs) {
        all = {std::min(all.fromNs, beginNs), std::max(all.toNs, endNs)};
    };
    if (!frames_.empty()) include(frames_.front().beginNs, frames_.back().endNs);
    for (const TimelineLane& lane : lanes_)
        for (const TimelineRow& row : lane.rows)
            if (!row.empty()) include(row.front().beginNs, row.back().endNs);
    return all.fromNs <= all.toNs ? all : TimeRange{};
}

std::uint64_t FrameTimeline::dropped() const {
    std::uint64_t sum = 0;
    for (const TimelineLane& lane : lanes_) sum += lane.dropped;
    return sum;
}

std::pair<std::size_t, std::size_t> FrameTimeline::framesIn(const TimeRange& range) const {
    const auto first = std::ranges::upper_bound(frames_, range.fromNs, {}, &TimelineFrame::endNs);
    const auto last = std::ranges::lower_bound(frames_, range.toNs, {}, &TimelineFrame::beginNs);
    return {static_cast<std::size_t>(first - frames_.begin()),
            static_cast<std::size_t>(std::max(first, last) - frames_.begin())};
}

std::pair<std::size_t, std::size_t> FrameTimeline::changesIn(std::uint64_t firstFrame,
                                                             std::uint64_t lastFrame) const {
    const auto first = std::ranges::lower_bound(changes_, firstFrame, {}, &ChunkChange::frame);
    const auto last = std::ranges::upper_bound(changes_, lastFrame, {}, &ChunkChange::frame);
    return {static_cast<std::size_t>(first - changes_.begin()),
            static_cast<std::size_t>(std::max(first, last) - changes_.begin())};
}

FrameTimes FrameTimeline::frameTimesIn(const TimeRange& range) const {
    std::vector<double> times;
    const auto [first, last] = framesIn(range);
    for (std::size_t i = first; i < last; ++i)
        if (frames_[i].beginNs >= range.fromNs) times.push_back(frames_[i].ms());
    return frameTimesOf(std::move(times));
}

std::vector<std::size_t> laneOrder(const FrameTimeline& timeline) {
    std::vector<std::size_t> order;
    const std::vector<TimelineLane>& lanes = timeline.lanes();
    for (std::size_t i = 0; i < lanes.size(); ++i)
        if (!lanes[i].rows.empty()) order.push_back(i);
    std::ranges::sort(order, {}, [&](std::size_t i) { return laneRank(lanes[i].name); });
    return order;
}

const char* chunkChangeName(ChunkChangeKind kind) {
    constexpr std::array<const char*, chunkChangeKinds> names = {"came",   "split",   "merged",
                                                                 "popped", "evicted", "failed"};
    return names[static_cast<std::size_t>(kind)];
}

}  // namespace worldy
