#include "planet/gl/store/colour_clipmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <glm/common.hpp>
#include <utility>

#include "planet/gl/device/gpu_memory.h"
#include "planet/gl/device/shader_inputs.h"

namespace planet::gl {

namespace {

Result<Texture> makeLayers(const glm::ivec2& size, int layers, GLint wrap, float anisotropy) {
    GLint largest = 0;
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    Texture texture = makeTexture();
    bool made = std::max(size.x, size.y) <= largest && layers <= most;
    if (made) {
        glActiveTexture(GL_TEXTURE0);
        glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
        glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, wrap);
        glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, wrap);
        glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
        if (anisotropy > 1) glTexParameterf(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
        made = hasRoomFor([&] {
            glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_SRGB8_ALPHA8, size.x, size.y, layers, 0, GL_RGBA,
                         GL_UNSIGNED_BYTE, nullptr);
        });
    }
    if (made) return texture;
    return badInput(
        fmt::format("GPU out of memory: clipmap of {} layers of {} x {} texels; reduce the window size",
                    layers, size.x, size.y));
}

// Restores the framebuffer and the viewport after filling.
class DrawingKept {
public:
    DrawingKept() {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer_);
        glGetIntegerv(GL_VIEWPORT, viewport_.data());
    }
    DrawingKept(const DrawingKept&) = delete;
    DrawingKept& operator=(const DrawingKept&) = delete;
    ~DrawingKept() {
        glDisable(GL_FRAMEBUFFER_SRGB);
        glUseProgram(0);
        glBindVertexArray(0);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(framebuffer_));
        glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    }

private:
    GLint framebuffer_ = 0;
    std::array<GLint, 4> viewport_{};
};

}  // namespace

ColourClipmap::ColourClipmap(const ClipmapLayout& layout, float anisotropy)
    : windows_(layout),
      anisotropy_(anisotropy),
      framebuffer_(makeFramebuffer()),
      noVertices_(makeVertexArray()) {}

Result<ColourClipmap> ColourClipmap::create(int sizePx, const TilePool& pool) {
    ColourClipmap clipmap(clipmapLayout(sizePx, pool.leafLevel()), pool.anisotropy());
    const ClipmapLayout& layout = clipmap.windows_.layout();
    if (const Result<void> made = clipmap.makeBase(); !made) return tl::unexpected(made.error());
    if (const Result<void> made = clipmap.makeStack(layout.movingLevels()); !made)
        return tl::unexpected(made.error());
    clipmap.describe({});
    return clipmap;
}

Result<void> ColourClipmap::makeBase() {
    Result<Texture> made =
        makeLayers(clipmapBaseSize(windows_.layout()), faceCount, GL_CLAMP_TO_EDGE, anisotropy_);
    if (!made) return tl::unexpected(made.error());
    base_ = std::move(*made);
    state_.baseBytes = clipmapBaseBytes(windows_.layout());
    return {};
}

// Makes at least one layer, because a texture must be bound.
Result<void> ColourClipmap::makeStack(int layers) {
    const glm::ivec2 size = layers > 0 ? glm::ivec2(windows_.layout().sizePx) : glm::ivec2(1);
    stack_ = Texture();  // frees the old one first, so that both never exist at once
    stackLayers_ = 0;
    Result<Texture> made = makeLayers(size, std::max(layers, 1), GL_REPEAT, anisotropy_);
    if (!made) return tl::unexpected(made.error());
    stack_ = std::move(*made);
    stackLayers_ = layers;
    state_.stackBytes = static_cast<std::size_t>(layers) * clipmapWindowBytes(windows_.layout());
    return {};
}

void ColourClipmap::follow(std::span<const TileChange> changes) {
    for (const TileChange& change : changes) {
        if (change.resets) windows_.forget();
        if (change.gone) windows_.changeBlock(*change.gone);
        if (change.arrived.empty()) continue;
        const ChunkId& first = change.arrived.front().id;
        if (first.level == 0)
            windows_.changeRoot(first.face);
        else
            windows_.changeBlock(parentOf(first));
    }
}

