#include "planet/format/fitted_prediction.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "planet/base/cpu_clones.h"

namespace planet {

namespace {

// Errors are magnitudes. Contrasts are absolute differences of known samples on both sides of a missing one.
enum PlaneIndex : std::int8_t {
    CoarsePlane,
    MiddlePlane,
    OddRowPlane,
    OddColumnPlane,
    BendXPlane,  // |second difference| of the coarse grid along a row
    BendYPlane,  // the same along a column
    MiddleErrorPlane,
    OddRowErrorPlane,
    OddColumnErrorPlane,
    FirstContrastPlane,
    SecondContrastPlane,
};

// A cell of a plane, relative to the predicted sample, and the term that it belongs to.
struct TermCell {
    std::int8_t plane;
    std::int8_t rows;
    std::int8_t columns;
    std::int8_t term;
};

constexpr auto middleSamples = std::to_array<TermCell>({
    {CoarsePlane, 0, 0, 0},    {CoarsePlane, 0, 1, 1},    {CoarsePlane, 1, 0, 2},   {CoarsePlane, 1, 1, 3},
    {CoarsePlane, 0, -1, 4},   {CoarsePlane, 0, 2, 5},    {CoarsePlane, 1, -1, 6},  {CoarsePlane, 1, 2, 7},
    {CoarsePlane, -1, 0, 8},   {CoarsePlane, -1, 1, 9},   {CoarsePlane, 2, 0, 10},  {CoarsePlane, 2, 1, 11},
    {CoarsePlane, -1, -1, 12}, {CoarsePlane, -1, 2, 13},  {CoarsePlane, 2, -1, 14}, {CoarsePlane, 2, 2, 15},
    {MiddlePlane, -1, 0, 16},  {MiddlePlane, -1, -1, 17}, {MiddlePlane, -1, 1, 18}, {MiddlePlane, -2, 0, 19},
});

constexpr auto oddRowSamples = std::to_array<TermCell>({
    {CoarsePlane, 0, 0, 0},   {CoarsePlane, 1, 0, 1},    {MiddlePlane, 0, -1, 2},   {MiddlePlane, 0, 0, 3},
    {CoarsePlane, -1, 0, 4},  {CoarsePlane, 2, 0, 5},    {CoarsePlane, 0, -1, 6},   {CoarsePlane, 0, 1, 7},
    {CoarsePlane, 1, -1, 8},  {CoarsePlane, 1, 1, 9},    {MiddlePlane, -1, -1, 10}, {MiddlePlane, -1, 0, 11},
    {MiddlePlane, 1, -1, 12}, {MiddlePlane, 1, 0, 13},   {MiddlePlane, 0, -2, 14},  {MiddlePlane, 0, 1, 15},
    {OddRowPlane, -1, 0, 16}, {OddRowPlane, -1, -1, 17}, {OddRowPlane, -1, 1, 18},
});

constexpr auto oddColumnSamples = std::to_array<TermCell>({
    {CoarsePlane, 0, 0, 0},       {CoarsePlane, 0, 1, 1},      {MiddlePlane, -1, 0, 2},
    {MiddlePlane, 0, 0, 3},       {OddRowPlane, -1, 0, 4},     {OddRowPlane, -1, 1, 5},
    {OddRowPlane, 0, 0, 6},       {OddRowPlane, 0, 1, 7},      {CoarsePlane, 0, -1, 8},
    {CoarsePlane, 0, 2, 9},       {CoarsePlane, -1, 0, 10},    {CoarsePlane, -1, 1, 11},
    {CoarsePlane, 1, 0, 12},      {CoarsePlane, 1, 1, 13},     {MiddlePlane, -1, -1, 14},
    {MiddlePlane, -1, 1, 15},     {MiddlePlane, 0, -1, 16},    {MiddlePlane, 0, 1, 17},
    {MiddlePlane, -2, 0, 18},     {MiddlePlane, 1, 0, 19},     {OddColumnPlane, -1, 0, 20},
    {OddColumnPlane, -1, -1, 21}, {OddColumnPlane, -1, 1, 22},
});
static_assert(oddColumnSamples.size() == maxPredictionTerms);

constexpr auto middleErrors = std::to_array<TermCell>({
    {BendXPlane, 0, 0, 0},
    {BendXPlane, 0, 1, 0},
    {BendXPlane, 1, 0, 0},
    {BendXPlane, 1, 1, 0},
    {BendYPlane, 0, 0, 0},
    {BendYPlane, 0, 1, 0},
    {BendYPlane, 1, 0, 0},
    {BendYPlane, 1, 1, 0},
    {FirstContrastPlane, 0, 0, 1},
    {MiddleErrorPlane, -1, 0, 2},
    {MiddleErrorPlane, -1, -1, 3},
    {MiddleErrorPlane, -1, 1, 3},
    {MiddleErrorPlane, -1, -2, 4},
    {MiddleErrorPlane, -1, 2, 4},
});

constexpr auto oddRowErrors = std::to_array<TermCell>({
    {FirstContrastPlane, 0, 0, 0},
    {SecondContrastPlane, 0, 0, 1},
    {BendXPlane, 0, 0, 2},
    {BendXPlane, 1, 0, 2},
    {BendYPlane, 0, 0, 3},
    {BendYPlane, 1, 0, 3},
    {MiddleErrorPlane, 0, -1, 4},
    {MiddleErrorPlane, 0, 0, 4},
    {MiddleErrorPlane, -1, -1, 5},
    {MiddleErrorPlane, -1, 0, 5},
    {MiddleErrorPlane, 1, -1, 5},
    {MiddleErrorPlane, 1, 0, 5},
    {MiddleErrorPlane, 0, -2, 6},
    {MiddleErrorPlane, 0, 1, 6},
    {OddRowErrorPlane, -1, 0, 7},
    {OddRowErrorPlane, -1, -1, 8},
    {OddRowErrorPlane, -1, 1, 8},
});

constexpr auto oddColumnErrors = std::to_array<TermCell>({
    {FirstContrastPlane, 0, 0, 0},   {SecondContrastPlane, 0, 0, 1},
    {BendXPlane, 0, 0, 2},           {BendXPlane, 0, 1, 2},
    {BendYPlane, 0, 0, 3},           {BendYPlane, 0, 1, 3},
    {MiddleErrorPlane, -1, 0, 4},    {MiddleErrorPlane, 0, 0, 4},
    {OddRowErrorPlane, -1, 0, 5},    {OddRowErrorPlane, -1, 1, 5},
    {OddRowErrorPlane, 0, 0, 5},     {OddRowErrorPlane, 0, 1, 5},
    {MiddleErrorPlane, -1, -1, 6},   {MiddleErrorPlane, -1, 1, 6},
    {MiddleErrorPlane, 0, -1, 6},    {MiddleErrorPlane, 0, 1, 6},
    {OddRowErrorPlane, -1, -1, 7},   {OddRowErrorPlane, -1, 2, 7},
    {OddRowErrorPlane, 0, -1, 7},    {OddRowErrorPlane, 0, 2, 7},
    {OddColumnErrorPlane, -1, 0, 8}, {OddColumnErrorPlane, -1, -1, 9},
    {OddColumnErrorPlane, -1, 1, 9},
});

using TermCells = std::span<const TermCell>;
constexpr std::array<TermCells, allRefinementPasses.size()> samplesOfPass = {middleSamples, oddRowSamples,
                                                                             oddColumnSamples};
constexpr std::array<TermCells, allRefinementPasses.size()> errorsOfPass = {middleErrors, oddRowErrors,
                                                                            oddColumnErrors};

constexpr std::size_t indexOf(RefinementPass pass) {
    return static_cast<std::size_t>(pass);
}

constexpr std::size_t columnGroup = 16;

struct WeightedRow {
    const std::int32_t* cells;
    std::uint32_t weight;
};

// Sums rows, modulo 2^32: a sum that fits is right, whatever its parts are. Works in groups of columns, whose sums stay in
// registers; the last group reads beyond the rows (BorderedPlane::slack).
PLANET_CPU_CLONES void sumRows(std::span<const WeightedRow> rows, std::size_t columns, std::uint32_t* sums) {
    for (std::size_t start = 0; start < columns; start += columnGroup) {
        std::array<std::uint32_t, columnGroup> group{};
        for (const WeightedRow& row : rows) {
            const std::int32_t* const in = row.cells + start;
            for (std::size_t i = 0; i < columnGroup; ++i)
                group[i] += row.weight * static_cast<std::uint32_t>(in[i]);
        }
        std::copy_n(group.begin(), columnGroup, sums + start);
    }
}

PLANET_CPU_CLONES void roundSums(std::span<const std::uint32_t> sums, std::span<std::int16_t> predicted) {
    const std::uint32_t* __restrict const in = sums.data();
    std::int16_t* __restrict const out = predicted.data();
    for (std::size_t x = 0; x < predicted.size(); ++x) {
        const auto rounded =
            static_cast<std::int32_t>(in[x] + (1u << (fittedWeightBits - 1))) >> fittedWeightBits;
        out[x] = static_cast<std::int16_t>(std::clamp(rounded, -32768, 32767));
    }
}

PLANET_CPU_CLONES void scaleSums(std::span<const std::uint32_t> sums, std::span<float> expected256) {
    constexpr float scale = 256.0f / (1 << errorWeightBits);
    const std::uint32_t* __restrict const in = sums.data();
    float* __restrict const out = expected256.data();
    for (std::size_t x = 0; x < expected256.size(); ++x)
        out[x] = scale * static_cast<float>(static_cast<std::int32_t>(in[x]));
}

// Memory for the sums of one row, and for the rows that are summed.
constexpr std::size_t maxColumns = 144;
static_assert(maxColumns % columnGroup == 0);
constexpr std::size_t maxCells = std::max(oddColumnSamples.size(), oddColumnErrors.size());

void sumCells(const std::vector<BorderedPlane>& planes, TermCells cells,
              std::span<const std::int32_t> weights, int row, std::size_t columns,
              std::array<std::uint32_t, maxColumns>& sums) {
    std::array<WeightedRow, maxCells> rows;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const TermCell& cell = cells[i];
        rows[i] = {planes[static_cast<std::size_t>(cell.plane)].row(row + cell.rows) + cell.columns,
                   static_cast<std::uint32_t>(weights[static_cast<std::size_t>(cell.term)])};
    }
    sumRows(std::span(rows).first(cells.size()), columns, sums.data());
}

void readTerm(const std::vector<BorderedPlane>& planes, TermCells cells, int term, int row,
              std::span<std::int32_t> values) {
    std::ranges::fill(values, 0);
    for (const TermCell& cell : cells) {
        if (cell.term != term) continue;
        const std::int32_t* const in =
            planes[static_cast<std::size_t>(cell.plane)].row(row + cell.rows) + cell.columns;
        for (std::size_t x = 0; x < values.size(); ++x) values[x] += in[x];
    }
}

// Repeats the outermost cells of a row into its border.
void holdRow(BorderedPlane& plane, int y) {
    std::int32_t* const row = plane.row(y);
    const int last = plane.columns - 1;
    for (int i = 1; i <= BorderedPlane::border; ++i) {
        row[-i] = row[0];
        row[last + i] = row[last];
    }
}

// Repeats the outermost rows, whose borders are set, into the border.
void holdRows(BorderedPlane& plane) {
    constexpr int border = BorderedPlane::border;
    for (int i = 1; i <= border; ++i) {
        std::copy_n(plane.row(0) - border, plane.columns + 2 * border, plane.row(-i) - border);
        std::copy_n(plane.row(plane.rows - 1) - border, plane.columns + 2 * border,
                    plane.row(plane.rows - 1 + i) - border);
    }
}

// Continues a plane straight beyond its edges.
void continuePlane(BorderedPlane& plane) {
    constexpr int border = BorderedPlane::border;
    const int lastColumn = plane.columns - 1;
    const int lastRow = plane.rows - 1;
    for (int y = 0; y <= lastRow; ++y) {
        std::int32_t* const row = plane.row(y);
        for (int i = 1; i <= border; ++i) {
            row[-i] = 2 * row[0] - row[i];
            row[lastColumn + i] = 2 * row[lastColumn] - row[lastColumn - i];
        }
    }
    for (int i = 1; i <= border; ++i)
        for (int x = -border; x <= lastColumn + border; ++x) {
            plane.row(-i)[x] = 2 * plane.row(0)[x] - plane.row(i)[x];
            plane.row(lastRow + i)[x] = 2 * plane.row(lastRow)[x] - plane.row(lastRow - i)[x];
        }
}

}  // namespace

