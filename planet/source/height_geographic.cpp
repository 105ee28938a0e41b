#include "planet/source/height_geographic.h"

#include <cmath>
#include <numbers>

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

}  // namespace

void geographicRow(Face face, int faceCells, int firstColumn, int row, const GeographicRow& out) {
    const FaceAxes& axes = faceAxes(face);
    const double perCell = 2.0 / faceCells;
    const glm::dvec3 base = axes.normal + (row * perCell - 1) * axes.v;
    const glm::dvec3 along = axes.u;
    const int count = static_cast<int>(out.ring.size());
    double* const longitudes = out.longitudeRad.data();
    double* const latitudes = out.latitudeRad.data();
    double* const rings = out.ring.data();
    for (int i = 0; i < count; ++i) {
        // This repeats cubePoint and sphereFromCube.
        const double u = (firstColumn + i) * perCell - 1;
        const double x = base.x + u * along.x;
        const double y = base.y + u * along.y;
        const double z = base.z + u * along.z;
        const double xx = x * x;
        const double yy = y * y;
        const double zz = z * z;
        const double dx = std::abs(x) * std::sqrt(1 - (yy + zz) / 2 + yy * zz / 3);
        const double dy = std::abs(y) * std::sqrt(1 - (zz + xx) / 2 + zz * xx / 3);
        const double dz = std::abs(z) * std::sqrt(1 - (xx + yy) / 2 + xx * yy / 3);
        const double ring = std::sqrt(dx * dx + dy * dy);
        const double latitude = quadrantAngleRad(ring, dz);
        const double fromMeridian = quadrantAngleRad(dx, dy);
        const double eastWest = x < 0 ? std::numbers::pi - fromMeridian : fromMeridian;
        const bool pole = ring == 0;
        longitudes[i] = pole ? 0.0 : (y < 0 ? -eastWest : eastWest);
        latitudes[i] = z < 0 ? -latitude : latitude;
        rings[i] = ring;
    }
}

}  // namespace planet
