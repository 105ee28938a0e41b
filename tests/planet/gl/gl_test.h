// What the GL tests share: a context without a window, which must end each test without a GL error.
#pragma once

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "planet/gl/device/offscreen_context.h"
#include "planet/gl/device/render_target.h"
#include "planet/gl/draw/chunk_renderer.h"

namespace planet::gl {

class GlTest : public testing::Test {
protected:
    explicit GlTest(ContextVersion highest = {4, 6}) {
        Result<OffscreenContext> context = OffscreenContext::create({highest, true});
        if (!context) throw std::runtime_error(context.error().message);
        context_ = std::make_unique<OffscreenContext>(std::move(*context));
        if (!epoxy_has_gl_extension("GL_KHR_debug")) return;
        glEnable(GL_DEBUG_OUTPUT);
        glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
        glDebugMessageCallback(collectError, &reported_);
    }

    void TearDown() override {
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        EXPECT_TRUE(reported_.empty()) << reported_;
    }

    // Without it depth is as OpenGL always had it.
    static bool hasClipControl() {
        return epoxy_gl_version() >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control");
    }
    void forgetReported() { reported_.clear(); }
    const OffscreenContext& context() const { return *context_; }

private:
    static void APIENTRY collectError(GLenum, GLenum type, GLuint, GLenum, GLsizei, const GLchar* message,
                                      const void* user) {
        if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR)
            *static_cast<std::string*>(const_cast<void*>(user)) += message;
    }

    std::unique_ptr<OffscreenContext> context_;
    std::string reported_;
};

template <class T>
T valueOf(Result<T> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(*result);
}

// Colours that differ by so little in each channel.
inline bool areNear(const glm::ivec3& a, const glm::ivec3& b, int by = 1) {
    const glm::ivec3 d = glm::abs(a - b);
    return std::max({d.x, d.y, d.z}) <= by;
}

// A drawn picture, rows from the top.
struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
    std::vector<float> depth;  // empty with several samples
    float clearDepth = 0;      // where nothing was drawn

    glm::ivec3 at(int x, int y) const {
        const std::size_t first =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
        return {rgb[first], rgb[first + 1], rgb[first + 2]};
    }
    int brightness(int x, int y) const {
        const glm::ivec3 colour = at(x, y);
        return colour.x + colour.y + colour.z;
    }
    float depthAt(int x, int y) const {
        return depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x)];
    }
    bool isGround(int x, int y) const { return depthAt(x, y) != clearDepth; }
};

inline Picture drawPicture(ChunkRenderer& renderer, const View& view, std::span<const DrawItem> items,
                           const RenderSettings& settings, int samples = 1,
                           std::span<const ChunkTint> tints = {}) {
    const RenderTarget target = valueOf(RenderTarget::create(view.widthPx, view.heightPx, samples));
    target.bind();
    renderer.draw(view, items, settings, tints);
    target.resolve();
    Picture picture{
        view.widthPx, view.heightPx, target.readRgb(), {}, renderer.projection().reversedZ ? 0.0f : 1.0f};
    if (samples == 1) picture.depth = target.readDepth();
    return picture;
}

// Flat colours, no air, no sun: for tests that ask where something is drawn.
inline RenderSettings plainSettings() {
    RenderSettings settings;
    settings.lighting = false;
    settings.atmosphere = false;
    settings.surface = SurfaceColour::HeightRamp;
    return settings;
}

// One colour all over.
inline std::vector<ChunkTint> oneTint(std::size_t count, const std::array<std::uint8_t, 4>& rgba) {
    return std::vector<ChunkTint>(count, ChunkTint{rgba});
}

}  // namespace planet::gl
