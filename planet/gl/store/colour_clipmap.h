// A clipmap of colours on the GPU. It is filled from the tiles of a TilePool through its page table, so it
// shows a coarser tile where a tile is not resident.
//
// The base has one layer per face for the levels that are kept whole: the finest in the corner, the others in
// a row above it. The stack has one window per layer; a texel lies at its coordinates modulo the size. Both
// are uncompressed, because BC1 textures cannot be rendered to. The stack starts with one layer per level.
// Near a face's edge there are more windows: the stack then grows, is filled again, and keeps that size.
//
// All calls require the same current context; one thread.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "planet/base/result.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/store/colour_clipmap_state.h"
#include "planet/gl/store/tile_pool.h"
#include "planet/paging/paging_types.h"

namespace planet::gl {

struct alignas(16) ClipmapWindow {
    glm::vec2 first;
    int layer;
};

// The uniform block of shaders/colour_clipmap.glsl, which describes its members. They have std140 offsets,
// because every vec3 is aligned to 16 bytes.
struct ClipmapUniforms {
    std::array<ClipmapWindow, faceCount*(maxColourLevel + 1)> windows;
    alignas(16) glm::vec3 centre;
    float sizePx;
    alignas(16) glm::vec3 up;
    float reach, perFade;
    int finestLevel, wholeLevel;
};

class ColourClipmap {
public:
    // Creates a clipmap of a pool's colours with windows of sizePx texels per side, [smallestClipmapPx,
    // largestClipmapPx]. The Error says what the context cannot hold.
    static Result<ColourClipmap> create(int sizePx, const TilePool& pool);

    // Applies the changes that the pool has applied.
    void follow(std::span<const TileChange> changes);

    // Moves the windows around the viewer, drops those finer than finestLevel, and fills new and changed
    // texels with fillProgram. Keeps the bound framebuffer and the viewport; leaves depth test, culling,
    // blending and scissor off. The Error says what the context is out of memory for; the clipmap must not be
    // drawn after it.
    Result<void> move(const glm::dvec3& eyeM, int finestLevel, const TilePool& pool, GLuint fillProgram);

    bool isFilled() const { return filled_; }  // false before the first move
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
