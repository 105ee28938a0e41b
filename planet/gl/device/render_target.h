// An off-screen framebuffer with colour and float depth, optionally multisampled. Requires a current context;
// one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

class RenderTarget {
public:
    // Creates a target. samples: [1, RenderCapabilities::samples]. The Error names what the context cannot
    // do.
    static Result<RenderTarget> create(int widthPx, int heightPx, int samples = 1);

    void bind() const;

    // Resolves the samples into the readable colour texture. Does nothing with one sample.
    void resolve() const;

    // Returns the rows from the top, 3 bytes per pixel, sRGB. Call resolve() first.
    std::vector<std::uint8_t> readRgb() const;

    // Returns the depth buffer's values, rows from the top. Requires one sample.
    std::vector<float> readDepth() const;

    GLuint colourTexture() const { return colour_.name(); }  // RGBA8, after resolve(); row 0 at the bottom
    GLuint framebuffer() const { return drawn_.name(); }
    int widthPx() const { return widthPx_; }
    int heightPx() const { return heightPx_; }
    int samples() const { return samples_; }
    std::size_t gpuBytes() const;

private:
    RenderTarget() = default;
    void allocate();

    int widthPx_ = 0;
    int heightPx_ = 0;
    int samples_ = 1;
    Texture colour_;
    Renderbuffer manyColours_;  // with several samples only
    Renderbuffer depth_;
    Framebuffer drawn_;
    Framebuffer resolved_;  // with several samples only
};

}  // namespace planet::gl
