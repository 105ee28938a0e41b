#include "planet/surface/tiling_noise.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace planet {

namespace {

std::uint32_t wrapped(double cell, int cells) {
    const auto at = static_cast<std::int64_t>(cell) % cells;
    return static_cast<std::uint32_t>(at < 0 ? at + cells : at);
}

double faded(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

double alongGradient(std::uint32_t hash, const glm::dvec2& p) {
    const double a = (hash & 1u) != 0 ? p.x : p.y;
    const double b = (hash & 1u) != 0 ? p.y : p.x;
    return ((hash & 2u) != 0 ? a : -a) + 0.5 * ((hash & 4u) != 0 ? b : -b);
}

}  // namespace

std::uint32_t tilingHash(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    std::uint32_t h = x * 0x8DA6B343u + y * 0xD8163841u + seed * 0x9E3779B9u;
    h = (h ^ (h >> 16)) * 0x7FEB352Du;
    h = (h ^ (h >> 15)) * 0x846CA68Bu;
    return h ^ (h >> 16);
}

double tilingRandom(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    return tilingHash(x, y, seed) / 4294967296.0;
}

double tilingNoise(const glm::dvec2& place, int cells, std::uint32_t seed) {
    const glm::dvec2 at = place * static_cast<double>(cells);
    const glm::dvec2 floor = glm::floor(at);
    const glm::dvec2 inside = at - floor;
    const auto corner = [&](int x, int y) {
        const std::uint32_t hash = tilingHash(wrapped(floor.x + x, cells), wrapped(floor.y + y, cells), seed);
        return alongGradient(hash, inside - glm::dvec2(x, y));
    };
    const double tx = faded(inside.x);
    return glm::mix(glm::mix(corner(0, 0), corner(1, 0), tx), glm::mix(corner(0, 1), corner(1, 1), tx),
                    faded(inside.y));
}

glm::dvec2 tilingNoise2(const glm::dvec2& place, int cells, std::uint32_t seed) {
    return {tilingNoise(place, cells, seed), tilingNoise(place, cells, seed + 7919)};
}

namespace {

// Returns one octave, shifted so that no two lattices coincide.
double octaveOf(const glm::dvec2& place, int cells, int octave, std::uint32_t seed) {
    return tilingNoise(place + static_cast<double>(octave) * glm::dvec2(0.37, 0.61), cells << octave,
                       seed + static_cast<std::uint32_t>(octave));
}

}  // namespace

double tilingFbm(const glm::dvec2& place, int cells, int octaves, std::uint32_t seed) {
    double sum = 0;
    double strength = 1;
    for (int octave = 0; octave < octaves; ++octave, strength /= 2)
        sum += strength * octaveOf(place, cells, octave, seed);
    return sum;
}

double tilingRidges(const glm::dvec2& place, int cells, int octaves, std::uint32_t seed) {
    double sum = 0;
    double strength = 1;
    double total = 0;
    double above = 1;
    for (int octave = 0; octave < octaves; ++octave, strength /= 2) {
        const double noise = octaveOf(place, cells, octave, seed);
        const double ridge = 1 - std::min(1.6 * std::abs(noise), 1.0);
        sum += strength * ridge * ridge * above;
        total += strength;
        above = 0.4 + 0.6 * ridge;
    }
    return sum / total;
}

CellPlace tilingCells(const glm::dvec2& place, int cells, std::uint32_t seed) {
    const glm::dvec2 at = place * static_cast<double>(cells);
    const glm::dvec2 floor = glm::floor(at);
    CellPlace found;
    found.nearest = 1e9;
    double second = 1e9;
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            const std::uint32_t cellX = wrapped(floor.x + x, cells);
            const std::uint32_t cellY = wrapped(floor.y + y, cells);
            const glm::dvec2 point =
                floor + glm::dvec2(x, y) +
                glm::dvec2(tilingRandom(cellX, cellY, seed), tilingRandom(cellX, cellY, seed + 104729));
            const double distance = glm::length(at - point);
            second = std::min(second, std::max(distance, found.nearest));
            if (distance >= found.nearest) continue;
            found.nearest = distance;
            found.offset = at - point;
            found.id = tilingHash(cellX, cellY, seed + 15485863);
        }
    }
    found.toBorder = (second - found.nearest) / 2;
    return found;
}

}  // namespace planet
