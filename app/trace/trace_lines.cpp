#include "app/trace/trace_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "app/scene/overlay_colours.h"

namespace worldy {

namespace {

using planet::TraceBounds;
using planet::TraceBoundsShape;

constexpr std::uint8_t nodeOpacity = 200;
constexpr planet::LineColour selectedColour{255, 190, 76, 255};
constexpr planet::LineColour cameraColour{255, 255, 255, 160};
constexpr planet::LineColour otherCameraColour{255, 255, 255, 70};

planet::LineColour colourOf(const TracedNode& node, double tauPx, const OverlaySettings& overlay) {
    if (overlay.colourBy == ColourBy::Morph)
        return colourBytes(rampColour(static_cast<double>(node.morph)), nodeOpacity);
    if (overlay.colourBy != ColourBy::Error)
        return colourBytes(levelColour(static_cast<int>(node.node.level)), nodeOpacity);
    const double share = node.errorPx / (tauPx * overlay.errorScale);
    return colourBytes(std::isnan(share) ? unmeasuredColour : errorColour(share), nodeOpacity);
}

bool isFinite(const TraceBounds& bounds) {
    return std::isfinite(glm::length(bounds.centre) + glm::length(bounds.halfSize) + bounds.radius);
}

void appendBounds(const TraceBounds& bounds, double scale, const planet::LineColour& colour,
                  planet::Lines& lines) {
    if (bounds.shape == TraceBoundsShape::Sphere)
        return planet::appendSphere(scale * bounds.centre, scale * bounds.radius, colour, lines);
    planet::OrientedBox box;
    box.centreM = scale * bounds.centre;
    box.axes = bounds.axes;
    box.halfSizeM = scale * bounds.halfSize;
    planet::appendBox(box, colour, lines);
}

// Appends the edges of what the engine's camera sees, down to the ground or the horizon.
void appendCamera(const planet::TraceView& camera, double radius, double scale,
                  const planet::LineColour& colour, planet::Lines& lines) {
    const double distance = glm::length(camera.eye);
    const double length =
        std::max(distance - radius, 0.02 * std::sqrt(std::max(distance * distance - radius * radius, 0.0)));
    const std::array<glm::dvec3, 4> ends = traceFrustum(camera, length);
    const auto finite = [](const glm::dvec3& v) { return std::isfinite(glm::length(v)); };
    if (!finite(camera.eye) || !std::ranges::all_of(ends, finite)) return;
    const auto line = [&](const glm::dvec3& from, const glm::dvec3& to) {
        lines.push_back({scale * from, colour});
        lines.push_back({scale * to, colour});
    };
    for (std::size_t i = 0; i < ends.size(); ++i) {
        line(camera.eye, ends[i]);
        line(ends[i], ends[(i + 1) % ends.size()]);
    }
}

}  // namespace

std::array<glm::dvec3, 4> traceFrustum(const planet::TraceView& camera, double length) {
    const glm::dmat3 worldFromView = glm::transpose(glm::dmat3(camera.view));
    const glm::dmat4& projection = camera.projection;
    std::array<glm::dvec3, 4> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double x = i == 0 || i == 3 ? -1 : 1, y = i < 2 ? -1 : 1;
        const glm::dvec3 inView((x + projection[2][0]) / projection[0][0],
                                (y + projection[2][1]) / projection[1][1], -1);
        corners[i] = camera.eye + length * (worldFromView * inView);
    }
    return corners;
}

bool hasPlaceOnPlanet(const TracedFrame& frame) {
    return frame.description && frame.description->shape == planet::TraceShape::Sphere &&
           frame.description->radius > 0 && std::isfinite(frame.description->radius);
}

planet::Lines traceLines(const TracedFrame& frame, const TracedView& view, double planetRadiusM,
                         const glm::dvec3& eyeM, const OverlaySettings& overlay,
                         std::optional<std::uint64_t> selected) {
    planet::Lines lines;
    if (!hasPlaceOnPlanet(frame)) return lines;
    const double scale = planetRadiusM / frame.description->radius;
    const double horizonM = std::sqrt(std::max(glm::dot(eyeM, eyeM) - planetRadiusM * planetRadiusM, 0.0));
    for (const TracedNode& node : view.nodes) {
        const TraceBounds& bounds = node.node.bounds;
        const bool isSelected = selected == node.node.id;
        if ((node.place != TracedPlace::Drawn && !isSelected) || bounds.shape == TraceBoundsShape::None ||
            !isFinite(bounds))
            continue;
        const glm::dvec3 centreM = scale * bounds.centre;
        if (glm::length(centreM - eyeM) - scale * bounds.reach() > horizonM) continue;
        appendBounds(bounds, scale, isSelected ? selectedColour : colourOf(node, view.tauPx, overlay), lines);
    }
    for (const TracedView& each : frame.views)
        if (each.info)
            appendCamera(*each.info, frame.description->radius, scale,
                         each.view == view.view ? cameraColour : otherCameraColour, lines);
    return lines;
}

}  // namespace worldy
