#include "planet/surface/star_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "planet/sphere/cube_sphere.h"

namespace planet {

namespace {

constexpr int cellsToEdge = 90;  // of the grid, from the middle of a face to its edge
static_assert(starCellRad * cellsToEdge == 1);
constexpr int cellsPerTile = 15;
constexpr int tilesAcross = 2 * cellsToEdge / cellsPerTile;
constexpr float shareWithout = 0.86F;  // of the cells

// Returns an even value in [0, 1).
float hash(glm::vec3 p) {
    p = glm::fract(p * glm::vec3(0.1031F, 0.1030F, 0.0973F));
    p += glm::dot(p, glm::vec3(p.y, p.x, p.z) + 33.33F);
    return glm::fract((p.x + p.y) * p.z);
}

// Returns a unit vector to a place on the grid of a face.
glm::dvec3 directionOfCell(int face, const glm::vec2& cell) {
    const glm::dvec2 place = glm::dvec2(cell) / double{cellsToEdge};
    return sphereFromCube(cubePoint(static_cast<Face>(face), place.x, place.y));
}

void addStar(int face, int column, int row, std::vector<Star>& stars) {
    const glm::vec2 cell(static_cast<float>(column - cellsToEdge), static_cast<float>(row - cellsToEdge));
    const auto random = [&](float seed) {
        return hash(glm::vec3(cell, static_cast<float>(face + 1) * seed));
    };
    const float pick = random(17);
    if (pick < shareWithout) return;
    const glm::vec2 within = glm::vec2(random(31), random(57)) * 0.7F + 0.15F;
    const float magnitude = (pick - shareWithout) / (1 - shareWithout);
    stars.push_back(
        {glm::vec3(directionOfCell(face, cell + within)), 0.02F + 0.55F * std::pow(magnitude, 9.0F)});
}

StarTile tileAt(int face, int column, int row) {
    const auto corner = [&](int right, int up) {
        const glm::vec2 cell(static_cast<float>((column + right) * cellsPerTile - cellsToEdge),
                             static_cast<float>((row + up) * cellsPerTile - cellsToEdge));
        return directionOfCell(face, cell);
    };
    const std::array<glm::dvec3, 4> corners = {corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)};
    StarTile tile;
    for (const glm::dvec3& place : corners) tile.middle += place;
    tile.middle = glm::normalize(tile.middle);
    for (const glm::dvec3& place : corners)
        tile.reachCos = std::min(tile.reachCos, glm::dot(tile.middle, place));
    return tile;
}

}  // namespace

StarField makeStarField() {
    StarField field;
    for (int face = 0; face < faceCount; ++face) {
        for (int place = 0; place < tilesAcross * tilesAcross; ++place) {
            const int column = place % tilesAcross;
            const int row = place / tilesAcross;
            StarTile tile = tileAt(face, column, row);
            tile.first = static_cast<std::uint32_t>(field.stars.size());
            for (int cell = 0; cell < cellsPerTile * cellsPerTile; ++cell)
                addStar(face, column * cellsPerTile + cell % cellsPerTile,
                        row * cellsPerTile + cell / cellsPerTile, field.stars);
            tile.count = static_cast<std::uint32_t>(field.stars.size()) - tile.first;
            field.tiles.push_back(tile);
        }
    }
    return field;
}

std::vector<StarRange> starsInView(const StarField& field, const View& view) {
    const double tanX = std::tan(view.horizontalFovRad / 2);
    const double tanY = tanX * view.heightPx / view.widthPx;
    // Half the angle between opposite corners of the view.
    const double halfCos = 1 / std::sqrt(1 + tanX * tanX + tanY * tanY);
    const double halfSin = std::hypot(tanX, tanY) * halfCos;
    std::vector<StarRange> ranges;
    for (const StarTile& tile : field.tiles) {
        const double reachSin = std::sqrt(1 - tile.reachCos * tile.reachCos);
        if (-glm::dot(tile.middle, view.back) < halfCos * tile.reachCos - halfSin * reachSin) continue;
        if (!ranges.empty() && ranges.back().first + ranges.back().count == tile.first)
            ranges.back().count += tile.count;
        else
            ranges.push_back({tile.first, tile.count});
    }
    return ranges;
}

}  // namespace planet
