// The distribution of frame times, for the Frame and Timeline panels. A frame's time is the time from its start to the start of
// the next, including the wait for the monitor, but not a rest while nothing changes. Pure function, any thread.
#pragma once

#include <cstddef>
#include <vector>

#include "planet/base/percentile.h"

namespace worldy {

struct FrameTimes {
    std::size_t frames = 0;
    // Percentiles by nearest rank, so each is the time of a frame (planet/base/percentile.h). 0 without frames.
    double p50Ms = 0;
    double p95Ms = 0;
    double p99Ms = 0;
    double maxMs = 0;
};

inline FrameTimes frameTimesOf(std::vector<double> frameMs) {
    return {frameMs.size(), planet::percentileOf(frameMs, 0.5), planet::percentileOf(frameMs, 0.95),
            planet::percentileOf(frameMs, 0.99), planet::percentileOf(frameMs, 1)};
}

}  // namespace worldy
