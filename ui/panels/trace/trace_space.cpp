#include "ui/panels/trace/trace_space.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "app/trace/trace_lines.h"
#include "ui/panels/trace/trace_plan.h"

namespace worldy::ui {

namespace {

using planet::TraceBounds;
using planet::TraceBoundsShape;
using Segment = std::array<glm::dvec2, 2>;

constexpr double fovRad = 0.8;
constexpr double radPerPx = 0.006;

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isGlobe(const TracedFrame& frame) {
    return frame.description && frame.description->shape == planet::TraceShape::Sphere;
}

bool hasBounds(const TracedNode& node) {
    const TraceBounds& bounds = node.node.bounds;
    return bounds.shape != TraceBoundsShape::None && isFinite(bounds.centre) && std::isfinite(bounds.reach());
}

// Two directions of the ground, at right angles to up and to each other.
std::array<glm::dvec3, 2> groundOf(const glm::dvec3& up) {
    const glm::dvec3 helper = std::abs(up.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = glm::normalize(glm::cross(helper, up));
    return {first, glm::cross(up, first)};
}

// Returns the direction from the target to the eye.
glm::dvec3 backOf(const SpaceCamera& camera) {
    const auto [first, second] = groundOf(camera.up);
    const glm::dvec3 level = std::cos(camera.yawRad) * first + std::sin(camera.yawRad) * second;
    return std::cos(camera.pitchRad) * level + std::sin(camera.pitchRad) * camera.up;
}

std::array<glm::dvec3, 8> cornersOf(const TraceBounds& box) {
    std::array<glm::dvec3, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        corners[i] = box.centre;
        for (int axis = 0; axis < 3; ++axis) {
            const double sign = (i >> axis & 1) != 0 ? 1 : -1;
            corners[i] += sign * box.halfSize[axis] * box.axes[static_cast<std::size_t>(axis)];
        }
    }
    return corners;
}

// Returns the convex hull of points, counterclockwise (Andrew's monotone chain, 1979).
std::vector<glm::dvec2> hullOf(std::vector<glm::dvec2> points) {
    std::ranges::sort(points,
                      [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    const auto side = [](const glm::dvec2& o, const glm::dvec2& a, const glm::dvec2& b) {
        return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    };
    std::vector<glm::dvec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t begin = hull.size();
        for (const glm::dvec2& point : points) {
            while (hull.size() >= begin + 2 && side(hull[hull.size() - 2], hull.back(), point) <= 0)
                hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::ranges::reverse(points);
    }
    return hull;
}

void appendEdge(const SpaceView& space, const glm::dvec3& from, const glm::dvec3& to, SpaceShape& shape) {
    if (const auto segment = space.segment(from, to)) shape.edges.push_back(*segment);
}

void appendBox(const SpaceView& space, const TraceBounds& box, SpaceShape& shape) {
    const std::array<glm::dvec3, 8> corners = cornersOf(box);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t bit = 1; bit < corners.size(); bit *= 2)
            if ((i & bit) == 0) appendEdge(space, corners[i], corners[i | bit], shape);
    }
}

void appendSphere(const SpaceView& space, const TraceBounds& sphere, SpaceShape& shape) {
    constexpr int corners = 24;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 before{0, 0, 0};
        for (int i = 0; i <= corners; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners;
            glm::dvec3 at{0, 0, 0};
            at[axis] = std::cos(angle);
            at[(axis + 1) % 3] = std::sin(angle);
            at = sphere.centre + sphere.radius * at;
            if (i > 0) appendEdge(space, before, at, shape);
            before = at;
        }
    }
}

// Returns the hull of what the edges cover; empty if less than a triangle is in front of the eye.
std::vector<glm::dvec2> hullOf(const SpaceShape& shape) {
    std::vector<glm::dvec2> points;
    for (const Segment& edge : shape.edges) points.insert(points.end(), edge.begin(), edge.end());
    return points.size() < 3 ? std::vector<glm::dvec2>() : hullOf(std::move(points));
}

}  // namespace

