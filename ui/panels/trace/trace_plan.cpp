#include "ui/panels/trace/trace_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <unordered_map>

#include "planet/trace/trace_quadtree.h"
#include "ui/model/net_cells.h"

namespace worldy::ui {

namespace {

using planet::TraceBounds;
using planet::TraceBoundsShape;

constexpr double turn = 2 * std::numbers::pi;
constexpr double largeRad = 0.6;

bool isSphere(const TracedFrame& frame) {
    return frame.description && frame.description->shape == planet::TraceShape::Sphere;
}

bool hasQuadtreeIds(const TracedFrame& frame) {
    return frame.description && frame.description->ids == planet::TraceIds::Quadtree;
}

// Returns the places of a view's nodes, coarse ones first.
std::vector<std::size_t> coarseFirst(const TracedView& view) {
    std::vector<std::size_t> order(view.nodes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return view.nodes[i].node.level; });
    return order;
}

TraceShape rectangle(std::size_t node, double x, double y, double width, double height) {
    TraceShape shape{.node = node};
    shape.corners = {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}};
    shape.count = 4;
    return shape;
}

// ---- by bounds ----

struct MapPoint {
    double longitudeRad = 0, latitudeRad = 0;
};

MapPoint mapPoint(const glm::dvec3& place) {
    return {std::atan2(place.y, place.x), std::atan2(place.z, std::hypot(place.x, place.y))};
}

// Returns the corners of the middle of a box, or a ring around the middle of a sphere.
std::vector<glm::dvec3> outlineOf(const TraceBounds& bounds) {
    std::vector<glm::dvec3> outline;
    if (bounds.shape == TraceBoundsShape::Box) {
        const glm::dvec3 right = bounds.axes[0] * bounds.halfSize.x, up = bounds.axes[1] * bounds.halfSize.y;
        for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            outline.push_back(bounds.centre + static_cast<double>(x) * right + static_cast<double>(y) * up);
        return outline;
    }
    // A sphere in space is seen as a ring around the direction to its middle.
    const double distance = glm::length(bounds.centre);
    const glm::dvec3 away = distance > 0 ? bounds.centre / distance : glm::dvec3(0, 0, 1);
    const glm::dvec3 helper = std::abs(away.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(helper, away)), up = glm::cross(away, right);
    constexpr int corners = 12;
    for (int i = 0; i < corners; ++i) {
        const double angle = turn * i / corners;
        outline.push_back(bounds.centre + bounds.radius * (std::cos(angle) * right + std::sin(angle) * up));
    }
    return outline;
}

// Appends a shape on the map of a sphere, x in [0, 2] from 180 degrees west, y in [0, 1] from the north pole. A shape across
// the date line is there twice.
void appendOnGlobe(std::size_t node, const TraceBounds& bounds, bool isDrawn,
                   std::vector<TraceShape>& shapes) {
    const MapPoint middle = mapPoint(bounds.centre);
    TraceShape shape{.node = node};
    double west = 1e9, east = -1e9, south = 1e9, north = -1e9;
    for (const glm::dvec3& corner : outlineOf(bounds)) {
        MapPoint at = mapPoint(corner);
        at.longitudeRad += turn * std::round((middle.longitudeRad - at.longitudeRad) / turn);
        west = std::min(west, at.longitudeRad);
        east = std::max(east, at.longitudeRad);
        south = std::min(south, at.latitudeRad);
        north = std::max(north, at.latitudeRad);
        shape.corners[shape.count++] = {at.longitudeRad / std::numbers::pi + 1,
                                        0.5 - at.latitudeRad / std::numbers::pi};
    }
    const double reachRad = std::max(north - middle.latitudeRad, middle.latitudeRad - south);
    // The corners of a box that holds a large part of a sphere say little of its outline.
    if (std::max(reachRad, (east - west) / 2) > largeRad && !isDrawn) return;
    const bool hasPole =
        std::abs(middle.latitudeRad) + reachRad > std::numbers::pi / 2 || east - west > 0.9 * turn;
    if (hasPole) {
        const bool isNorth = middle.latitudeRad > 0;
        const double edge = 0.5 - (isNorth ? south : north) / std::numbers::pi;
        shape = isNorth ? rectangle(node, 0, 0, 2, edge) : rectangle(node, 0, edge, 2, 1 - edge);
    }
    shapes.push_back(shape);
    const double shift = west < -std::numbers::pi ? 2 : east > std::numbers::pi ? -2 : 0;
    if (hasPole || shift == 0) return;
    for (std::size_t i = 0; i < shape.count; ++i) shape.corners[i].x += shift;
    shapes.push_back(shape);
}

