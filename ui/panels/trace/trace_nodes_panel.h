// The Trace nodes panel: what the engine drew, split and culled in the shown frame, on the net of faces, on a map, as a
// tree or in three dimensions.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/panels/trace/trace_colours.h"
#include "ui/panels/trace/trace_plan.h"
#include "ui/panels/trace/trace_space.h"

namespace worldy::ui {

struct TraceNodesPanelState {
    TraceLayout layout = TraceLayout::Net;
    TraceColouring colouring = TraceColouring::State;
    bool ownCamera = true;  // in three dimensions; false: the engine's camera
    PlanFocus focus;
    SpaceCamera camera;
    bool dragging = false;
    std::filesystem::path file;             // whose layout was chosen
    std::optional<std::uint64_t> followed;  // the selected node that was brought into view
    Rect area{};                            // of the picture, pixels
    TracePlan plan;                         // shown last
};

void traceNodesPanel(const EditorView& view, TraceNodesPanelState& state, Commands& commands);

}  // namespace worldy::ui
