#include "planet/source/colour_source.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

#include "planet/source/height_source.h"

namespace planet {

namespace {

constexpr int channelCount = 3;

using Channels = std::array<HeightSource, channelCount>;

// Samples a side. Channels are sampled in turn, piece by piece: where a piece lies in the image is worked out
// once for the three.
constexpr int colourPieceSide = 65;

// out: the piece's first colour; stride: from one row of it to the next.
Result<void> samplePiece(const Channels& channels, const SampleTile& piece, glm::vec3* out,
                         std::size_t stride) {
    const auto columns = static_cast<std::size_t>(piece.columns);
    std::vector<float> values(columns * static_cast<std::size_t>(piece.rows));
    for (int channel = 0; channel < channelCount; ++channel) {
        const auto sampled = channels[static_cast<std::size_t>(channel)].sample(piece, values);
        if (!sampled) return sampled;
        for (std::size_t i = 0; i < values.size(); ++i)
            out[i / columns * stride + i % columns][channel] = std::clamp(values[i], 0.0f, 1.0f);
    }
    return {};
}

Result<void> sampleChannels(const Channels& channels, const SampleTile& tile, std::span<glm::vec3> out) {
    const auto stride = static_cast<std::size_t>(tile.columns);
    for (int row = 0; row < tile.rows; row += colourPieceSide) {
        for (int column = 0; column < tile.columns; column += colourPieceSide) {
            const SampleTile piece{tile.face,
                                   tile.faceCells,
                                   tile.firstColumn + column,
                                   tile.firstRow + row,
                                   std::min(colourPieceSide, tile.columns - column),
                                   std::min(colourPieceSide, tile.rows - row)};
            glm::vec3* const to =
                out.data() + static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column);
            if (auto sampled = samplePiece(channels, piece, to, stride); !sampled) return sampled;
        }
    }
    return {};
}

}  // namespace

Result<ColourSource> openColourSource(const std::filesystem::path& path, std::size_t cacheBytes) {
    Channels channels;
    for (int channel = 0; channel < channelCount; ++channel) {
        HeightSourceSettings settings;
        settings.colourChannel = channel;
        settings.cacheBytes = cacheBytes / channelCount;
        Result<HeightSource> opened = openHeightSource(path, settings);
        if (!opened) return tl::unexpected(std::move(opened.error()));
        channels[static_cast<std::size_t>(channel)] = *std::move(opened);
    }
    ColourSource source;
    source.description = channels[0].description;
    source.naturalFaceSize = channels[0].naturalFaceSize;
    source.notice = std::ranges::max_element(channels, {}, &HeightSource::seamEdges)->notice;
    source.sample = [channels = std::move(channels)](const SampleTile& tile, std::span<glm::vec3> out) {
        return sampleChannels(channels, tile, out);
    };
    return source;
}

}  // namespace planet
