#include "app/base/colour_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>

namespace worldy {

std::optional<glm::vec3> colourFromText(std::string_view text) {
    std::uint32_t hex = 0;
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    const auto [end, problem] = std::from_chars(text.data() + 1, text.data() + text.size(), hex, 16);
    if (problem != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    const auto channel = [&](int shift) { return static_cast<float>((hex >> shift) & 0xFFu) / 255.0f; };
    return glm::vec3(channel(16), channel(8), channel(0));
}

std::string colourText(const glm::vec3& colour) {
    const auto byte = [](float channel) {
        return static_cast<int>(std::lround(255 * glm::clamp(channel, 0.0f, 1.0f)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.r), byte(colour.g), byte(colour.b));
}

}  // namespace worldy