Result<void> ColourClipmap::move(const glm::dvec3& eyeM, int finestLevel, const TilePool& pool,
                                 GLuint fillProgram) {
    const ClipmapCentre centre = clipmapCentre(eyeM);
    std::vector<ClipmapUpdate> updates = windows_.move(centre, finestLevel);
    if (windows_.layerCount() > stackLayers_) {
        const Result<void> made = makeStack(windows_.layerCount());
        if (!made) return tl::unexpected(made.error());
        // The old stack's texels are lost. forget() also makes the whole levels be filled again.
        windows_.forget();
        updates = windows_.move(centre, finestLevel);
    }
    if (!updates.empty()) fill(updates, pool, fillProgram);
    describe(std::move(updates));
    filled_ = true;
    return {};
}

void ColourClipmap::fill(std::span<const ClipmapUpdate> updates, const TilePool& pool, GLuint program) const {
    const DrawingKept kept;
    const ClipmapLayout& layout = windows_.layout();
    for (const GLenum test : std::to_array<GLenum>({GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_SCISSOR_TEST}))
        glDisable(test);
    glEnable(GL_FRAMEBUFFER_SRGB);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
    glBindVertexArray(noVertices_.name());
    bindTexture(Sampler::colourTiles, GL_TEXTURE_2D_ARRAY, pool.tiles());
    bindTexture(Sampler::colourPages, GL_TEXTURE_2D_ARRAY, pool.pages());
    glUseProgram(program);
    const auto place = [&](const char* name) { return glGetUniformLocation(program, name); };
    glUniform1i(place("leafLevel"), layout.leafLevel);
    const GLint firstTexel = place("firstTexel");
    const GLint face = place("face");
    const GLint level = place("level");
    const auto draw = [&](const TexelRect& texels, int column, int row) {
        glUniform2i(firstTexel, texels.x - column, texels.y - row);
        glViewport(column, row, texels.width, texels.height);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    };
    for (const ClipmapUpdate& update : updates) {
        const bool whole = update.level <= layout.wholeLevel;
        const int layer = whole ? static_cast<int>(update.face) : windows_.layerOf(update.face, update.level);
        glFramebufferTextureLayer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0,
                                  whole ? base_.name() : stack_.name(), 0, layer);
        glUniform1i(face, static_cast<int>(update.face));
        glUniform1i(level, update.level);
        if (whole) {
            const TexelRect all = faceTexels(update.level);
            const glm::ivec2 corner = clipmapBaseCorner(layout, update.level);
            draw(update.texels, corner.x + update.texels.x - all.x, corner.y + update.texels.y - all.y);
            continue;
        }
        for (const TorusPiece& piece : onTorus(update.texels, layout.sizePx))
            draw(piece.texels, piece.column, piece.row);
    }
}

void ColourClipmap::describe(std::vector<ClipmapUpdate> updates) {
    const ClipmapLayout& layout = windows_.layout();
    const ClipmapCentre& centre = windows_.centre();
    state_.layout = layout;
    state_.windows.clear();
    for (const Face face : allFaces) {
        for (int level = 0; level <= maxColourLevel; ++level) {
            const auto at =
                static_cast<std::size_t>(face) * (maxColourLevel + 1) + static_cast<std::size_t>(level);
            const bool moves = level > layout.wholeLevel && level <= layout.leafLevel;
            const int layer = moves ? windows_.layerOf(face, level) : -1;
            const TexelRect texels = moves ? windows_.window(face, level) : TexelRect{};
            uniforms_.windows[at] = {{texels.x, texels.y}, layer};
            if (layer >= 0) state_.windows.push_back({face, level, texels});
        }
    }
    uniforms_.centre = centre.cube;
    uniforms_.up = glm::abs(faceAxes(centre.home).normal);
    uniforms_.sizePx = static_cast<float>(layout.sizePx);
    uniforms_.reach = static_cast<float>(clipmapReach(layout));
    uniforms_.perFade = static_cast<float>(1 / clipmapFade);
    uniforms_.finestLevel = windows_.finestLevel();
    uniforms_.wholeLevel = layout.wholeLevel;
    state_.updatedTexels = 0;
    for (const ClipmapUpdate& update : updates) state_.updatedTexels += update.texels.count();
    state_.updates = std::move(updates);
}

}  // namespace planet::gl
