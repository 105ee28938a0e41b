#include "ui/panels/trace/trace_nodes_panel.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "app/trace/traced_reasons.h"
#include "ui/kit/item_map.h"
#include "ui/kit/legend_rows.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/panels/trace/trace_links.h"

namespace worldy::ui {

namespace {

constexpr double wheelFactor = 1.35;

// Chooses a layout when another trace is shown.
void followTrace(const EditorView& view, const TracedView& shown, TraceNodesPanelState& state) {
    if (state.file == view.trace.file) return;
    state.file = view.trace.file;
    state.layout = suitingLayout(*view.trace.frame, shown);
    state.focus = {};
    state.camera = {};
}

void controls(const EditorView& view, TraceNodesPanelState& state) {
    int layout = static_cast<int>(state.layout);
    if (choiceIndex("Layout", layout, 0, "net of faces\0map\0tree\0space (3-D)\0",
                    "Where the nodes are: on the faces by their ids, on a map by their bounds (latitude and "
                    "longitude on a sphere, from above in a flat world), in rows by their levels below their "
                    "parents, or in three dimensions.")) {
        state.layout = static_cast<TraceLayout>(layout);
        state.focus = {};
    }
    choice("Colour by", state.colouring, TraceColouring::State,
           (std::string("state") + '\0' + "level" + '\0' + epsSymbol() + " / " + tauSymbol() + '\0' +
            "morph" + '\0')
               .c_str(),
           "Quantity shown by the colours: what the engine did with the node, its level, its error on screen "
           "relative to the tolerance, or how far it is morphed to its parent's surface.");
    if (button("Fit", "Shows everything. Double-clicking beside the nodes does the same.")) {
        state.focus = {};
        state.camera = {};
    }
    ImGui::SameLine();
    if (state.layout != TraceLayout::Space) {
        beginGrey(!view.trace.selected, "Select a node first.");
        if (button("Selected", "Brings the selected node into view.")) state.followed.reset();
        endGrey();
        return;
    }
    bool engine = !state.ownCamera;
    if (checkbox("Engine's camera", engine, false, "Looks through the camera of the traced view."))
        state.ownCamera = !engine;
}

std::string hitText(const EditorView& view, const TracedView& shown, const TracedNode& node) {
    std::string text = fmt::format("{}\n{}, level {}", traceNodeName(view, node.node.id),
                                   tracedPlaceText(node), node.node.level);
    if (!std::isnan(node.errorPx)) text += fmt::format(", {:.2f} px", node.errorPx);
    for (const std::string& reason : tracedReasons(*view.trace.frame, shown, node)) {
        text += "\n" + inFont(reason);
        break;
    }
    return text;
}

// Handles a click on a node and hovering. hit: the node under the pointer, or noTracedNode.
void nodeMouse(const EditorView& view, const TracedView& shown, std::size_t hit, TraceNodesPanelState& state,
               Commands& commands) {
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && hit == noTracedNode) {
        state.focus = {};
        state.camera = {};
    }
    if (state.dragging) return;
    const bool isClicked = ImGui::IsItemDeactivated();
    if (hit == noTracedNode) {
        if (isClicked) commands.push_back(SelectTraceNode{});
        return;
    }
    const TracedNode& node = shown.nodes[hit];
    tooltip(hitText(view, shown, node).c_str());
    if (!isClicked) return;
    state.followed = node.node.id;
    commands.push_back(SelectTraceNode{node.node.id});
}

// Follows a drag with the left button. Returns the pixels of this frame.
ImVec2 drag(TraceNodesPanelState& state, ImGuiMouseButton mouseButton) {
    if (ImGui::IsItemActivated()) state.dragging = false;
    if (!ImGui::IsItemActive() || !ImGui::IsMouseDragging(mouseButton)) return {0, 0};
    state.dragging = true;
    return dragDelta(mouseButton);
}

// ---- in a plane ----

void planMouse(const EditorView& view, const TracedView& shown, TraceNodesPanelState& state,
               Commands& commands) {
    const ImGuiIO& io = ImGui::GetIO();
    const PlanSize& size = state.plan.size;
    const ImVec2 moved = drag(state, ImGuiMouseButton_Left);
    if (moved.x != 0 || moved.y != 0)
        state.focus = movedBy(size, state.focus, state.area, static_cast<double>(moved.x),
                              static_cast<double>(moved.y));
    if (!ImGui::IsItemHovered()) return;
    ImGui::SetItemUsingMouseWheel();
    const auto x = static_cast<double>(io.MousePos.x), y = static_cast<double>(io.MousePos.y);
    if (io.MouseWheel != 0)
        state.focus = zoomedAbout(size, state.focus, state.area, x, y,
                                  std::pow(wheelFactor, static_cast<double>(io.MouseWheel)));
    const PlanPoint at = onPlan(placementOf(size, state.focus, state.area), x, y);
    nodeMouse(view, shown, nodeAt(state.plan, at), state, commands);
}

// Brings a node that was selected elsewhere into view, large enough to be seen.
void followSelected(const EditorView& view, const TracedView& shown, TraceNodesPanelState& state) {
    if (state.followed == view.trace.selected) return;
    for (const TraceShape& shape : state.plan.shapes) {
        if (shown.nodes[shape.node].node.id != view.trace.selected) continue;
        double left = 1e300, right = -1e300, top = 1e300, bottom = -1e300;
        for (std::size_t i = 0; i < shape.count; ++i) {
            left = std::min(left, shape.corners[i].x);
            right = std::max(right, shape.corners[i].x);
            top = std::min(top, shape.corners[i].y);
            bottom = std::max(bottom, shape.corners[i].y);
        }
        state.followed = view.trace.selected;
        const double side = std::max({right - left, bottom - top, 1e-12});
        state.focus =
            centredOn(state.plan.size, state.focus, state.area, {(left + right) / 2, (top + bottom) / 2},
                      side, 2.5 * static_cast<double>(ImGui::GetFontSize()));
        return;
    }
}

ImVec2 planPixel(const PlanPlacement& placement, const PlanPoint& point) {
    const PlanPoint at = onScreen(placement, point);
    // Far outside the window a float cannot resolve a pixel, and nothing is visible there.
    return {static_cast<float>(std::clamp(at.x, -1e5, 1e5)), static_cast<float>(std::clamp(at.y, -1e5, 1e5))};
}

void drawShape(ImDrawList& list, const PlanPlacement& placement, const TraceShape& shape,
               const TracedNode& node, const TraceNodesPanelState& state, double tauPx, bool isSelected) {
    std::array<ImVec2, 12> points;
    ImVec2 low{1e9f, 1e9f}, high{-1e9f, -1e9f};
    for (std::size_t i = 0; i < shape.count; ++i) {
        points[i] = planPixel(placement, shape.corners[i]);
        low = {std::min(low.x, points[i].x), std::min(low.y, points[i].y)};
        high = {std::max(high.x, points[i].x), std::max(high.y, points[i].y)};
    }
    const Rect& area = state.area;
    if (high.x < area.x || high.y < area.y || low.x > area.x + area.width || low.y > area.y + area.height)
        return;
    // A shape of a pixel or two cannot be seen, so it is drawn only if it is marked.
    const TraceMark mark = traceMark(node, tauPx);
    const float side = std::max(high.x - low.x, high.y - low.y);
    if (side < 1.5f && mark == TraceMark::None && !isSelected) return;
    const int count = static_cast<int>(shape.count);
    const float unit = ImGui::GetFontSize() / 13;
    const bool isDrawn = node.place == TracedPlace::Drawn;
    ImVec4 colour(0, 0, 0, 1);
    const glm::vec3 rgb = traceColour(state.colouring, node, tauPx);
    colour = {rgb.x, rgb.y, rgb.z, 1};
    const float opacity = isDrawn || state.colouring == TraceColouring::State ? 1.0f : 0.3f;
    list.AddConvexPolyFilled(points.data(), count, packed(colour, opacity));
    if (side >= 5) list.AddPolyline(points.data(), count, IM_COL32(0, 0, 0, 140), ImDrawFlags_Closed, 1);
    if (mark != TraceMark::None)
        list.AddPolyline(points.data(), count, packed(markColour(mark)), ImDrawFlags_Closed, 1.6f * unit);
    if (isSelected)
        list.AddPolyline(points.data(), count, packed(palette().warning), ImDrawFlags_Closed, 2.6f * unit);
}

void drawPlan(const EditorView& view, const TracedView& shown, const TraceNodesPanelState& state) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const PlanPlacement placement = placementOf(state.plan.size, state.focus, state.area);
    const TraceShape* selected = nullptr;
    for (const TraceShape& shape : state.plan.shapes) {
        const TracedNode& node = shown.nodes[shape.node];
        if (view.trace.selected == node.node.id) selected = &shape;
        drawShape(list, placement, shape, node, state, shown.tauPx, false);
    }
    if (selected)
        drawShape(list, placement, *selected, shown.nodes[selected->node], state, shown.tauPx, true);
    const bool isGlobe =
        view.trace.frame->description && view.trace.frame->description->shape == planet::TraceShape::Sphere;
    if (state.layout != TraceLayout::Map || !isGlobe || !shown.info) return;
    // The place below the camera.
    const glm::dvec3& eye = shown.info->eye;
    const ImVec2 at =
        planPixel(placement, {std::atan2(eye.y, eye.x) / 3.14159265358979 + 1,
                              0.5 - std::atan2(eye.z, std::hypot(eye.x, eye.y)) / 3.14159265358979});
    const float unit = ImGui::GetFontSize() / 13;
    list.AddCircle(at, 5 * unit, IM_COL32(0, 0, 0, 180), 0, 3.5f * unit);
    list.AddCircle(at, 5 * unit, IM_COL32(255, 255, 255, 255), 0, 1.5f * unit);
}

