// The pop meter's last minutes over time. Each level change is a tick in the colour of its cause, as high as
// its jump. Above the ticks is a bar for each chunk that waits for its children.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planet/measure/pop_meter.h"
#include "ui/model/export_table.h"
#include "ui/model/figures.h"

namespace worldy::ui {

// Identifies an event; the meter has no two events with the same key.
struct PopKey {
    std::uint64_t frame = 0;
    planet::ChunkId chunk;

    bool operator==(const PopKey&) const = default;
};
inline PopKey keyOf(const planet::PopEvent& event) {
    return {event.frame, event.chunk};
}

// The top of the logarithmic axis of jumps, pixels; leastPopPx is its foot. Values outside are drawn at its ends.
inline constexpr double mostPopPx = 100;

struct PopTimelineState {
    double spanS = 60;   // time range shown, [0.5, planet::PopMeter::keptS]
    double behindS = 0;  // seconds from the right end to now
    double movedPx = 0;  // distance dragged so far
};

ImVec4 popColour(planet::PopCause cause);

// Returns the values of an event that are copied and saved.
std::vector<ExportField<planet::PopEvent>> popFields();

// Draws the timeline: the wheel zooms in time, dragging moves it, and keys do both. The selected event is marked.
// Returns the event that was clicked or reached by the keys.
std::optional<PopKey> popTimeline(const planet::PopMeter& meter, float lines,
                                  const std::optional<PopKey>& selected, PopTimelineState& state);

}  // namespace worldy::ui
