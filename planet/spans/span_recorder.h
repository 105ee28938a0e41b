// Records what threads do and when, as spans of a monotonic clock, for a timeline. Process-wide, like a log.
//
//     nameSpanThread("loader", 3);          // once per thread; a thread without a name records nothing
//     {
//         const SpanScope span("decode", block);
//         ...
//     }
//     drainSpans(take);                     // now and then, on one thread
//
// While spans are not recorded, which is the default, a scope costs one relaxed load. While they are, it costs two readings of
// the clock and a copy into a ring of its thread: no lock and no allocation, except in the first span of a thread. A full
// ring drops new spans and counts them.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "planet/sphere/block_id.h"

namespace planet {

// The monotonic clock of spans, nanoseconds since an arbitrary start. Any thread.
std::int64_t spanClockNs();

struct Span {
    const char* name = "";     // a string literal
    std::int64_t beginNs = 0;  // of spanClockNs()
    std::int64_t endNs = 0;
    BlockId block;  // that was worked on, if hasBlock
    bool hasBlock = false;
    std::uint8_t depth = 0;  // the number of spans of the same thread that enclose it
};

// Turns recording on or off, for all threads. Any thread.
void recordSpans(bool on);

namespace detail {
inline std::atomic<bool> spansAreRecorded{false};
}
// Returns whether spans are recorded. Any thread.
inline bool spansAreRecorded() {
    return detail::spansAreRecorded.load(std::memory_order_relaxed);
}

inline constexpr std::size_t spansPerLane = 4096;  // that wait for drainSpans()

class SpanRing;

// A sequence of spans with a name: that of a thread, or of a device such as the GPU. One thread at a time records into it. Its
// ring outlives it until the spans are drained, and is then given to a lane of the same name.
class SpanLane {
public:
    explicit SpanLane(std::string_view name);
    ~SpanLane();
    SpanLane(const SpanLane&) = delete;
    SpanLane& operator=(const SpanLane&) = delete;

    // Records a finished span, or drops and counts it if the ring is full.
    void record(const Span& span) noexcept;

private:
    SpanRing* ring_;  // owned by the registry of lanes, which is never destroyed
};

// Names the calling thread, for its lane: "loader 3", or "main" with the number 0. name: a string literal.
void nameSpanThread(const char* name, int number = 0);

// Records the time from its construction to its destruction in the lane of the calling thread. Spans of a thread nest.
class SpanScope {
public:
    explicit SpanScope(const char* name) {
        if (spansAreRecorded()) begin(name, nullptr);
    }
    SpanScope(const char* name, const BlockId& block) {
        if (spansAreRecorded()) begin(name, &block);
    }
    ~SpanScope() {
        if (lane_) end();
    }
    SpanScope(const SpanScope&) = delete;
    SpanScope& operator=(const SpanScope&) = delete;

private:
    void begin(const char* name, const BlockId* block);
    void end();

    SpanLane* lane_ = nullptr;  // null: not recorded
    Span span_;
};

// Finished spans of a lane.
struct SpanBatch {
    std::size_t lane = 0;  // the same number for the same ring; numbers begin at 0
    std::string_view name;
    std::span<const Span>
        spans;  // in the order of their ends, except in a lane that records them in another order
    std::uint64_t dropped = 0;  // since the last drain, because the ring was full
};

// Calls take(batch) for each lane with new spans; at most twice for a lane. One thread at a time.
void drainSpans(const std::function<void(const SpanBatch&)>& take);

}  // namespace planet
