#include <fcntl.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "planet/base/open_file.h"
#include "planet/base/try.h"
#include "planet/raster/height_raster.h"
#include "planet/raster/temporary_file.h"

namespace planet {

namespace {

constexpr int rawBlockSide = 256;            // samples
constexpr int spillBlockWidth = 256;         // samples
constexpr int spillBlockHeight = 64;         // samples
constexpr std::size_t bandBytes = 8u << 20;  // rows of an image read at once

// The layout of the temporary file: whole blocks one after another, row-major, also at the edges.
struct SpillLayout {
    std::uint64_t blocksAcross = 0;
    std::uint64_t blockBytes = 0;
    std::size_t sampleBytes = 0;

    SpillLayout(const ImageLayout& image)
        : blocksAcross(static_cast<std::uint64_t>((image.width + spillBlockWidth - 1) / spillBlockWidth)),
          blockBytes(bytesOf(image.type) * spillBlockWidth * spillBlockHeight),
          sampleBytes(bytesOf(image.type)) {}

    // Returns the offset of a sample in the first column of a block.
    std::uint64_t offsetOf(int blockX, int y) const {
        const auto block = static_cast<std::uint64_t>(y / spillBlockHeight) * blocksAcross +
                           static_cast<std::uint64_t>(blockX);
        return block * blockBytes +
               static_cast<std::uint64_t>(y % spillBlockHeight) * spillBlockWidth * sampleBytes;
    }
};

// Writes whole rows of the image that lie within one row of blocks.
Result<void> spillRows(const OpenFile& file, const ImageLayout& image, int firstRow, int count,
                       std::span<const std::byte> native) {
    const SpillLayout layout(image);
    const std::size_t rowBytes = static_cast<std::size_t>(image.width) * layout.sampleBytes;
    const std::size_t pieceBytes = spillBlockWidth * layout.sampleBytes;
    std::vector<std::byte> piece(pieceBytes * static_cast<std::size_t>(count));
    for (int blockX = 0; blockX * spillBlockWidth < image.width; ++blockX) {
        const std::size_t begin = static_cast<std::size_t>(blockX) * pieceBytes;
        const std::size_t length = std::min(pieceBytes, rowBytes - begin);
        for (std::size_t row = 0; row < static_cast<std::size_t>(count); ++row) {
            const auto from = native.subspan(row * rowBytes + begin, length);
            std::copy(from.begin(), from.end(),
                      piece.begin() + static_cast<std::ptrdiff_t>(row * pieceBytes));
        }
        TRY(file.write(layout.offsetOf(blockX, firstRow), piece));
    }
    return {};
}

using RowsCallback = std::function<Result<void>(int firstRow, int count, std::span<const std::byte> native)>;

// Passes all rows to the callback from the top, some at a time, but never across two rows of blocks.
Result<void> forRows(ImageFile& image, const RowsCallback& callback) {
    const ImageLayout& layout = image.layout();
    const std::size_t rowBytes = static_cast<std::size_t>(layout.width) * bytesOf(layout.type);
    const int most = static_cast<int>(std::clamp<std::size_t>(bandBytes / rowBytes, 1, spillBlockHeight));
    std::vector<std::byte> native(rowBytes * static_cast<std::size_t>(most));
    for (int row = 0; row < layout.height;) {
        const int blockEnd = (row / spillBlockHeight + 1) * spillBlockHeight;
        const int count = std::min({most, blockEnd - row, layout.height - row});
        const std::span band(native.data(), rowBytes * static_cast<std::size_t>(count));
        TRY(image.readRows(row, count, band));
        TRY(callback(row, count, band));
        row += count;
    }
    return {};
}

Result<HeightRaster> openWhole(ImageFile& image, const HeightConversion& conversion) {
    const ImageLayout& layout = image.layout();
    const auto width = static_cast<std::size_t>(layout.width);
    std::vector<float> heights(width * static_cast<std::size_t>(layout.height));
    HeightStatistics statistics;
    TRY(forRows(image, [&](int firstRow, int count, std::span<const std::byte> native) -> Result<void> {
        const std::span rows = std::span(heights).subspan(static_cast<std::size_t>(firstRow) * width,
                                                          static_cast<std::size_t>(count) * width);
        addTo(statistics, convertToMetres(conversion, native, rows));
        return {};
    }));
    return HeightRaster::whole(layout.width, layout.height, std::move(heights), statistics);
}

Result<HeightRaster> openSpilled(ImageFile& image, const HeightConversion& conversion,
                                 const RasterMemory& memory, const FileCalls& calls) {
    TRY_ASSIGN(const auto file, createTemporaryFile(calls));
    const ImageLayout layout = image.layout();
    HeightStatistics statistics;
    std::vector<float> heights;
    TRY(forRows(image, [&](int firstRow, int count, std::span<const std::byte> native) {
        heights.resize(native.size() / bytesOf(layout.type));
        addTo(statistics, convertToMetres(conversion, native, heights));
        return spillRows(*file, layout, firstRow, count, native);
    }));
    const auto readBlock = [file, layout](int blockX, int blockY, std::span<std::byte> native) {
        // The last row of blocks ends with the image.
        const int rows = std::min(spillBlockHeight, layout.height - blockY * spillBlockHeight);
        const std::size_t bytes = static_cast<std::size_t>(rows) * spillBlockWidth * bytesOf(layout.type);
        return file->read(SpillLayout(layout).offsetOf(blockX, blockY * spillBlockHeight),
                          native.first(bytes));
    };
    return HeightRaster::inBlocks(
        layout.width, layout.height, conversion,
        {spillBlockWidth, spillBlockHeight, readBlock, memory.cache, memory.cacheSlot}, statistics);
}

}  // namespace

Result<HeightRaster> openImageRaster(const std::shared_ptr<ImageFile>& image,
                                     const HeightConversion& conversion, const RasterMemory& memory,
                                     const FileCalls& calls) {
    const ImageLayout& layout = image->layout();
    assert(conversion.type == layout.type);
    if (layout.tileWidth > 0) {
        const auto readBlock = [image](int blockX, int blockY, std::span<std::byte> native) {
            return image->readTile(blockX * image->layout().tileWidth, blockY * image->layout().tileHeight,
                                   native);
        };
        return HeightRaster::inBlocks(
            layout.width, layout.height, conversion,
            {layout.tileWidth, layout.tileHeight, readBlock, memory.cache, memory.cacheSlot});
    }
    const std::uint64_t wholeBytes =
        static_cast<std::uint64_t>(layout.width) * static_cast<std::uint64_t>(layout.height) * sizeof(float);
    return wholeBytes <= memory.wholeLimitBytes ? openWhole(*image, conversion)
                                                : openSpilled(*image, conversion, memory, calls);
}

Result<HeightRaster> openRawRaster(const std::filesystem::path& path, int width, int height,
                                   const HeightConversion& conversion, const RasterMemory& memory,
                                   const FileCalls& calls) {
    TRY_ASSIGN(auto opened, OpenFile::open(path, O_RDONLY | O_NONBLOCK, calls));
    const auto file = std::make_shared<const OpenFile>(std::move(opened));
    const std::size_t sampleBytes = bytesOf(conversion.type);
    const auto readBlock = [=](int blockX, int blockY, std::span<std::byte> native) -> Result<void> {
        const int x = blockX * rawBlockSide;
        const int y = blockY * rawBlockSide;
        const auto columns = static_cast<std::size_t>(std::min(rawBlockSide, width - x));
        for (int row = 0; row < std::min(rawBlockSide, height - y); ++row) {
            const std::uint64_t sample =
                static_cast<std::uint64_t>(y + row) * static_cast<std::uint64_t>(width) +
                static_cast<std::uint64_t>(x);
            const auto into = native.subspan(static_cast<std::size_t>(row) * rawBlockSide * sampleBytes,
                                             columns * sampleBytes);
            TRY(file->read(sample * sampleBytes, into));
        }
        return {};
    };
    return HeightRaster::inBlocks(width, height, conversion,
                                  {rawBlockSide, rawBlockSide, readBlock, memory.cache, memory.cacheSlot});
}

}  // namespace planet
