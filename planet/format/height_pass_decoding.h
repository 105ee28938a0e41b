// Decodes the rows of a pass of the height codec, with either of its predictors. Internal to the codec.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "planet/format/height_residual_coder.h"
#include "planet/format/height_rows.h"

namespace planet {

// Decodes a pass that the predictor has begun, and fills its samples of the fine grid; returns false if the bytes end early.
// Predictor: RefinementPredictor or FittedPredictor. shape: of the residuals, [0, residualShapeCount).
template <class Predictor>
bool decodePassRows(Predictor& predictor, RefinementPass pass, int widthShift, int shape,
                    ResidualDecoder& decoder, int coarseCells, std::span<std::int16_t> fine) {
    RowBuffers row(passColumns(pass, coarseCells));
    const std::span predicted = row.predicted();
    const std::span residuals = row.residuals();
    const std::span samples = row.samples();
    for (int y = 0; y < passRows(pass, coarseCells); ++y) {
        predictor.predictRow(y, predicted);
        predictor.expectErrors(y, row.expected256());
        residualWidths(row.expected256(), widthShift, row.widths());
        decoder.readRow(row.widths(), residuals, shape);
        if (decoder.failed()) return false;
        std::int16_t* const out = fine.data() + rowStart(pass, y, coarseCells);
        for (std::size_t x = 0; x < samples.size(); ++x) {
            samples[x] = static_cast<std::int16_t>(predicted[x] + residuals[x]);
            out[2 * x] = samples[x];
        }
        predictor.setErrors(y, residuals);
        predictor.setSamples(y, samples);
    }
    return true;
}

}  // namespace planet
