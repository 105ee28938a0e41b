// A clipmap of colours on the GPU, filled from the tiles of a TilePool through its page table, so that it
// shows what the tiles show: of what is not resident, what lies above.
//
// The base: a layer for each face with the levels that are kept whole, the finest in the corner, the others
// in a row above it. The stack: a window a layer, a texel at its coordinates modulo the size. Both
// uncompressed: textures that are drawn into cannot be BC1. The stack begins with a layer for each level;
// where more windows stand, near a face's edge, it is made larger and filled anew, and stays so large.
//
// Everything here wants a current context, and the same one throughout; one thread.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/store/colour_clipmap_state.h"
#include "planet/gl/store/tile_pool.h"
#include "planet/paging/paging_types.h"

namespace planet::gl {

// The uniform block of shaders/colour_clipmap.glsl. std140: only members of 16 bytes.
struct ClipmapUniforms {
    std::array<glm::vec4, faceCount*(maxColourLevel + 1)> windows;
    glm::vec4 centre, up, sizes;
    glm::ivec4 whole;
};
static_assert(sizeof(ClipmapUniforms) == (66 + 4) * 16);

class ColourClipmap {
public:
    // Of a pool's colours, in windows of so many pixels, [smallestClipmapPx, largestClipmapPx]. The Error
    // says what the context cannot hold.
    static Result<ColourClipmap> create(int sizePx, const TilePool& pool);

    // What the pool has followed.
    void follow(std::span<const TileChange> changes);

    // Puts the windows around the viewer, and fills with fillProgram what that and the changes since bring
    // in; windows of levels finer than the one wanted go. Keeps what is bound for drawing and the viewport;
    // leaves depth test, culling, blending and scissor off. An Error says what the context has no room for:
    // then the windows are no longer to be drawn from.
    Result<void> move(const glm::dvec3& eyeM, int finestLevel, const TilePool& pool, GLuint fillProgram);

    bool isFilled() const { return filled_; }  // false until it is first moved
    GLuint base() const { return base_.name(); }
    GLuint stack() const { return stack_.name(); }
    const ClipmapUniforms& uniforms() const { return uniforms_; }
    const ColourClipmapState& state() const { return state_; }

private:
    ColourClipmap(const ClipmapLayout& layout, float anisotropy);
    Result<void> makeBase();
    Result<void> makeStack(int layers);
    void fill(std::span<const ClipmapUpdate> updates, const TilePool& pool, GLuint program) const;
    void describe(std::vector<ClipmapUpdate> updates);

    ClipmapWindows windows_;
    float anisotropy_ = 1;
    Texture base_, stack_;
    int stackLayers_ = 0;
    bool filled_ = false;
    Framebuffer framebuffer_;
    VertexArray noVertices_;
    ClipmapUniforms uniforms_{};
    ColourClipmapState state_;
};

}  // namespace planet::gl
