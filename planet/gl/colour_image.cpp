#include "planet/gl/colour_image.h"

#include <algorithm>
#include <cassert>
#include <string_view>
#include <vector>

namespace planet::gl {

namespace {

constexpr float wantedAnisotropy = 8;

struct Pixels {
    std::vector<std::uint8_t> rgb;
    int width = 0;
    int height = 0;
};

std::size_t byteCount(int width, int height) {
    return std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

// Averages 2 x 2 pixels; an odd last row or column is left out.
Pixels halved(const Pixels& from) {
    Pixels to{{}, std::max(from.width / 2, 1), std::max(from.height / 2, 1)};
    to.rgb.reserve(byteCount(to.width, to.height));
    const auto at = [&](int x, int y, int channel) -> int {
        const auto column = static_cast<std::size_t>(std::min(x, from.width - 1));
        const auto row = static_cast<std::size_t>(std::min(y, from.height - 1));
        return from.rgb[(row * static_cast<std::size_t>(from.width) + column) * 3 +
                        static_cast<std::size_t>(channel)];
    };
    for (int y = 0; y < to.height; ++y) {
        for (int x = 0; x < to.width; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                const int sum = at(2 * x, 2 * y, channel) + at(2 * x + 1, 2 * y, channel) +
                                at(2 * x, 2 * y + 1, channel) + at(2 * x + 1, 2 * y + 1, channel);
                to.rgb.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
            }
        }
    }
    return to;
}

// Four bytes a texel: drivers pad the three.
std::size_t bytesWithMipmaps(int width, int height) {
    std::size_t bytes = 0;
    for (;;) {
        bytes += std::size_t{4} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        if (width == 1 && height == 1) return bytes;
        width = std::max(width / 2, 1);
        height = std::max(height / 2, 1);
    }
}

// Mesa's software renderer has the extension, but some footprints make it sample at the wrong place.
bool hasGoodAnisotropy() {
    const std::string_view renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic") &&
           renderer.find("llvmpipe") == std::string_view::npos;
}

// Returns the anisotropy set.
float setSampling() {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    if (!hasGoodAnisotropy()) return 1;
    GLfloat most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    const float anisotropy = std::min(most, wantedAnisotropy);
    glTexParameterf(GL_TEXTURE_2D, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
    return anisotropy;
}

}  // namespace

ColourImage::ColourImage(std::span<const std::uint8_t> rgb, int width, int height) : texture_(makeTexture()) {
    assert(width > 0 && height > 0 && rgb.size() == byteCount(width, height));
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    Pixels smaller;
    while (std::max(width, height) > largest) {
        if (smaller.rgb.empty()) smaller = {{rgb.begin(), rgb.end()}, width, height};
        smaller = halved(smaller);
        rgb = smaller.rgb;
        width = smaller.width;
        height = smaller.height;
    }
    glBindTexture(GL_TEXTURE_2D, texture_.name());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glGenerateMipmap(GL_TEXTURE_2D);
    anisotropy_ = setSampling();
    bytes_ = bytesWithMipmaps(width, height);
}

}  // namespace planet::gl
