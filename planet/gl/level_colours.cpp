#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/common.hpp>

#include "planet/gl/chunk_renderer.h"

namespace planet::gl {

namespace {

// Neighbouring levels are far apart in hue; after twelve the series begins again, lighter.
constexpr std::array<std::uint32_t, 12> hues = {0x3D6BE0, 0xFF9A1F, 0x1FA34A, 0xE0332B, 0x9B3FD1, 0xF2D024,
                                                0x12A5C9, 0xE64C93, 0x7CC21A, 0x95602E, 0x1BB89A, 0x6A6F7A};

glm::vec3 fromHex(std::uint32_t hex) {
    const auto channel = [&](int shift) { return static_cast<float>((hex >> shift) & 0xFFu) / 255.0f; };
    return {channel(16), channel(8), channel(0)};
}

}  // namespace

glm::vec3 levelColour(int level) {
    const auto index = static_cast<std::size_t>(std::max(level, 0));
    const glm::vec3 colour = fromHex(hues[index % hues.size()]);
    return index < hues.size() ? colour : glm::mix(colour, glm::vec3(1), 0.45f);
}

glm::vec3 errorColour(double epsOverTau) {
    const glm::vec3 green(0.16f, 0.66f, 0.26f);
    const glm::vec3 yellow(0.97f, 0.83f, 0.15f);
    const glm::vec3 red(0.86f, 0.14f, 0.12f);
    const auto t = static_cast<float>(std::clamp(epsOverTau, 0.0, 2.0));
    return t < 1 ? glm::mix(green, yellow, t) : glm::mix(yellow, red, t - 1);
}

}  // namespace planet::gl