// ---- in space ----

void spaceMouse(const EditorView& view, const TracedView& shown, const std::vector<SpaceShape>& shapes,
                TraceNodesPanelState& state, Commands& commands) {
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 turnedPx = drag(state, ImGuiMouseButton_Left);
    if (state.ownCamera && (turnedPx.x != 0 || turnedPx.y != 0))
        state.camera = turned(state.camera, static_cast<double>(turnedPx.x), static_cast<double>(turnedPx.y));
    if (!ImGui::IsItemHovered()) return;
    ImGui::SetItemUsingMouseWheel();
    if (state.ownCamera && io.MouseWheel != 0)
        state.camera = nearer(state.camera, std::pow(wheelFactor, static_cast<double>(io.MouseWheel)));
    if (state.ownCamera && ImGui::IsMouseDragging(ImGuiMouseButton_Right)) {
        const ImVec2 by = io.MouseDelta;
        state.camera = moved(state.camera, state.area, static_cast<double>(by.x), static_cast<double>(by.y));
    }
    const glm::dvec2 at(static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y));
    nodeMouse(view, shown, nodeAt(shapes, at), state, commands);
}

ImVec2 asPixel(const glm::dvec2& at) {
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
}

void drawSpace(const EditorView& view, const TracedView& shown, const SpaceView& space,
               const std::vector<SpaceShape>& shapes, const TraceNodesPanelState& state) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float unit = ImGui::GetFontSize() / 13;
    double farthest = 0;
    for (const SpaceShape& shape : shapes) {
        const TracedNode& node = shown.nodes[shape.node];
        const glm::vec3 rgb = traceColour(state.colouring, node, shown.tauPx);
        const ImVec4 colour(rgb.x, rgb.y, rgb.z, 1);
        const bool isSelected = view.trace.selected == node.node.id;
        std::vector<ImVec2> hull;
        for (const glm::dvec2& at : shape.hull) hull.push_back(asPixel(at));
        if (!shape.isBehind && hull.size() >= 3)
            list.AddConvexPolyFilled(hull.data(), static_cast<int>(hull.size()),
                                     packed(colour, isSelected ? 0.4f : 0.13f));
        const TraceMark mark = traceMark(node, shown.tauPx);
        const ImU32 line = isSelected                ? packed(palette().warning)
                           : mark != TraceMark::None ? packed(markColour(mark))
                                                     : packed(colour, shape.isBehind ? 0.12f : 0.85f);
        const float width = isSelected ? 2.2f * unit : unit;
        for (const auto& edge : shape.edges) list.AddLine(asPixel(edge[0]), asPixel(edge[1]), line, width);
        if (shown.info) farthest = std::max(farthest, glm::length(node.node.bounds.centre - shown.info->eye));
    }
    // The engine's camera does not see its own frustum.
    for (const TracedView& each : view.trace.frame->views) {
        const bool isShown = each.view == shown.view;
        if (!each.info || (isShown && !state.ownCamera)) continue;
        for (const auto& edge : spaceFrustum(space, *each.info, 0.5 * farthest))
            list.AddLine(asPixel(edge[0]), asPixel(edge[1]), packed(palette().text, isShown ? 0.6f : 0.3f),
                         unit);
    }
}

