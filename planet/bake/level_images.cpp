#include "planet/bake/level_images.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <system_error>
#include <vector>

#include "planet/base/atomic_file.h"
#include "planet/base/try.h"
#include "planet/format/chunk_file.h"

namespace planet {

namespace {

using VisitChunk = std::function<void(const ChunkData&)>;

// Visits the chunks of a level in one of its rows, west to east, from a chunk above them.
Result<void> visitRow(const ChunkFile& file, const ChunkData& above, int level, std::uint32_t row,
                      const VisitChunk& visit) {
    if (above.id.level == level) {
        visit(above);
        return {};
    }
    TRY_ASSIGN(const auto children, file.readChildren(above.id, above.children, above.heights));
    for (const ChunkData& child : children) {
        if (row >> (level - child.id.level) != child.id.y) continue;
        TRY(visitRow(file, child, level, row, visit));
    }
    return {};
}

class LevelImage {
public:
    LevelImage(const ChunkFile& file, const ChunkData& root, int level)
        : file_(file),
          root_(root),
          level_(level),
          cells_(chunkCells(file.info().shape)),
          width_((cells_ << level) + 1),
          band_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(cells_ + 1)) {}

    // Writes the picture to a temporary file. path: its final name, for messages.
    Result<void> write(const std::filesystem::path& path, const std::filesystem::path& temporary) {
        const auto output = OIIO::ImageOutput::create(temporary.string());
        const OIIO::ImageSpec spec(width_, width_, 1, OIIO::TypeDesc::UINT16);
        if (!output || !output->open(temporary.string(), spec)) {
            return ioError(fmt::format("{}: cannot write it: {}", path.string(),
                                       output ? output->geterror() : OIIO::geterror()));
        }
        int nextRow = 0;
        for (std::uint32_t row = 1u << level_; row-- > 0;) {
            TRY(fillBand(row));
            // Neighbouring bands share a row; the southern band skips it.
            const int first = nextRow == 0 ? 0 : 1;
            for (int j = first; j <= cells_; ++j) {
                const auto* const line =
                    band_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(width_);
                if (!output->write_scanline(nextRow++, 0, OIIO::TypeDesc::UINT16, line)) {
                    return ioError(fmt::format("{}: writing failed: {}", path.string(), output->geterror()));
                }
            }
        }
        if (!output->close())
            return ioError(fmt::format("{}: writing failed: {}", path.string(), output->geterror()));
        return {};
    }

private:
    Result<void> fillBand(std::uint32_t row) {
        return visitRow(file_, root_, level_, row, [this](const ChunkData& chunk) {
            const auto side = static_cast<std::size_t>(cells_) + 1;
            const std::size_t column = chunk.id.x * (side - 1);
            for (std::size_t j = 0; j < side; ++j) {
                for (std::size_t i = 0; i < side; ++i) {
                    band_[(side - 1 - j) * static_cast<std::size_t>(width_) + column + i] =
                        grey(chunk.heights[j * side + i]);
                }
            }
        });
    }

    std::uint16_t grey(std::int32_t step) const {
        const int lowest = file_.info().minStep;
        const int range = std::max(1, file_.info().maxStep - lowest);
        return static_cast<std::uint16_t>(static_cast<std::int64_t>(step - lowest) * 65535 / range);
    }

    const ChunkFile& file_;
    const ChunkData& root_;
    int level_;
    int cells_;
    int width_;
    std::vector<std::uint16_t> band_;  // one row of chunks, the northernmost samples first
};

}  // namespace

Result<void> writeLevelImages(const std::filesystem::path& chunkFile, const std::filesystem::path& folder) {
    TRY_ASSIGN(const auto file, ChunkFile::open(chunkFile));
    std::error_code problem;
    std::filesystem::create_directories(folder, problem);
    if (problem)
        return ioError(fmt::format("{}: cannot make this folder: {}", folder.string(), problem.message()));
    for (const Face face : allFaces) {
        TRY_ASSIGN(const auto root, file.readRoot(face));
        for (int level = 0; level <= file.info().coarsestLeafLevel; ++level) {
            const auto path = folder / fmt::format("{}_level{:02}.png", faceName(face), level);
            const auto written = writeAtomically(path, [&](const std::filesystem::path& temporary) {
                return LevelImage(file, root, level).write(path, temporary);
            });
            if (!written) return written;
        }
    }
    return {};
}

}  // namespace planet
