// The places of a piece of a face's grid. Internal to the library.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "planet/source/height_source_types.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

// Places on the planet, and the cosines of their latitudes.
struct GeographicPlaces {
    std::vector<double> longitudeRad;
    std::vector<double> latitudeRad;
    std::vector<double> ring;  // cos(latitude)
};

// The places of the samples of a piece, row-major, or a single place that lies on no grid. Each thread has its own.
class PiecePlaces {
public:
    explicit PiecePlaces(const SampleTile& piece);
    explicit PiecePlaces(const Geographic& place);

    std::size_t count() const { return count_; }
    // Computes the places at the first call. Most places of a raster in a projection are interpolated without them
    // (place_lattice.h).
    const GeographicPlaces& geographic() const;

    // The spacing of the grid that the filter is made for: (pi / 2) / cells.
    double spacingRad() const { return spacingRad_; }
    // The piece; unset: a single place.
    const std::optional<SampleTile>& tile() const { return tile_; }
    // A cap of the unit sphere that holds all places.
    const glm::dvec3& centre() const { return centre_; }
    double radiusRad() const { return radiusRad_; }

private:
    std::size_t count_ = 0;
    double spacingRad_ = 0;
    std::optional<SampleTile> tile_;
    glm::dvec3 centre_{};
    double radiusRad_ = 0;
    mutable std::optional<GeographicPlaces> geographic_;
};

}  // namespace planet
