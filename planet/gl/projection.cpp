#include "planet/gl/projection.h"

#include <cmath>

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

double viewDistanceM(const Projection& projection, double depth) {
    if (projection.reversedZ) return projection.nearM / depth;
    const double clip = 2 * depth - 1;
    const double nearM = projection.nearM;
    const double farM = projection.farM;
    return 2 * farM * nearM / (farM + nearM - clip * (farM - nearM));
}

}  // namespace planet::gl
