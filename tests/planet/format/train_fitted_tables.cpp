// Trains the tables of fitted blocks (planet/format/fitted_tables.h) on terrain of data/, and prints
// planet/format/fitted_table_numbers.h. It prints the same in each run, and takes about 10 s on two cores.
// Usage, in the root of the repository:
//   cmake --build build --target train_fitted_tables
//   build/train_fitted_tables | clang-format > planet/format/fitted_table_numbers.h
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <exception>
#include <string_view>
#include <vector>

#include "planet/format/height_prediction.h"
#include "tests/planet/format/training/error_training.h"
#include "tests/planet/format/training/prediction_training.h"
#include "tests/planet/format/training/training_blocks.h"

namespace {

using namespace planet::training;
using planet::RefinementPass;

constexpr std::string_view beginning =
    R"(// This file holds the numbers of fitted_tables.h. tests/planet/format/train_fitted_tables.cpp prints it: do not edit it.
#pragma once

#include <array>
#include <cstdint>

namespace planet::trained {

)";

std::string_view nameOf(RefinementPass pass) {
    switch (pass) {
        case RefinementPass::Middle:
            return "middle";
        case RefinementPass::OddRow:
            return "oddRow";
        case RefinementPass::OddColumn:
            return "oddColumn";
    }
    return "";
}

void printTable(RefinementPass pass, std::string_view table, std::string_view type,
                const std::vector<std::int32_t>& numbers) {
    fmt::print("inline constexpr auto {}{} = std::to_array<{}>({{{}}});\n\n", nameOf(pass), table, type,
               fmt::join(numbers, ", "));
}

void printTrained(RefinementPass pass, std::vector<TrainingBlock>& blocks) {
    const TrainedPredictions predictions = trainPredictions(pass, blocks);
    printTable(pass, "MeanWeights", "std::int32_t", predictions.meanWeights);
    printTable(pass, "Directions", "std::int32_t", predictions.directions);
    printTable(pass, "CoefficientWidths", "std::uint8_t", predictions.coefficientWidths);
    printTable(pass, "ErrorWeights", "std::int32_t", trainErrorWeights(pass, blocks, predictions.errors));
}

}  // namespace

int main() try {
    std::vector<TrainingBlock> blocks = trainingBlocks();
    fmt::print(stderr, "{} blocks\n", blocks.size());
    fmt::print("{}", beginning);
    for (const RefinementPass pass : planet::allRefinementPasses) printTrained(pass, blocks);
    fmt::print("}}  // namespace planet::trained\n");
} catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
}
