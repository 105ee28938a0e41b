#include "app/editor/frame_controller.h"

#include <utility>

#include "app/session/overloaded.h"
#include "planet/gl/device/gpu_clock.h"

namespace worldy {

namespace {

constexpr double historyS = 10;

}  // namespace

void execute(FrameController& frames, const ui::FrameCommand& command) {
    std::visit(Overloaded{
                   [&](const ui::PauseFrames& pause) { frames.paused = pause.paused; },
                   [&](const ui::StepFrame&) { frames.paused = frames.stepOnce = true; },
                   [&](const ui::DrawAtFullSpeed& draw) { frames.fullSpeed = draw.on; },
                   [&](const ui::RecordTimeline& record) { frames.recorder.turn(record.on); },
               },
               command);
}

FrameStep takeStep(FrameController& frames, double secondsSinceLast) {
    const bool single = std::exchange(frames.stepOnce, false);
    if (!frames.paused) return {true, secondsSinceLast, std::nullopt};
    constexpr double stepS = 1.0 / 60;
    return {single, stepS, stepS};
}

ui::FramesView framesViewOf(const FrameController& frames, int frameLimit) {
    const auto& gpuClock = planet::gl::gpuClock();
    return {.stats = frames.stats,
            .history = frames.history.samples,
            .timeS = frames.timeS,
            .paused = frames.paused,
            .drawnBecause = frames.activity.reason,
            .fullSpeed = frames.fullSpeed,
            .limit = frameLimit,
            .timeline = &frames.recorder.timeline(),
            .recordsTimeline = frames.recorder.isOn(),
            .gpuClockErrorNs = gpuClock ? std::optional(gpuClock->errorNs) : std::nullopt};
}

void finishFrame(FrameController& frames, const FrameStats& stats) {
    frames.stats = smoothed(frames.stats, stats);
    auto& [samples, last] = frames.history;
    if (last) {
        last->stats.frameMs = stats.frameMs;
        samples.push_back(*last);
    }
    last = {frames.timeS, stats};
    while (!samples.empty() && samples.front().timeS < frames.timeS - historyS) samples.pop_front();
}

}  // namespace worldy
