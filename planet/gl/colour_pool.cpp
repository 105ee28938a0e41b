#include "planet/gl/colour_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>

#include "planet/gl/software_renderer.h"

namespace planet::gl {

namespace {

// Borders of tiles are wide enough for the samples of this.
constexpr float wantedAnisotropy = 8;

bool hasBc1() {
    return epoxy_has_gl_extension("GL_EXT_texture_compression_s3tc") &&
           (epoxy_has_gl_extension("GL_EXT_texture_sRGB") ||
            epoxy_has_gl_extension("GL_EXT_texture_compression_s3tc_srgb"));
}

// Mesa's software renderer has anisotropy, but some footprints make it sample at the wrong place.
float anisotropyToUse() {
    if (isSoftwareRenderer() || !epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic")) return 1;
    GLfloat most = 1;
    glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &most);
    return std::min(most, wantedAnisotropy);
}

void setSampling(GLint minFilter, GLint magFilter, GLint lastLevel) {
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, minFilter);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, magFilter);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, lastLevel);
}

Texture makeArray() {
    Texture texture = makeTexture();
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.name());
    return texture;
}

}  // namespace

std::uint32_t mostColourTiles() {
    GLint layers = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &layers);
    // As pages name slots.
    return std::min(static_cast<std::uint32_t>(std::max(layers, 0)), std::uint32_t{1} << 16);
}

Result<ColourPool> ColourPool::create(const ColourPoolConfig& config) {
    assert(config.tileCapacity >= faceCount && config.leafLevel <= maxColourLevel);
    if (config.tileCapacity > mostColourTiles()) {
        return badInput(
            fmt::format("this OpenGL context cannot hold {} tiles of colour: "
                        "GL_MAX_ARRAY_TEXTURE_LAYERS is {}; a smaller share of the budget needs fewer",
                        config.tileCapacity, mostColourTiles()));
    }
    ColourPool pool;
    pool.config_ = config;
    pool.compressed_ = config.format == ColourFormat::Bc1 && hasBc1();
    const auto layers = static_cast<GLsizei>(config.tileCapacity);
    while (glGetError() != GL_NO_ERROR) continue;  // so that what follows is the allocations' own
    pool.tiles_ = makeArray();
    const float anisotropy = pool.anisotropy_ = anisotropyToUse();
    setSampling(GL_LINEAR, GL_LINEAR, 0);
    if (anisotropy > 1) glTexParameterf(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
    if (pool.compressed_) {
        const std::size_t bytes = colourTileBytes(ColourFormat::Bc1) * config.tileCapacity;
        glCompressedTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_COMPRESSED_SRGB_S3TC_DXT1_EXT, colourTileTexels,
                               colourTileTexels, layers, 0, static_cast<GLsizei>(bytes), nullptr);
    } else {
        glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_SRGB8, colourTileTexels, colourTileTexels, layers, 0, GL_RGB,
                     GL_UNSIGNED_BYTE, nullptr);
    }
    pool.roots_ = makeArray();
    setSampling(mipmapFilter(), GL_LINEAR, std::bit_width(static_cast<unsigned>(colourTileTexels)) - 1);
    if (anisotropy > 1) glTexParameterf(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_SRGB8, colourTileTexels, colourTileTexels, faceCount, 0, GL_RGB,
                 GL_UNSIGNED_BYTE, nullptr);
    pool.pages_ = makeArray();
    setSampling(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, config.leafLevel);
    for (int level = 0; level <= config.leafLevel; ++level) {
        const GLsizei across = 1 << level;
        glTexImage3D(GL_TEXTURE_2D_ARRAY, config.leafLevel - level, GL_RG16UI, across, across, faceCount, 0,
                     GL_RG_INTEGER, GL_UNSIGNED_SHORT, nullptr);
    }
    if (glGetError() != GL_NO_ERROR) {
        return badInput(
            fmt::format("this OpenGL context has no memory for {} tiles of colour; a smaller share of "
                        "the budget needs fewer",
                        config.tileCapacity));
    }
    return pool;
}

std::vector<ColourPool::Page>& ColourPool::levelOf(Face face, int level) {
    return table_[static_cast<std::size_t>(face) * static_cast<std::size_t>(config_.leafLevel + 1) +
                  static_cast<std::size_t>(level)];
}