int predictionTermCount(RefinementPass pass) {
    return static_cast<int>(samplesOfPass[indexOf(pass)].size());
}

int errorTermCount(RefinementPass pass) {
    return errorsOfPass[indexOf(pass)].back().term + 1;
}

FittedPredictor::FittedPredictor(int coarseCells) : cells_(coarseCells) {
    assert(coarseCells >= 2 && coarseCells <= 128);
    const int side = coarseCells + 1;
    for (const auto& [rows, columns] : std::to_array<std::pair<int, int>>({{side, side},
                                                                           {cells_, cells_},
                                                                           {cells_, side},
                                                                           {side, cells_},
                                                                           {side, side},
                                                                           {side, side},
                                                                           {cells_, cells_},
                                                                           {cells_, side},
                                                                           {side, cells_},
                                                                           {side, side},
                                                                           {side, side}}))
        planes_.emplace_back(rows, columns);
}

void FittedPredictor::setCoarse(std::span<const std::int16_t> coarse) {
    const int side = cells_ + 1;
    assert(coarse.size() == static_cast<std::size_t>(side * side));
    BorderedPlane& known = plane(CoarsePlane);
    for (int y = 0; y < side; ++y) std::copy_n(coarse.begin() + y * side, side, known.row(y));
    continuePlane(known);
    BorderedPlane& bendX = plane(BendXPlane);
    BorderedPlane& bendY = plane(BendYPlane);
    // A line that continues straight has no bend at the edge, so the edge gets the bend next to it.
    for (int y = 0; y < side; ++y) {
        const int inner = std::clamp(y, 1, side - 2);
        for (int x = 0; x < side; ++x) {
            const std::int32_t* const here = known.row(y) + std::clamp(x, 1, side - 2);
            bendX.row(y)[x] = std::abs(here[-1] + here[1] - 2 * here[0]);
            bendY.row(y)[x] =
                std::abs(known.row(inner - 1)[x] + known.row(inner + 1)[x] - 2 * known.row(inner)[x]);
        }
    }
}

