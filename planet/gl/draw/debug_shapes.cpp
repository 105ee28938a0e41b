#include "planet/gl/draw/debug_shapes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace planet {

namespace {

constexpr int circleSegments = 128;

void append(const glm::dvec3& a, const glm::dvec3& b, const LineColour& colour, Lines& lines) {
    lines.push_back({a, colour});
    lines.push_back({b, colour});
}

// Appends the circle around a centre through centre + x and centre + y.
void appendCircle(const glm::dvec3& centreM, const glm::dvec3& x, const glm::dvec3& y,
                  const LineColour& colour, Lines& lines) {
    const auto at = [&](int segment) {
        const double angle = 2 * std::numbers::pi * (segment % circleSegments) / circleSegments;
        return centreM + std::cos(angle) * x + std::sin(angle) * y;
    };
    for (int segment = 0; segment < circleSegments; ++segment)
        append(at(segment), at(segment + 1), colour, lines);
}

// Returns a unit vector perpendicular to the direction.
glm::dvec3 across(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    const glm::dvec3 other = size.x < size.y && size.x < size.z ? glm::dvec3(1, 0, 0)
                             : size.y < size.z                  ? glm::dvec3(0, 1, 0)
                                                                : glm::dvec3(0, 0, 1);
    return glm::normalize(glm::cross(direction, other));
}

}  // namespace

void appendBox(const OrientedBox& box, const LineColour& colour, Lines& lines) {
    const auto corner = [&](int bits) {
        glm::dvec3 point = box.centreM;
        for (int axis = 0; axis < 3; ++axis) {
            const double side = (bits >> axis & 1) != 0 ? box.halfSizeM[axis] : -box.halfSizeM[axis];
            point += side * box.axes[static_cast<std::size_t>(axis)];
        }
        return point;
    };
    for (int bits = 0; bits < 8; ++bits) {
        for (int axis = 0; axis < 3; ++axis)
            if ((bits >> axis & 1) == 0) append(corner(bits), corner(bits | 1 << axis), colour, lines);
    }
}

void appendFrustum(const View& view, double lengthM, const LineColour& colour, Lines& lines) {
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    const auto corner = [&](int index, double share) {
        const double x = index == 0 || index == 3 ? -tanX : tanX;
        const double y = index < 2 ? -tanY : tanY;
        return view.eyeM + share * lengthM * (x * view.right + y * view.up - view.back);
    };
    for (int index = 0; index < 4; ++index) {
        append(view.eyeM, corner(index, 1), colour, lines);
        for (const double share : {1.0 / 3, 2.0 / 3, 1.0})
            append(corner(index, share), corner((index + 1) % 4, share), colour, lines);
    }
}

void appendHorizon(const Horizon& horizon, const glm::dvec3& eyeM, const LineColour& colour, Lines& lines) {
    if (horizon.seesAll) return;
    const glm::dvec3 centreM = horizon.occluderRadiusM * std::cos(horizon.angleRad) * horizon.eyeDirection;
    const double radiusM = horizon.occluderRadiusM * std::sin(horizon.angleRad);
    const glm::dvec3 x = radiusM * across(horizon.eyeDirection);
    const glm::dvec3 y = glm::cross(horizon.eyeDirection, x);
    appendCircle(centreM, x, y, colour, lines);
    constexpr int sights = 16;
    for (int i = 0; i < sights; ++i) {
        const double angle = 2 * std::numbers::pi * i / sights;
        append(eyeM, centreM + std::cos(angle) * x + std::sin(angle) * y, colour, lines);
    }
}

void appendSphere(const glm::dvec3& centreM, double radiusM, const LineColour& colour, Lines& lines) {
    const glm::dvec3 x(radiusM, 0, 0);
    const glm::dvec3 y(0, radiusM, 0);
    const glm::dvec3 z(0, 0, radiusM);
    appendCircle(centreM, x, y, colour, lines);
    appendCircle(centreM, y, z, colour, lines);
    appendCircle(centreM, z, x, colour, lines);
}

void appendOutline(const ChunkTree& tree, const ChunkNode& node, double liftM, const LineColour& colour,
                   Lines& lines) {
    const int cells = chunkCells(tree.shape);
    const FaceSquare square = faceSquareOf(node.id);
    const auto vertex = [&](int column, int row) {
        const glm::dvec3 direction = sphereFromCube(cubePoint(
            node.id.face, square.u + square.side * column / cells, square.v + square.side * row / cells));
        const auto index = static_cast<std::size_t>(row * (cells + 1) + column);
        return positionM(tree.shape, direction, heightM(tree.shape, (*node.heights)[index]) + liftM);
    };
    for (int i = 0; i < cells; ++i) {
        append(vertex(i, 0), vertex(i + 1, 0), colour, lines);
        append(vertex(cells, i), vertex(cells, i + 1), colour, lines);
        append(vertex(cells - i, cells), vertex(cells - i - 1, cells), colour, lines);
        append(vertex(0, cells - i), vertex(0, cells - i - 1), colour, lines);
    }
}

}  // namespace planet
