// Predicts the samples that a refinement adds, for the height codec.
//
// The missing samples of a fine grid of (2c + 1)^2 come in three passes. Each one uses all passes before it:
//
//   K s K s K     K  known, the coarse grid: (c + 1)^2
//   r m r m r     m  Middle: odd row, odd column, c^2, from the coarse samples around
//   K s K s K     r  OddRow: odd row, even column, c x (c + 1), from two coarse samples and two middles
//   r m r m r     s  OddColumn: even row, odd column, (c + 1) x c, from those and four of OddRow
//   K s K s K
//
// A pass does not use samples of the same row, so a whole row is predicted at once. The prediction is a
// weighted sum of samples. The expected size of its error is a weighted sum of the errors nearby and of the
// surface's curvature. Only integers are used, so the results are bit-identical on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace planet {

enum class RefinementPass : std::uint8_t { Middle, OddRow, OddColumn };
inline constexpr std::array allRefinementPasses = {RefinementPass::Middle, RefinementPass::OddRow,
                                                   RefinementPass::OddColumn};

// Return the numbers of rows and columns of a pass. coarseCells: cells per side of the coarse grid.
int passRows(RefinementPass pass, int coarseCells);
int passColumns(RefinementPass pass, int coarseCells);

// The number of predictors of a pass.
inline constexpr int refinementPredictorCount = 8;

// A plane of integers with a border of two cells on every side: rows and columns start at -2.
struct BorderedPlane {
    static constexpr int border = 2;
    // The number of cells that may be read behind the last row.
    static constexpr int slack = 16;

    int rows = 0;  // without the border
    int columns = 0;
    std::vector<std::int32_t> cells;

    BorderedPlane(int rowCount, int columnCount);
    std::int32_t* row(int y) { return cells.data() + startOf(y); }
    const std::int32_t* row(int y) const { return cells.data() + startOf(y); }

private:
    int startOf(int y) const { return (y + border) * (columns + 2 * border) + border; }
};

// Returns the value halfway between b and c of four consecutive values, on the cubic through all of them.
inline std::int32_t cubicHalfway(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    return (9 * (b + c) - a - d + 8) >> 4;
}

// Holds the known samples and errors of one block, for the encoder and the decoder.
class RefinementPredictor {
public:
    explicit RefinementPredictor(int coarseCells);  // c in [1, 128]

    // Sets the coarse grid: (c + 1)^2, row-major.
    void setCoarse(std::span<const std::int16_t> coarse);

    // Starts or restarts a pass with a predictor in [0, refinementPredictorCount). The previous passes must
    // be complete.
    void beginPass(RefinementPass pass, int predictor);

    // Predict one row, and its expected |error| in 1/256 steps, >= 0. Process rows in order: set the errors
    // of a row before predicting the next one, and set all samples before the next pass.
    void predictRow(int row, std::span<std::int16_t> predicted) const;
    void expectErrors(int row, std::span<float> expected256) const;
    void setErrors(int row, std::span<const std::int16_t> errors);
    void setSamples(int row, std::span<const std::int16_t> samples);

private:
    void beginMiddle();
    void beginOddRow();
    void beginOddColumn();
    void predictMiddle(int row, std::span<std::int16_t> predicted) const;
    void predictOddRow(int row, std::span<std::int16_t> predicted) const;
    void predictOddColumn(int row, std::span<std::int16_t> predicted) const;
    void expectMiddle(int row, std::span<float> expected256) const;
    void expectOddRow(int row, std::span<float> expected256) const;
    void expectOddColumn(int row, std::span<float> expected256) const;

    int cells_;
    RefinementPass pass_ = RefinementPass::Middle;
    std::size_t predictor_ = 0;
    BorderedPlane coarse_;
    BorderedPlane bendX_;  // |second difference| of the coarse grid along a row
    BorderedPlane bendY_;  // the same along a column
    BorderedPlane middle_;
    BorderedPlane middleError_;  // |error|, as for the other passes
    BorderedPlane oddRow_;
    BorderedPlane oddRowError_;
    BorderedPlane oddColumnError_;
};

}  // namespace planet
