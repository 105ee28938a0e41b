// Fuzzes the decoders of a chunk file's blocks: coded heights and packed colours. The first byte of an input
// chooses the decoder, the second the size of the grid.
#include <algorithm>
#include <vector>

#include "planet/format/colour_tile.h"
#include "planet/format/height_codec.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace planet;
using fuzz::isRead;
using fuzz::require;

void decodeWholeGrid(std::uint8_t sizeByte, std::span<const std::byte> coded) {
    const int size = (1 << sizeByte % 7) + 1;
    std::vector<std::int16_t> grid(static_cast<std::size_t>(size * size));
    if (!isRead(decodeGrid(coded, size, grid))) return;
    std::vector<std::byte> again;
    encodeGrid(grid, size, again);
    std::vector<std::int16_t> decoded(grid.size());
    require(isRead(decodeGrid(again, size, decoded)) && decoded == grid, "what is encoded decodes the same");
}

void decodeFineGrid(std::uint8_t cellsByte, std::uint8_t pattern, std::span<const std::byte> coded) {
    const int cells = 1 + cellsByte % 40;
    const auto side = static_cast<std::size_t>(cells) + 1;
    std::vector<std::int16_t> coarse(side * side);
    for (std::size_t i = 0; i < coarse.size(); ++i)
        coarse[i] = static_cast<std::int16_t>(pattern * (i % side + 3 * i * i));
    const auto fineSide = 2 * static_cast<std::size_t>(cells) + 1;
    std::vector<std::int16_t> fine(fineSide * fineSide);
    if (!isRead(decodeRefinement(coded, coarse, cells, fine))) return;
    for (std::size_t i = 0; i < coarse.size(); ++i)
        require(fine[i / side * 2 * fineSide + i % side * 2] == coarse[i], "coarse samples stay");
    std::vector<std::byte> again;
    encodeRefinement(fine, cells, 1, again);
    std::vector<std::int16_t> decoded(fine.size());
    require(isRead(decodeRefinement(again, coarse, cells, decoded)) && decoded == fine,
            "what is encoded decodes the same");
}

void unpackTile(ColourFormat format, std::span<const std::byte> packed) {
    const auto texels = unpackColourTexels(format, packed);
    if (!isRead(texels)) return;
    require(texels->size() == colourTileBytes(format), "tiles are whole");
    require(rgbOfColourTexels(format, *texels).size() ==
                static_cast<std::size_t>(3 * colourTileTexels * colourTileTexels),
            "every texel has a colour");
    require(unpackColourTexels(format, packColourTexels(format, *texels)) == *texels,
            "what is packed unpacks the same");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Input input(data, size);
    const std::uint8_t kind = input.byte() % 4, sizeByte = input.byte(), pattern = input.byte();
    if (kind == 0) decodeWholeGrid(sizeByte, input.rest());
    if (kind == 1) decodeFineGrid(sizeByte, pattern, input.rest());
    if (kind == 2) unpackTile(ColourFormat::Bc1, input.rest());
    if (kind == 3) unpackTile(ColourFormat::Lossless, input.rest());
    return 0;
}
