#include "planet/source/piece_places.h"

#include <cmath>
#include <numbers>
#include <span>

#include "planet/source/height_geographic.h"
#include "planet/source/sample_tiles.h"

namespace planet {

namespace {

constexpr double singleRad = 1e-9;  // the spacing around a single place, and the radius of its cap

GeographicPlaces geographicPlacesOf(const SampleTile& piece) {
    const std::size_t count = samplesIn(piece);
    const auto columns = static_cast<std::size_t>(piece.columns);
    GeographicPlaces places{std::vector<double>(count), std::vector<double>(count),
                            std::vector<double>(count)};
    const GeographicColumns grid(piece.face, piece.faceCells, piece.firstColumn, piece.columns);
    for (int row = 0; row < piece.rows; ++row) {
        const std::size_t first = static_cast<std::size_t>(row) * columns;
        grid.placesOfRow(piece.firstRow + row, {std::span(places.longitudeRad).subspan(first, columns),
                                                std::span(places.latitudeRad).subspan(first, columns),
                                                std::span(places.ring).subspan(first, columns)});
    }
    return places;
}

}  // namespace

PiecePlaces::PiecePlaces(const SampleTile& piece)
    : count_(samplesIn(piece)),
      spacingRad_(std::numbers::pi / 2 / filterCellsOf(piece)),
      tile_(piece),
      centre_(directionOf(piece.face, piece.faceCells, piece.firstColumn + piece.columns / 2,
                          piece.firstRow + piece.rows / 2)),
      // A cell of a face is at most 2 / cells radians long, and half the diagonal of a piece has the middle.
      radiusRad_(2.0 / piece.faceCells * std::hypot(piece.columns + 1, piece.rows + 1) / 2) {}

PiecePlaces::PiecePlaces(const Geographic& place)
    : count_(1),
      spacingRad_(singleRad),
      centre_(directionFromGeographic(place)),
      radiusRad_(singleRad),
      geographic_({{place.longitudeRad}, {place.latitudeRad}, {std::cos(place.latitudeRad)}}) {}

const GeographicPlaces& PiecePlaces::geographic() const {
    if (!geographic_) geographic_ = geographicPlacesOf(*tile_);
    return *geographic_;
}

}  // namespace planet
