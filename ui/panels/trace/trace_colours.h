// The colours of a trace's nodes, and their legends. Pure functions, no ImGui.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "app/trace/traced_frame.h"
#include "ui/model/overlay_legend.h"

namespace worldy::ui {

enum class TraceColouring : std::uint8_t { State, Level, Error, Morph };

// sRGB. Nodes without what is asked for are grey.
glm::vec3 traceColour(TraceColouring by, const TracedNode& node, double tauPx);
Legend traceLegend(TraceColouring by, const TracedView& view);

// The mark of a node; if several apply, the first one of this list.
enum class TraceMark : std::uint8_t { None, Twice, Starved, Switched };
TraceMark traceMark(const TracedNode& node, double tauPx);
glm::vec3 markColour(TraceMark mark);
const char* markText(TraceMark mark);

}  // namespace worldy::ui
