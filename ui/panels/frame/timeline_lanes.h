// The lanes of the Timeline panel: frames, changes of chunks, and a lane for each thread and the GPU, under one axis of time.
#pragma once

#include <cstdint>
#include <optional>

#include "app/measure/frame_timeline.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct TimelineLanesState {
    // In view. Its length stays while the view follows the newest frame.
    TimeRange shown{0, 5'000'000'000};
    bool held = false;                     // the view stays; otherwise it follows the newest frame
    std::optional<TimeRange> marked{};     // not empty
    std::optional<std::uint64_t> frame{};  // selected, by number
    double movedPx = 0;                    // by the current drag, which also sets the next two
    bool marks = false;                    // it marks a range
    std::int64_t markFromNs = 0;
};

// Moves the view to the newest frame unless it is held. Call before the lanes are drawn.
void followNewest(const FrameTimeline& timeline, TimelineLanesState& state);
// Shows all that is kept.
void fitTimeline(const FrameTimeline& timeline, TimelineLanesState& state);
// Returns the range whose frame times are told: the marked one, or the one in view.
TimeRange toldRange(const TimelineLanesState& state);

// Fills the rest of the window.
void timelineLanes(const FrameTimeline& timeline, TimelineLanesState& state);

}  // namespace worldy::ui
