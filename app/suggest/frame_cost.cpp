#include "app/suggest/frame_cost.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/stopwatch.h"
#include "app/base/text.h"
#include "app/scene/offscreen.h"
#include "app/scene/scene.h"
#include "planet/base/percentile.h"
#include "planet/base/result.h"
#include "planet/base/try.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"

namespace worldy {

namespace {

using planet::Result;

// Takes a number and the words after it from the front of a text.
std::optional<double> takeNumber(std::string_view& text, std::string_view after) {
    const auto skipSpaces = [&] { text.remove_prefix(std::min(text.find_first_not_of(' '), text.size())); };
    skipSpaces();
    const std::size_t end = std::min(text.find_first_not_of("0123456789.eE"), text.size());
    const std::optional<double> number = numberFromText(text.substr(0, end));
    text.remove_prefix(end);
    skipSpaces();
    if (!number || !text.starts_with(after)) return std::nullopt;
    text.remove_prefix(after.size());
    skipSpaces();
    return number;
}

}  // namespace

FrameCost fittedFrameCost(std::span<const TimedFrame> frames) {
    // Weights of 1 / ms^2 make the squares those of relative differences.
    double w = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const TimedFrame& frame : frames) {
        const double weight = 1 / (frame.ms * frame.ms), millions = 1e-6 * frame.triangles;
        w += weight;
        x += weight * millions;
        y += weight * frame.ms;
        xx += weight * millions * millions;
        xy += weight * millions * frame.ms;
    }
    FrameCost cost;
    cost.frames = frames.size();
    const double spread = w * xx - x * x;
    if (spread > 1e-12 * w * xx) cost.msPerMillion = (w * xy - x * y) / spread;
    cost.fixedMs = (y - cost.msPerMillion * x) / w;
    if (cost.msPerMillion < 0) {
        cost.msPerMillion = 0;
        cost.fixedMs = y / w;
    } else if (cost.fixedMs < 0) {
        cost.fixedMs = 0;
        cost.msPerMillion = xy / xx;
    }
    for (const TimedFrame& frame : frames)
        cost.worstOff = std::max(cost.worstOff, std::abs(cost.ms(frame.triangles) - frame.ms) / frame.ms);
    return cost;
}

FrameCost raisedAbove(FrameCost cost, std::span<const TimedFrame> frames) {
    double factor = 1;
    for (const TimedFrame& frame : frames) factor = std::max(factor, frame.ms / cost.ms(frame.triangles));
    cost.fixedMs *= factor;
    cost.msPerMillion *= factor;
    return cost;
}

Result<FrameCost> frameCostFromText(std::string_view text) {
    std::string_view rest = text;
    FrameCost cost;
    const std::optional<double> fixed = takeNumber(rest, "ms");
    const bool joins = rest.starts_with('+');
    if (joins) rest.remove_prefix(1);
    const std::optional<double> slope = joins ? takeNumber(rest, "ms per million triangles") : std::nullopt;
    if (!fixed || !slope || !rest.empty() || *fixed + *slope <= 0) {
        return planet::badInput(fmt::format(
            "\"{}\" is no cost of a frame; expected for example \"0.8 ms + 9 ms per million triangles\"",
            text));
    }
    cost.fixedMs = *fixed;
    cost.msPerMillion = *slope;
    cost.machine = "the given cost model";
    return cost;
}

std::string frameCostText(const FrameCost& cost) {
    return fmt::format("{:.3g} ms + {:.3g} ms per million triangles", cost.fixedMs, cost.msPerMillion);
}

Result<TimedFrame> timeFrame(Offscreen& offscreen, const planet::View& view, const ViewSettings& settings,
                             const std::function<bool()>& goOn) {
    constexpr int timed = 5;
    offscreen.scene.planet->tools().forgetSelections();
    const auto settle = [&](double timeoutS) {
        return settleScene(offscreen.scene, view, settings, timeoutS);
    };
    if (!settleWhile(settle, goOn)) return goOn() ? loadingTimedOut() : planet::cancelled();
    TRY(drawAndFinish(offscreen, view, settings));  // uploads, and is not timed
    std::vector<double> times;
    for (int i = 0; i < timed; ++i) {
        if (!goOn()) return planet::cancelled();
        const Stopwatch watch;
        stepScene(offscreen.scene, view, settings);
        TRY(drawAndFinish(offscreen, view, settings));
        times.push_back(watch.elapsedMs());
    }
    const auto triangles = static_cast<double>(offscreen.scene.planet->selection().counters.triangles());
    return TimedFrame{triangles, planet::percentileOf(times, 0.5)};
}

Result<FrameCost> measureFrameCost(Offscreen& offscreen, std::span<const planet::View> views,
                                   const ViewSettings& settings, const std::function<bool(double)>& goOn) {
    constexpr std::array<double, 3> factors = {0.5, 1, 3};
    std::vector<TimedFrame> frames;
    const std::size_t count = factors.size() * views.size();
    for (const planet::View& view : views) {
        for (const double factor : factors) {
            ViewSettings varied = settings;
            varied.lod.tauPx = std::clamp(factor * settings.lod.tauPx, smallestTauPx, largestTauPx);
            const auto share = static_cast<double>(frames.size()) / static_cast<double>(count);
            TRY_ASSIGN(const TimedFrame frame,
                       timeFrame(offscreen, view, varied, [&] { return goOn(share); }));
            frames.push_back(frame);
        }
    }
    FrameCost cost = raisedAbove(fittedFrameCost(frames), frames);
    cost.isMeasured = true;
    cost.machine = offscreen.context.renderer();
    return cost;
}

}  // namespace worldy
