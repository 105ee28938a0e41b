// The last seconds' frames as what plots want: times and values in step.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <vector>

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Seconds from a moment that stays the same for a thousand seconds: floats keep them apart, and plots that
// move on keep their shape.
inline std::vector<float> historyTimes(const std::deque<FrameSample>& history) {
    std::vector<float> times;
    times.reserve(history.size());
    const double originS = history.empty() ? 0 : std::floor(history.front().timeS / 1000) * 1000;
    for (const FrameSample& sample : history) times.push_back(static_cast<float>(sample.timeS - originS));
    return times;
}

// valueOf(const FrameStats&) gives a number.
template <class Value = float, class ValueOf>
std::vector<Value> historyValues(const std::deque<FrameSample>& history, const ValueOf& valueOf) {
    std::vector<Value> values;
    values.reserve(history.size());
    for (const FrameSample& sample : history) values.push_back(static_cast<Value>(valueOf(sample.stats)));
    return values;
}

// 0 where there are no frames.
inline double longestFrameMs(const std::deque<FrameSample>& history) {
    double longestMs = 0;
    for (const FrameSample& sample : history) longestMs = std::max(longestMs, sample.stats.frameMs);
    return longestMs;
}

}  // namespace worldy::ui
