#include "planet/gl/store/detail_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "planet/gl/device/software_renderer.h"

namespace planet::gl {

namespace {

std::uint32_t hashed(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed) {
    std::uint32_t h = x * 0x8DA6B343u + y * 0xD8163841u + z * 0xCB1AB31Fu + seed * 0x9E3779B9u;
    h = (h ^ (h >> 16)) * 0x7FEB352Du;
    h = (h ^ (h >> 15)) * 0x846CA68Bu;
    return h ^ (h >> 16);
}

// Returns the dot product with one of Perlin's twelve gradients, which point from a cell's corner to the
// middles of a cube's edges.
float alongGradient(std::uint32_t hash, const glm::vec3& p) {
    const std::uint32_t pick = hash % 12;
    const float a = pick < 8 ? p.x : p.y;
    const float b = pick < 4 ? p.y : p.z;
    return ((hash & 256u) != 0 ? a : -a) + ((hash & 512u) != 0 ? b : -b);
}

float faded(float t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

// Returns noise in [-1, 1] that repeats after `cells` cells along each axis.
float gradientNoise(const glm::vec3& p, std::uint32_t cells, std::uint32_t seed) {
    const glm::vec3 floor(std::floor(p.x), std::floor(p.y), std::floor(p.z));
    const glm::vec3 inside = p - floor;
    const auto cell = [&](float at, std::uint32_t step) {
        return (static_cast<std::uint32_t>(at) + step) % cells;
    };
    float sum = 0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
        const std::uint32_t x = corner & 1u;
        const std::uint32_t y = (corner >> 1) & 1u;
        const std::uint32_t z = corner >> 2;
        const glm::vec3 from = inside - glm::vec3(x, y, z);
        const float weight = (x == 1 ? faded(inside.x) : 1 - faded(inside.x)) *
                             (y == 1 ? faded(inside.y) : 1 - faded(inside.y)) *
                             (z == 1 ? faded(inside.z) : 1 - faded(inside.z));
        sum +=
            weight * alongGradient(hashed(cell(floor.x, x), cell(floor.y, y), cell(floor.z, z), seed), from);
    }
    return sum;
}

// Returns three octaves, creased where the noise passes through 0: ridges with rounded valleys between them.
float ridges(int x, int y, int z) {
    const glm::vec3 place = glm::vec3(x, y, z) / static_cast<float>(detailNoiseSize);
    float sum = 0;
    float weight = 1;
    for (std::uint32_t cells = 4; cells <= 16; cells *= 2) {
        sum -= weight * std::abs(gradientNoise(place * static_cast<float>(cells), cells, cells));
        weight *= 0.5f;
    }
    return sum;
}

std::size_t indexOf(int x, int y, int z) {
    const auto wrapped = [](int at) {
        return static_cast<std::size_t>((at + detailNoiseSize) % detailNoiseSize);
    };
    return (wrapped(z) * detailNoiseSize + wrapped(y)) * detailNoiseSize + wrapped(x);
}

std::uint8_t toByte(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(128 + 127 * value, 0.0f, 255.0f)));
}

std::vector<std::uint8_t> makeNoise() {
    std::vector<float> heights;
    double sum = 0;
    for (int i = 0; i < detailNoiseSize * detailNoiseSize * detailNoiseSize; ++i) {
        heights.push_back(ridges(i % detailNoiseSize, i / detailNoiseSize % detailNoiseSize,
                                 i / detailNoiseSize / detailNoiseSize));
        sum += static_cast<double>(heights.back());
    }
    const auto mean = static_cast<float>(sum / static_cast<double>(heights.size()));
    std::vector<std::uint8_t> texels;
    for (int i = 0; i < detailNoiseSize * detailNoiseSize * detailNoiseSize; ++i) {
        const int x = i % detailNoiseSize;
        const int y = i / detailNoiseSize % detailNoiseSize;
        const int z = i / detailNoiseSize / detailNoiseSize;
        const auto slope = [&](int dx, int dy, int dz) {
            return 4.0f *
                   (heights[indexOf(x + dx, y + dy, z + dz)] - heights[indexOf(x - dx, y - dy, z - dz)]);
        };
        const float height = 1.6f * (heights[indexOf(x, y, z)] - mean);
        texels.insert(texels.end(), {toByte(slope(1, 0, 0)), toByte(slope(0, 1, 0)), toByte(slope(0, 0, 1)),
                                     toByte(height)});
    }
    return texels;
}

}  // namespace

const std::vector<std::uint8_t>& detailNoise() {
    static const std::vector<std::uint8_t> texels = makeNoise();
    return texels;
}

Texture detailNoiseTexture() {
    const std::vector<std::uint8_t>& texels = detailNoise();
    Texture texture = makeTexture();
    glBindTexture(GL_TEXTURE_3D, texture.name());
    glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA8, detailNoiseSize, detailNoiseSize, detailNoiseSize, 0, GL_RGBA,
                 GL_UNSIGNED_BYTE, texels.data());
    glGenerateMipmap(GL_TEXTURE_3D);
    for (const GLenum axis : std::to_array<GLenum>({GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}))
        glTexParameteri(GL_TEXTURE_3D, axis, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, mipmapFilter());
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

}  // namespace planet::gl
