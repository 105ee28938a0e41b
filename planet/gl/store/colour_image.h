// The colour image of the planet: a texture array of the six faces, drawn from an equirectangular image. The
// centres of a face's outermost texels lie on the cube's edges, so that faces meet without a seam. RGB holds
// square roots of linear light, which filter in 8 bits about as well as sRGB and are cheaper to decode. Alpha
// is the probability of water, [0, 1].
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

class ColourImage {
public:
    ColourImage() = default;  // no image

    // Takes 3 bytes per pixel, row 0 at the north, column 0 at longitude -180, and halves the image until it
    // fits the context. Draws with the program of shaders/face_image; leaves depth test, culling, blending
    // and scissor off. The Error says what the context is out of memory for.
    static Result<ColourImage> create(std::span<const std::uint8_t> rgb, int width, int height,
                                      GLuint faceProgram);

    bool exists() const { return texture_.name() != 0; }
    GLuint texture() const { return texture_.name(); }
    int faceSizePx() const { return faceSizePx_; }  // texels along a face
    std::size_t bytes() const { return bytes_; }    // including mipmaps

private:
    void fill(std::span<const std::uint8_t> rgb, int width, int height, GLuint faceProgram);

    Texture texture_;
    int faceSizePx_ = 0;
    std::size_t bytes_ = 0;
};

}  // namespace planet::gl
