// Makes terrain by fault formation: soft steps across random planes.
//
// Heights are summed in integers of 2^-16 m, so that faults far from a piece can be summed once, and the sum
// does not depend on which faults these are.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "planet/source/terrain_sources.h"

namespace planet {

namespace {

constexpr double unitsPerM = 65536;
constexpr double reachW = 12;       // at this many widths a soft step ends: e^-12 / 2 is 3e-6
constexpr int faultPieceSide = 33;  // samples per side of a piece that shares its far faults
constexpr double rangeRms = 5;      // with many faults, less than one in a million places exceeds it

struct Fault {
    glm::dvec3 normal;       // of the plane; the ground beyond it is raised
    double latitudeRad = 0;  // of the circle that the plane cuts, with the normal as the pole
    std::int64_t delta = 0;  // units
};

double latitudeOf(const glm::dvec3& normal, const glm::dvec3& direction) {
    return std::asin(std::clamp(glm::dot(normal, direction), -1.0, 1.0));
}

// Returns random planes with a uniform distribution of normals over the sphere and of distances from the
// centre, so that every place is equally likely to be cut. If planes passed through the centre, each half
// would be the negative of the other.
std::vector<Fault> faultsOf(const FaultTerrain& terrain) {
    std::vector<Fault> faults;
    std::uint64_t state = scrambled64(terrain.seed);
    const auto next = [&] { return unitOf(state = scrambled64(state)); };
    for (int i = 0; i < terrain.count; ++i) {
        const double z = 2 * next() - 1;
        const double longitude = 2 * std::numbers::pi * next();
        const double ring = std::sqrt(1 - z * z);
        const double sine = 2 * next() - 1;
        faults.push_back({{ring * std::cos(longitude), ring * std::sin(longitude), z},
                          std::asin(sine),
                          std::llround(faultDeltaM(terrain, i) * unitsPerM)});
    }
    return faults;
}

// Returns the share of a fault's step at an arc beyond it, in units of w.
double softStep(double widths) {
    return widths < 0 ? 0.5 * std::exp(widths) : 1 - 0.5 * std::exp(-widths);
}

struct Faults {
    std::vector<Fault> all;
    double smoothRad = 0;
    double baseM = 0;  // height of a place below all faults
    double minM = 0;
    double maxM = 0;

    double widthRad(int filterCells) const { return std::max(smoothRad, gridStepRad(filterCells) / 2); }
};

struct NearFaults {
    std::int64_t farUnits = 0;  // sum of all other faults
    std::vector<const Fault*> near;
};

NearFaults nearFaults(const Faults& faults, const glm::dvec3& middle, double radiusRad, double widthRad) {
    NearFaults result;
    const double reachRad = radiusRad + reachW * widthRad + 1e-9;
    for (const Fault& fault : faults.all) {
        const double pastRad = latitudeOf(fault.normal, middle) - fault.latitudeRad;
        if (std::abs(pastRad) <= reachRad) {
            result.near.push_back(&fault);
        } else if (pastRad > 0) {
            result.farUnits += fault.delta;
        }
    }
    return result;
}

std::int64_t unitsAt(const NearFaults& faults, const glm::dvec3& direction, double widthRad) {
    std::int64_t units = faults.farUnits;
    for (const Fault* fault : faults.near) {
        const double widths = (latitudeOf(fault->normal, direction) - fault->latitudeRad) / widthRad;
        if (widths >= reachW) {
            units += fault->delta;
        } else if (widths > -reachW) {
            units += std::llround(static_cast<double>(fault->delta) * softStep(widths));
        }
    }
    return units;
}

Result<void> samplePiece(const Faults& faults, const SampleTile& piece, float* out, std::size_t stride) {
    const auto directionAt = [&](int column, int row) {
        return directionOf(piece.face, piece.faceCells, piece.firstColumn + column, piece.firstRow + row);
    };
    const int lastColumn = piece.columns - 1, lastRow = piece.rows - 1;
    const glm::dvec3 middle = glm::normalize(directionAt(0, 0) + directionAt(lastColumn, lastRow) +
                                             directionAt(lastColumn, 0) + directionAt(0, lastRow));
    // A grid step covers at most 2 / faceCells radians along each axis.
    const double radiusRad =
        std::min(std::numbers::pi, 2.0 * (std::max(lastColumn, 1) + std::max(lastRow, 1)) / piece.faceCells);
    const double widthRad = faults.widthRad(filterCellsOf(piece));
    const NearFaults near = nearFaults(faults, middle, radiusRad, widthRad);
    for (int row = 0; row < piece.rows; ++row) {
        for (int column = 0; column < piece.columns; ++column) {
            const auto units = static_cast<double>(unitsAt(near, directionAt(column, row), widthRad));
            out[static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column)] =
                static_cast<float>(std::clamp(faults.baseM + units / unitsPerM, faults.minM, faults.maxM));
        }
    }
    return {};
}

}  // namespace

HeightSource faultSource(const FaultTerrain& terrain) {
    Faults faults;
    faults.all = faultsOf(terrain);
    faults.smoothRad = radFromDeg(terrain.smoothDeg);
    double sumM = 0, squares = 0;
    for (int i = 0; i < terrain.count; ++i) {
        const double deltaM = faultDeltaM(terrain, i);
        sumM += deltaM;
        squares += deltaM * deltaM;
    }
    // Each fault raises or lowers a place by half its step, so the root mean square of the sum is at most
    // this half.
    const double reachM = std::min(sumM / 2, rangeRms * std::sqrt(squares) / 2);
    faults.baseM = terrain.offsetM - sumM / 2;
    faults.minM = terrain.offsetM - reachM;
    faults.maxM = terrain.offsetM + reachM;
    const TerrainExtent extent{naturalCells(faults.smoothRad), faults.minM, faults.maxM};
    return pieceSource(terrain, extent, faultPieceSide, std::move(faults), samplePiece);
}

}  // namespace planet
