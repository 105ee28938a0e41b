// The Timeline panel: the last minutes of frames, threads and the GPU as lanes, the percentiles of the frame times of a range,
// and the chunks that changed in a frame.
#pragma once

#include "ui/panels/frame/timeline_lanes.h"

namespace worldy::ui {

struct TimelinePanelState {
    TimelineLanesState lanes;
};

void timelinePanel(const EditorView& view, TimelinePanelState& state, Commands& commands);

}  // namespace worldy::ui
