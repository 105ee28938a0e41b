#include "planet/gl/device/gpu_clock.h"

#include <epoxy/gl.h>

#include "planet/spans/span_recorder.h"

namespace planet::gl {

namespace {

struct FollowedClock {
    std::optional<GpuClockReading> reading;
    std::int64_t readAtNs = 0;
    bool isKnown = false;  // that there are timestamps, or that there are none
};
// A thread that draws besides the window, such as a sweep's, follows no clock and records nothing in the window's lane.
thread_local FollowedClock followedClock;

// Is never destroyed, because contexts may end after the static objects of the program.
SpanLane& gpuLane() {
    static SpanLane& lane = *new SpanLane("GPU");
    return lane;
}

}  // namespace

std::optional<GpuClockReading> readGpuClock() {
    GLint bits = 0;
    glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
    if (bits == 0) return std::nullopt;
    std::optional<GpuClockReading> best;
    constexpr int tries = 4;
    for (int i = 0; i < tries; ++i) {
        const std::int64_t beforeNs = spanClockNs();
        GLint64 gpuNs = 0;
        glGetInteger64v(GL_TIMESTAMP, &gpuNs);
        const std::int64_t afterNs = spanClockNs();
        const std::int64_t errorNs = (afterNs - beforeNs + 1) / 2;
        if (!best || errorNs < best->errorNs) best = {beforeNs + (afterNs - beforeNs) / 2 - gpuNs, errorNs};
    }
    return best;
}

void followGpuClock() {
    if (!spansAreRecorded()) return;
    constexpr std::int64_t intervalNs = 1'000'000'000;
    const std::int64_t nowNs = spanClockNs();
    if (followedClock.isKnown && nowNs - followedClock.readAtNs < intervalNs) return;
    followedClock = {readGpuClock(), nowNs, true};
}

const std::optional<GpuClockReading>& gpuClock() {
    return followedClock.reading;
}

void recordGpuSpan(const char* name, std::uint64_t beginTimestamp, std::uint64_t endTimestamp) {
    if (!spansAreRecorded() || !followedClock.reading) return;
    const std::int64_t offsetNs = followedClock.reading->offsetNs;
    Span span;
    span.name = name;
    span.beginNs = static_cast<std::int64_t>(beginTimestamp) + offsetNs;
    span.endNs = static_cast<std::int64_t>(endTimestamp) + offsetNs;
    gpuLane().record(span);
}

}  // namespace planet::gl