SpaceCamera cameraAround(const TracedFrame& frame, const TracedView& view) {
    SpaceCamera camera;
    glm::dvec3 low{std::numeric_limits<double>::max()}, high{std::numeric_limits<double>::lowest()};
    glm::dvec3 boxes{0, 0, 0};
    bool isAny = false;
    for (const TracedNode& node : view.nodes) {
        if (node.place != TracedPlace::Drawn || !hasBounds(node)) continue;
        const TraceBounds& bounds = node.node.bounds;
        low = glm::min(low, bounds.centre - bounds.reach());
        high = glm::max(high, bounds.centre + bounds.reach());
        if (bounds.shape == TraceBoundsShape::Box) boxes += bounds.axes[2];
        isAny = true;
    }
    if (!isAny) return camera;
    camera.isPlaced = true;
    camera.target = (low + high) / 2.0;
    camera.distance = std::max(1.2 * glm::length(high - low), 1e-6);
    const double radius = isGlobe(frame) ? frame.description->radius : 0;
    if (radius > 0 && glm::length(camera.target) > 0.5 * radius) {
        camera.up = glm::normalize(camera.target);
        return camera;
    }
    if (radius > 0) {
        // The whole globe, from the side of the engine's camera.
        camera.target = {0, 0, 0};
        camera.distance = 3.2 * radius;
        if (view.info && glm::length(view.info->eye) > 0) {
            const glm::dvec3 eye = glm::normalize(view.info->eye);
            camera.pitchRad = std::asin(std::clamp(eye.z, -1.0, 1.0));
            const auto [first, second] = groundOf(camera.up);
            camera.yawRad = std::atan2(glm::dot(eye, second), glm::dot(eye, first));
        }
        return camera;
    }
    const glm::dvec3 level = glm::abs(boxes);
    if (level.y > level.z && level.y >= level.x) camera.up = {0, 1, 0};
    if (level.x > level.z && level.x > level.y) camera.up = {1, 0, 0};
    return camera;
}

SpaceCamera turned(const SpaceCamera& camera, double xPx, double yPx) {
    SpaceCamera turned = camera;
    turned.yawRad -= radPerPx * xPx;
    turned.pitchRad = std::clamp(camera.pitchRad + radPerPx * yPx, -1.5, 1.5);
    return turned;
}

SpaceCamera moved(const SpaceCamera& camera, const Rect& area, double xPx, double yPx) {
    const glm::dvec3 back = backOf(camera);
    const glm::dvec3 right = glm::normalize(glm::cross(camera.up, back));
    const glm::dvec3 up = glm::cross(back, right);
    const double unitsPerPx =
        2 * camera.distance * std::tan(fovRad / 2) / std::max(static_cast<double>(area.height), 1.0);
    SpaceCamera moved = camera;
    moved.target += unitsPerPx * (yPx * up - xPx * right);
    return moved;
}

SpaceCamera nearer(const SpaceCamera& camera, double factor) {
    SpaceCamera nearer = camera;
    nearer.distance = std::clamp(camera.distance / factor, 1e-6, 1e15);
    return nearer;
}

std::optional<Segment> SpaceView::segment(const glm::dvec3& from, const glm::dvec3& to) const {
    // Relative to the eye, so that far worlds keep their precision.
    glm::dvec4 a = clipFromWorld * glm::dvec4(from - eye, 1), b = clipFromWorld * glm::dvec4(to - eye, 1);
    const double nearest = 1e-9 * std::max(std::abs(a.w), std::abs(b.w));
    if (!(a.w > nearest) && !(b.w > nearest)) return std::nullopt;
    if (!(a.w > nearest)) a = glm::mix(a, b, (nearest - a.w) / (b.w - a.w) + 1e-9);
    if (!(b.w > nearest)) b = glm::mix(b, a, (nearest - b.w) / (a.w - b.w) + 1e-9);
    const auto onScreen = [&](const glm::dvec4& clip) {
        // Far outside the window a float cannot resolve a pixel.
        const glm::dvec2 at = glm::clamp(glm::dvec2(clip) / clip.w, -1e3, 1e3);
        return glm::dvec2(
            static_cast<double>(area.x) + (0.5 + 0.5 * at.x) * static_cast<double>(area.width),
            static_cast<double>(area.y) + (0.5 - 0.5 * at.y) * static_cast<double>(area.height));
    };
    return Segment{onScreen(a), onScreen(b)};
}

