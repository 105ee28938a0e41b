// The window's frames: their clock, pausing and single steps, and what the last ones measured. Main thread.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

#include "app/scene/frame_stats.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy {

struct FrameController {
    bool paused = false;
    bool stepOnce = false;                // the next frame moves and chooses although frames are paused
    std::uint64_t frame = 0;              // run so far
    double timeS = 0;                     // since the window opened
    FrameStats stats;                     // smoothed
    std::deque<ui::FrameSample> history;  // of the last 10 s
    std::shared_ptr<const int>
        lastScene;  // identity of the frame before's, to see that another took its place
};

void execute(FrameController& frames, const ui::FrameCommand& command);

// Tells what the planet does in a frame.
struct FrameStep {
    bool goesOn = true;                // false: frames are paused, and the planet is only drawn
    double seconds = 0;                // that it goes on by
    std::optional<double> elapsedS{};  // in place of the clock's, for a single step
};
// Returns the frame's step; a single one is then done. secondsSinceLast: >= 0.
FrameStep takeStep(FrameController& frames, double secondsSinceLast);

// At a frame's end: keeps what it has measured.
void finishFrame(FrameController& frames, const FrameStats& stats);

}  // namespace worldy
