// Places of the samples that a refinement adds in the fine grid, memory for one row of them, and what the encoders share.
// Internal to the codec.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/format/height_prediction.h"

namespace planet {

inline constexpr std::size_t passCount = allRefinementPasses.size();

inline constexpr std::size_t maxRowSamples = 129;

// The shift of all widths of a pass.
inline constexpr int minWidthShift = -23;
inline constexpr int maxWidthShift = 8;

inline std::size_t gridSamples(int cells) {
    const auto side = static_cast<std::size_t>(cells) + 1;
    return side * side;
}

inline std::size_t missingSamples(int coarseCells) {
    return gridSamples(2 * coarseCells) - gridSamples(coarseCells);
}

// The position of a pass's first sample in the fine grid.
struct PassLayout {
    int firstRow;
    int firstColumn;
};

inline constexpr std::array<PassLayout, passCount> passLayouts = {{{1, 1}, {1, 0}, {0, 1}}};

// Returns the index in the fine grid of the first sample of a pass's row; the row's samples are every other
// one.
inline std::size_t rowStart(RefinementPass pass, int row, int coarseCells) {
    const PassLayout layout = passLayouts[static_cast<std::size_t>(pass)];
    return static_cast<std::size_t>((layout.firstRow + 2 * row) * (2 * coarseCells + 1) + layout.firstColumn);
}

// Returns size * size samples of a grid, every step-th one of a row and of a column. rowSamples: of the grid. The first
// sample of the grid is the first one of the result.
template <class From, class To = From>
std::vector<To> thinned(std::span<const From> grid, int rowSamples, int size, int step) {
    std::vector<To> samples;
    samples.reserve(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            samples.push_back(grid[static_cast<std::size_t>(y * step) * static_cast<std::size_t>(rowSamples) +
                                   static_cast<std::size_t>(x * step)]);
    return samples;
}

// Descends from a width shift to the minimum of costOf(shift), which is unique, and returns that cost.
template <class Cost>
std::int64_t descendShift(const Cost& costOf, int& widthShift) {
    std::int64_t best = costOf(widthShift);
    for (const int direction : {-1, 1}) {
        const int before = widthShift;
        while (widthShift + direction >= minWidthShift && widthShift + direction <= maxWidthShift) {
            const std::int64_t next = costOf(widthShift + direction);
            if (next >= best) break;
            best = next;
            widthShift += direction;
        }
        if (widthShift != before) break;
    }
    return best;
}

// Memory for one row of a pass.
class RowBuffers {
public:
    explicit RowBuffers(int columns) : columns_(static_cast<std::size_t>(columns)) {}

    std::span<std::int16_t> predicted() { return std::span(predicted_).first(columns_); }
    std::span<float> expected256() { return std::span(expected256_).first(columns_); }
    std::span<std::uint8_t> widths() { return std::span(widths_).first(columns_); }
    std::span<std::int16_t> residuals() { return std::span(residuals_).first(columns_); }
    std::span<std::int16_t> samples() { return std::span(samples_).first(columns_); }

private:
    std::size_t columns_;
    std::array<std::int16_t, maxRowSamples> predicted_;
    std::array<float, maxRowSamples> expected256_;
    std::array<std::uint8_t, maxRowSamples> widths_;
    std::array<std::int16_t, maxRowSamples> residuals_;
    std::array<std::int16_t, maxRowSamples> samples_;
};

}  // namespace planet
