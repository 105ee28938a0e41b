#include "ui/panels/trace/trace_links.h"

#include <fmt/format.h>

#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

void traceNodeLink(std::uint64_t id, const EditorView& view, Commands& commands, ImGuiSelectableFlags flags) {
    const std::string name = traceNodeName(view, id);
    highlightHits(name);
    if (ImGui::Selectable(name.c_str(), view.trace.selected == id, flags))
        commands.push_back(SelectTraceNode{id});
    noteItem(name);
    if (!ImGui::BeginPopupContextItem()) return;
    if (ImGui::MenuItem("Select")) commands.push_back(SelectTraceNode{id});
    if (ImGui::MenuItem("Copy id")) commands.push_back(CopyText{name});
    ImGui::EndPopup();
}

void traceFrameLink(std::uint64_t frame, const EditorView& view, Commands& commands) {
    const std::string name = fmt::format("{}", frame);
    const bool isShown = view.trace.frame && view.trace.frame->frame.number == frame;
    if (ImGui::Selectable(name.c_str(), isShown)) commands.push_back(ShowTraceFrame{frame});
}

const TracedView* shownTraceView(const EditorView& view) {
    return view.trace.frame ? view.trace.frame->view(view.trace.view) : nullptr;
}

std::optional<planet::TraceDescription> traceDescription(const EditorView& view) {
    if (view.trace.frame && view.trace.frame->description) return view.trace.frame->description;
    return view.trace.history ? view.trace.history->report.description : std::nullopt;
}

std::string traceNodeName(const EditorView& view, std::uint64_t id) {
    return tracedName(traceDescription(view), id);
}

bool traceEmptyState(const EditorView& view) {
    if (shownTraceView(view)) return false;
    const TraceView& trace = view.trace;
    if (trace.file.empty())
        emptyState(trace.link.isOn
                       ? "Waiting for an engine. The Trace panel says what the connection does."
                       : "No trace is open. The Trace panel opens a file or attaches to an engine.");
    else if (!trace.problem.empty() && !trace.frame)
        emptyState("The trace cannot be read. The Trace panel says why.");
    else if (!trace.frame)
        emptyState("Reading the trace...");
    else
        emptyState(fmt::format("Frame {} has no view {}.", trace.frame->frame.number, trace.view).c_str());
    return true;
}

}  // namespace worldy::ui
