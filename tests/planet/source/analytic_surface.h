// A surface whose heights are known everywhere, the projections in which tests write it as rasters, and what the
// interpolation of such a raster gives at a place.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "planet/source/height_geographic.h"
#include "planet/source/sample_tiles.h"
#include "tests/planet/source/raster_fixture.h"

namespace planet::test {

// Continents, ridges and a peak at a place.
inline Heights terrainAround(double longitudeDeg, double latitudeDeg) {
    return [=](double longitude, double latitude) {
        const double east = std::remainder(longitude - longitudeDeg, 360) * std::cos(latitudeDeg * radPerDeg);
        const double north = latitude - latitudeDeg;
        const double distance = std::hypot(east, north);
        return 900 * std::sin(longitude * radPerDeg * 3) + 500 * std::cos(latitude * radPerDeg * 5) +
               200 * std::sin(9 * east + 4 * north) + 2500 * std::exp(-distance * distance * 20);
    };
}

// A random sample of the finest grid near a place, and where it lies.
struct Probe {
    SampleTile tile;
    double longitudeDeg = 0;
    double latitudeDeg = 0;
};
inline Probe probeAt(double longitudeDeg, double latitudeDeg, int faceCells = finest) {
    const FacePoint point =
        facePointFromDirection(directionFromGeographic({latitudeDeg * radPerDeg, longitudeDeg * radPerDeg}));
    Probe probe{{point.face, faceCells, static_cast<int>(std::lround((point.u + 1) / 2 * faceCells)),
                 static_cast<int>(std::lround((point.v + 1) / 2 * faceCells)), 1, 1}};
    std::array<double, 3> place{};
    GeographicColumns(point.face, faceCells, probe.tile.firstColumn, 1)
        .placesOfRow(probe.tile.firstRow,
                     {std::span(place).first(1), std::span(place).subspan(1, 1), std::span(place).last(1)});
    probe.longitudeDeg = place[0] / radPerDeg;
    probe.latitudeDeg = place[1] / radPerDeg;
    return probe;
}

inline double cubic(double t, const std::array<double, 4>& p) {
    return p[1] + 0.5 * t *
                      (p[2] - p[0] +
                       t * (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3] + t * (3 * (p[1] - p[2]) + p[3] - p[0])));
}

// Interpolates the samples of a grid at a place, in doubles, and gives a bound of what that differs from the function
// they were taken of: the cubic reproduces parabolas, so it is the size of the third differences.
struct Interpolated {
    double height = 0;
    double bound = 0;
};
inline Interpolated interpolated(const SampleGrid& grid, const Crs& crs, std::span<const float> samples,
                                 double longitudeDeg, double latitudeDeg) {
    double x = longitudeDeg;
    double y = latitudeDeg;
    crs.fromDegrees(x, y);
    const double column = (x - grid.x) / grid.step;
    const double row = (grid.y - y) / grid.step;
    const int left = static_cast<int>(std::floor(column)) - 1;
    const int top = static_cast<int>(std::floor(row)) - 1;
    std::array<double, 4> rows{};
    double third = 0;
    const auto thirdOf = [](const std::array<double, 4>& p) {
        return std::abs(p[3] - 3 * p[2] + 3 * p[1] - p[0]);
    };
    for (int j = 0; j < 4; ++j) {
        std::array<double, 4> taps{};
        for (int i = 0; i < 4; ++i)
            taps[static_cast<std::size_t>(i)] = static_cast<double>(
                samples[static_cast<std::size_t>(std::clamp(top + j, 0, grid.height - 1) * grid.width +
                                                 std::clamp(left + i, 0, grid.width - 1))]);
        rows[static_cast<std::size_t>(j)] = cubic(column - left - 1, taps);
        third = std::max(third, thirdOf(taps));
    }
    return {cubic(row - top - 1, rows), third + thirdOf(rows)};
}

struct Projected {
    const char* name;
    int epsg;
    double longitudeDeg;  // of a place that the rasters surround
    double latitudeDeg;
    double metresPerUnit;
};
inline constexpr std::array<Projected, 5> projections = {{{"geographic", 4326, -70.3, -32.6, 111'195},
                                                          {"UTM", 32719, -70.3, -32.6, 1},
                                                          {"Mercator", 3857, 11.2, 46.4, 1},
                                                          {"polar stereographic", 3413, -40.0, 78.0, 1},
                                                          {"equal area", 3035, 14.0, 47.2, 1}}};

// Returns a part of a grid.
inline SampleGrid partOf(const SampleGrid& grid, int column, int row, int width, int height) {
    return {grid.epsg, width, height, grid.x + column * grid.step, grid.y - row * grid.step, grid.step};
}

inline std::vector<float> samplesOfPart(const SampleGrid& grid, std::span<const float> samples, int column,
                                        int row, int width, int height) {
    std::vector<float> part;
    for (int j = row; j < row + height; ++j) {
        const auto from = samples.subspan(static_cast<std::size_t>(j * grid.width + column),
                                          static_cast<std::size_t>(width));
        part.insert(part.end(), from.begin(), from.end());
    }
    return part;
}

}  // namespace planet::test
