#include "planet/format/fitted_block.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "planet/format/fitted_pass.h"
#include "planet/format/fitted_prediction.h"
#include "planet/format/fitted_tables.h"
#include "planet/format/height_codec.h"
#include "tests/support/earth_windows.h"

namespace planet {
namespace {

using test::Square;
using testing::Each;
using testing::HasSubstr;
using testing::Lt;

using Weights = std::vector<std::int32_t>;

Weights weightsWith(RefinementPass pass, std::span<const std::int16_t> coefficients, int precision = 0) {
    Weights weights(static_cast<std::size_t>(predictionTermCount(pass)));
    fittedWeights(pass, coefficients, precision, weights);
    return weights;
}

std::vector<std::int16_t> levelGrid(int cells, int step) {
    return std::vector<std::int16_t>(static_cast<std::size_t>((cells + 1) * (cells + 1)),
                                     static_cast<std::int16_t>(step));
}

TEST(FittedPrediction, WeightsSumToOneWhateverTheCoefficients) {
    std::mt19937 random(5);
    for (const RefinementPass pass : allRefinementPasses) {
        for (int trial = 0; trial < 50; ++trial) {
            std::vector<std::int16_t> coefficients(random() %
                                                   static_cast<unsigned>(directionCount(pass) + 1));
            // Every other trial is hostile.
            for (std::int16_t& coefficient : coefficients)
                coefficient = static_cast<std::int16_t>(trial % 2 ? random() : random() % 41 - 20);
            std::uint32_t sum = 0;
            for (const std::int32_t weight :
                 weightsWith(pass, coefficients, trial % (maxCoefficientPrecision + 1)))
                sum += static_cast<std::uint32_t>(weight);
            EXPECT_EQ(sum, 1u << fittedWeightBits);
        }
    }
}

TEST(FittedPrediction, WithoutCoefficientsOnlyTheMeanWeightsCount) {
    for (const RefinementPass pass : allRefinementPasses) {
        const Weights weights = weightsWith(pass, {});
        const auto mean = fittedTables(pass).meanWeights;
        EXPECT_TRUE(std::equal(weights.begin() + 1, weights.end(), mean.begin(), mean.end()));
    }
}

TEST(FittedPrediction, TheTablesHaveOneRowForEachSampleAndOneWeightForEachTerm) {
    for (const RefinementPass pass : allRefinementPasses) {
        const FittedTables& tables = fittedTables(pass);
        const auto directions = static_cast<std::size_t>(directionCount(pass));
        EXPECT_EQ(static_cast<std::size_t>(predictionTermCount(pass)), directions + 1);
        EXPECT_EQ(tables.meanWeights.size(), directions);
        EXPECT_EQ(tables.directions.size(), directions * directions);
        EXPECT_EQ(tables.errorWeights.size(),
                  static_cast<std::size_t>(errorWeightSetCount * errorTermCount(pass)));
        EXPECT_THAT(tables.coefficientWidths, Each(Lt(residualWidthCount)));
    }
}

TEST(FittedPrediction, LevelGroundIsPredictedWithoutAnExpectedError) {
    constexpr int cells = 16;
    for (const int step : {-32768, -7, 0, 8848, 32767}) {
        FittedPredictor predictor(cells);
        predictor.setCoarse(levelGrid(cells, step));
        for (const RefinementPass pass : allRefinementPasses) {
            const auto columns = static_cast<std::size_t>(passColumns(pass, cells));
            predictor.beginPass(pass);
            predictor.setWeights(weightsWith(pass, {}));
            std::vector<std::int16_t> predicted(columns);
            std::vector<float> expected(columns);
            for (int row = 0; row < passRows(pass, cells); ++row) {
                predictor.predictRow(row, predicted);
                EXPECT_THAT(predicted, Each(step));
                for (int set = 0; set < errorWeightSetCount; ++set) {
                    predictor.setErrorWeights(errorWeightSet(pass, set));
                    predictor.expectErrors(row, expected);
                    EXPECT_THAT(expected, Each(0.0f));
                }
                predictor.setErrors(row, std::vector<std::int16_t>(columns));
                predictor.setSamples(row, predicted);
            }
        }
    }
}

// One error of 64 steps on level ground: the sample below it expects the weight of its term times 64.
TEST(FittedPrediction, OneErrorIsExpectedAgainBelowAndNowhereFar) {
    constexpr int cells = 16;
    constexpr int termOfErrorAbove = 2;
    constexpr RefinementPass pass = RefinementPass::Middle;
    FittedPredictor predictor(cells);
    predictor.setCoarse(levelGrid(cells, 100));
    predictor.beginPass(pass);
    std::vector<std::int16_t> errors(cells);
    errors[5] = -64;
    predictor.setErrors(0, errors);
    for (int set = 0; set < errorWeightSetCount; ++set) {
        const auto weights = errorWeightSet(pass, set);
        predictor.setErrorWeights(weights);
        std::vector<float> expected256(cells);
        predictor.expectErrors(1, expected256);
        EXPECT_EQ(expected256[5], 64 * 256.0f * static_cast<float>(weights[termOfErrorAbove]) / 1024);
        EXPECT_EQ(expected256[2], 0);
        EXPECT_EQ(expected256[8], 0);
    }
}

// Rows that repeat their upper neighbour: the mean weights blur them, and fitted ones do not.
TEST(FittedBlock, GroundOfDoubledRowsCostsAFifthLessThanWithFixedWeights) {
    constexpr int cells = 32;
    std::mt19937 random(3);
    std::vector<std::int32_t> fine;
    std::vector<std::int32_t> row(2 * cells + 1);
    for (int y = 0; y <= 2 * cells; ++y) {
        if (y % 2 == 0) {
            int height = 0;
            for (std::int32_t& step : row) step = height += static_cast<int>(random() % 61) - 30;
        }
        fine.insert(fine.end(), row.begin(), row.end());
    }
    std::vector<std::byte> fixed;
    std::vector<std::byte> fitted;
    encodeRefinement(fine, cells, defaultCompressionLevel, 0, fixed);
    encodeRefinement(fine, cells, maxCompressionLevel, 0, fitted);
    EXPECT_LT(5 * fitted.size(), 4 * fixed.size());
}

TEST(FittedBlock, EarthTakesAtLeastFivePerCentLessThanWithFixedWeights) {
    const Square window = test::earthWindow(2600, 400, 257);
    std::vector<std::byte> fixed;
    std::vector<std::byte> fitted;
    for (const test::Block& block : test::pyramidBlocks(window, 32)) {
        encodeRefinement(block.fine.samples, 32, defaultCompressionLevel, 0, fixed);
        encodeRefinement(block.fine.samples, 32, maxCompressionLevel, 0, fitted);
    }
    EXPECT_LT(static_cast<double>(fitted.size()), 0.95 * static_cast<double>(fixed.size()));
}

// A block whose passes have these parameters and no residuals.
std::vector<std::byte> blockWith(int cells, const ParameterRow& parameters) {
    ResidualEncoder encoder(4000, fittedStates);
    for (const RefinementPass pass : allRefinementPasses) {
        encoder.addRow(parameters, parameterWidths);
        const auto count = static_cast<std::size_t>(std::max(0, parameters[4] + parameterMiddles[4]));
        const auto widths = fittedTables(pass).coefficientWidths;
        encoder.addRow(std::vector<std::int16_t>(std::min(count, widths.size())),
                       widths.first(std::min(count, widths.size())));
        const auto columns = static_cast<std::size_t>(passColumns(pass, cells));
        for (int row = 0; row < passRows(pass, cells); ++row)
            encoder.addRow(std::vector<std::int16_t>(columns), std::vector<std::uint8_t>(columns));
    }
    std::vector<std::byte> bytes;
    encoder.finish(bytes);
    return bytes;
}

Result<void> decoded(int cells, const std::vector<std::byte>& coded) {
    std::vector<std::int16_t> fine(static_cast<std::size_t>((2 * cells + 1) * (2 * cells + 1)));
    return decodeFitted(coded, levelGrid(cells, 3), cells, fine);
}

TEST(FittedBlock, ParametersOutOfRangeAreRefused) {
    ASSERT_TRUE(decoded(16, blockWith(16, {})));
    const auto relative = [](std::size_t parameter, int value) {
        ParameterRow row{};
        row[parameter] = static_cast<std::int16_t>(value - parameterMiddles[parameter]);
        return row;
    };
    for (const ParameterRow& bad :
         {relative(0, -1), relative(0, residualShapeCount), relative(1, -1), relative(1, errorWeightSetCount),
          relative(2, minWidthShift - 1), relative(2, maxWidthShift + 1), relative(3, -1),
          relative(3, maxCoefficientPrecision + 1), relative(4, -1), relative(4, 24)}) {
        const auto result = decoded(16, blockWith(16, bad));
        ASSERT_FALSE(result);
        EXPECT_THAT(result.error().message, HasSubstr("fitted data ends early or is damaged"));
    }
}

TEST(FittedBlock, SmallBlocksAreRefused) {
    const auto result = decoded(4, blockWith(4, {}));
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().message, HasSubstr("4 cells; expected at least 8"));
}

TEST(FittedBlock, BytesCutShortAnywhereAreRefused) {
    const Square fine = test::earthWindow(2200, 500, 33);
    const std::vector<std::int16_t> samples(fine.samples.begin(), fine.samples.end());
    std::vector<std::byte> good;
    encodeFitted(samples, 16, good);
    std::vector<std::int16_t> coarse;
    for (std::size_t y = 0; y < 33; y += 2)
        for (std::size_t x = 0; x < 33; x += 2) coarse.push_back(samples[y * 33 + x]);
    std::vector<std::int16_t> room(samples.size());
    ASSERT_TRUE(decodeFitted(good, coarse, 16, room));
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(decodeFitted(std::span(good).first(size), coarse, 16, room)) << size << " bytes";
}

TEST(FittedBlock, HostileBytesGiveAnErrorOrSamples) {
    std::mt19937 random(11);
    const Square fine = test::earthWindow(2200, 500, 33);
    std::vector<std::int16_t> samples(fine.samples.begin(), fine.samples.end());
    std::vector<std::byte> good;
    encodeFitted(samples, 16, good);
    for (int trial = 0; trial < 500; ++trial) {
        std::vector<std::byte> bytes = good;
        for (unsigned i = 0; i <= random() % 4; ++i)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        if (trial % 3 == 0) bytes.resize(random() % bytes.size());
        if (trial % 3 == 1)
            for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
        const auto result = decoded(16, bytes);
        if (!result) {
            EXPECT_THAT(result.error().message, HasSubstr("height block: fitted"));
        }
    }
}

}  // namespace
}  // namespace planet