void FittedPredictor::beginPass(RefinementPass pass) {
    pass_ = pass;
    switch (pass) {
        case RefinementPass::Middle:
            return beginMiddle();
        case RefinementPass::OddRow:
            return beginOddRow();
        case RefinementPass::OddColumn:
            return beginOddColumn();
    }
}

// Each pass estimates the samples and the errors of the rows above its first one, from those that are known there.

void FittedPredictor::beginMiddle() {
    const BorderedPlane& coarse = plane(CoarsePlane);
    const auto mean = [&](int y, int x) {
        const std::int32_t* const k0 = coarse.row(y) + x;
        const std::int32_t* const k1 = coarse.row(y + 1) + x;
        return (k0[0] + k0[1] + k1[0] + k1[1] + 2) >> 2;
    };
    for (int x = 0; x < cells_; ++x) {
        plane(MiddlePlane).row(-1)[x] = mean(-1, x);
        plane(MiddlePlane).row(-2)[x] = mean(-2, x);
        std::int32_t bends = 0;
        for (const int y : {0, 1})
            for (const int i : {x, x + 1}) bends += plane(BendXPlane).row(y)[i] + plane(BendYPlane).row(y)[i];
        plane(MiddleErrorPlane).row(-1)[x] = bends / 16;
    }
    holdRow(plane(MiddlePlane), -1);
    holdRow(plane(MiddlePlane), -2);
    holdRow(plane(MiddleErrorPlane), -1);
    for (int y = 0; y < cells_; ++y) {
        const std::int32_t* const k0 = coarse.row(y);
        const std::int32_t* const k1 = coarse.row(y + 1);
        std::int32_t* const contrast = plane(FirstContrastPlane).row(y);
        for (int x = 0; x < cells_; ++x)
            contrast[x] = std::abs(k0[x] - k1[x + 1]) + std::abs(k0[x + 1] - k1[x]);
    }
}

