// Finds the principal axes of a symmetric matrix.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace planet::training {

struct SquareMatrix {
    std::size_t size = 0;
    std::vector<double> values;  // row-major

    explicit SquareMatrix(std::size_t rows) : size(rows), values(rows * rows) {}
    SquareMatrix(std::size_t rows, std::vector<double> all) : size(rows), values(std::move(all)) {}
    double& at(std::size_t row, std::size_t column) { return values[row * size + column]; }
    double at(std::size_t row, std::size_t column) const { return values[row * size + column]; }
};

struct PrincipalAxes {
    std::vector<double> lengths;  // the eigenvalues, the largest first
    SquareMatrix axes;            // the eigenvector of each, in its column
};

// Turns the matrix by cyclic Jacobi rotations (Golub and Van Loan, "Matrix Computations").
PrincipalAxes principalAxes(SquareMatrix symmetric);

}  // namespace planet::training
