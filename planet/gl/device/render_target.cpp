#include "planet/gl/device/render_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace planet::gl {

namespace {

GLint limitOf(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

// Reverses the order of rows, because OpenGL reads them from the bottom.
template <class T>
void flipRows(std::vector<T>& pixels, std::size_t rowLength) {
    const std::size_t rows = pixels.size() / rowLength;
    for (std::size_t row = 0; row < rows / 2; ++row) {
        const auto top = pixels.begin() + static_cast<std::ptrdiff_t>(row * rowLength);
        const auto bottom = pixels.begin() + static_cast<std::ptrdiff_t>((rows - 1 - row) * rowLength);
        std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(rowLength), bottom);
    }
}

}  // namespace

Result<RenderTarget> RenderTarget::create(int widthPx, int heightPx, int samples) {
    assert(widthPx > 0 && heightPx > 0 && samples >= 1);
    const GLint largest = std::min(limitOf(GL_MAX_TEXTURE_SIZE), limitOf(GL_MAX_RENDERBUFFER_SIZE));
    if (std::max(widthPx, heightPx) > largest) {
        return badInput(
            fmt::format("picture of {} x {} px exceeds the OpenGL limit; expected at most {} per side",
                        widthPx, heightPx, largest));
    }
    if (samples > limitOf(GL_MAX_SAMPLES)) {
        return badInput(fmt::format("{} samples per pixel exceed the OpenGL limit; expected at most {}",
                                    samples, limitOf(GL_MAX_SAMPLES)));
    }
    RenderTarget target;
    target.widthPx_ = widthPx;
    target.heightPx_ = heightPx;
    target.samples_ = samples;
    target.allocate();
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        return badInput(
            fmt::format("OpenGL limit: cannot draw into RGBA8 with a 32-bit float depth and {} samples "
                        "(status {:#x})",
                        samples, status));
    }
    return target;
}

void RenderTarget::allocate() {
    colour_ = makeTexture();
    glBindTexture(GL_TEXTURE_2D, colour_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, widthPx_, heightPx_, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);

    const GLsizei renderbufferSamples = samples_ > 1 ? samples_ : 0;
    depth_ = makeRenderbuffer();
    glBindRenderbuffer(GL_RENDERBUFFER, depth_.name());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, renderbufferSamples, GL_DEPTH_COMPONENT32F, widthPx_,
                                     heightPx_);
    if (samples_ > 1) {
        manyColours_ = makeRenderbuffer();
        glBindRenderbuffer(GL_RENDERBUFFER, manyColours_.name());
        glRenderbufferStorageMultisample(GL_RENDERBUFFER, renderbufferSamples, GL_RGBA8, widthPx_, heightPx_);
        resolved_ = makeFramebuffer();
        glBindFramebuffer(GL_FRAMEBUFFER, resolved_.name());
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
    }
    drawn_ = makeFramebuffer();
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
    if (samples_ > 1) {
        glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, manyColours_.name());
    } else {
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.name(), 0);
    }
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
}

void RenderTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
}

void RenderTarget::resolve() const {
    if (samples_ == 1) return;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_.name());
    glBlitFramebuffer(0, 0, widthPx_, heightPx_, 0, 0, widthPx_, heightPx_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn_.name());
}

std::vector<std::uint8_t> RenderTarget::readRgb() const {
    const std::size_t rowLength = static_cast<std::size_t>(widthPx_) * 3;
    std::vector<std::uint8_t> pixels(rowLength * static_cast<std::size_t>(heightPx_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, samples_ > 1 ? resolved_.name() : drawn_.name());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, widthPx_, heightPx_, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    flipRows(pixels, rowLength);
    return pixels;
}

std::vector<float> RenderTarget::readDepth() const {
    assert(samples_ == 1);
    const auto rowLength = static_cast<std::size_t>(widthPx_);
    std::vector<float> depths(rowLength * static_cast<std::size_t>(heightPx_));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_.name());
    glReadPixels(0, 0, widthPx_, heightPx_, GL_DEPTH_COMPONENT, GL_FLOAT, depths.data());
    flipRows(depths, rowLength);
    return depths;
}

std::size_t RenderTarget::gpuBytes() const {
    const std::size_t pixels = static_cast<std::size_t>(widthPx_) * static_cast<std::size_t>(heightPx_);
    const std::size_t drawn = pixels * 8 * static_cast<std::size_t>(samples_);
    return samples_ > 1 ? drawn + pixels * 4 : drawn;
}

}  // namespace planet::gl
