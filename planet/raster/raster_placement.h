// Places the samples of a georeferenced raster on the planet, with PROJ. The geodetic latitude and longitude of
// WGS 84 are taken unchanged as those of the sphere; a raster of another body uses that body's own. Internal
// to the library.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "planet/base/result.h"

namespace planet {

// The grid of a raster: maps (column, row) to the centre of a sample in a reference system, as in
// RasterLayout.
struct RasterGrid {
    std::array<double, 3> x{};
    std::array<double, 3> y{};
    std::string crs;  // WKT
};

// Placements in the same reference system share its transformations. Several threads may call the const functions at once;
// each borrows a transformation of its own.
class RasterPlacement {
public:
    // file: for messages. The Error says that PROJ knows no way from longitude and latitude to the
    // coordinates of the grid.
    static Result<RasterPlacement> make(const std::string& file, const RasterGrid& grid);

    // Convert places, in radians, to positions on the grid and back. All spans of a call have the same
    // length. Positions and places that the projection does not reach are not finite. Longitudes are in
    // [-pi, pi].
    void toGrid(std::span<const double> longitudeRad, std::span<const double> latitudeRad,
                std::span<double> column, std::span<double> row) const;
    void toPlanet(std::span<const double> column, std::span<const double> row, std::span<double> longitudeRad,
                  std::span<double> latitudeRad) const;

    // Returns whether places go through PROJ, which takes long; otherwise the grid is one of degrees.
    bool isProjected() const { return system_ != nullptr; }

    // The number of columns once around the planet, if columns follow the meridians at equal distances, as in a grid of
    // degrees or a cylindrical projection such as Mercator; otherwise 0.
    double columnsAround() const { return columnsAround_; }
    // Returns whether rows follow the parallels at equal distances, as in a grid of degrees, and columns the meridians.
    bool isGeographic() const { return columnsAround_ > 0 && std::isfinite(northRow_); }
    // The row of the north pole and of the south pole of a geographic grid; infinite on others.
    double northRow() const { return northRow_; }
    double southRow() const { return southRow_; }
    // The number of rows in a radian of latitude of a geographic grid.
    double rowsPerRad() const;

private:
    class System;
    class RecentSystems;
    RasterPlacement() = default;

    std::array<double, 3> x_{};
    std::array<double, 3> y_{};
    double perArea_ = 0;              // 1 over the determinant of the grid's steps
    std::shared_ptr<System> system_;  // null: longitude and latitude in degrees
    double columnsAround_ = 0;
    double northRow_ = -std::numeric_limits<double>::infinity();
    double southRow_ = std::numeric_limits<double>::infinity();
};

}  // namespace planet
