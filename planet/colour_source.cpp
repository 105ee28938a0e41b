#include "planet/colour_source.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>
#include <vector>

namespace planet {

namespace {

constexpr int channelCount = 3;

using Channels = std::array<HeightSource, channelCount>;

Result<void> sampleChannels(const Channels& channels, const SampleTile& tile, std::span<glm::vec3> out) {
    std::vector<float> values(out.size());
    for (int channel = 0; channel < channelCount; ++channel) {
        const auto sampled = channels[static_cast<std::size_t>(channel)].sample(tile, values);
        if (!sampled) return sampled;
        for (std::size_t i = 0; i < out.size(); ++i) out[i][channel] = std::clamp(values[i], 0.0f, 1.0f);
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
    source.sample = [channels = std::move(channels)](const SampleTile& tile, std::span<glm::vec3> out) {
        return sampleChannels(channels, tile, out);
    };
    return source;
}

}  // namespace planet
