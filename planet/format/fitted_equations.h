// The least squares by which weights are fitted to samples, for the encoder of fitted blocks and for the program that trains
// their tables (fitted_tables.h). Internal to fitted_block.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planet/format/fitted_prediction.h"

namespace planet {

// The input of a fit: for each sample of a pass the differences of its known samples from the first of them, and the
// sample's own difference.
struct FitSamples {
    std::size_t terms = 0;  // differences a sample
    std::vector<double> differences;
    std::vector<double> targets;
};

// Reads the samples of a pass. The predictor must have the passes before it, and keeps the samples of this one.
// fine: (2c + 1)^2 samples, row-major.
FitSamples fitSamplesOf(FittedPredictor& predictor, RefinementPass pass, std::span<const std::int16_t> fine,
                        int coarseCells);

// A symmetric system of equations in weights, or in coefficients of directions.
struct NormalEquations {
    std::size_t size = 0;
    std::vector<double> matrix;  // size^2
    std::vector<double> right;

    double& at(std::size_t row, std::size_t column) { return matrix[row * size + column]; }
    double at(std::size_t row, std::size_t column) const { return matrix[row * size + column]; }
};

// Solves the equations by Cholesky's decomposition. Returns nothing if the matrix is not positive definite.
std::optional<std::vector<double>> solved(NormalEquations equations);

// Returns the equations of the change of the weights that makes the residuals least likely to be large. Each sample counts
// by its expected error, and less if its residual is an outlier of Student's t with 5 degrees of freedom (Lange, Little and
// Taylor, "Robust statistical modeling using the t distribution", 1989). weights: one for each difference; expected: one
// for each sample, in steps, >= 0.
NormalEquations robustEquations(const FitSamples& samples, std::span<const double> weights,
                                std::span<const double> expected);

}  // namespace planet
