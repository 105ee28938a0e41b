#include "tests/planet/format/training/principal_axes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace planet::training {

namespace {

struct Rotation {
    double cosine;
    double sine;

    void turn(double& first, double& second) const {
        const double before = first;
        first = cosine * before - sine * second;
        second = sine * before + cosine * second;
    }
};

// Returns the rotation in the plane of two coordinates that makes their element outside of the diagonal 0.
Rotation rotationOf(const SquareMatrix& a, std::size_t p, std::size_t q) {
    const double theta = (a.at(q, q) - a.at(p, p)) / (2 * a.at(p, q));
    const double tangent = (theta >= 0 ? 1 : -1) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    const double cosine = 1 / std::sqrt(tangent * tangent + 1);
    return {cosine, tangent * cosine};
}

// Rotates once in each plane. Returns the sum of the squares outside of the diagonal, as they were.
double sweep(SquareMatrix& a, SquareMatrix& axes) {
    double sum = 0;
    for (std::size_t p = 0; p < a.size; ++p)
        for (std::size_t q = p + 1; q < a.size; ++q) {
            sum += a.at(p, q) * a.at(p, q);
            if (std::abs(a.at(p, q)) < 1e-15) continue;
            const Rotation rotation = rotationOf(a, p, q);
            for (std::size_t k = 0; k < a.size; ++k) rotation.turn(a.at(k, p), a.at(k, q));
            for (std::size_t k = 0; k < a.size; ++k) rotation.turn(a.at(p, k), a.at(q, k));
            for (std::size_t k = 0; k < a.size; ++k) rotation.turn(axes.at(k, p), axes.at(k, q));
        }
    return sum;
}

}  // namespace

PrincipalAxes principalAxes(SquareMatrix symmetric) {
    SquareMatrix& a = symmetric;
    SquareMatrix turned(a.size);
    for (std::size_t i = 0; i < a.size; ++i) turned.at(i, i) = 1;
    constexpr int mostSweeps = 60;
    for (int i = 0; i < mostSweeps; ++i)
        if (sweep(a, turned) < 1e-20) break;
    std::vector<std::size_t> order(a.size);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return a.at(i, i); });
    PrincipalAxes sorted{{}, SquareMatrix(a.size)};
    for (std::size_t column = 0; column < a.size; ++column) {
        sorted.lengths.push_back(a.at(order[column], order[column]));
        for (std::size_t row = 0; row < a.size; ++row)
            sorted.axes.at(row, column) = turned.at(row, order[column]);
    }
    return sorted;
}

}  // namespace planet::training
