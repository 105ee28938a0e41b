#include "planet/gl/store/tile_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "planet/gl/device/gpu_memory.h"
#include "planet/gl/device/software_renderer.h"
#include "planet/paging/normal_tile.h"

namespace planet::gl {

namespace {

bool hasBc1() {
    return epoxy_has_gl_extension("GL_EXT_texture_compression_s3tc") &&
           (epoxy_has_gl_extension("GL_EXT_texture_sRGB") ||
            epoxy_has_gl_extension("GL_EXT_texture_compression_s3tc_srgb"));
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
    const auto most = static_cast<std::uint32_t>(std::max(layers, static_cast<GLint>(faceCount)));
    return std::min(most - static_cast<std::uint32_t>(faceCount), noTile);
}

Result<TilePool> TilePool::create(const ColourPoolConfig& config) {
    const bool compressed = config.format == ColourFormat::Bc1 && hasBc1() && !config.unpacked;
    Texels texels;
    texels.internalFormat =
        compressed ? static_cast<GLenum>(GL_COMPRESSED_SRGB_S3TC_DXT1_EXT) : static_cast<GLenum>(GL_SRGB8);
    texels.rootsInternalFormat = GL_SRGB8;
    texels.format = GL_RGB;
    texels.type = GL_UNSIGNED_BYTE;
    texels.isCompressed = compressed;
    texels.mipmapsInTiles = !compressed && isSoftwareRenderer();
    texels.tileBytes = colourTileBytes(compressed ? ColourFormat::Bc1 : ColourFormat::Lossless);
    texels.rootBytes = colourTileBytes(ColourFormat::Lossless);
    texels.colours = config.format;
    texels.name = "colour tiles";
    return make(texels, config.leafLevel, config.tileCapacity);
}

Result<TilePool> TilePool::create(const NormalPoolConfig& config) {
    Texels texels;
    texels.internalFormat = texels.rootsInternalFormat = GL_RG16F;
    texels.format = GL_RG;
    texels.type = GL_HALF_FLOAT;
    texels.tileBytes = texels.rootBytes = normalTileBytes;
    texels.name = "normal tiles";
    return make(texels, config.leafLevel, config.tileCapacity);
}

Result<TilePool> TilePool::make(const Texels& texels, int leafLevel, std::uint32_t tileCapacity) {
    assert(tileCapacity >= faceCount && leafLevel <= maxTileLevel);
    if (tileCapacity > mostColourTiles()) {
        return badInput(
            fmt::format("GPU limit: {} {} exceed GL_MAX_ARRAY_TEXTURE_LAYERS, {}; reduce their share of the "
                        "budget",
                        tileCapacity, texels.name, mostColourTiles()));
    }
    TilePool pool;
    pool.texels_ = texels;
    pool.leafLevel_ = leafLevel;
    pool.tileCapacity_ = tileCapacity;
    if (!hasRoomFor([&] { pool.allocate(); })) {
        return badInput(fmt::format("GPU out of memory: {} {}; reduce their share of the budget",
                                    tileCapacity, texels.name));
    }
    return pool;
}

void TilePool::allocate() {
    const auto layers = static_cast<GLsizei>(tileCapacity_ + (texels_.mipmapsInTiles ? faceCount : 0));
    tiles_ = makeArray();
    anisotropy_ = anisotropyToUse();
    setSampling(GL_LINEAR, GL_LINEAR, 0);
    if (anisotropy_ > 1) glTexParameterf(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy_);
    if (texels_.isCompressed) {
        glCompressedTexImage3D(GL_TEXTURE_2D_ARRAY, 0, texels_.internalFormat, tileTexels, tileTexels, layers,
                               0, static_cast<GLsizei>(texels_.tileBytes * tileCapacity_), nullptr);
    } else {
        glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(texels_.internalFormat), tileTexels,
                     tileTexels, layers, 0, texels_.format, texels_.type, nullptr);
    }
    roots_ = makeArray();
    setSampling(mipmapFilter(), GL_LINEAR, coarsestRootMipmap);
    if (anisotropy_ > 1) glTexParameterf(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_ANISOTROPY_EXT, anisotropy_);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(texels_.rootsInternalFormat), tileTexels,
                 tileTexels, faceCount, 0, texels_.format, texels_.type, nullptr);
    pages_ = makeArray();
    setSampling(GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, leafLevel_);
    for (int level = 0; level <= leafLevel_; ++level) {
        const GLsizei across = 1 << level;
        glTexImage3D(GL_TEXTURE_2D_ARRAY, leafLevel_ - level, GL_RGBA16UI, across, across, faceCount, 0,
                     GL_RGBA_INTEGER, GL_UNSIGNED_SHORT, nullptr);
    }
}

std::vector<TilePool::Page>& TilePool::levelOf(Face face, int level) {
    return table_[static_cast<std::size_t>(face) * static_cast<std::size_t>(leafLevel_ + 1) +
                  static_cast<std::size_t>(level)];
}

TilePool::Page TilePool::pageOf(const ChunkId& tile) const {
    const auto at = static_cast<std::size_t>(tile.face) * static_cast<std::size_t>(leafLevel_ + 1) +
                    static_cast<std::size_t>(tile.level);
    return table_[at][(std::size_t{tile.y} << tile.level) + tile.x];
}