// Returns which axis of a flat world is up: the one to which the third axes of the boxes are nearest, or else the one along
// which the nodes are spread least.
int upAxis(const TracedView& view) {
    glm::dvec3 boxes{0, 0, 0}, low{1e300}, high{-1e300};
    for (const TracedNode& node : view.nodes) {
        const TraceBounds& bounds = node.node.bounds;
        if (bounds.shape == TraceBoundsShape::None) continue;
        if (bounds.shape == TraceBoundsShape::Box) boxes += glm::abs(bounds.axes[2]);
        low = glm::min(low, bounds.centre);
        high = glm::max(high, bounds.centre);
    }
    const glm::dvec3 least = boxes == glm::dvec3(0) ? low - high : boxes;
    if (least.z >= least.x && least.z >= least.y) return 2;
    return least.y >= least.x ? 1 : 0;
}

// Returns a point of a flat world seen from above, x to the right and y down.
PlanPoint fromAbove(const glm::dvec3& point, int up) {
    if (up == 2) return {point.x, -point.y};
    if (up == 1) return {point.x, point.z};
    return {point.y, -point.z};
}

// Makes the larger side 1.
void fit(TracePlan& plan) {
    double left = 1e300, top = 1e300, right = -1e300, bottom = -1e300;
    for (const TraceShape& shape : plan.shapes) {
        for (std::size_t i = 0; i < shape.count; ++i) {
            left = std::min(left, shape.corners[i].x);
            right = std::max(right, shape.corners[i].x);
            top = std::min(top, shape.corners[i].y);
            bottom = std::max(bottom, shape.corners[i].y);
        }
    }
    const double side = std::max({right - left, bottom - top, 1e-300});
    for (TraceShape& shape : plan.shapes) {
        for (std::size_t i = 0; i < shape.count; ++i)
            shape.corners[i] = {(shape.corners[i].x - left) / side, (shape.corners[i].y - top) / side};
    }
    plan.size = {std::max((right - left) / side, 1e-3), std::max((bottom - top) / side, 1e-3)};
}

TracePlan mapPlan(const TracedFrame& frame, const TracedView& view) {
    TracePlan plan;
    plan.size = {2, 1};
    const bool isGlobe = isSphere(frame);
    const int up = isGlobe ? 2 : upAxis(view);
    for (const std::size_t place : coarseFirst(view)) {
        const TraceBounds& bounds = view.nodes[place].node.bounds;
        const bool isFinite =
            std::isfinite(glm::length(bounds.centre) + glm::length(bounds.halfSize) + bounds.radius);
        if (bounds.shape == TraceBoundsShape::None || !isFinite) continue;
        if (isGlobe) {
            appendOnGlobe(place, bounds, view.nodes[place].place == TracedPlace::Drawn, plan.shapes);
            continue;
        }
        TraceShape shape{.node = place};
        TraceBounds seen = bounds;
        // A sphere looks the same from everywhere, so the ring lies in the plane.
        if (seen.shape == TraceBoundsShape::Sphere) {
            seen.shape = TraceBoundsShape::Box;
            seen.axes = {glm::dvec3(up == 0 ? 0 : 1, up == 0 ? 1 : 0, 0),
                         glm::dvec3(0, up == 2 ? 1 : 0, up == 2 ? 0 : 1), glm::dvec3(0)};
            seen.halfSize = glm::dvec3(bounds.radius / std::numbers::sqrt2);
        }
        for (const glm::dvec3& corner : outlineOf(seen)) shape.corners[shape.count++] = fromAbove(corner, up);
        plan.shapes.push_back(shape);
    }
    if (plan.shapes.empty())
        plan.problem = "The engine told no bounds, so the nodes have no place. The tree can show them.";
    else if (!isGlobe)
        fit(plan);
    return plan;
}

