// The time of a frame as a function of its triangles. All chunks of a planet have as many triangles, so those stand for
// chunks too.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "app/settings/view_settings.h"
#include "planet/base/result.h"
#include "planet/sphere/view.h"

namespace worldy {

struct Offscreen;

struct FrameCost {
    double fixedMs = 0;       // >= 0
    double msPerMillion = 0;  // triangles, >= 0
    bool isMeasured = false;  // by drawing frames here; otherwise it was given
    std::string machine{};    // whose times these are, for users
    std::size_t frames = 0;   // that it was fitted to
    double worstOff = 0;      // largest difference of a fitted frame's time, as a share of it

    double ms(double triangles) const { return fixedMs + msPerMillion * 1e-6 * triangles; }
};

struct TimedFrame {
    double triangles = 0;
    double ms = 0;
};
// Fits by least squares of relative differences; neither part is negative. frames: at least two, with times above 0. Times
// that do not grow with the triangles give their mean. Pure.
FrameCost fittedFrameCost(std::span<const TimedFrame> frames);
// Returns the cost times the factor that no frame exceeds, at least 1. Pure.
FrameCost raisedAbove(FrameCost cost, std::span<const TimedFrame> frames);

// Reads "0.8 ms + 9 ms per million triangles". The Error says what is wrong and what is right. Pure.
planet::Result<FrameCost> frameCostFromText(std::string_view text);
// Returns such a text.
std::string frameCostText(const FrameCost& cost);

// Returns the time of one settled frame, ms: the median of several that are selected and drawn until the GPU has finished.
// Needs the current context of the scene.
planet::Result<TimedFrame> timeFrame(Offscreen& offscreen, const planet::View& view,
                                     const ViewSettings& settings, const std::function<bool()>& goOn);

// Measures the views with several tolerances around that of the settings, fits, and raises the cost above all of them. goOn:
// false cancels.
planet::Result<FrameCost> measureFrameCost(Offscreen& offscreen, std::span<const planet::View> views,
                                           const ViewSettings& settings,
                                           const std::function<bool(double share)>& goOn);

}  // namespace worldy
