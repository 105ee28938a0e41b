// The window's frames: their clock, pausing and single steps, and their statistics. Main thread.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "app/base/stopwatch.h"
#include "app/measure/timeline_recorder.h"
#include "app/scene/frame_stats.h"
#include "app/window/frame_pace.h"
#include "planet/sphere/view.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy {

// The statistics of frames whose time is known, which it is only when the next one begins.
struct FrameHistory {
    std::deque<ui::FrameSample> samples;  // of the last 10 s
    std::optional<ui::FrameSample> last;  // the last frame
};

struct FrameController {
    bool paused = false;
    bool fullSpeed = false;   // neither idles nor waits, whatever the preferences say
    bool stepOnce = false;    // the next frame moves and selects although frames are paused
    std::uint64_t frame = 0;  // number of frames run
    double timeS = 0;         // seconds since the window opened
    FrameStats stats;         // smoothed
    FrameHistory history;
    FramePace pace;
    Stopwatch clock{};         // for the frame limit
    FrameActivity activity{};  // of the last frame
    double restedS = 0;        // before this frame, seconds
    planet::View lastView;     // of the main picture in the last frame
    planet::View lastObserverView;
    std::shared_ptr<const int>
        lastScene;  // identity of the last frame's scene, to detect that another is shown
    TimelineRecorder recorder;
};

void execute(FrameController& frames, const ui::FrameCommand& command);

// The planet's part of a frame.
struct FrameStep {
    bool goesOn = true;                // false: frames are paused, and the planet is only drawn
    double seconds = 0;                // by which the planet advances
    std::optional<double> elapsedS{};  // for a single step, used instead of the clock's
};
// Returns the frame's step and clears a pending single step. secondsSinceLast: >= 0.
FrameStep takeStep(FrameController& frames, double secondsSinceLast);

// Returns what panels may read.
ui::FramesView framesViewOf(const FrameController& frames, int frameLimit);

// Stores the statistics at the end of a frame. stats.frameMs is of the frame before, which it completes in the history.
void finishFrame(FrameController& frames, const FrameStats& stats);

}  // namespace worldy
