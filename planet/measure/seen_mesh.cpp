#include "planet/measure/seen_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace planet {

namespace {

// The distance of the near plane, metres.
constexpr double clipM = 1e-3;

double crossOf(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

double distanceToSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 ab = b - a;
    const double squared = glm::dot(ab, ab);
    const double share = squared > 0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0;
    return glm::length(p - (a + share * ab));
}

}  // namespace

SeenMesh::SeenMesh(const View& view) : view_(view), scalePx_(screenScalePx(view)) {}

void SeenMesh::add(const std::array<glm::dvec3, 3>& cornersM, std::uint32_t label) {
    std::array<glm::dvec3, 3> inCamera;  // right, up, ahead
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 fromEye = cornersM[i] - view_.eyeM;
        inCamera[i] = {glm::dot(fromEye, view_.right), glm::dot(fromEye, view_.up),
                       -glm::dot(fromEye, view_.back)};
    }
    std::array<glm::dvec3, 4> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3& here = inCamera[i];
        const glm::dvec3& next = inCamera[(i + 1) % 3];
        if (here.z >= clipM) kept[count++] = here;
        if ((here.z >= clipM) != (next.z >= clipM))
            kept[count++] = glm::mix(here, next, (clipM - here.z) / (next.z - here.z));
    }
    const auto seen = [&](const glm::dvec3& p) {
        const double z = std::max(p.z, clipM);
        return Corner{{view_.widthPx / 2.0 + scalePx_ * p.x / z, view_.heightPx / 2.0 - scalePx_ * p.y / z},
                      1 / z};
    };
    for (std::size_t i = 2; i < count; ++i)
        addClipped({seen(kept[0]), seen(kept[i - 1]), seen(kept[i])}, label);
}

void SeenMesh::addClipped(const std::array<Corner, 3>& corners, std::uint32_t label) {
    const glm::dvec2 low = glm::min(glm::min(corners[0].px, corners[1].px), corners[2].px);
    const glm::dvec2 high = glm::max(glm::max(corners[0].px, corners[1].px), corners[2].px);
    triangles_.push_back({corners, low, high, label});
}

SeenMesh::Hit SeenMesh::hitOf(const Triangle& triangle, const glm::dvec2& centre) {
    const auto& [a, b, c] = triangle.corners;
    const glm::dvec2 ab = b.px - a.px;
    const glm::dvec2 ac = c.px - a.px;
    const glm::dvec2 at = centre - a.px;
    const double area = crossOf(ab, ac);
    const auto [least, most] = std::minmax({a.inverse, b.inverse, c.inverse});
    Hit hit;
    hit.label = triangle.label;
    const double toB = crossOf(at, ac) / area;
    const double toC = crossOf(ab, at) / area;
    const bool inside = area != 0 && toB >= 0 && toC >= 0 && toB + toC <= 1;
    if (!inside) {
        hit.offPx = std::min({distanceToSegment(centre, a.px, b.px), distanceToSegment(centre, b.px, c.px),
                              distanceToSegment(centre, c.px, a.px)});
    }
    double low = least;
    double high = most;
    double middle = (least + most) / 2;
    if (area != 0) {
        const double byB = b.inverse - a.inverse;
        const double byC = c.inverse - a.inverse;
        middle = std::clamp(a.inverse + toB * byB + toC * byC, least, most);
        const glm::dvec2 gradient((byB * ac.y - byC * ab.y) / area, (byC * ab.x - byB * ac.x) / area);
        const double spread = slackPx * (std::abs(gradient.x) + std::abs(gradient.y));
        low = std::clamp(middle - spread, least, most);
        high = std::clamp(middle + spread, least, most);
    }
    hit.nearestM = 1 / high;
    hit.farthestM = 1 / low;
    hit.distanceM = 1 / middle;
    return hit;
}

std::optional<SeenMesh::Hit> SeenMesh::frontAt(int x, int y) const {
    const glm::dvec2 centre(x + 0.5, y + 0.5);
    std::optional<Hit> best;
    const auto better = [&](const Hit& hit) {
        if (!best) return true;
        const bool at = hit.offPx <= slackPx;
        if (at != (best->offPx <= slackPx)) return at;
        return at ? hit.farthestM < best->farthestM : hit.offPx < best->offPx;
    };
    for (const Triangle& triangle : triangles_) {
        // A triangle counts as the closest only within a pixel.
        const bool outside = centre.x < triangle.low.x - 1 || centre.y < triangle.low.y - 1 ||
                             centre.x > triangle.high.x + 1 || centre.y > triangle.high.y + 1;
        if (outside) continue;
        const Hit hit = hitOf(triangle, centre);
        if (better(hit)) best = hit;
    }
    return best;
}

std::optional<double> SeenMesh::nearestAtM(int x, int y) const {
    const glm::dvec2 centre(x + 0.5, y + 0.5);
    std::optional<double> nearest;
    for (const Triangle& triangle : triangles_) {
        const bool outside = centre.x < triangle.low.x - slackPx || centre.y < triangle.low.y - slackPx ||
                             centre.x > triangle.high.x + slackPx || centre.y > triangle.high.y + slackPx;
        if (outside) continue;
        const Hit hit = hitOf(triangle, centre);
        if (hit.offPx <= slackPx) nearest = std::min(nearest.value_or(hit.nearestM), hit.nearestM);
    }
    return nearest;
}

glm::dvec3 SeenMesh::pointAt(const View& view, int x, int y, double distanceM) {
    const double scalePx = screenScalePx(view);
    const double right = (x + 0.5 - view.widthPx / 2.0) / scalePx;
    const double up = (view.heightPx / 2.0 - y - 0.5) / scalePx;
    return view.eyeM + distanceM * (right * view.right + up * view.up - view.back);
}

}  // namespace planet
