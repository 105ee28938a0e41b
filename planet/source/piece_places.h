// The places of a piece of a face's grid. Internal to the library.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "planet/source/height_source_types.h"

namespace planet {

// The places of the samples of a piece, row-major.
struct PiecePlaces {
    std::vector<double> longitudeRad;
    std::vector<double> latitudeRad;
    std::vector<double> ring;          // cos(latitude)
    double spacingRad = 0;             // of the grid that the filter is made for: (pi / 2) / cells
    std::optional<SampleTile> tile{};  // the piece; unset: a single place that lies on no grid
    // A cap of the unit sphere that holds all places.
    glm::dvec3 centre{};
    double radiusRad = 0;
};
}  // namespace planet
