#include "planet/raster/spilled_raster.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "planet/base/try.h"

namespace planet {

namespace {

constexpr int pieceWidth = 256;       // samples
constexpr int narrowEnough = 512;     // samples; narrower blocks stay as they are
constexpr int mostPieceHeight = 512;  // samples, unless the raster's blocks cannot be divided
constexpr int leastPieceHeight = 64;
constexpr std::int16_t missing16 = std::numeric_limits<std::int16_t>::min();

// Returns a height for the pieces of blocks of a height. A piece must lie within one block.
int pieceHeightFor(int blockHeight, int height) {
    if (blockHeight >= height) return std::min(height, pieceWidth);
    if (blockHeight <= mostPieceHeight) return blockHeight;
    for (int rows = mostPieceHeight; rows >= leastPieceHeight; --rows) {
        if (blockHeight % rows == 0) return rows;
    }
    return blockHeight;
}

// Converts heights to 16 bits; returns false if that changes one of them. NaN becomes missing16.
bool toInt16(std::span<const float> heights, std::span<std::int16_t> out) {
    bool same = true;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const float height = heights[i];
        const bool isMissing = std::isnan(height);
        const float most = std::numeric_limits<std::int16_t>::max();
        out[i] = isMissing ? missing16 : static_cast<std::int16_t>(std::clamp(height, -most, most));
        // Compares bits, because -0 would become 0.
        same = same && (isMissing || std::bit_cast<std::uint32_t>(static_cast<float>(out[i])) ==
                                         std::bit_cast<std::uint32_t>(height));
    }
    return same;
}

class SpilledRaster : public Raster {
public:
    explicit SpilledRaster(std::shared_ptr<const Raster> raster) : raster_(std::move(raster)) {
        path_ = raster_->path();
        layout_ = raster_->layout();
        bandRows_ = layout_.blockHeight;
        layout_.blockWidth = pieceWidth;
        layout_.blockHeight = pieceHeightFor(bandRows_, layout_.height);
        piecesAcross_ = (layout_.width + pieceWidth - 1) / pieceWidth;
        const int piecesDown = (layout_.height + layout_.blockHeight - 1) / layout_.blockHeight;
        isInt16_.resize(static_cast<std::size_t>(piecesAcross_) * static_cast<std::size_t>(piecesDown));
        bands_ = std::vector<Band>(static_cast<std::size_t>((layout_.height + bandRows_ - 1) / bandRows_));
    }

    // Must succeed before a block is read.
    Result<void> takeRoom(TemporarySpace& space) {
        TRY_ASSIGN(room_, space.take(isInt16_.size() * slotBytes()));
        return {};
    }

    Result<std::vector<float>> readBlock(int blockX, int blockY) const override {
        TRY(spillBand(blockY * layout_.blockHeight / bandRows_));
        const Piece piece = pieceAt(blockX, blockY);
        std::vector<float> heights(piece.samples());
        if (isInt16_[piece.number] == 0) {
            TRY(room_.file->read(piece.offset, std::as_writable_bytes(std::span(heights))));
            return heights;
        }
        std::vector<std::int16_t> stored(piece.samples());
        TRY(room_.file->read(piece.offset, std::as_writable_bytes(std::span(stored))));
        std::ranges::transform(stored, heights.begin(), [](std::int16_t height) {
            return height == missing16 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(height);
        });
        return heights;
    }

    bool isEmpty(int, int blockY) const override {
        return raster_->isEmpty(0, blockY * layout_.blockHeight / bandRows_);
    }

    int rowsReadTogether() const override { return std::max(bandRows_ / layout_.blockHeight, 1); }

    std::optional<std::uint64_t> samplesRead() const override { return samplesRead_; }

private:
    // A block of the raster that is copied.
    struct Band {
        std::mutex mutex;
        std::atomic<bool> isSpilled = false;
    };

    // A block of this raster, and its place in the file.
    struct Piece {
        std::size_t number = 0;
        int x = 0;  // of its first sample
        int y = 0;
        int width = 0;
        int height = 0;
        std::uint64_t offset = 0;

        std::size_t samples() const {
            return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        }
    };

    Piece pieceAt(int blockX, int blockY) const {
        const int x = blockX * layout_.blockWidth;
        const int y = blockY * layout_.blockHeight;
        const auto number = static_cast<std::size_t>(blockY) * static_cast<std::size_t>(piecesAcross_) +
                            static_cast<std::size_t>(blockX);
        return {number,
                x,
                y,
                std::min(layout_.blockWidth, layout_.width - x),
                std::min(layout_.blockHeight, layout_.height - y),
                room_.offset + number * slotBytes()};
    }

    // Returns the room of a piece, as floats.
    std::uint64_t slotBytes() const {
        return sizeof(float) * static_cast<std::uint64_t>(layout_.blockWidth) *
               static_cast<std::uint64_t>(layout_.blockHeight);
    }

    Result<void> spillBand(int number) const {
        Band& band = bands_[static_cast<std::size_t>(number)];
        if (band.isSpilled) return {};
        const std::lock_guard lock(band.mutex);
        if (band.isSpilled) return {};
        TRY_ASSIGN(const auto heights, raster_->readBlock(0, number));
        samplesRead_ += heights.size();
        const int firstRow = number * bandRows_;
        const int endRow = std::min(firstRow + bandRows_, layout_.height);
        for (int row = firstRow; row < endRow; row += layout_.blockHeight) {
            for (int column = 0; column < piecesAcross_; ++column)
                TRY(write(pieceAt(column, row / layout_.blockHeight), heights, firstRow));
        }
        band.isSpilled = true;
        return {};
    }

    // Writes a piece of a band that starts at a row.
    Result<void> write(const Piece& piece, std::span<const float> band, int firstRow) const {
        std::vector<float> heights;
        heights.reserve(piece.samples());
        for (int row = piece.y; row < piece.y + piece.height; ++row) {
            const auto from = band.subspan(
                static_cast<std::size_t>(row - firstRow) * static_cast<std::size_t>(layout_.width) +
                    static_cast<std::size_t>(piece.x),
                static_cast<std::size_t>(piece.width));
            heights.insert(heights.end(), from.begin(), from.end());
        }
        std::vector<std::int16_t> small(heights.size());
        isInt16_[piece.number] = toInt16(heights, small) ? 1 : 0;
        return isInt16_[piece.number] != 0
                   ? room_.file->write(piece.offset, std::as_bytes(std::span(small)))
                   : room_.file->write(piece.offset, std::as_bytes(std::span(heights)));
    }

    std::shared_ptr<const Raster> raster_;
    TemporarySpace::Room room_;
    int bandRows_ = 0;
    int piecesAcross_ = 0;
    mutable std::vector<Band> bands_;
    mutable std::vector<std::uint8_t> isInt16_;  // of each piece of a band that is spilled
    mutable std::atomic<std::uint64_t> samplesRead_ = 0;
};

}  // namespace

Result<std::shared_ptr<const Raster>> inSmallBlocks(std::shared_ptr<const Raster> raster,
                                                    std::size_t cacheBytes, TemporarySpace& space) {
    const RasterLayout& layout = raster->layout();
    const std::uint64_t samples =
        static_cast<std::uint64_t>(layout.width) * static_cast<std::uint64_t>(layout.height);
    const bool byRows = layout.blockWidth >= layout.width && layout.width > narrowEnough;
    if (!byRows || samples * sizeof(float) <= 2 * cacheBytes) return raster;
    auto spilled = std::make_shared<SpilledRaster>(std::move(raster));
    TRY(spilled->takeRoom(space));
    return spilled;
}

}  // namespace planet
