// Places GPU timestamps on the clock of spans (planet/spans/span_recorder.h). Call it with a current context. One thread, that
// of the window, follows the GPU's clock; spans of other threads' contexts are not recorded.
#pragma once

#include <cstdint>
#include <optional>

namespace planet::gl {

// One reading of both clocks.
struct GpuClockReading {
    std::int64_t offsetNs = 0;  // spanClockNs() minus the GPU's timestamp
    std::int64_t errorNs = 0;  // the true offset differs by at most this: half the time that the reading took
};

// Reads both clocks, several times, and returns the most exact reading; nothing if the context has no timestamps.
std::optional<GpuClockReading> readGpuClock();

// Reads the clocks if spans are recorded and the last reading is more than a second old. Call it once per frame, always from the
// same thread.
void followGpuClock();
// Returns the calling thread's last reading of followGpuClock(); nothing before the first.
const std::optional<GpuClockReading>& gpuClock();

// Records the time between two timestamps of GL_TIMESTAMP in the lane "GPU", if spans are recorded and the calling thread
// follows the clock. name: a string literal.
void recordGpuSpan(const char* name, std::uint64_t beginTimestamp, std::uint64_t endTimestamp);

}  // namespace planet::gl