void TilePool::follow(std::span<const TileChange> changes) {
    for (const TileChange& change : changes) {
        if (change.resets) reset();
        if (change.gone) {
            const Page above = pageOf(*change.gone);
            for (int q = 0; q < quadrantCount; ++q)
                setPages(childOf(*change.gone, q), above.slot, above.level);
        }
        for (std::uint32_t i = 0; i < change.arrived.size(); ++i) {
            const TileData& tile = change.arrived[i];
            const std::uint32_t slot = change.firstSlot + i;
            upload(slot, tile);
            if (tile.id.level == 0) uploadRoot(tile);
            setPages(tile.id, static_cast<std::uint16_t>(slot), tile.id.level);
        }
    }
}

void TilePool::reset() {
    table_.clear();
    for (std::size_t face = 0; face < faceCount; ++face) {
        for (int level = 0; level <= leafLevel_; ++level) table_.emplace_back(std::size_t{1} << (2 * level));
    }
    for (const Face face : allFaces) setPages({face, 0, 0, 0}, noTile, 0);
}

// Returns the texels for a texture whose format is not the tile's own.
std::vector<std::uint8_t> TilePool::unpacked(const TileData& tile) const {
    if (texels_.colours) return rgbOfColourTexels(*texels_.colours, tile.texels);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(tile.texels.data());
    return {bytes, bytes + tile.texels.size()};
}

void TilePool::upload(std::uint32_t slot, const TileData& tile) {
    assert(slot < tileCapacity_);
    assert(tile.texels.size() == (texels_.colours ? colourTileBytes(*texels_.colours) : normalTileBytes));
    const auto layer = static_cast<GLint>(slot);
    glBindTexture(GL_TEXTURE_2D_ARRAY, tiles_.name());
    if (texels_.isCompressed) {
        glCompressedTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, tileTexels, tileTexels, 1,
                                  texels_.internalFormat, static_cast<GLsizei>(tile.texels.size()),
                                  tile.texels.data());
        return;
    }
    const std::vector<std::uint8_t> texels = unpacked(tile);
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, tileTexels, tileTexels, 1, texels_.format,
                    texels_.type, texels.data());
}

void TilePool::uploadRoot(const TileData& root) {
    const std::vector<std::uint8_t> texels = unpacked(root);
    glBindTexture(GL_TEXTURE_2D_ARRAY, roots_.name());
    glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, static_cast<GLint>(root.id.face), tileTexels, tileTexels, 1,
                    texels_.format, texels_.type, texels.data());
    glGenerateMipmap(GL_TEXTURE_2D_ARRAY);
    if (texels_.mipmapsInTiles) copyMipmaps(root.id.face);
}

// Copies the mipmaps of a root into a layer behind the slots: each one to the right of the one that is twice as large, so
// that the shader finds them by a formula (colour_tiles.glsl).
void TilePool::copyMipmaps(Face face) {
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 1; level <= coarsestRootMipmap; ++level) {
        const int side = tileTexels >> level;
        const int column = tileTexels - (tileTexels >> (level - 1));
        const std::size_t faceBytes = static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3;
        std::vector<std::uint8_t> texels(faceBytes * faceCount);
        glBindTexture(GL_TEXTURE_2D_ARRAY, roots_.name());
        glGetTexImage(GL_TEXTURE_2D_ARRAY, level, texels_.format, texels_.type, texels.data());
        glBindTexture(GL_TEXTURE_2D_ARRAY, tiles_.name());
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, column, 0,
                        static_cast<GLint>(tileCapacity_) + static_cast<GLint>(face), side, side, 1,
                        texels_.format, texels_.type,
                        texels.data() + faceBytes * static_cast<std::size_t>(face));
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

// Writes a resident tile, or noTile, to the page of a place in the tree and to those of all its descendants, none of which
// is resident.
void TilePool::setPages(const ChunkId& tile, std::uint16_t slot, std::uint16_t tileLevel) {
    glBindTexture(GL_TEXTURE_2D_ARRAY, pages_.name());
    for (int level = tile.level; level <= leafLevel_; ++level) {
        Page page{slot, tileLevel, slot, tileLevel};
        if (level == tile.level && level > 0) {
            const Page above = pageOf(parentOf(tile));
            page.coarserSlot = above.slot;
            page.coarserLevel = above.level;
        }
        const int finer = level - tile.level;
        const std::size_t side = std::size_t{1} << finer;
        const std::size_t firstColumn = std::size_t{tile.x} << finer;
        const std::size_t firstRow = std::size_t{tile.y} << finer;
        std::vector<Page>& pages = levelOf(tile.face, level);
        for (std::size_t row = firstRow; row < firstRow + side; ++row)
            std::fill_n(pages.begin() + static_cast<std::ptrdiff_t>((row << level) + firstColumn), side,
                        page);
        const std::vector<Page> square(side * side, page);
        glTexSubImage3D(GL_TEXTURE_2D_ARRAY, leafLevel_ - level, static_cast<GLint>(firstColumn),
                        static_cast<GLint>(firstRow), static_cast<GLint>(tile.face),
                        static_cast<GLsizei>(side), static_cast<GLsizei>(side), 1, GL_RGBA_INTEGER,
                        GL_UNSIGNED_SHORT, square.data());
    }
}

std::size_t TilePool::bytes() const {
    std::size_t pageTexels = 0;
    for (int level = 0; level <= leafLevel_; ++level) pageTexels += std::size_t{faceCount} << (2 * level);
    return (tileCapacity_ + (texels_.mipmapsInTiles ? faceCount : 0)) * texels_.tileBytes +
           faceCount * texels_.rootBytes * 4 / 3 + pageTexels * sizeof(Page);
}

}  // namespace planet::gl
