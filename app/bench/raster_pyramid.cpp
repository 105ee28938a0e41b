#include "app/bench/raster_pyramid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include "planet/format/chunk_file_format.h"
#include "planet/format/height_codec.h"
#include "planet/format/height_rows.h"

namespace worldy {

namespace {

using planet::ChunkEntry;

// Returns size * size samples of a square, every step-th one from a place on.
std::vector<std::int32_t> thinnedSquare(const HeightSquare& square, int x0, int y0, int size, int step) {
    const std::size_t first =
        static_cast<std::size_t>(y0) * static_cast<std::size_t>(square.side) + static_cast<std::size_t>(x0);
    return planet::thinned<std::int16_t, std::int32_t>(std::span(square.steps).subspan(first), square.side,
                                                       size, step);
}

class PyramidWriter {
public:
    PyramidWriter(const HeightSquare& square, int chunkCells, int compressionLevel)
        : square_(square), level_(compressionLevel) {
        pyramid_.chunkCells = chunkCells;
        pyramid_.fileBytes = planet::chunkFileHeaderBytes;
    }

    RasterPyramid written() {
        const int step = (square_.side - 1) / pyramid_.chunkCells;
        const ChunkEntry root = writeChildren(0, 0, step);
        std::vector<std::byte> block;
        planet::putIndex(block, {&root, 1}, pyramid_.fileBytes);
        planet::encodeGrid(thinnedSquare(square_, 0, 0, pyramid_.chunkCells + 1, step),
                           pyramid_.chunkCells + 1, 0, block);
        pyramid_.fileBytes += block.size() + planet::checksumBytes;
        return std::move(pyramid_);
    }

private:
    // Writes the blocks below the chunk at a place, whose samples are `step` finest ones apart. Returns the chunk's entry.
    // The errors of an entry take the same bytes whatever they are.
    ChunkEntry writeChildren(int x, int y, int step) {
        const int cells = pyramid_.chunkCells;
        ChunkEntry entry;
        if (step == 1) {
            const auto samples = thinnedSquare(square_, x, y, cells + 1, 1);
            std::tie(entry.minStep, entry.maxStep) =
                std::pair(std::ranges::min(samples), std::ranges::max(samples));
            return entry;
        }
        std::array<ChunkEntry, planet::quadrantCount> children;
        for (std::size_t q = 0; q < children.size(); ++q) {
            const int half = cells * step / 2;
            children[q] = writeChildren(x + static_cast<int>(q % 2) * half,
                                        y + static_cast<int>(q / 2) * half, step / 2);
        }
        entry.minStep = std::ranges::min(children, {}, &ChunkEntry::minStep).minStep;
        entry.maxStep = std::ranges::max(children, {}, &ChunkEntry::maxStep).maxStep;
        std::vector<std::byte> index;
        planet::putIndex(index, children, pyramid_.fileBytes);
        PyramidBlock block;
        planet::encodeRefinement(thinnedSquare(square_, x, y, 2 * cells + 1, step / 2), cells, level_, 0,
                                 block.coded);
        block.coarse =
            planet::Steps(std::span<const std::int32_t>(thinnedSquare(square_, x, y, cells + 1, step)));
        entry.children = {pyramid_.fileBytes, static_cast<std::uint32_t>(index.size() + block.coded.size() +
                                                                         planet::checksumBytes)};
        pyramid_.fileBytes += entry.children.size;
        pyramid_.blocks.push_back(std::move(block));
        return entry;
    }

    const HeightSquare& square_;
    int level_;
    RasterPyramid pyramid_;
};

}  // namespace

RasterPyramid codePyramid(const HeightSquare& square, int chunkCells, int compressionLevel) {
    assert(square.side > chunkCells + 1 && (square.side - 1) % chunkCells == 0);
    return PyramidWriter(square, chunkCells, compressionLevel).written();
}

planet::Result<void> decodePyramid(const RasterPyramid& pyramid) {
    for (const PyramidBlock& block : pyramid.blocks) {
        const auto fine = planet::decodeRefinement(block.coded, block.coarse, pyramid.chunkCells, 0);
        if (!fine) return tl::unexpected(fine.error());
    }
    return {};
}

}  // namespace worldy