SpaceView spaceView(const SpaceCamera& camera, const Rect& area) {
    SpaceView space;
    space.area = area;
    space.eye = camera.target + camera.distance * backOf(camera);
    const double aspect = static_cast<double>(area.width) / std::max(static_cast<double>(area.height), 1.0);
    const glm::dmat4 view = glm::lookAt(glm::dvec3(0), camera.target - space.eye, camera.up);
    space.clipFromWorld =
        glm::perspective(fovRad, aspect, 0.001 * camera.distance, 1000 * camera.distance) * view;
    return space;
}

SpaceView spaceView(const planet::TraceView& camera, const Rect& area) {
    SpaceView space;
    space.eye = camera.eye;
    space.area = area;
    const double aspect = static_cast<double>(std::max(camera.width, 1)) / std::max(camera.height, 1);
    const double width = std::min(static_cast<double>(area.width), static_cast<double>(area.height) * aspect);
    space.area.x += static_cast<float>((static_cast<double>(area.width) - width) / 2);
    space.area.y += static_cast<float>((static_cast<double>(area.height) - width / aspect) / 2);
    space.area.width = static_cast<float>(width);
    space.area.height = static_cast<float>(width / aspect);
    // The rotation alone: positions are relative to the eye.
    space.clipFromWorld = camera.projection * glm::dmat4(glm::dmat3(camera.view));
    return space;
}

std::vector<SpaceShape> spaceShapes(const SpaceView& space, const TracedFrame& frame, const TracedView& view,
                                    std::optional<std::uint64_t> selected) {
    std::vector<SpaceShape> shapes;
    const double radius = isGlobe(frame) ? frame.description->radius : 0;
    const double horizon = std::sqrt(std::max(glm::dot(space.eye, space.eye) - radius * radius, 0.0));
    for (std::size_t i = 0; i < view.nodes.size(); ++i) {
        const TracedNode& node = view.nodes[i];
        if ((node.place != TracedPlace::Drawn && node.node.id != selected) || !hasBounds(node)) continue;
        SpaceShape shape{.node = i, .distance = glm::length(node.node.bounds.centre - space.eye)};
        shape.isBehind = radius > 0 && shape.distance > horizon;
        if (node.node.bounds.shape == TraceBoundsShape::Box)
            appendBox(space, node.node.bounds, shape);
        else
            appendSphere(space, node.node.bounds, shape);
        if (shape.edges.empty()) continue;
        shape.hull = hullOf(shape);
        shapes.push_back(std::move(shape));
    }
    std::ranges::sort(shapes, std::greater(), &SpaceShape::distance);
    return shapes;
}

std::vector<Segment> spaceFrustum(const SpaceView& space, const planet::TraceView& camera, double length) {
    const std::array<glm::dvec3, 4> ends = traceFrustum(camera, length);
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (!isFinite(ends[i])) continue;
        if (const auto edge = space.segment(camera.eye, ends[i])) segments.push_back(*edge);
        if (const auto edge = space.segment(ends[i], ends[(i + 1) % ends.size()])) segments.push_back(*edge);
    }
    return segments;
}

std::size_t nodeAt(const std::vector<SpaceShape>& shapes, const glm::dvec2& point) {
    for (auto shape = shapes.rbegin(); shape != shapes.rend(); ++shape) {
        if (shape->hull.size() < 3 || shape->isBehind) continue;
        bool isInside = true;
        for (std::size_t i = 0; i < shape->hull.size() && isInside; ++i) {
            const glm::dvec2 &a = shape->hull[i], &b = shape->hull[(i + 1) % shape->hull.size()];
            isInside = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x) >= 0;
        }
        if (isInside) return shape->node;
    }
    return noTracedNode;
}

}  // namespace worldy::ui
