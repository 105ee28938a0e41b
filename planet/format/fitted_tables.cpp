#include "planet/format/fitted_tables.h"

#include <array>
#include <cassert>
#include <cstddef>

#include "planet/format/fitted_prediction.h"
#include "planet/format/fitted_table_numbers.h"

namespace planet {

namespace {

constexpr std::array<FittedTables, allRefinementPasses.size()> tablesOfPass = {{
    {trained::middleMeanWeights, trained::middleDirections, trained::middleCoefficientWidths,
     trained::middleErrorWeights},
    {trained::oddRowMeanWeights, trained::oddRowDirections, trained::oddRowCoefficientWidths,
     trained::oddRowErrorWeights},
    {trained::oddColumnMeanWeights, trained::oddColumnDirections, trained::oddColumnCoefficientWidths,
     trained::oddColumnErrorWeights},
}};

constexpr int directionBits = 4;  // of the directions below those of the weights

}  // namespace

const FittedTables& fittedTables(RefinementPass pass) {
    return tablesOfPass[static_cast<std::size_t>(pass)];
}

int directionCount(RefinementPass pass) {
    return static_cast<int>(fittedTables(pass).coefficientWidths.size());
}

void fittedWeights(RefinementPass pass, std::span<const std::int16_t> coefficients, int precision,
                   std::span<std::int32_t> weights) {
    const FittedTables& tables = fittedTables(pass);
    const std::size_t directions = tables.coefficientWidths.size();
    assert(coefficients.size() <= directions && weights.size() == directions + 1);
    const int shift = directionBits + precision;
    // Unsigned, because hostile coefficients may overflow.
    std::uint32_t rest = 1u << fittedWeightBits;
    for (std::size_t i = 0; i < directions; ++i) {
        const std::int32_t* const row = tables.directions.data() + i * directions;
        std::uint32_t sum = 1u << (shift - 1);
        for (std::size_t j = 0; j < coefficients.size(); ++j)
            sum += static_cast<std::uint32_t>(row[j]) * static_cast<std::uint32_t>(int{coefficients[j]});
        const auto change = static_cast<std::uint32_t>(static_cast<std::int32_t>(sum) >> shift);
        const std::uint32_t weight = static_cast<std::uint32_t>(tables.meanWeights[i]) + change;
        weights[i + 1] = static_cast<std::int32_t>(weight);
        rest -= weight;
    }
    weights[0] = static_cast<std::int32_t>(rest);
}

std::span<const std::int32_t> errorWeightSet(RefinementPass pass, int set) {
    const std::span all = fittedTables(pass).errorWeights;
    const auto terms = static_cast<std::size_t>(errorTermCount(pass));
    return all.subspan(static_cast<std::size_t>(set) * terms, terms);
}

}  // namespace planet
