#include "planet/source/gradient_noise.h"

#include <array>
#include <cmath>

namespace planet {

namespace {

struct Gradient {
    double x, y, z;
};

// The directions to the middles of a cube's edges. Four occur twice, so that four bits select one.
constexpr std::array<Gradient, 16> gradients = {{{1, 1, 0},
                                                 {-1, 1, 0},
                                                 {1, -1, 0},
                                                 {-1, -1, 0},
                                                 {1, 0, 1},
                                                 {-1, 0, 1},
                                                 {1, 0, -1},
                                                 {-1, 0, -1},
                                                 {0, 1, 1},
                                                 {0, -1, 1},
                                                 {0, 1, -1},
                                                 {0, -1, -1},
                                                 {1, 1, 0},
                                                 {0, -1, 1},
                                                 {-1, 1, 0},
                                                 {0, -1, -1}}};

double fade(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

double mix(double a, double b, double t) {
    return a + t * (b - a);
}

}  // namespace

double gradientNoise(const glm::dvec3& point, std::uint32_t seed) {
    const double floorX = std::floor(point.x), floorY = std::floor(point.y), floorZ = std::floor(point.z);
    const auto cellX = static_cast<std::int32_t>(floorX);
    const auto cellY = static_cast<std::int32_t>(floorY);
    const auto cellZ = static_cast<std::int32_t>(floorZ);
    const double x = point.x - floorX, y = point.y - floorY, z = point.z - floorZ;
    const auto corner = [&](int dx, int dy, int dz) {
        const Gradient& g = gradients[latticeHash(cellX + dx, cellY + dy, cellZ + dz, seed) & 15u];
        return g.x * (x - dx) + g.y * (y - dy) + g.z * (z - dz);
    };
    const double u = fade(x), v = fade(y), w = fade(z);
    const double near =
        mix(mix(corner(0, 0, 0), corner(1, 0, 0), u), mix(corner(0, 1, 0), corner(1, 1, 0), u), v);
    const double far =
        mix(mix(corner(0, 0, 1), corner(1, 0, 1), u), mix(corner(0, 1, 1), corner(1, 1, 1), u), v);
    return mix(near, far, w);
}

}  // namespace planet
