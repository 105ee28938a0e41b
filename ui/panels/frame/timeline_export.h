// The frames of the timeline as a table, to copy and save.
#pragma once

#include "app/measure/frame_timeline.h"
#include "ui/model/export_table.h"

namespace worldy::ui {

// Returns a row for each frame that begins in the range: its time, and how many chunks changed. The timeline must outlive it.
ExportTable timelineFramesTable(const FrameTimeline& timeline, const TimeRange& range);

}  // namespace worldy::ui
