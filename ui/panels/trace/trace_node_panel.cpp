#include "ui/panels/trace/trace_node_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/base/text.h"
#include "app/trace/traced_reasons.h"
#include "ui/kit/marked_box.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/panels/trace/trace_colours.h"
#include "ui/panels/trace/trace_links.h"

namespace worldy::ui {

namespace {

constexpr const char* notTold = "not told";

std::string lengthText(double units, const EditorView& view) {
    return tracedLengthText(units, traceDescription(view));
}

void reasonsBox(const TracedNode& node, const TracedView& shown, const std::vector<std::string>& reasons) {
    std::string text;
    for (const std::string& reason : reasons) text += (text.empty() ? "" : "\n") + inFont(reason);
    markedBox(text, packed(traceColour(TraceColouring::State, node, shown.tauPx)));
}

void screenRows(const TracedNode& node, const TracedView& shown, const EditorView& view) {
    if (!beginValues("screen")) return;
    valueRow("State", tracedPlaceText(node), "What the engine did with the node in this view and frame.");
    const bool isOver = node.place == TracedPlace::Drawn && node.errorPx > shown.tauPx;
    valueRow("Error on screen", std::isnan(node.errorPx) ? "unknown" : fmt::format("{:.3f} px", node.errorPx),
             node.isErrorTold ? "As the engine told it for this frame."
                              : "Computed from the node's error: error K' / D.",
             isOver ? &palette().bad : nullptr);
    valueRow("Tolerance", std::isnan(shown.tauPx) ? notTold : fmt::format("{:g} px", shown.tauPx),
             "The engine's setting \"tau\" for this view.");
    if (node.place == TracedPlace::Drawn)
        valueRow("Morph", fmt::format("{:.3f}", static_cast<double>(node.morph)),
                 "0: the node's own surface; 1: its parent's.");
    if (shown.info) {
        const double distance = planet::traceDistance(node.node.bounds, shown.info->eye);
        valueRow("Distance D", std::isnan(distance) ? notTold : lengthText(distance, view),
                 "From the eye to the bounds of the node; 0 inside.");
    }
    endValues();
}

void nodeRows(const TracedNode& node, const EditorView& view) {
    if (!beginValues("node")) return;
    const auto description = traceDescription(view);
    const bool isPixels = description && description->error == planet::TraceErrorUnit::Pixels;
    const planet::TraceNode& told = node.node;
    valueRow("Level", told.isTold ? fmt::format("{}", told.level) : notTold, "0 at a root.");
    valueRow("Error",
             !told.isTold ? notTold
             : isPixels   ? fmt::format("{:.4g} px", told.error)
                          : lengthText(told.error, view),
             "As the engine described the node.");
    valueRow("Triangles", told.triangles == 0 ? notTold : countText(static_cast<double>(told.triangles)),
             "When the node is drawn.");
    valueRow("Bytes", told.bytes == 0 ? notTold : bytesText(static_cast<double>(told.bytes)),
             "Of the node's data.");
    const planet::TraceBounds& bounds = told.bounds;
    valueRow("Bounds",
             bounds.shape == planet::TraceBoundsShape::None ? notTold
             : bounds.shape == planet::TraceBoundsShape::Sphere
                 ? "sphere, radius " + lengthText(bounds.radius, view)
                 : "box, diagonal " + lengthText(2 * glm::length(bounds.halfSize), view),
             "The volume that holds all that the node and its descendants draw.");
    valueRow("Children", node.children == 0 ? "none described" : fmt::format("{}", node.children),
             "That the engine described.");
    valueRow("Children missing", fmt::format("{}", node.missingChildren),
             "Described children whose data is not there.",
             node.missingChildren > 0 ? &palette().warning : nullptr);
    valueRow("Data", node.isResident ? "resident" : tracedDataText(node.data.data),
             "State of the node's data of the first kind. If the engine told no paging, all data counts as "
             "resident.");
    endValues();
}

void buttons(const TracedNode& node, const TracedView& shown, const EditorView& view, Commands& commands) {
    const auto parent = std::ranges::find(shown.nodes, node.parent, &TracedNode::index);
    beginGrey(parent == shown.nodes.end(),
              "The engine told no parent of this node, or it is not in this frame.");
    if (button("Parent", "Selects the parent.")) commands.push_back(SelectTraceNode{parent->node.id});
    endGrey();
    sameLineForButton("Copy id");
    if (button("Copy id", "Copies the node's name to the clipboard."))
        commands.push_back(CopyText{traceNodeName(view, node.node.id)});
    sameLineForButton("Worst node");
    beginGrey(std::isnan(shown.worstErrorPx), "No error is known in this frame.");
    if (button("Worst node", "Selects the drawn node with the largest error on screen."))
        commands.push_back(SelectTraceNode{shown.worstNode});
    endGrey();
}

}  // namespace

void traceNodePanel(const EditorView& view, Commands& commands) {
    if (traceEmptyState(view)) return;
    const TracedView& shown = *shownTraceView(view);
    if (!view.trace.selected) {
        emptyState("Click a node in the Trace nodes panel or its name in a list.");
        return;
    }
    wrappedText(traceNodeName(view, *view.trace.selected), palette().accent);
    const TracedNode* const node = shown.find(*view.trace.selected);
    if (!node) {
        wrappedText(fmt::format("In frame {}, view {} neither draws nor splits nor culls it, nor is it a "
                                "child of a node that it draws.",
                                view.trace.frame->frame.number, shown.view),
                    palette().dim);
        return;
    }
    buttons(*node, shown, view, commands);
    reasonsBox(*node, shown, tracedReasons(*view.trace.frame, shown, *node));
    screenRows(*node, shown, view);
    ImGui::Separator();
    nodeRows(*node, view);
}

}  // namespace worldy::ui