// ---- by ids ----

// Returns whether y of the ids grows downwards on the map, as it does in most map tilings. Without bounds it does not.
bool growsDown(const TracedFrame& frame, const TracedView& view) {
    const bool isGlobe = isSphere(frame);
    const int up = isGlobe ? 2 : upAxis(view);
    double sumY = 0, sumDown = 0, sumBoth = 0, count = 0;
    for (const TracedNode& node : view.nodes) {
        const TraceBounds& bounds = node.node.bounds;
        if (bounds.shape == TraceBoundsShape::None || node.node.level == 0) continue;
        const planet::TraceQuadtreePlace id = planet::traceQuadtreePlace(node.node.id);
        const double y = std::ldexp(id.y + 0.5, -static_cast<int>(id.level));
        const double down = isGlobe ? -mapPoint(bounds.centre).latitudeRad : fromAbove(bounds.centre, up).y;
        if (!std::isfinite(down)) continue;
        sumY += y;
        sumDown += down;
        sumBoth += y * down;
        ++count;
    }
    return count * sumBoth - sumY * sumDown > 0;  // the sign of the covariance
}

// A sphere with six faces is an unfolded cube, whose faces have v up. Other worlds have their faces side by side.
TracePlan netPlan(const TracedFrame& frame, const TracedView& view) {
    TracePlan plan;
    std::uint32_t faces = 1;
    for (const TracedNode& node : view.nodes)
        faces = std::max(faces, planet::traceQuadtreePlace(node.node.id).face + 1);
    const bool isCube = isSphere(frame) && faces > 2;
    if (isCube && faces > planet::faceCount) {
        plan.problem = "The ids name more than six faces. The map and the tree can show the nodes.";
        return plan;
    }
    plan.size = isCube ? netSize : PlanSize{static_cast<double>(faces), 1};
    const bool isDown = !isCube && growsDown(frame, view);
    for (const std::size_t place : coarseFirst(view)) {
        const planet::TraceQuadtreePlace id = planet::traceQuadtreePlace(view.nodes[place].node.id);
        const double side = std::ldexp(1.0, -static_cast<int>(id.level));
        const NetCell cell = isCube ? netCells[id.face] : NetCell{static_cast<int>(id.face), 0};
        const double top = isDown ? id.y * side : 1 - (id.y + 1.0) * side;
        plan.shapes.push_back(rectangle(place, cell.column + id.x * side, cell.row + top, side, side));
    }
    return plan;
}

// ---- by parents ----

// The nodes of a view as a forest.
struct Forest {
    std::vector<std::vector<std::size_t>> children;
    std::vector<std::size_t> roots;
};

Forest forestOf(const TracedView& view) {
    std::unordered_map<planet::TraceNodeIndex, std::size_t> places;
    for (std::size_t i = 0; i < view.nodes.size(); ++i) places[view.nodes[i].index] = i;
    Forest forest{std::vector<std::vector<std::size_t>>(view.nodes.size()), {}};
    for (std::size_t i = 0; i < view.nodes.size(); ++i) {
        const auto parent = places.find(view.nodes[i].parent);
        if (parent == places.end())
            forest.roots.push_back(i);
        else
            forest.children[parent->second].push_back(i);
    }
    const auto byId = [&](std::size_t i) { return view.nodes[i].node.id; };
    std::ranges::sort(forest.roots, {}, byId);
    for (auto& children : forest.children) std::ranges::sort(children, {}, byId);
    return forest;
}

