// A picture to draw into without a window: colour and float depth, multisampled where asked.
// Wants a current context; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"

namespace planet::gl {

class RenderTarget {
public:
    // Samples: 1, or more for smooth edges, at most RenderCapabilities::samples. The Error names what the
    // context cannot do.
    static Result<RenderTarget> create(int widthPx, int heightPx, int samples = 1);

    void bind() const;  // to draw into it

    // Copies the samples into the readable colour texture; nothing to do with one sample.
    void resolve() const;

    // After resolve(). Rows from the top, 3 bytes a pixel, sRGB.
    std::vector<std::uint8_t> readRgb() const;

    // Rows from the top, as the depth buffer holds it; one sample only.
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
