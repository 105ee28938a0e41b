#include "planet/source/height_geographic.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/vec3.hpp>
#include <numbers>

#include "planet/base/cpu_clones.h"

namespace planet {

namespace {

// Returns the angle of (x, y) above the x axis, [0, pi/2], for x, y >= 0; 0 if both are 0. Selects and plain
// arithmetic let a compiler vectorise it with the same bits.
inline double quadrantAngleRad(double x, double y) {
    constexpr double tanOfEighth = 0.41421356237309503;  // tan(pi / 8)
    const double low = y < x ? y : x;
    const double high = y < x ? x : y;
    // Above pi/8, atan(t) = pi/4 + atan((t - 1) / (t + 1)).
    const bool reduce = low > tanOfEighth * high;
    const double numerator = reduce ? low - high : low;
    const double denominator = (reduce ? low + high : high) + 1e-300;
    const double t = numerator / denominator;
    const double z = t * t;
    // atan(t) / t as a polynomial in t^2, fitted at Chebyshev's points of [0, tan(pi/8)^2]; error 1e-15.
    double p = -0.0253164795737764757;
    p = p * z + 0.0502476211894012803;
    p = p * z - 0.0650598296717083992;
    p = p * z + 0.0767353542818328602;
    p = p * z - 0.0908952995656230736;
    p = p * z + 0.111110488537512957;
    p = p * z - 0.142857126616847938;
    p = p * z + 0.199999999783926621;
    p = p * z - 0.33333333333221434;
    p = p * z + 0.999999999999999041;
    const double angle = t * p + (reduce ? std::numbers::pi / 4 : 0.0);
    return y < x ? angle : std::numbers::pi / 2 - angle;
}

// Returns the scale of a coordinate of the cube in Nowell's mapping, from the squares of the other two.
inline double scaleOf(double squareA, double squareB) {
    return std::sqrt(1 - (squareA + squareB) / 2 + squareA * squareB / 3);
}

// The coordinates of a row's points along the face's normal, u and v, on the cube and on the sphere.
struct CubeRow {
    double normal;  // -1 or 1
    double v;
    double uScale;  // of u on the sphere; the same for the whole row
    double uSign;   // of the planet's axis along u: -1 or 1
    const double* u;
    const double* vScale;
};

// Names the axis of a face that lies along an axis of the planet.
enum class Along { Normal, U, V };

// Fills a row of places. X, Y and Z say which of the face's axes lie along the planet's. This repeats cubePoint and
// sphereFromCube.
template <Along X, Along Y, Along Z>
PLANET_ALWAYS_INLINE void fillRow(const CubeRow& cube, const GeographicRow& out) {
    const std::size_t count = out.ring.size();
    double* const longitudes = out.longitudeRad.data();
    double* const latitudes = out.latitudeRad.data();
    double* const rings = out.ring.data();
    const double* const us = cube.u;
    const double* const vScales = cube.vScale;
    const double normal = cube.normal;
    const double v = cube.v;
    const double vSize = std::abs(v);
    const double vSquare = v * v;
    const double uScale = cube.uScale;
    const double uSign = cube.uSign;
    for (std::size_t i = 0; i < count; ++i) {
        const double u = us[i] * uSign;
        const double uSquare = us[i] * us[i];
        const double onNormal = scaleOf(uSquare, vSquare);
        const double onU = std::abs(u) * uScale;
        const double onV = vSize * vScales[i];
        const auto onSphere = [&](Along axis) {
            return axis == Along::Normal ? onNormal : axis == Along::U ? onU : onV;
        };
        const auto onCube = [&](Along axis) {
            return axis == Along::Normal ? normal : axis == Along::U ? u : v;
        };
        const double dx = onSphere(X);
        const double dy = onSphere(Y);
        const double dz = onSphere(Z);
        const double ring = std::sqrt(dx * dx + dy * dy);
        const double latitude = quadrantAngleRad(ring, dz);
        const double fromMeridian = quadrantAngleRad(dx, dy);
        const double eastWest = onCube(X) < 0 ? std::numbers::pi - fromMeridian : fromMeridian;
        const bool pole = ring == 0;
        longitudes[i] = pole ? 0.0 : (onCube(Y) < 0 ? -eastWest : eastWest);
        latitudes[i] = onCube(Z) < 0 ? -latitude : latitude;
        rings[i] = ring;
    }
}

PLANET_CPU_CLONES void fillScales(const double* u, double* scales, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) scales[i] = scaleOf(1, u[i] * u[i]);
}

// One function for each direction of a face's axes, so that each loop is compiled without branches.
PLANET_CPU_CLONES void fillOnX(const CubeRow& cube, const GeographicRow& out) {
    fillRow<Along::Normal, Along::U, Along::V>(cube, out);
}

PLANET_CPU_CLONES void fillOnY(const CubeRow& cube, const GeographicRow& out) {
    fillRow<Along::U, Along::Normal, Along::V>(cube, out);
}

PLANET_CPU_CLONES void fillOnZ(const CubeRow& cube, const GeographicRow& out) {
    fillRow<Along::V, Along::U, Along::Normal>(cube, out);
}

double sumOf(const glm::dvec3& axis) {
    return axis.x + axis.y + axis.z;
}

}  // namespace

GeographicColumns::GeographicColumns(Face face, int faceCells, int firstColumn, int count)
    : face_(face),
      perCell_(2.0 / faceCells),
      u_(static_cast<std::size_t>(count)),
      vScale_(static_cast<std::size_t>(count)) {
    for (std::size_t i = 0; i < u_.size(); ++i) u_[i] = (firstColumn + static_cast<int>(i)) * perCell_ - 1;
    fillScales(u_.data(), vScale_.data(), u_.size());
}

void GeographicColumns::placesOfRow(int row, const GeographicRow& out) const {
    assert(out.ring.size() == u_.size());
    // Each axis of a face is one of the planet's, or its opposite.
    const FaceAxes& axes = faceAxes(face_);
    const double v = row * perCell_ - 1;
    const CubeRow cube{.normal = sumOf(axes.normal),
                       .v = v * sumOf(axes.v),
                       .uScale = scaleOf(1, v * v),
                       .uSign = sumOf(axes.u),
                       .u = u_.data(),
                       .vScale = vScale_.data()};
    if (axes.normal.x != 0) return fillOnX(cube, out);
    if (axes.normal.y != 0) return fillOnY(cube, out);
    fillOnZ(cube, out);
}

}  // namespace planet
