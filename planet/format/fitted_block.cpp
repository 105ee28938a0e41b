#include "planet/format/fitted_block.h"

#include <fmt/format.h>

#include <cassert>
#include <optional>

#include "planet/format/fitted_pass.h"
#include "planet/format/fitted_tables.h"
#include "planet/format/height_pass_decoding.h"

namespace planet {

namespace {

// Reads the parameters of a pass; nothing if they are out of range or the bytes ended.
std::optional<FittedPass> readFittedPass(ResidualDecoder& decoder, RefinementPass pass) {
    ParameterRow row;
    decoder.readRow(parameterWidths, row);
    if (decoder.failed()) return std::nullopt;
    const auto parameter = [&](std::size_t i) { return int{row[i]} + parameterMiddles[i]; };
    FittedPass read{parameter(0), parameter(1), parameter(2), parameter(3), parameter(4), {}};
    if (read.shape < 0 || read.shape >= residualShapeCount || read.errorSet < 0 ||
        read.errorSet >= errorWeightSetCount || read.widthShift < minWidthShift ||
        read.widthShift > maxWidthShift || read.precision < 0 || read.precision > maxCoefficientPrecision ||
        read.coefficientCount < 0 || read.coefficientCount > directionCount(pass))
        return std::nullopt;
    const auto count = static_cast<std::size_t>(read.coefficientCount);
    decoder.readRow(coefficientWidths(pass, read), std::span(read.coefficients).first(count));
    if (decoder.failed()) return std::nullopt;
    return read;
}

bool decodeFittedPass(FittedPredictor& predictor, RefinementPass pass, ResidualDecoder& decoder,
                      int coarseCells, std::span<std::int16_t> fine) {
    const std::optional<FittedPass> parameters = readFittedPass(decoder, pass);
    if (!parameters) return false;
    std::array<std::int32_t, maxPredictionTerms> weights;
    const std::span used = std::span(weights).first(static_cast<std::size_t>(predictionTermCount(pass)));
    fittedWeights(pass, parameters->usedCoefficients(), parameters->precision, used);
    predictor.beginPass(pass);
    predictor.setWeights(used);
    predictor.setErrorWeights(errorWeightSet(pass, parameters->errorSet));
    return decodePassRows(predictor, pass, parameters->widthShift, parameters->shape, decoder, coarseCells,
                          fine);
}

}  // namespace

Result<void> decodeFitted(std::span<const std::byte> coded, std::span<const std::int16_t> coarse,
                          int coarseCells, std::span<std::int16_t> fine) {
    if (coarseCells < minFittedCells)
        return badInput(fmt::format("height block: fitted weights on {} cells; expected at least {}",
                                    coarseCells, minFittedCells));
    FittedPredictor predictor(coarseCells);
    predictor.setCoarse(coarse);
    ResidualDecoder decoder(coded, fittedStates);
    for (const RefinementPass pass : allRefinementPasses) {
        if (decoder.failed() || !decodeFittedPass(predictor, pass, decoder, coarseCells, fine))
            return badInput("height block: fitted data ends early or is damaged");
    }
    if (!decoder.ended())
        return badInput("height block: fitted data is damaged or continues after the last sample");
    return {};
}

}  // namespace planet
