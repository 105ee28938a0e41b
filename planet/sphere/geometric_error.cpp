#include "planet/sphere/geometric_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace planet {

namespace {

// Returns the largest squared distance along a row between vertices first, first + 2, ... and the middles of
// their two neighbours, which are `offset` elements before and after them.
double largestSquaredGap(const GeometricErrorScratch& scratch, std::size_t row, std::size_t side,
                         std::size_t first, std::size_t offset) {
    const auto gapAlong = [offset](const double* at) { return *at - (*(at - offset) + *(at + offset)) / 2; };
    double largest = 0;
    for (std::size_t i = first; i < side; i += 2) {
        const std::size_t at = row * side + i;
        const double x = gapAlong(scratch.x.data() + at);
        const double y = gapAlong(scratch.y.data() + at);
        const double z = gapAlong(scratch.z.data() + at);
        largest = std::max(largest, x * x + y * y + z * z);
    }
    return largest;
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
        const double v = square.v + step * static_cast<double>(j);
        const double vSquared = v * v;
        const double vRoot = std::sqrt(0.5 - vSquared / 6);
        heights.subspan(j * side, side).copyTo(scratch.row);
        const std::int32_t* const steps = scratch.row.data();
        double* const x = scratch.x.data() + j * side;
        double* const y = scratch.y.data() + j * side;
        double* const z = scratch.z.data() + j * side;
        for (std::size_t i = 0; i < side; ++i) {
            const double u = scratch.u[i];
            const double radius = base + shape.quantumM * steps[i];
            x[i] = radius * u * vRoot;
            y[i] = radius * v * scratch.uRoot[i];
            z[i] = radius * std::sqrt(1 - (u * u + vSquared) / 2 + u * u * vSquared / 3);
        }
    }
}

double geometricErrorM(const PlanetShape& shape, const ChunkId& chunk, StepsView refined,
                       GeometricErrorScratch& scratch) {
    const auto side = static_cast<std::size_t>(2 * chunkCells(shape) + 1);
    assert(refined.size() == side * side);
    facePositions(shape, faceSquareOf(chunk), side, refined, scratch);
    double largest = 0;
    for (std::size_t row = 0; row < side; ++row) {
        if (row % 2 == 0) {
            largest = std::max(largest, largestSquaredGap(scratch, row, side, 1, 1));  // on a west-east edge
        } else {
            largest =
                std::max(largest, largestSquaredGap(scratch, row, side, 0, side));  // on a south-north edge
            largest =
                std::max(largest, largestSquaredGap(scratch, row, side, 1, side + 1));  // on the diagonal
        }
    }
    return std::sqrt(largest);
}

float roundedUp(double value) {
    const auto nearest = static_cast<float>(value);
    return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

}  // namespace planet
