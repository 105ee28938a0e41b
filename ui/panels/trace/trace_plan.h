// Lays the nodes of a trace out in a plane: by their ids on the net of faces, by their bounds on a map, or as a tree. Pure
// functions, no ImGui.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "app/trace/traced_frame.h"
#include "ui/model/plan_view.h"

namespace worldy::ui {

enum class TraceLayout : std::uint8_t {
    Net,    // by face, level, x and y
    Map,    // by bounds: latitude and longitude on a sphere, from above in a flat world
    Tree,   // by parents: a row a level
    Space,  // in three dimensions (trace_space.h)
};

// A convex polygon.
struct TraceShape {
    std::size_t node = 0;  // place in TracedView::nodes
    std::array<PlanPoint, 12> corners{};
    std::size_t count = 0;

    bool holds(const PlanPoint& point) const;
};

struct TracePlan {
    PlanSize size{};
    std::vector<TraceShape> shapes{};  // in drawing order: coarse nodes first
    std::string problem{};             // why there is nothing to show
};

// layout: not Space.
TracePlan planOf(TraceLayout layout, const TracedFrame& frame, const TracedView& view);

// Returns the node whose shape was drawn last at a point; none: noTracedNode.
inline constexpr std::size_t noTracedNode = static_cast<std::size_t>(-1);
std::size_t nodeAt(const TracePlan& plan, const PlanPoint& point);

// Returns the layout that suits a trace best.
TraceLayout suitingLayout(const TracedFrame& frame, const TracedView& view);

}  // namespace worldy::ui