TracePlan treePlan(const TracedView& view) {
    const Forest forest = forestOf(view);
    struct Visit {
        std::size_t node;
        std::size_t depth;
    };
    // Parents before children. A ring of parents has no root, so it is left out.
    std::vector<Visit> order;
    for (const std::size_t root : forest.roots) order.push_back({root, 0});
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (const std::size_t child : forest.children[order[i].node])
            order.push_back({child, order[i].depth + 1});
    }
    TracePlan plan;
    std::vector<double> width(view.nodes.size(), 0);
    std::size_t rows = 1;
    for (auto visit = order.rbegin(); visit != order.rend(); ++visit) {
        double& own = width[visit->node];
        for (const std::size_t child : forest.children[visit->node]) own += width[child];
        own = std::max(own, 1.0);
        rows = std::max(rows, visit->depth + 1);
    }
    double total = 0;
    for (const std::size_t root : forest.roots) total += width[root];
    std::vector<double> left(view.nodes.size(), 0);
    double at = 0;
    for (const std::size_t root : forest.roots) {
        left[root] = at;
        at += width[root];
    }
    plan.size = {2, 1};
    const double scale = plan.size.width / std::max(total, 1.0);
    const double height = plan.size.height / static_cast<double>(rows);
    for (const Visit& visit : order) {
        double from = left[visit.node];
        for (const std::size_t child : forest.children[visit.node]) {
            left[child] = from;
            from += width[child];
        }
        plan.shapes.push_back(rectangle(visit.node, scale * left[visit.node],
                                        height * static_cast<double>(visit.depth), scale * width[visit.node],
                                        0.94 * height));
    }
    return plan;
}

// Shrinks what lies below a drawn node to a mark, so that the drawn node is seen around it.
void shrinkBelow(const TracedView& view, std::vector<TraceShape>& shapes) {
    constexpr double markShare = 0.4;
    for (TraceShape& shape : shapes) {
        if (view.nodes[shape.node].place != TracedPlace::Below) continue;
        PlanPoint middle;
        for (std::size_t i = 0; i < shape.count; ++i) {
            middle.x += shape.corners[i].x / static_cast<double>(shape.count);
            middle.y += shape.corners[i].y / static_cast<double>(shape.count);
        }
        for (std::size_t i = 0; i < shape.count; ++i) {
            PlanPoint& corner = shape.corners[i];
            corner = {middle.x + markShare * (corner.x - middle.x),
                      middle.y + markShare * (corner.y - middle.y)};
        }
    }
}

}  // namespace

bool TraceShape::holds(const PlanPoint& point) const {
    bool isLeft = false, isRight = false;  // of a side
    for (std::size_t i = 0; i < count; ++i) {
        const PlanPoint &a = corners[i], &b = corners[(i + 1) % count];
        const double side = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
        isLeft = isLeft || side > 0;
        isRight = isRight || side < 0;
    }
    return count >= 3 && !(isLeft && isRight);
}

TracePlan planOf(TraceLayout layout, const TracedFrame& frame, const TracedView& view) {
    if (layout == TraceLayout::Tree) return treePlan(view);
    TracePlan plan;
    if (layout == TraceLayout::Map)
        plan = mapPlan(frame, view);
    else if (hasQuadtreeIds(frame))
        plan = netPlan(frame, view);
    else
        plan.problem =
            "The ids of this trace say no place on a face. The map and the tree can show the nodes.";
    shrinkBelow(view, plan.shapes);
    return plan;
}

std::size_t nodeAt(const TracePlan& plan, const PlanPoint& point) {
    for (auto shape = plan.shapes.rbegin(); shape != plan.shapes.rend(); ++shape)
        if (shape->holds(point)) return shape->node;
    return noTracedNode;
}

TraceLayout suitingLayout(const TracedFrame& frame, const TracedView& view) {
    if (hasQuadtreeIds(frame)) return TraceLayout::Net;
    const bool hasBounds = std::ranges::any_of(
        view.nodes, [](const TracedNode& node) { return node.node.bounds.shape != TraceBoundsShape::None; });
    return hasBounds ? TraceLayout::Map : TraceLayout::Tree;
}

}  // namespace worldy::ui
