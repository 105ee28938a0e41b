#include "planet/format/height_prediction.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdlib>

#include "planet/base/cpu_clones.h"

namespace planet {

namespace {

// The border of a plane beyond the block's edge. Mirror: the inner sample again. Hold: the sample on the
// edge. Continue: linear extrapolation through both.
enum class BeyondEdge { Mirror, Hold, Continue };

// Weights are in 1/1024; their sum over all samples is 1024. They are rounded least-squares fits over
// ETOPO5's own grid and over grids that oversample it.
constexpr int weightBits = 10;

struct MiddleWeights {
    int near;    // the 4 nearest coarse samples
    int ring;    // the 8 coarse samples one further away along one axis
    int corner;  // the 4 coarse samples one further away along both axes
    BeyondEdge beyond;
};

// The weights of a sample between two coarse samples. "Along" is their line; the two middles lie across it.
struct OddWeights {
    int near;         // the 2 coarse samples
    int middle;       // the 2 middles
    int along;        // the 2 next coarse samples along
    int across;       // the 4 coarse samples beside the near ones
    int alongMiddle;  // the 4 middles beside the two middles
    int diagonal;     // the 4 samples of OddRow; 0 in OddRow itself
    BeyondEdge beyond;
};

// The likelier predictors come first, because a fast encoder tries only those.
constexpr std::array<MiddleWeights, refinementPredictorCount> middlePredictors = {{
    {331, -39, 3, BeyondEdge::Continue},
    {340, -48, 12, BeyondEdge::Continue},
    {331, -39, 3, BeyondEdge::Hold},
    {256, 0, 0, BeyondEdge::Hold},
    {350, -62, 30, BeyondEdge::Continue},
    {340, -48, 12, BeyondEdge::Hold},
    {331, -39, 3, BeyondEdge::Mirror},
    {296, -20, 0, BeyondEdge::Continue},
}};

constexpr std::array<OddWeights, refinementPredictorCount> oddRowPredictors = {{
    {263, 415, 16, -51, -40, 0, BeyondEdge::Hold},
    {346, 330, 20, -31, -61, 0, BeyondEdge::Continue},
    {263, 415, 16, -51, -40, 0, BeyondEdge::Continue},
    {256, 256, 0, 0, 0, 0, BeyondEdge::Hold},
    {346, 330, 20, -31, -61, 0, BeyondEdge::Hold},
    {314, 310, 16, -16, -48, 0, BeyondEdge::Continue},
    {263, 415, 16, -51, -40, 0, BeyondEdge::Mirror},
    {346, 330, 20, -31, -61, 0, BeyondEdge::Mirror},
}};

constexpr std::array<OddWeights, refinementPredictorCount> oddColumnPredictors = {{
    {477, 381, 4, -7, -34, -134, BeyondEdge::Hold},
    {363, 327, 12, -26, -50, -19, BeyondEdge::Continue},
    {448, 420, 6, -14, -28, -139, BeyondEdge::Hold},
    {256, 256, 0, 0, 0, 0, BeyondEdge::Hold},
    {477, 381, 4, -7, -34, -134, BeyondEdge::Mirror},
    {477, 381, 4, -7, -34, -134, BeyondEdge::Continue},
    {363, 327, 12, -26, -50, -19, BeyondEdge::Hold},
    {448, 420, 6, -14, -28, -139, BeyondEdge::Continue},
}};

constexpr bool sumsToOne(const MiddleWeights& w) {
    return 4 * w.near + 8 * w.ring + 4 * w.corner == 1 << weightBits;
}
constexpr bool sumsToOne(const OddWeights& w) {
    return 2 * (w.near + w.middle + w.along) + 4 * (w.across + w.alongMiddle + w.diagonal) == 1 << weightBits;
}
static_assert(std::ranges::all_of(middlePredictors, [](const auto& w) { return sumsToOne(w); }));
static_assert(std::ranges::all_of(oddRowPredictors, [](const auto& w) { return sumsToOne(w); }));
static_assert(std::ranges::all_of(oddColumnPredictors, [](const auto& w) { return sumsToOne(w); }));

std::int16_t roundedSample(std::int32_t weighted) {
    const std::int32_t rounded = (weighted + (1 << (weightBits - 1))) >> weightBits;
    return static_cast<std::int16_t>(std::clamp(rounded, -32768, 32767));
}

std::int32_t beyondEdge(std::int32_t edge, std::int32_t inner, BeyondEdge beyond) {
    switch (beyond) {
        case BeyondEdge::Mirror:
            return inner;
        case BeyondEdge::Hold:
            return edge;
        case BeyondEdge::Continue:
            break;
    }
    return 2 * edge - inner;
}

// Repeats a plane's outermost cells into its border.
void holdBorder(BorderedPlane& plane) {
    const int columns = plane.columns;
    for (int y = 0; y < plane.rows; ++y) {
        plane.row(y)[-1] = plane.row(y)[0];
        plane.row(y)[columns] = plane.row(y)[columns - 1];
    }
    std::copy_n(plane.row(0) - 1, columns + 2, plane.row(-1) - 1);
    std::copy_n(plane.row(plane.rows - 1) - 1, columns + 2, plane.row(plane.rows) - 1);
}

void extendCoarse(BorderedPlane& coarse, BeyondEdge beyond) {
    const int last = coarse.rows - 1;
    for (int y = 0; y <= last; ++y) {
        std::int32_t* const row = coarse.row(y);
        row[-1] = beyondEdge(row[0], row[1], beyond);
        row[last + 1] = beyondEdge(row[last], row[last - 1], beyond);
    }
    for (int x = -1; x <= last + 1; ++x) {
        coarse.row(-1)[x] = beyondEdge(coarse.row(0)[x], coarse.row(1)[x], beyond);
        coarse.row(last + 1)[x] = beyondEdge(coarse.row(last)[x], coarse.row(last - 1)[x], beyond);
    }
}

// Extends the middles: the edge between the outermost middles and those beyond is interpolated from its
// coarse samples.
void extendMiddle(BorderedPlane& middle, const BorderedPlane& coarse, BeyondEdge beyond) {
    const int cells = middle.rows;
    const auto edgeInRow = [&](int y, int x) {
        const std::int32_t* const k = coarse.row(y) + x;
        return cubicHalfway(k[-1], k[0], k[1], k[2]);
    };
    const auto edgeInColumn = [&](int y, int x) {
        return cubicHalfway(coarse.row(y - 1)[x], coarse.row(y)[x], coarse.row(y + 1)[x],
                            coarse.row(y + 2)[x]);
    };
    for (int i = 0; i < cells; ++i) {
        middle.row(-1)[i] = beyondEdge(edgeInRow(0, i), middle.row(0)[i], beyond);
        middle.row(cells)[i] = beyondEdge(edgeInRow(cells, i), middle.row(cells - 1)[i], beyond);
        middle.row(i)[-1] = beyondEdge(edgeInColumn(i, 0), middle.row(i)[0], beyond);
        middle.row(i)[cells] = beyondEdge(edgeInColumn(i, cells), middle.row(i)[cells - 1], beyond);
    }
    for (const int y : {-1, cells}) {
        middle.row(y)[-1] = middle.row(y)[0];
        middle.row(y)[cells] = middle.row(y)[cells - 1];
    }
}

// Extends odd rows above and below, as OddColumn needs. The edge is a row of coarse samples.
void extendOddRow(BorderedPlane& oddRow, const BorderedPlane& coarse, BeyondEdge beyond) {
    const int cells = oddRow.rows;
    for (int x = 0; x <= cells; ++x) {
        oddRow.row(-1)[x] = beyondEdge(coarse.row(0)[x], oddRow.row(0)[x], beyond);
        oddRow.row(cells)[x] = beyondEdge(coarse.row(cells)[x], oddRow.row(cells - 1)[x], beyond);
    }
}

// Returns the curvature of the coarse grid at the four samples around a middle, along both axes.
std::int32_t bendsAround(const BorderedPlane& bendX, const BorderedPlane& bendY, int y, int x) {
    const std::int32_t* const x1 = bendX.row(y) + x;
    const std::int32_t* const x2 = bendX.row(y + 1) + x;
    const std::int32_t* const y1 = bendY.row(y) + x;
    const std::int32_t* const y2 = bendY.row(y + 1) + x;
    return x1[0] + x1[1] + x2[0] + x2[1] + y1[0] + y1[1] + y2[0] + y2[1];
}

}  // namespace

BorderedPlane::BorderedPlane(int rowCount, int columnCount)
    : rows(rowCount),
      columns(columnCount),
      cells(static_cast<std::size_t>((rowCount + 2 * border) * (columnCount + 2 * border) + slack)) {}

RefinementPredictor::RefinementPredictor(int coarseCells)
    : cells_(coarseCells),
      coarse_(coarseCells + 1, coarseCells + 1),
      bendX_(coarseCells + 1, coarseCells + 1),
      bendY_(coarseCells + 1, coarseCells + 1),
      middle_(coarseCells, coarseCells),
      middleError_(coarseCells, coarseCells),
      oddRow_(coarseCells, coarseCells + 1),
      oddRowError_(coarseCells, coarseCells + 1),
      oddColumnError_(coarseCells + 1, coarseCells) {
    assert(coarseCells >= 1 && coarseCells <= 128);
}

int passRows(RefinementPass pass, int coarseCells) {
    return pass == RefinementPass::OddColumn ? coarseCells + 1 : coarseCells;
}

int passColumns(RefinementPass pass, int coarseCells) {
    return pass == RefinementPass::OddRow ? coarseCells + 1 : coarseCells;
}

void RefinementPredictor::setCoarse(std::span<const std::int16_t> coarse) {
    const int side = cells_ + 1;
    assert(coarse.size() == static_cast<std::size_t>(side * side));
    for (int y = 0; y < side; ++y) std::copy_n(coarse.begin() + y * side, side, coarse_.row(y));
    extendCoarse(coarse_, BeyondEdge::Continue);
    for (int y = 0; y < side; ++y) {
        const std::int32_t* const up = coarse_.row(y - 1);
        const std::int32_t* const here = coarse_.row(y);
        const std::int32_t* const down = coarse_.row(y + 1);
        for (int x = 0; x < side; ++x) {
            bendX_.row(y)[x] = std::abs(here[x - 1] + here[x + 1] - 2 * here[x]);
            bendY_.row(y)[x] = std::abs(up[x] + down[x] - 2 * here[x]);
        }
    }
    if (side < 3) return;
    // The line continues straight over the edge, so the edge gets the bend next to it.
    for (int i = 0; i < side; ++i) {
        bendX_.row(i)[0] = bendX_.row(i)[1];
        bendX_.row(i)[side - 1] = bendX_.row(i)[side - 2];
        bendY_.row(0)[i] = bendY_.row(1)[i];
        bendY_.row(side - 1)[i] = bendY_.row(side - 2)[i];
    }
}

void RefinementPredictor::beginPass(RefinementPass pass, int predictor) {
    assert(predictor >= 0 && predictor < refinementPredictorCount);
    pass_ = pass;
    predictor_ = static_cast<std::size_t>(predictor);
    switch (pass) {
        case RefinementPass::Middle:
            return beginMiddle();
        case RefinementPass::OddRow:
            return beginOddRow();
        case RefinementPass::OddColumn:
            return beginOddColumn();
    }
}

// Each pass also estimates a row of errors above its first row, from the curvature or from the previous pass.

void RefinementPredictor::beginMiddle() {
    extendCoarse(coarse_, middlePredictors[predictor_].beyond);
    std::int32_t* const above = middleError_.row(-1);
    for (int x = 0; x < cells_; ++x) above[x] = bendsAround(bendX_, bendY_, 0, x) / 16;
    above[-1] = above[0];
    above[cells_] = above[cells_ - 1];
}

void RefinementPredictor::beginOddRow() {
    const BeyondEdge beyond = oddRowPredictors[predictor_].beyond;
    holdBorder(middleError_);
    extendCoarse(coarse_, beyond);
    extendMiddle(middle_, coarse_, beyond);
    const std::int32_t* const middleError = middleError_.row(0);
    std::int32_t* const above = oddRowError_.row(-1);
    for (int x = 0; x <= cells_; ++x) above[x] = (middleError[x - 1] + middleError[x]) / 3;
    above[-1] = above[0];
    above[cells_ + 1] = above[cells_];
}

void RefinementPredictor::beginOddColumn() {
    const BeyondEdge beyond = oddColumnPredictors[predictor_].beyond;
    holdBorder(oddRowError_);
    extendCoarse(coarse_, beyond);
    extendMiddle(middle_, coarse_, beyond);
    extendOddRow(oddRow_, coarse_, beyond);
    for (int x = -1; x <= cells_; ++x) oddColumnError_.row(-1)[x] = 2 * middleError_.row(0)[x] / 3;
}

void RefinementPredictor::predictRow(int row, std::span<std::int16_t> predicted) const {
    assert(predicted.size() == static_cast<std::size_t>(passColumns(pass_, cells_)));
    switch (pass_) {
        case RefinementPass::Middle:
            return predictMiddle(row, predicted);
        case RefinementPass::OddRow:
            return predictOddRow(row, predicted);
        case RefinementPass::OddColumn:
            return predictOddColumn(row, predicted);
    }
}

void RefinementPredictor::expectErrors(int row, std::span<float> expected256) const {
    assert(expected256.size() == static_cast<std::size_t>(passColumns(pass_, cells_)));
    switch (pass_) {
        case RefinementPass::Middle:
            return expectMiddle(row, expected256);
        case RefinementPass::OddRow:
            return expectOddRow(row, expected256);
        case RefinementPass::OddColumn:
            return expectOddColumn(row, expected256);
    }
}

// In the loops below, k0 to k3 are coarse rows from above to below, m middles, r odd rows, b bends, e errors.
// The loops write a different type than they read, which lets the compiler vectorise them.

PLANET_CPU_CLONES void RefinementPredictor::predictMiddle(int row, std::span<std::int16_t> predicted) const {
    const MiddleWeights w = middlePredictors[predictor_];
    const std::int32_t* const k0 = coarse_.row(row - 1);
    const std::int32_t* const k1 = coarse_.row(row);
    const std::int32_t* const k2 = coarse_.row(row + 1);
    const std::int32_t* const k3 = coarse_.row(row + 2);
    std::int16_t* const out = predicted.data();
    for (int x = 0; x < cells_; ++x) {
        const int near = k1[x] + k1[x + 1] + k2[x] + k2[x + 1];
        const int ring =
            k0[x] + k0[x + 1] + k3[x] + k3[x + 1] + k1[x - 1] + k1[x + 2] + k2[x - 1] + k2[x + 2];
        const int corner = k0[x - 1] + k0[x + 2] + k3[x - 1] + k3[x + 2];
        out[x] = roundedSample(w.near * near + w.ring * ring + w.corner * corner);
    }
}

PLANET_CPU_CLONES void RefinementPredictor::predictOddRow(int row, std::span<std::int16_t> predicted) const {
    const OddWeights w = oddRowPredictors[predictor_];
    const std::int32_t* const k0 = coarse_.row(row - 1);
    const std::int32_t* const k1 = coarse_.row(row);
    const std::int32_t* const k2 = coarse_.row(row + 1);
    const std::int32_t* const k3 = coarse_.row(row + 2);
    const std::int32_t* const m0 = middle_.row(row - 1);
    const std::int32_t* const m1 = middle_.row(row);
    const std::int32_t* const m2 = middle_.row(row + 1);
    std::int16_t* const out = predicted.data();
    for (int x = 0; x <= cells_; ++x) {
        const int near = k1[x] + k2[x];
        const int middle = m1[x - 1] + m1[x];
        const int along = k0[x] + k3[x];
        const int across = k1[x - 1] + k1[x + 1] + k2[x - 1] + k2[x + 1];
        const int alongMiddle = m0[x - 1] + m0[x] + m2[x - 1] + m2[x];
        out[x] = roundedSample(w.near * near + w.middle * middle + w.along * along + w.across * across +
                               w.alongMiddle * alongMiddle);
    }
}

PLANET_CPU_CLONES void RefinementPredictor::predictOddColumn(int row,
                                                             std::span<std::int16_t> predicted) const {
    const OddWeights w = oddColumnPredictors[predictor_];
    const std::int32_t* const k0 = coarse_.row(row - 1);
    const std::int32_t* const k1 = coarse_.row(row);
    const std::int32_t* const k2 = coarse_.row(row + 1);
    const std::int32_t* const m0 = middle_.row(row - 1);
    const std::int32_t* const m1 = middle_.row(row);
    const std::int32_t* const r0 = oddRow_.row(row - 1);
    const std::int32_t* const r1 = oddRow_.row(row);
    std::int16_t* const out = predicted.data();
    for (int x = 0; x < cells_; ++x) {
        const int near = k1[x] + k1[x + 1];
        const int middle = m0[x] + m1[x];
        const int along = k1[x - 1] + k1[x + 2];
        const int across = k0[x] + k0[x + 1] + k2[x] + k2[x + 1];
        const int alongMiddle = m0[x - 1] + m0[x + 1] + m1[x - 1] + m1[x + 1];
        const int diagonal = r0[x] + r0[x + 1] + r1[x] + r1[x + 1];
        out[x] = roundedSample(w.near * near + w.middle * middle + w.along * along + w.across * across +
                               w.alongMiddle * alongMiddle + w.diagonal * diagonal);
    }
}

// The weights of expected errors are in 1/256, least-squares fits of |error| over ETOPO5.

PLANET_CPU_CLONES void RefinementPredictor::expectMiddle(int row, std::span<float> expected256) const {
    const std::int32_t* const e = middleError_.row(row - 1);
    float* const out = expected256.data();
    for (int x = 0; x < cells_; ++x) {
        const int bends = bendsAround(bendX_, bendY_, row, x);
        out[x] = static_cast<float>(6 * bends + 40 * e[x] + 14 * (e[x - 1] + e[x + 1]));
    }
}

PLANET_CPU_CLONES void RefinementPredictor::expectOddRow(int row, std::span<float> expected256) const {
    const std::int32_t* const b1 = bendX_.row(row);
    const std::int32_t* const b2 = bendX_.row(row + 1);
    const std::int32_t* const m1 = middle_.row(row);
    const std::int32_t* const middleError = middleError_.row(row);
    const std::int32_t* const e = oddRowError_.row(row - 1);
    float* const out = expected256.data();
    for (int x = 0; x <= cells_; ++x) {
        const int known = 4 * std::abs(m1[x] - m1[x - 1]) + 6 * (b1[x] + b2[x]);
        const int errors =
            19 * (middleError[x - 1] + middleError[x]) + 28 * e[x] + 14 * (e[x - 1] + e[x + 1]);
        out[x] = static_cast<float>(known + errors);
    }
}

PLANET_CPU_CLONES void RefinementPredictor::expectOddColumn(int row, std::span<float> expected256) const {
    const std::int32_t* const k1 = coarse_.row(row);
    const std::int32_t* const b1 = bendX_.row(row);
    const std::int32_t* const m0 = middle_.row(row - 1);
    const std::int32_t* const m1 = middle_.row(row);
    const std::int32_t* const middleError0 = middleError_.row(row - 1);
    const std::int32_t* const middleError1 = middleError_.row(row);
    const std::int32_t* const r0 = oddRowError_.row(row - 1);
    const std::int32_t* const r1 = oddRowError_.row(row);
    const std::int32_t* const e = oddColumnError_.row(row - 1);
    float* const out = expected256.data();
    for (int x = 0; x < cells_; ++x) {
        const int twist = std::abs(k1[x] + k1[x + 1] - m0[x] - m1[x]);
        const int known = 2 * std::abs(k1[x] - k1[x + 1]) + twist + 3 * (b1[x] + b1[x + 1]);
        const int errors = middleError0[x] + middleError1[x] + 30 * (r0[x] + r0[x + 1] + r1[x] + r1[x + 1]) +
                           28 * e[x] + 9 * (e[x - 1] + e[x + 1]);
        out[x] = static_cast<float>(known + errors);
    }
}

void RefinementPredictor::setErrors(int row, std::span<const std::int16_t> errors) {
    const int count = passColumns(pass_, cells_);
    assert(errors.size() == static_cast<std::size_t>(count));
    BorderedPlane& plane = pass_ == RefinementPass::Middle   ? middleError_
                           : pass_ == RefinementPass::OddRow ? oddRowError_
                                                             : oddColumnError_;
    std::int32_t* const magnitude = plane.row(row);
    for (int x = 0; x < count; ++x) magnitude[x] = std::abs(int{errors[static_cast<std::size_t>(x)]});
    magnitude[-1] = magnitude[0];
    magnitude[count] = magnitude[count - 1];
}

void RefinementPredictor::setSamples(int row, std::span<const std::int16_t> samples) {
    assert(samples.size() == static_cast<std::size_t>(passColumns(pass_, cells_)));
    if (pass_ == RefinementPass::OddColumn) return;  // no pass uses the samples of the last one
    BorderedPlane& plane = pass_ == RefinementPass::Middle ? middle_ : oddRow_;
    std::ranges::copy(samples, plane.row(row));
}

}  // namespace planet
