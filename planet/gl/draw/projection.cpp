#include "planet/gl/draw/projection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace planet::gl {

namespace {

glm::dmat4 sideways(const View& view) {
    const double tanX = std::tan(view.horizontalFovRad / 2);
    glm::dmat4 matrix(0);
    matrix[0][0] = 1 / tanX;
    matrix[1][1] = view.widthPx / (tanX * view.heightPx);
    matrix[2][3] = -1;
    return matrix;
}

}  // namespace

Projection reversedProjection(const View& view, double nearM) {
    Projection projection{sideways(view), true, nearM, 0};
    projection.clipFromCamera[3][2] = nearM;
    return projection;
}

Projection classicProjection(const View& view, double nearM, double farM) {
    Projection projection{sideways(view), false, nearM, farM};
    projection.clipFromCamera[2][2] = -(farM + nearM) / (farM - nearM);
    projection.clipFromCamera[3][2] = -2 * farM * nearM / (farM - nearM);
    return projection;
}

Projection fallbackProjection(const View& view, double radiusM, double highestRadiusM) {
    const double scale = std::min(radiusM / 6.371e6, 1.0);
    const double eyeRadiusM = glm::length(view.eyeM);
    const double nearM = std::max(0.3 * (eyeRadiusM - highestRadiusM), 2 * scale);
    return classicProjection(view, nearM, std::max(eyeRadiusM + highestRadiusM, 10 * nearM));
}

double viewDistanceM(const Projection& projection, double depth) {
    if (projection.reversedZ) return projection.nearM / depth;
    const double clip = 2 * depth - 1;
    const double nearM = projection.nearM;
    const double farM = projection.farM;
    return 2 * farM * nearM / (farM + nearM - clip * (farM - nearM));
}

double depthStepM(const Projection& projection, double distanceM) {
    const double nearM = projection.nearM;
    const double farM = projection.farM;
    if (projection.reversedZ) {
        const auto depth = static_cast<float>(nearM / distanceM);
        return nearM / static_cast<double>(std::nextafter(depth, 0.0f)) - nearM / static_cast<double>(depth);
    }
    const double clip = ((farM + nearM) - 2 * farM * nearM / distanceM) / (farM - nearM);
    const auto depth = static_cast<float>(clip / 2 + 0.5);
    const float next = std::nextafter(depth, 2.0f);
    if (next > 1) return std::numeric_limits<double>::infinity();
    return viewDistanceM(projection, static_cast<double>(next)) -
           viewDistanceM(projection, static_cast<double>(depth));
}

}  // namespace planet::gl
