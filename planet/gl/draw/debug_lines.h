// Draws lines over a picture that ChunkRenderer has drawn. Requires a current context; one thread.
#pragma once

#include <cstddef>
#include <span>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/gl/draw/projection.h"
#include "planet/sphere/view.h"

namespace planet::gl {

enum class LineDepth : std::uint8_t {
    Hidden,  // hidden by nearer ground
    Faint,   // drawn at a quarter of the opacity behind nearer ground
    InFront,
};

class DebugLines {
public:
    static Result<DebugLines> create();

    // Draws into the bound framebuffer with the projection of the last ChunkRenderer::draw. widthPx: [1, 16],
    // with antialiased sides. Leaves depth test, blending and clip control as in a new context.
    void draw(const View& view, const Projection& projection, std::span<const LineVertex> lines,
              float widthPx, LineDepth depth);

    std::size_t gpuBytes() const { return bytes_; }

private:
    DebugLines() = default;
    void upload(const glm::dvec3& eyeM, std::span<const LineVertex> lines);
    void setUniforms(const View& view, const Projection& projection, float widthPx) const;
    void drawPass(GLsizei lineCount, GLenum depthFunction, float opacity) const;

    Program program_;
    VertexArray array_;
    Buffer vertices_;
    std::size_t bytes_ = 0;
};

}  // namespace planet::gl