// The middles continue straight beyond the edge. What lies on the edge between them is interpolated from its coarse
// samples.
void FittedPredictor::extendMiddle() {
    constexpr int border = BorderedPlane::border;
    BorderedPlane& middle = plane(MiddlePlane);
    const BorderedPlane& coarse = plane(CoarsePlane);
    const int last = cells_ - 1;
    for (int y = 0; y < cells_; ++y) {
        std::int32_t* const row = middle.row(y);
        const auto onEdge = [&](int x) {
            return cubicHalfway(coarse.row(y - 1)[x], coarse.row(y)[x], coarse.row(y + 1)[x],
                                coarse.row(y + 2)[x]);
        };
        for (int i = 0; i < border; ++i) {
            row[-1 - i] = 2 * onEdge(0) - row[i];
            row[cells_ + i] = 2 * onEdge(cells_) - row[last - i];
        }
    }
    for (int x = 0; x < cells_; ++x) {
        const auto onEdge = [&](int y) {
            const std::int32_t* const k = coarse.row(y) + x;
            return cubicHalfway(k[-1], k[0], k[1], k[2]);
        };
        for (int i = 0; i < border; ++i) {
            middle.row(-1 - i)[x] = 2 * onEdge(0) - middle.row(i)[x];
            middle.row(cells_ + i)[x] = 2 * onEdge(cells_) - middle.row(last - i)[x];
        }
    }
    for (int i = 0; i < border; ++i) {
        holdRow(middle, -1 - i);
        holdRow(middle, cells_ + i);
    }
}

