// The invented stars behind a planet. They are fixed to the world's axes. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "planet/sphere/view.h"

namespace planet {

// The side of a cell of the grid that stars lie in, in the middle of a face.
inline constexpr float starCellRad = 1.0F / 90;

struct Star {
    glm::vec3 direction{0};  // unit vector
    float light = 0;         // at its centre, of a white level square in full sun
};

// The stars of one square of a cube's face.
struct StarTile {
    glm::dvec3 middle{0};  // unit vector
    double reachCos = 1;   // cosine of the angle from the middle to the farthest corner
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

struct StarField {
    std::vector<Star> stars;  // tile by tile
    std::vector<StarTile> tiles;
};

// Returns about 27,000 stars, always the same. Each lies in a cell of its own of a grid on the cube's faces, at
// least 0.15 cells from the cell's border. Nowell's mapping to the sphere (cube_sphere.h) keeps them evenly spread.
StarField makeStarField();

// A run of stars.
struct StarRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

// Returns the runs of stars whose tiles the view may show, in order. Runs that touch are joined.
std::vector<StarRange> starsInView(const StarField& field, const View& view);

}  // namespace planet
