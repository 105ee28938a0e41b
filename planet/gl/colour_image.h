// The picture laid over the planet: an equirectangular sRGB texture with mipmaps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "planet/gl/gl_objects.h"

namespace planet::gl {

class ColourImage {
public:
    ColourImage() = default;  // none

    // 3 bytes a pixel, row 0 at the north, column 0 at longitude -180. Halved until the context can hold it.
    ColourImage(std::span<const std::uint8_t> rgb, int width, int height);

    bool exists() const { return texture_.name() != 0; }
    GLuint texture() const { return texture_.name(); }
    float anisotropy() const { return anisotropy_; }  // longest footprint over shortest that is sampled well
    std::size_t bytes() const { return bytes_; }      // mipmaps included

private:
    Texture texture_;
    float anisotropy_ = 1;
    std::size_t bytes_ = 0;
};

}  // namespace planet::gl
