#include "planet/surface/layer_noise.h"

#include <cassert>
#include <glm/common.hpp>

namespace planet {

glm::uvec3 latticeCell(const glm::dvec3& whole) {
    const auto wrapped = [](double value) {
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
    };
    return {wrapped(whole.x), wrapped(whole.y), wrapped(whole.z)};
}

std::uint32_t layerHash(const glm::uvec3& cell) {
    std::uint32_t h = cell.x * 0x8DA6B343u + cell.y * 0xD8163841u + cell.z * 0xCB1AB31Fu;
    h = (h ^ (h >> 16)) * 0x7FEB352Du;
    h = (h ^ (h >> 15)) * 0x846CA68Bu;
    return h ^ (h >> 16);
}

namespace {

glm::dvec4 latticeValue(const glm::uvec3& cell) {
    const std::uint32_t h = layerHash(cell);
    return glm::dvec4(h & 0xFFu, (h >> 8) & 0xFFu, (h >> 16) & 0xFFu, h >> 24) / 127.5 - 1.0;
}

}  // namespace

glm::dvec4 valueNoise(const glm::dvec3& place) {
    const glm::dvec3 floor = glm::floor(place);
    const glm::uvec3 cell = latticeCell(floor);
    const glm::dvec3 inside = place - floor;
    const glm::dvec3 t = inside * inside * (3.0 - 2.0 * inside);
    const auto alongX = [&](std::uint32_t y, std::uint32_t z) {
        return glm::mix(latticeValue(cell + glm::uvec3(0, y, z)), latticeValue(cell + glm::uvec3(1, y, z)),
                        t.x);
    };
    return glm::mix(glm::mix(alongX(0, 0), alongX(1, 0), t.y), glm::mix(alongX(0, 1), alongX(1, 1), t.y),
                    t.z);
}

glm::dvec4 layerNoise(const glm::dvec3& positionM, double sizeM) {
    assert(sizeM > 0);
    glm::dvec4 sum(0);
    double cellsPerM = 1 / sizeM;
    for (const double share : layerNoiseShares) {
        sum += share * valueNoise(positionM * cellsPerM);
        cellsPerM *= layerNoiseOctave;
    }
    return sum;
}

}  // namespace planet
