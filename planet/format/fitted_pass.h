// The parameters of a pass of a fitted block, as they are coded. Internal to fitted_block.h.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/format/fitted_prediction.h"
#include "planet/format/fitted_tables.h"
#include "planet/format/height_residual_coder.h"
#include "planet/format/height_rows.h"

namespace planet {

// The number of states of the entropy coder: another one would take 8 bytes of each block.
inline constexpr int fittedStates = 1;

struct FittedPass {
    int shape = defaultResidualShape;  // of the residuals' distributions
    int errorSet = 0;
    int widthShift = 0;        // in [minWidthShift, maxWidthShift]
    int precision = 0;         // coefficients are multiples of 2^-precision; [0, maxCoefficientPrecision]
    int coefficientCount = 0;  // those after these are 0
    std::array<std::int16_t, maxPredictionTerms> coefficients{};

    std::span<const std::int16_t> usedCoefficients() const {
        return std::span(coefficients).first(static_cast<std::size_t>(coefficientCount));
    }
};

// The row of parameters: each one relative to a value in the middle of its usual ones, with the width of their spread.
inline constexpr std::size_t parameterCount = 5;
using ParameterRow = std::array<std::int16_t, parameterCount>;
inline constexpr std::array<std::int16_t, parameterCount> parameterMiddles = {1, 3, 0, 0, 5};
inline constexpr std::array<std::uint8_t, parameterCount> parameterWidths = {
    residualWidthOfOne, residualWidthOfOne + 4, residualWidthOfOne + 4, residualWidthOfOne,
    residualWidthOfOne + 9};

// Returns the widths of the first coefficients.
inline std::vector<std::uint8_t> coefficientWidths(RefinementPass pass, const FittedPass& parameters) {
    const auto count = static_cast<std::size_t>(parameters.coefficientCount);
    std::vector<std::uint8_t> widths(count);
    for (std::size_t i = 0; i < count; ++i)
        widths[i] =
            static_cast<std::uint8_t>(fittedTables(pass).coefficientWidths[i] + 4 * parameters.precision);
    return widths;
}

}  // namespace planet
