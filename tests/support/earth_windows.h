// Pieces of the real Earth, on its own grid, as the codec's test and benchmark take them.
#pragma once

#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace planet::test {

// A square grid of steps, row-major.
struct Square {
    int side = 0;
    std::vector<std::int32_t> samples;

    std::int32_t at(int x, int y) const { return samples[static_cast<std::size_t>(y * side + x)]; }
};

// The square with its corner at sample x, y of a raster of int16 metres in data/. Throws where it is not to be had.
inline Square rasterWindow(const std::string& file, int x, int y, int side) {
    const std::string path = std::string(WORLDY_SOURCE_DIR) + "/data/" + file;
    const auto image = OIIO::ImageInput::open(path);
    if (!image) throw std::runtime_error("cannot open " + path);
    const auto width = static_cast<std::size_t>(image->spec().width);
    const auto height = static_cast<std::size_t>(image->spec().height);
    std::vector<std::int16_t> all(width * height);
    if (!image->read_image(0, 0, 0, 1, OIIO::TypeDesc::INT16, all.data()))
        throw std::runtime_error("cannot read " + path);
    Square square{side, {}};
    for (int row = y; row < y + side; ++row)
        for (int column = x; column < x + side; ++column)
            square.samples.push_back(
                all.at(static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)));
    return square;
}

// The square with its corner at sample x, y of data/earth/elevation.tif: 4320 x 2160.
inline Square earthWindow(int x, int y, int side) {
    return rasterWindow("earth/elevation.tif", x, y, side);
}

// The square of side samples with its corner at x, y, taking every step-th.
inline Square pieceOf(const Square& square, int x, int y, int side, int step = 1) {
    Square piece{side, {}};
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            piece.samples.push_back(square.at(x + step * column, y + step * row));
    return piece;
}

// A block to refine: the fine grid and the coarse grid inside it.
struct Block {
    Square fine;
    Square coarse;
};

// All blocks of a square's pyramid: its own, those of every other sample, and so on down to a single block.
// Its side is a power of two plus one.
inline std::vector<Block> pyramidBlocks(const Square& square, int coarseCells) {
    std::vector<Block> blocks;
    for (Square level = square; level.side > 2 * coarseCells;
         level = pieceOf(level, 0, 0, level.side / 2 + 1, 2)) {
        for (int y = 0; y + 1 < level.side; y += 2 * coarseCells)
            for (int x = 0; x + 1 < level.side; x += 2 * coarseCells)
                blocks.push_back(
                    {pieceOf(level, x, y, 2 * coarseCells + 1), pieceOf(level, x, y, coarseCells + 1, 2)});
    }
    return blocks;
}

}  // namespace planet::test
