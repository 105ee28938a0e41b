// Codes a refinement with weights that are fitted to it (fitted_prediction.h): the best of the height codec's codings for
// most terrain, at the price of a slow encoder.
//
// Each pass begins with a row of parameters and a row of coefficients, coded as residuals like the samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/base/result.h"

namespace planet {

// Smaller blocks gain nothing from fits.
inline constexpr int minFittedCells = 8;

// Appends the code of the missing samples. fine: (2c + 1)^2 samples, c in [minFittedCells, 128].
void encodeFitted(std::span<const std::int16_t> fine, int coarseCells, std::vector<std::byte>& out);

// Sets the missing samples of the fine grid. Malicious bytes give an Error or wrong samples.
Result<void> decodeFitted(std::span<const std::byte> coded, std::span<const std::int16_t> coarse,
                          int coarseCells, std::span<std::int16_t> fine);

}  // namespace planet