void FittedPredictor::beginOddRow() {
    holdRows(plane(MiddleErrorPlane));
    extendMiddle();
    const BorderedPlane& coarse = plane(CoarsePlane);
    const std::int32_t* const middleError = plane(MiddleErrorPlane).row(0);
    for (int x = 0; x <= cells_; ++x) {
        plane(OddRowPlane).row(-1)[x] = (coarse.row(-1)[x] + coarse.row(0)[x]) >> 1;
        plane(OddRowErrorPlane).row(-1)[x] = (middleError[x - 1] + middleError[x]) / 3;
    }
    holdRow(plane(OddRowPlane), -1);
    holdRow(plane(OddRowErrorPlane), -1);
    for (int y = 0; y < cells_; ++y) {
        const std::int32_t* const middle = plane(MiddlePlane).row(y);
        const std::int32_t* const k0 = coarse.row(y);
        const std::int32_t* const k1 = coarse.row(y + 1);
        std::int32_t* const across = plane(FirstContrastPlane).row(y);
        std::int32_t* const along = plane(SecondContrastPlane).row(y);
        for (int x = 0; x <= cells_; ++x) {
            across[x] = std::abs(middle[x] - middle[x - 1]);
            along[x] = std::abs(k0[x] - k1[x]);
        }
    }
}

