// The pop meter's last minutes over time: a tick for each switch of level, as high as it jumps, in the colour
// of its cause; above them a bar for each chunk that waits for its children.
#pragma once

#include <imgui.h>

#include <cstdint>
#include <optional>
#include <string>

#include "planet/measure/pop_meter.h"

namespace worldy::ui {

// Names an event; the meter keeps no two alike.
struct PopKey {
    std::uint64_t frame = 0;
    planet::ChunkId chunk;

    bool operator==(const PopKey&) const = default;
};
inline PopKey keyOf(const planet::PopEvent& event) {
    return {event.frame, event.chunk};
}

// The axis of jumps, pixels, logarithmic; what moves less or more stands at its end.
inline constexpr double leastPopPx = 0.001;
inline constexpr double mostPopPx = 100;

struct PopTimelineState {
    double spanS = 60;   // shown, [minSpanS, keptS]
    double behindS = 0;  // the right end, before now
    double movedPx = 0;  // while it is dragged
};

ImVec4 popColour(planet::PopCause cause);
std::string popPxText(double px);  // "under 0.001 px", "0.004 px", "1.3 px"

// Wheel: nearer in time; drag: back and forth. Returns the event that was clicked. Selected: lit.
std::optional<PopKey> popTimeline(const planet::PopMeter& meter, float lines,
                                  const std::optional<PopKey>& selected, PopTimelineState& state);

}  // namespace worldy::ui
