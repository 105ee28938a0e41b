// The last minutes of frames: when each began and ended, what the threads and the GPU did meanwhile (planet/spans), and which
// chunks changed in it. Memory is bounded: the oldest are discarded and counted. One thread.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/measure/frame_times.h"
#include "planet/spans/span_recorder.h"

namespace worldy {

// A half-open range of planet::spanClockNs(), nanoseconds.
struct TimeRange {
    std::int64_t fromNs = 0;
    std::int64_t toNs = 0;

    std::int64_t lengthNs() const { return toNs - fromNs; }
    bool operator==(const TimeRange&) const = default;
};

struct TimelineFrame {
    std::uint64_t number = 0;
    std::int64_t beginNs = 0;
    std::int64_t endNs = 0;  // the start of the next frame, or of a rest before it

    double ms() const { return static_cast<double>(endNs - beginNs) * 1e-6; }
};

enum class ChunkChangeKind : std::uint8_t { Came, Split, Merged, Popped, Evicted, Failed };
inline constexpr std::size_t chunkChangeKinds = 6;

// Something that happened to a chunk, or to a block of four, in a frame.
struct ChunkChange {
    std::uint64_t frame = 0;
    ChunkChangeKind kind = ChunkChangeKind::Came;
    // The parent whose four children came, were evicted or failed; otherwise the chunk.
    planet::BlockId block;
    // Came, Failed: reading and decoding, ms. Popped: the jump, pixels. Otherwise 0.
    float value = 0;
};

// Spans that do not overlap, in order.
using TimelineRow = std::deque<planet::Span>;

struct TimelineLane {
    std::string name;  // "main", "GPU", "loader 1"
    // Row n holds the spans that n others enclose. Spans that overlap without being nested, as measurements of a GPU may, are in
    // the first row with room for them.
    std::vector<TimelineRow> rows;
    bool nests = true;          // false: spans overlapped
    std::uint64_t dropped = 0;  // spans that never got here, because a ring or all rows were full
};

// The most that is kept. Full, it takes about 40 MB.
struct TimelineLimits {
    std::size_t spans = 500'000;
    std::size_t frames = 100'000;
    std::size_t changes = 200'000;
};

class FrameTimeline {
public:
    explicit FrameTimeline(const TimelineLimits& limits = {}) : limits_(limits) {}

    // Begins a frame at nowNs. The frame before it, if it was begun since the last interrupt(), ended at lastEndNs.
    void beginFrame(std::uint64_t number, std::int64_t nowNs, std::int64_t lastEndNs);
    // Forgets the frame that has begun: the next one does not follow it.
    void interrupt() { begun_.reset(); }
    // Adds a change in the frame that has begun; ignored if none has.
    void add(ChunkChangeKind kind, const planet::BlockId& block, double value = 0);
    void add(const planet::SpanBatch& batch);
    // Counts changes that the source of changes no longer knew.
    void missChanges(std::uint64_t changes) { changesMissed_ += changes; }

    // The frames that have ended, oldest first.
    const std::deque<TimelineFrame>& frames() const { return frames_; }
    // Oldest first; those of the frame that has begun are the last.
    const std::deque<ChunkChange>& changes() const { return changes_; }
    // By number of the recorder's lanes; lanes without spans have no rows.
    const std::vector<TimelineLane>& lanes() const { return lanes_; }

    // Everything kept: from the earliest begin to the latest end. Empty without frames and spans.
    TimeRange extent() const;
    // Before this, something has been discarded.
    std::int64_t completeFromNs() const { return completeFromNs_.value_or(extent().fromNs); }
    // The begin of the recording, for readable times; does not change when the oldest are discarded.
    std::int64_t originNs() const { return originNs_.value_or(0); }
    std::size_t spanCount() const { return spanCount_; }
    std::uint64_t discarded() const { return discarded_; }  // spans, because there were newer ones
    std::uint64_t dropped() const;                          // spans that were not recorded, of all lanes
    std::uint64_t changesMissed() const { return changesMissed_; }

    // Returns the indices [first, last) of the frames that overlap a range.
    std::pair<std::size_t, std::size_t> framesIn(const TimeRange& range) const;
    // Returns the indices [first, last) of the changes in frames [firstFrame, lastFrame], by number.
    std::pair<std::size_t, std::size_t> changesIn(std::uint64_t firstFrame, std::uint64_t lastFrame) const;
    // Returns the times of the frames that begin in a range.
    FrameTimes frameTimesIn(const TimeRange& range) const;

private:
    void insert(TimelineLane& lane, const planet::Span& span);
    void trim();
    void noteOrigin(std::int64_t ns);

    TimelineLimits limits_;
    std::deque<TimelineFrame> frames_;
    std::deque<ChunkChange> changes_;
    std::vector<TimelineLane> lanes_;
    std::optional<TimelineFrame> begun_;
    std::optional<std::int64_t> originNs_;
    std::optional<std::int64_t> completeFromNs_;
    std::size_t spanCount_ = 0;
    std::uint64_t discarded_ = 0;
    std::uint64_t changesMissed_ = 0;
};

// Returns the numbers of the lanes with spans in the order to show them: main, GPU, then by name and number.
std::vector<std::size_t> laneOrder(const FrameTimeline& timeline);

// "came", "split", ...
const char* chunkChangeName(ChunkChangeKind kind);

}  // namespace worldy
