// Names of nodes and numbers of frames that can be clicked, for all trace panels.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Draws a node's name. A click selects the node; a right click offers to copy the name.
void traceNodeLink(std::uint64_t id, const EditorView& view, Commands& commands,
                   ImGuiSelectableFlags flags = 0);
// Draws a frame's number. A click shows the frame.
void traceFrameLink(std::uint64_t frame, const EditorView& view, Commands& commands);

// Returns the view that the panels show; null: the frame is not read yet, or has no such view.
const TracedView* shownTraceView(const EditorView& view);
// Returns the description of the trace; none: the engine told none, or nothing is read.
std::optional<planet::TraceDescription> traceDescription(const EditorView& view);
// Returns a node's name.
std::string traceNodeName(const EditorView& view, std::uint64_t id);

// Draws why there is nothing to show, if there is nothing. Returns true if there is no view to show.
bool traceEmptyState(const EditorView& view);

}  // namespace worldy::ui
