#include "planet/spans/span_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace planet {

// A ring with one producer, the thread of its lane, and one consumer, drainSpans().
class SpanRing {
public:
    explicit SpanRing(std::string laneName) : name(std::move(laneName)), spans_(spansPerLane) {}

    void push(const Span& span) noexcept {
        const std::uint64_t at = written_.load(std::memory_order_relaxed);
        if (at - read_.load(std::memory_order_acquire) == spansPerLane) {
            dropped_.fetch_add(1, std::memory_order_relaxed);
            return;
        }
        spans_[at % spansPerLane] = span;
        written_.store(at + 1, std::memory_order_release);
    }

    void drain(std::size_t lane, const std::function<void(const SpanBatch&)>& take) {
        const std::uint64_t end = written_.load(std::memory_order_acquire);
        std::uint64_t at = read_.load(std::memory_order_relaxed);
        std::uint64_t dropped = dropped_.exchange(0, std::memory_order_relaxed);
        while (at < end || dropped > 0) {
            const std::size_t first = at % spansPerLane;
            const std::size_t count = std::min<std::size_t>(end - at, spansPerLane - first);
            take({lane, name, std::span(spans_).subspan(first, count), std::exchange(dropped, 0)});
            at += count;
            read_.store(at, std::memory_order_release);
        }
    }

    const std::string name;
    bool isTaken = true;  // by a lane; guarded by the registry

private:
    std::vector<Span> spans_;
    std::atomic<std::uint64_t> written_{0};
    std::atomic<std::uint64_t> read_{0};
    std::atomic<std::uint64_t> dropped_{0};
};

namespace {

struct SpanRegistry {
    std::mutex mutex;
    std::vector<std::unique_ptr<SpanRing>> rings;  // are never removed
};

// Threads may end after the static objects of the program, so it is never destroyed.
SpanRegistry& spanRegistry() {
    static SpanRegistry& registry = *new SpanRegistry;
    return registry;
}

struct SpanThread {
    const char* name = nullptr;  // null: it records nothing
    int number = 0;
    std::optional<SpanLane> lane;  // from the first span on
    std::uint8_t depth = 0;

    SpanLane* takeLane() {
        if (!lane && name) lane.emplace(number > 0 ? fmt::format("{} {}", name, number) : std::string(name));
        return lane ? &*lane : nullptr;
    }
};

thread_local SpanThread spanThread;

}  // namespace

std::int64_t spanClockNs() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

void recordSpans(bool on) {
    detail::spansAreRecorded.store(on, std::memory_order_relaxed);
}

SpanLane::SpanLane(std::string_view name) {
    SpanRegistry& registry = spanRegistry();
    const std::lock_guard lock(registry.mutex);
    for (const auto& ring : registry.rings) {
        if (ring->isTaken || ring->name != name) continue;
        ring->isTaken = true;
        ring_ = ring.get();
        return;
    }
    ring_ = registry.rings.emplace_back(std::make_unique<SpanRing>(std::string(name))).get();
}

SpanLane::~SpanLane() {
    const std::lock_guard lock(spanRegistry().mutex);
    ring_->isTaken = false;
}

void SpanLane::record(const Span& span) noexcept {
    ring_->push(span);
}

void nameSpanThread(const char* name, int number) {
    spanThread.lane.reset();
    spanThread.name = name;
    spanThread.number = number;
}

void SpanScope::begin(const char* name, const BlockId* block) {
    lane_ = spanThread.takeLane();
    if (!lane_) return;
    span_.name = name;
    if (block) {
        span_.block = *block;
        span_.hasBlock = true;
    }
    span_.depth = spanThread.depth++;
    span_.beginNs = spanClockNs();
}

void SpanScope::end() {
    span_.endNs = spanClockNs();
    --spanThread.depth;
    lane_->record(span_);
}

void drainSpans(const std::function<void(const SpanBatch&)>& take) {
    SpanRegistry& registry = spanRegistry();
    const std::lock_guard lock(registry.mutex);
    for (std::size_t lane = 0; lane < registry.rings.size(); ++lane) registry.rings[lane]->drain(lane, take);
}

}  // namespace planet
