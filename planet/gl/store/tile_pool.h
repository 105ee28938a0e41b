// Tiles of colours or of normals on the GPU, and what the surface finds them by.
//
// A pool: a texture array whose layer is a tile's slot. A page table: for each face and level a texel for
// each tile there would be of that level, which names the finest resident tile over it, itself or one above,
// or none;
// so one lookup finds what there is for any place at any level (virtual texturing, after Barrett, "Sparse
// virtual textures", GDC 2008). And the six roots once more with mipmaps, for a planet that is small in the
// picture.
//
// Everything here wants a current context, and the same one throughout; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planet/base/result.h"
#include "planet/format/colour_tile.h"
#include "planet/gl/device/gl_objects.h"
#include "planet/gl/store/colour_pool_config.h"
#include "planet/gl/store/normal_pool_config.h"
#include "planet/paging/paging_types.h"

namespace planet::gl {

// The most tiles that the context can hold in one pool.
std::uint32_t mostColourTiles();

class TilePool {
public:
    // The Error says what the context cannot hold.
    static Result<TilePool> create(const ColourPoolConfig& config);
    static Result<TilePool> create(const NormalPoolConfig& config);

    // In the order that they came. The first of all changes begin anew.
    void follow(std::span<const TileChange> changes);

    int leafLevel() const { return leafLevel_; }
    GLuint tiles() const { return tiles_.name(); }
    GLuint pages() const { return pages_.name(); }
    GLuint roots() const { return roots_.name(); }
    // Whether tiles stay BC1 on the GPU; where the context has none of it they are unpacked.
    bool isCompressed() const { return texels_.isCompressed; }
    float anisotropy() const { return anisotropy_; }  // of its sampler, >= 1
    std::size_t bytes() const;

private:
    // How the textures hold texels, and how they are given: those of roots may be given another way.
    struct Texels {
        GLenum internalFormat = 0;
        GLenum rootsInternalFormat = 0;
        GLenum format = 0;
        GLenum type = 0;
        bool isCompressed = false;
        std::size_t tileBytes = 0;  // on the GPU
        std::size_t rootBytes = 0;
        std::optional<ColourFormat> colours{};  // as the tiles come; none: normals
        const char* name = "";
    };
    // What a texel of the page table says.
    struct Page {
        std::uint16_t slot = 0xFFFF;  // none
        std::uint16_t level = 0;
    };

    TilePool() = default;
    static Result<TilePool> make(const Texels& texels, int leafLevel, std::uint32_t tileCapacity);
    void allocate();
    void beginAnew();
    void upload(std::uint32_t slot, const TileData& tile);
    void uploadRoot(const TileData& root);
    std::vector<std::uint8_t> unpacked(const TileData& tile) const;
    void setPages(const ChunkId& tile, Page page);
    Page pageOf(const ChunkId& tile) const;
    std::vector<Page>& levelOf(Face face, int level);

    Texels texels_;
    int leafLevel_ = 0;
    std::uint32_t tileCapacity_ = 0;
    float anisotropy_ = 1;
    Texture tiles_, pages_, roots_;
    std::vector<std::vector<Page>> table_;  // by face and level: 2^level x 2^level, rows from the south
};

}  // namespace planet::gl