void spacePicture(const EditorView& view, const TracedView& shown, TraceNodesPanelState& state,
                  Commands& commands) {
    if (!state.camera.isPlaced) state.camera = cameraAround(*view.trace.frame, shown);
    const bool isEngine = !state.ownCamera && shown.info;
    const SpaceView space =
        isEngine ? spaceView(*shown.info, state.area) : spaceView(state.camera, state.area);
    const std::vector<SpaceShape> shapes = spaceShapes(space, *view.trace.frame, shown, view.trace.selected);
    spaceMouse(view, shown, shapes, state, commands);
    drawSpace(view, shown, space, shapes, state);
    if (shapes.empty()) state.plan.problem = "No drawn node has bounds.";
}

void picture(const EditorView& view, const TracedView& shown, TraceNodesPanelState& state,
             Commands& commands) {
    ImVec2 size = ImGui::GetContentRegionAvail();
    size = {std::max(size.x, 20.0f), std::max(size.y, 6 * ImGui::GetFontSize())};
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 end(corner.x + size.x, corner.y + size.y);
    state.area = {corner.x, corner.y, size.x, size.y};
    ImGui::GetWindowDrawList()->AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.5f));
    ImGui::InvisibleButton("nodes", size);
    noteItem("Nodes");
    ImGui::PushClipRect(corner, end, true);
    if (state.layout == TraceLayout::Space) {
        state.plan = {};
        spacePicture(view, shown, state, commands);
    } else {
        state.plan = planOf(state.layout, *view.trace.frame, shown);
        followSelected(view, shown, state);
        planMouse(view, shown, state, commands);
        drawPlan(view, shown, state);
    }
    ImGui::PopClipRect();
    if (shown.nodes.empty()) state.plan.problem = "In this frame nothing is drawn, split or culled.";
    if (state.plan.problem.empty()) return;
    ImGui::SetCursorScreenPos({corner.x, corner.y + size.y / 2 - ImGui::GetFontSize()});
    wrappedText(state.plan.problem, palette().dim);
}

}  // namespace

void traceNodesPanel(const EditorView& view, TraceNodesPanelState& state, Commands& commands) {
    if (traceEmptyState(view)) return;
    const TracedView& shown = *shownTraceView(view);
    followTrace(view, shown, state);
    controls(view, state);
    legendRows(traceLegend(state.colouring, shown));
    picture(view, shown, state, commands);
}

}  // namespace worldy::ui
