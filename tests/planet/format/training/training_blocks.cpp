#include "tests/planet/format/training/training_blocks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/planet/format/training/training_random.h"
#include "tests/support/earth_windows.h"

namespace planet::training {

namespace {

using test::Block;
using test::Square;

constexpr std::int32_t voidStep = -32767;  // of SRTM

// A square whose heights are known in part.
struct PartialSquare {
    int side = 0;
    std::vector<double> heights;  // 0 where they are unknown
    std::vector<char> isKnown;

    std::size_t at(int x, int y) const { return static_cast<std::size_t>(y * side + x); }
};

// Returns a square of half the side, of the means of the known heights.
PartialSquare halved(const PartialSquare& fine) {
    const int side = (fine.side + 1) / 2;
    const auto count = static_cast<std::size_t>(side * side);
    PartialSquare coarse{side, std::vector<double>(count), std::vector<char>(count)};
    for (int y = 0; y < fine.side; ++y)
        for (int x = 0; x < fine.side; ++x) {
            if (!fine.isKnown[fine.at(x, y)]) continue;
            coarse.heights[coarse.at(x / 2, y / 2)] += fine.heights[fine.at(x, y)];
            ++coarse.isKnown[coarse.at(x / 2, y / 2)];
        }
    for (std::size_t i = 0; i < count; ++i)
        if (coarse.isKnown[i] > 0) coarse.heights[i] /= coarse.isKnown[i];
    return coarse;
}

// Returns the height of a square at a place between its samples: bilinear, and constant beyond the outermost ones.
double interpolated(const PartialSquare& square, double x, double y) {
    const int last = square.side - 1;
    const double columns = std::clamp(x, 0.0, static_cast<double>(last));
    const double rows = std::clamp(y, 0.0, static_cast<double>(last));
    const int west = std::min(static_cast<int>(columns), std::max(0, last - 1));
    const int north = std::min(static_cast<int>(rows), std::max(0, last - 1));
    const int east = std::min(west + 1, last);
    const int south = std::min(north + 1, last);
    const double u = columns - west;
    const double v = rows - north;
    const auto along = [&](int row) {
        return square.heights[square.at(west, row)] * (1 - u) + square.heights[square.at(east, row)] * u;
    };
    return along(north) * (1 - v) + along(south) * v;
}

// Fills the unknown heights smoothly from the means of larger and larger squares around them (push-pull: Gortler et al.,
// "The Lumigraph", SIGGRAPH 1996).
void fillUnknown(PartialSquare& square) {
    if (square.side == 1) return;
    PartialSquare coarse = halved(square);
    fillUnknown(coarse);
    for (int y = 0; y < square.side; ++y)
        for (int x = 0; x < square.side; ++x)
            if (const std::size_t i = square.at(x, y); !square.isKnown[i])
                square.heights[i] = interpolated(coarse, x / 2.0 - 0.25, y / 2.0 - 0.25);
}

Square withoutVoids(Square square) {
    PartialSquare partial{square.side, {}, {}};
    for (const std::int32_t step : square.samples) {
        partial.isKnown.push_back(step != voidStep);
        partial.heights.push_back(step != voidStep ? step : 0);
    }
    fillUnknown(partial);
    std::ranges::transform(partial.heights, square.samples.begin(),
                           [](double height) { return static_cast<std::int32_t>(std::lround(height)); });
    return square;
}

// Returns the square of 513 samples that are twice as dense as those of ETOPO5 and begin at sample x, y: bilinear, the mean of
// four places one dense sample off.
Square oversampledEarth(int x, int y) {
    constexpr int side = 513;
    const Square from = test::earthWindow(x - 1, y - 1, side / 2 + 3);
    Square square{side, {}};
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            double sum = 0;
            for (const int dy : {-1, 1})
                for (const int dx : {-1, 1}) {
                    const int i = (column + 2 + dx) / 2;
                    const int j = (row + 2 + dy) / 2;
                    const double u = ((column + dx) & 1) / 2.0;
                    const double v = ((row + dy) & 1) / 2.0;
                    sum += (from.at(i, j) * (1 - u) + from.at(i + 1, j) * u) * (1 - v) +
                           (from.at(i, j + 1) * (1 - u) + from.at(i + 1, j + 1) * u) * v;
                }
            square.samples.push_back(static_cast<std::int32_t>(std::lround(sum / 4)));
        }
    return square;
}

// Returns about one of `among` blocks of all levels of a square.
std::vector<Block> someBlocks(const Square& square, unsigned among) {
    std::vector<Block> blocks = test::pyramidBlocks(square, trainingCells);
    Random random(1);
    std::erase_if(blocks, [&](const Block&) { return (random() >> 16) % among != 0; });
    return blocks;
}

bool isFlat(const Block& block) {
    constexpr int reliefM = 40;
    const auto [lowest, highest] = std::ranges::minmax(block.fine.samples);
    return highest - lowest <= reliefM;
}

}  // namespace

std::vector<TrainingBlock> trainingBlocks() {
    std::vector<TrainingBlock> all;
    const auto add = [&all](const std::vector<Block>& blocks) {
        for (const Block& block : blocks) {
            const auto& fine = block.fine.samples;
            all.push_back({{fine.begin(), fine.end()}, FittedPredictor(trainingCells)});
            const auto& coarse = block.coarse.samples;
            all.back().predictor.setCoarse(std::vector<std::int16_t>(coarse.begin(), coarse.end()));
        }
    };
    add(someBlocks(test::earthWindow(20, 50, 2049), 3));
    std::vector<Block> regional = test::pyramidBlocks(
        withoutVoids(test::rasterWindow("regions/N49W124.tif", 0, 0, 1025)), trainingCells);
    std::erase_if(regional, isFlat);
    add(regional);
    add(someBlocks(oversampledEarth(320, 350), 2));
    add(someBlocks(oversampledEarth(920, 1250), 2));
    return all;
}

}  // namespace planet::training
