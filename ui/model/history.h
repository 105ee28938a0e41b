// The frames of the last seconds as parallel vectors of times and values for plots.
#pragma once

#include <cmath>
#include <deque>
#include <vector>

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Returns times in seconds from an origin that changes every 1000 s: floats stay precise, and the shape of a
// moving plot stays the same.
inline std::vector<float> historyTimes(const std::deque<FrameSample>& history) {
    std::vector<float> times;
    times.reserve(history.size());
    const double originS = history.empty() ? 0 : std::floor(history.front().timeS / 1000) * 1000;
    for (const FrameSample& sample : history) times.push_back(static_cast<float>(sample.timeS - originS));
    return times;
}

// Returns valueOf(const FrameStats&) of each frame.
template <class Value = float, class ValueOf>
std::vector<Value> historyValues(const std::deque<FrameSample>& history, const ValueOf& valueOf) {
    std::vector<Value> values;
    values.reserve(history.size());
    for (const FrameSample& sample : history) values.push_back(static_cast<Value>(valueOf(sample.stats)));
    return values;
}

}  // namespace worldy::ui