ColourPool::Page ColourPool::pageOf(const ChunkId& tile) const {
    const auto at = static_cast<std::size_t>(tile.face) * static_cast<std::size_t>(config_.leafLevel + 1) +
                    static_cast<std::size_t>(tile.level);
    return table_[at][(std::size_t{tile.y} << tile.level) + tile.x];
}

void ColourPool::follow(std::span<const ColourChange> changes) {
    for (const ColourChange& change : changes) {
        if (change.beginsAnew) {
            table_.clear();
            for (std::size_t face = 0; face < faceCount; ++face) {
                for (int level = 0; level <= config_.leafLevel; ++level)
                    table_.emplace_back(std::size_t{1} << (2 * level));
            }
        }
        if (change.gone) {
            const Page above = pageOf(*change.gone);
            for (int q = 0; q < quadrantCount; ++q) setPages(childOf(*change.gone, q), above);
        }
        for (std::uint32_t i = 0; i < change.arrived.size(); ++i) {
            const ColourTileData& tile = change.arrived[i];
            const std::uint32_t slot = change.firstSlot + i;
            upload(slot, tile);
            if (tile.id.level == 0) uploadRoot(tile);
            setPages(tile.id, {static_cast<std::uint16_t>(slot), tile.id.level});
        }
    }
}

void ColourPool::upload(std::uint32_t slot, const ColourTileData& tile) {
    assert(slot < config_.tileCapacity && tile.texels.size() == colourTileBytes(config_.format));
    const auto layer = static_cast<GLint>(slot);
    glBindTexture(GL_TEXTURE_2D_ARRAY, tiles_.name());
    if (compressed_) {
        glCompressedTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, colourTileTexels, colourTileTexels, 1,
                                  GL_COMPRESSED_SRGB_S3TC_DXT1_EXT, static_cast<GLsizei>(tile.texels.size()),
                                  tile.texels.data());
        return;
    }
    const std::vector<std::uint8_t> rgb = rgbOfColourTexels(config_.format, tile.texels);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, colourTileTexels, colourTileTexels, 1, GL_RGB,
                    GL_UNSIGNED_BYTE, rgb.data());
}

void ColourPool::uploadRoot(const ColourTileData& root) {
    const std::vector<std::uint8_t> rgb = rgbOfColourTexels(config_.format, root.texels);
    glBindTexture(GL_TEXTURE_2D_ARRAY, roots_.name());
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(root.id.face), colourTileTexels,
                    colourTileTexels, 1, GL_RGB, GL_UNSIGNED_BYTE, rgb.data());
    glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
}

// The tile's own texel and all those under it, of which nothing finer is resident.
void ColourPool::setPages(const ChunkId& tile, Page page) {
    glBindTexture(GL_TEXTURE_2D_ARRAY, pages_.name());
    for (int level = tile.level; level <= config_.leafLevel; ++level) {
        const int finer = level - tile.level;
        const std::size_t side = std::size_t{1} << finer;
        const std::size_t firstColumn = std::size_t{tile.x} << finer;
        const std::size_t firstRow = std::size_t{tile.y} << finer;
        std::vector<Page>& pages = levelOf(tile.face, level);
        for (std::size_t row = firstRow; row < firstRow + side; ++row)
            std::fill_n(pages.begin() + static_cast<std::ptrdiff_t>((row << level) + firstColumn), side,
                        page);
        const std::vector<Page> square(side * side, page);
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, config_.leafLevel - level, static_cast<GLint>(firstColumn),
                        static_cast<GLint>(firstRow), static_cast<GLint>(tile.face),
                        static_cast<GLsizei>(side), static_cast<GLsizei>(side), 1, GL_RG_INTEGER,
                        GL_UNSIGNED_SHORT, square.data());
    }
}

std::size_t ColourPool::bytes() const {
    const ColourFormat format = compressed_ ? ColourFormat::Bc1 : ColourFormat::Lossless;
    const std::size_t rootBytes = faceCount * colourTileBytes(ColourFormat::Lossless) * 4 / 3;
    std::size_t pageTexels = 0;
    for (int level = 0; level <= config_.leafLevel; ++level)
        pageTexels += std::size_t{faceCount} << (2 * level);
    return config_.tileCapacity * colourTileBytes(format) + rootBytes + pageTexels * sizeof(Page);
}

}  // namespace planet::gl
