#include "planet/source/colour_source.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

#include "planet/base/try.h"
#include "planet/source/height_source.h"
#include "planet/source/sample_tiles.h"
#include "planet/source/source_parts.h"
#include "planet/source/world_file.h"

namespace planet {

namespace {

constexpr int channelCount = 3;

using Channels = std::array<HeightSource, channelCount>;

// Samples per side of a piece. The channels are sampled one after the other, piece by piece, so that the
// place of a piece in the image is computed once for all three.
constexpr int colourPieceSide = 65;

// Samples a piece into out, whose rows are `stride` colours apart.
Result<void> samplePiece(const Channels& channels, const SampleTile& piece, glm::vec3* out,
                         std::size_t stride) {
    const auto columns = static_cast<std::size_t>(piece.columns);
    std::vector<float> values(samplesIn(piece));
    for (int channel = 0; channel < channelCount; ++channel) {
        TRY(channels[static_cast<std::size_t>(channel)].sample(piece, values));
        for (std::size_t i = 0; i < values.size(); ++i)
            out[i / columns * stride + i % columns][channel] = std::clamp(values[i], 0.0f, 1.0f);
    }
    return {};
}

}  // namespace

bool hasColourLayers(const std::filesystem::path& path) {
    if (!isWorldFile(path)) return false;
    const Result<WorldFile> world = readWorldFile(path);
    return world && !layersOn(world->colours).empty();
}

Result<ColourSource> openColourSource(const std::filesystem::path& path, std::size_t cacheBytes,
                                      const std::shared_ptr<const SurveyShare>& share) {
    Channels channels;
    for (int channel = 0; channel < channelCount; ++channel) {
        HeightSourceSettings settings;
        settings.colourChannel = channel;
        settings.cacheBytes = cacheBytes / channelCount;
        settings.share = share;
        TRY_ASSIGN(channels[static_cast<std::size_t>(channel)], openHeightSource(path, settings));
    }
    ColourSource source;
    source.description = channels[0].description;
    source.naturalFaceSize = channels[0].naturalFaceSize;
    source.notice = std::ranges::max_element(channels, {}, &HeightSource::seamEdges)->notice;
    source.finestCells = channels[0].finestCells;
    source.signature = [parts = channels[0].parts]() -> Result<std::uint64_t> {
        TRY_ASSIGN(const auto made, parts(0));
        Fingerprint hash;
        for (const SourcePart& part : made) hash.add(part.signature);
        return hash.hash();
    };
    source.sample = [channels = std::move(channels)](const SampleTile& tile, std::span<glm::vec3> out) {
        return sampleInPieces(tile, colourPieceSide, out,
                              [&](const SampleTile& piece, glm::vec3* to, std::size_t stride) {
                                  return samplePiece(channels, piece, to, stride);
                              });
    };
    return source;
}

}  // namespace planet
