// Fuzzes the decoders of a chunk file's blocks: coded heights and packed colours. The first byte of an input
// chooses the decoder, the second the size of the grid.
#include <array>
#include <vector>

#include "planet/format/colour_tile.h"
#include "planet/format/height_codec.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace planet;
using fuzz::isRead;
using fuzz::require;

// The high bits of the byte of the size choose the fractions.
int fractionBitsOf(std::uint8_t sizeByte) {
    constexpr std::array<int, 4> choices = {0, 6, 12, 1};
    return choices[sizeByte >> 6];
}

void requireLimits(const Steps& steps, int fractionBits) {
    const auto [lowest, highest] = lowestAndHighest(steps);
    require(lowest >= lowestStepOf(fractionBits) && highest <= highestStepOf(fractionBits),
            "steps are within their limits");
}

void decodeWholeGrid(std::uint8_t sizeByte, std::span<const std::byte> coded) {
    const int size = (1 << (sizeByte & 63) % 7) + 1;
    const int fractionBits = fractionBitsOf(sizeByte);
    const auto grid = decodeGrid(coded, size, fractionBits);
    if (!isRead(grid)) return;
    requireLimits(*grid, fractionBits);
    std::vector<std::byte> again;
    encodeGrid(grid->view().toVector(), size, fractionBits, again);
    const auto decoded = decodeGrid(again, size, fractionBits);
    require(isRead(decoded) && *decoded == *grid, "what is encoded decodes the same");
}

void decodeFineGrid(std::uint8_t cellsByte, std::uint8_t pattern, std::span<const std::byte> coded) {
    const int cells = 1 + (cellsByte & 63) % 40;
    const int fractionBits = fractionBitsOf(cellsByte);
    const auto side = static_cast<std::size_t>(cells) + 1;
    std::vector<std::int32_t> coarse(side * side);
    for (std::size_t i = 0; i < coarse.size(); ++i)
        coarse[i] = static_cast<std::int16_t>(pattern * (i % side + 3 * i * i)) * (1 << fractionBits / 2);
    const auto fineSide = 2 * static_cast<std::size_t>(cells) + 1;
    const Steps known{std::span<const std::int32_t>(coarse)};
    const auto fine = decodeRefinement(coded, known, cells, fractionBits);
    if (!isRead(fine)) return;
    requireLimits(*fine, fractionBits);
    for (std::size_t i = 0; i < coarse.size(); ++i)
        require((*fine)[i / side * 2 * fineSide + i % side * 2] == coarse[i], "coarse samples stay");
    std::vector<std::byte> again;
    encodeRefinement(fine->view().toVector(), cells, 1, fractionBits, again);
    const auto decoded = decodeRefinement(again, known, cells, fractionBits);
    require(isRead(decoded) && *decoded == *fine, "what is encoded decodes the same");
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
