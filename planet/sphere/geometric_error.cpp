#include "planet/sphere/geometric_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "planet/base/cpu_clones.h"

namespace planet {

namespace {

// Returns the largest squared distance of vertices first, first + step, ... before `end` from the middles of their two
// neighbours, which are `offset` elements before and after them.
PLANET_ALWAYS_INLINE double largestSquaredGap(const double* x, const double* y, const double* z,
                                              std::size_t first, std::size_t end, std::size_t step,
                                              std::size_t offset) {
    double largest = 0;
    for (std::size_t at = first; at < end; at += step) {
        const double dx = x[at] - (x[at - offset] + x[at + offset]) / 2;
        const double dy = y[at] - (y[at - offset] + y[at + offset]) / 2;
        const double dz = z[at] - (z[at - offset] + z[at + offset]) / 2;
        largest = std::max(largest, dx * dx + dy * dy + dz * dz);
    }
    return largest;
}

// Returns the same for all vertices that a chunk lacks. Its grid begins at index `start` of a grid with rows of `side`
// vertices, and takes every stride-th row and column; it has `cells` + 1 of both.
PLANET_ALWAYS_INLINE double largestSquaredGapOfChunk(const GeometricErrorScratch& grid, std::size_t side,
                                                     std::size_t start, std::size_t stride,
                                                     std::size_t cells) {
    const double* const x = grid.x.data();
    const double* const y = grid.y.data();
    const double* const z = grid.z.data();
    double largest = 0;
    for (std::size_t row = 0; row <= cells; ++row) {
        const std::size_t west = start + row * stride * side;
        const std::size_t end = west + cells * stride + 1;
        if (row % 2 == 0) {
            // On a west-east edge.
            largest = std::max(largest, largestSquaredGap(x, y, z, west + stride, end, 2 * stride, stride));
        } else {
            // On a south-north edge, and on the diagonal.
            largest = std::max(largest, largestSquaredGap(x, y, z, west, end, 2 * stride, stride * side));
            largest = std::max(
                largest, largestSquaredGap(x, y, z, west + stride, end, 2 * stride, stride * side + stride));
        }
    }
    return largest;
}

PLANET_CPU_CLONES double largestSquaredGapOfFinest(const GeometricErrorScratch& grid, std::size_t side,
                                                   std::size_t start, std::size_t cells) {
    return largestSquaredGapOfChunk(grid, side, start, 1, cells);
}

// Fills a row of positions.
PLANET_CPU_CLONES void fillPositions(const double* __restrict us, const double* __restrict uRoots,
                                     const std::int32_t* __restrict steps, std::size_t count, double v,
                                     double base, double quantumM, double* __restrict x, double* __restrict y,
                                     double* __restrict z) {
    const double vSquared = v * v;
    const double vRoot = std::sqrt(0.5 - vSquared / 6);
    for (std::size_t i = 0; i < count; ++i) {
        const double u = us[i];
        const double radius = base + quantumM * steps[i];
        x[i] = radius * u * vRoot;
        y[i] = radius * v * uRoots[i];
        z[i] = radius * std::sqrt(1 - (u * u + vSquared) / 2 + u * u * vSquared / 3);
    }
}

}  // namespace

void facePositions(const PlanetShape& shape, const FaceSquare& square, std::size_t side, StepsView heights,
                   GeometricErrorScratch& scratch) {
    assert(heights.size() == side * side);
    const double step = square.side / static_cast<double>(side - 1);
    for (std::vector<double>* grid : {&scratch.x, &scratch.y, &scratch.z}) grid->resize(side * side);
    scratch.u.resize(side);
    scratch.uRoot.resize(side);
    scratch.row.resize(side);
    for (std::size_t i = 0; i < side; ++i) {
        const double u = square.u + step * static_cast<double>(i);
        scratch.u[i] = u;
        scratch.uRoot[i] = std::sqrt(0.5 - u * u / 6);
    }
    const double base = shape.radiusM + shape.baseHeightM;
    for (std::size_t j = 0; j < side; ++j) {
        heights.subspan(j * side, side).copyTo(scratch.row);
        fillPositions(scratch.u.data(), scratch.uRoot.data(), scratch.row.data(), side,
                      square.v + step * static_cast<double>(j), base, shape.quantumM,
                      scratch.x.data() + j * side, scratch.y.data() + j * side, scratch.z.data() + j * side);
    }
}

double geometricErrorM(const PlanetShape& shape, const ChunkId& chunk, StepsView refined,
                       GeometricErrorScratch& scratch) {
    const auto side = static_cast<std::size_t>(2 * chunkCells(shape) + 1);
    assert(refined.size() == side * side);
    facePositions(shape, faceSquareOf(chunk), side, refined, scratch);
    return geometricErrorOnGridM(scratch, side, {0, 0, 1, side - 1});
}

double geometricErrorOnGridM(const GeometricErrorScratch& positions, std::size_t side,
                             const RefinedSquare& square) {
    assert(square.firstColumn + square.cells * square.stride < side);
    const std::size_t start = square.firstRow * side + square.firstColumn;
    return std::sqrt(square.stride == 1
                         ? largestSquaredGapOfFinest(positions, side, start, square.cells)
                         : largestSquaredGapOfChunk(positions, side, start, square.stride, square.cells));
}

float roundedUp(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

}  // namespace planet