void FittedPredictor::beginOddColumn() {
    holdRows(plane(OddRowErrorPlane));
    const BorderedPlane& coarse = plane(CoarsePlane);
    BorderedPlane& oddRow = plane(OddRowPlane);
    for (int x = 0; x <= cells_; ++x) {
        oddRow.row(-1)[x] = 2 * coarse.row(0)[x] - oddRow.row(0)[x];
        oddRow.row(cells_)[x] = 2 * coarse.row(cells_)[x] - oddRow.row(cells_ - 1)[x];
    }
    for (int x = 0; x < cells_; ++x) {
        plane(OddColumnPlane).row(-1)[x] = (coarse.row(-1)[x] + coarse.row(-1)[x + 1]) >> 1;
        plane(OddColumnErrorPlane).row(-1)[x] = 2 * plane(MiddleErrorPlane).row(0)[x] / 3;
    }
    holdRow(plane(OddColumnPlane), -1);
    holdRow(plane(OddColumnErrorPlane), -1);
    for (int y = 0; y <= cells_; ++y) {
        const std::int32_t* const k = coarse.row(y);
        const std::int32_t* const m0 = plane(MiddlePlane).row(y - 1);
        const std::int32_t* const m1 = plane(MiddlePlane).row(y);
        std::int32_t* const twist = plane(FirstContrastPlane).row(y);
        std::int32_t* const along = plane(SecondContrastPlane).row(y);
        for (int x = 0; x < cells_; ++x) {
            twist[x] = std::abs(k[x] + k[x + 1] - m0[x] - m1[x]);
            along[x] = std::abs(k[x] - k[x + 1]);
        }
    }
}

void FittedPredictor::setWeights(std::span<const std::int32_t> weights) {
    assert(weights.size() == samplesOfPass[indexOf(pass_)].size());
    weights_.assign(weights.begin(), weights.end());
}

void FittedPredictor::setErrorWeights(std::span<const std::int32_t> weights) {
    assert(static_cast<int>(weights.size()) == errorTermCount(pass_));
    errorWeights_.assign(weights.begin(), weights.end());
}

void FittedPredictor::predictRow(int row, std::span<std::int16_t> predicted) const {
    std::array<std::uint32_t, maxColumns> sums;
    const std::span used = std::span(sums).first(predicted.size());
    sumCells(planes_, samplesOfPass[indexOf(pass_)], weights_, row, used.size(), sums);
    roundSums(used, predicted);
}

void FittedPredictor::expectErrors(int row, std::span<float> expected256) const {
    std::array<std::uint32_t, maxColumns> sums;
    const std::span used = std::span(sums).first(expected256.size());
    sumCells(planes_, errorsOfPass[indexOf(pass_)], errorWeights_, row, used.size(), sums);
    scaleSums(used, expected256);
}

void FittedPredictor::setErrors(int row, std::span<const std::int16_t> errors) {
    BorderedPlane& magnitudes = plane(MiddleErrorPlane + static_cast<int>(pass_));
    std::int32_t* const out = magnitudes.row(row);
    for (std::size_t x = 0; x < errors.size(); ++x) out[x] = std::abs(int{errors[x]});
    holdRow(magnitudes, row);
}

void FittedPredictor::setSamples(int row, std::span<const std::int16_t> samples) {
    BorderedPlane& known = plane(MiddlePlane + static_cast<int>(pass_));
    std::ranges::copy(samples, known.row(row));
    holdRow(known, row);
}

void FittedPredictor::readPredictionTerm(int term, int row, std::span<std::int32_t> values) const {
    readTerm(planes_, samplesOfPass[indexOf(pass_)], term, row, values);
}

void FittedPredictor::readErrorTerm(int term, int row, std::span<std::int32_t> values) const {
    readTerm(planes_, errorsOfPass[indexOf(pass_)], term, row, values);
}

}  // namespace planet
