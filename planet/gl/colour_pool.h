// Tiles of colour on the GPU, and what the surface finds them by.
//
// A pool: a texture array whose layer is a tile's slot. A page table: for each face and level a texel for
// each tile there would be of that level, which names the finest resident tile over it, itself or one above;
// so one lookup finds what there is for any place at any level (virtual texturing, after Barrett, "Sparse
// virtual textures", GDC 2008). And the six roots once more with mipmaps, for a planet that is small in the
// picture.
//
// Everything here wants a current context, and the same one throughout; one thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/colour_tile.h"
#include "planet/gl/colour_pool_config.h"
#include "planet/gl/gl_objects.h"
#include "planet/planet.h"
#include "planet/result.h"

namespace planet::gl {

// The most tiles that the context can hold in one pool.
std::uint32_t mostColourTiles();

class ColourPool {
public:
    // The Error says what the context cannot hold.
    static Result<ColourPool> create(const ColourPoolConfig& config);

    // In the order that they came. The first of all changes begin anew.
    void follow(std::span<const ColourChange> changes);

    const ColourPoolConfig& config() const { return config_; }
    GLuint tiles() const { return tiles_.name(); }
    GLuint pages() const { return pages_.name(); }
    GLuint roots() const { return roots_.name(); }
    // Whether tiles stay BC1 on the GPU; where the context has none of it they are unpacked.
    bool isCompressed() const { return compressed_; }
    float anisotropy() const { return anisotropy_; }  // of its sampler, >= 1
    std::size_t bytes() const;

private:
    // What a texel of the page table says.
    struct Page {
        std::uint16_t slot = 0;
        std::uint16_t level = 0;
    };

    ColourPool() = default;
    void upload(std::uint32_t slot, const ColourTileData& tile);
    void uploadRoot(const ColourTileData& root);
    void setPages(const ChunkId& tile, Page page);
    Page pageOf(const ChunkId& tile) const;
    std::vector<Page>& levelOf(Face face, int level);

    ColourPoolConfig config_;
    bool compressed_ = false;
    float anisotropy_ = 1;
    Texture tiles_, pages_, roots_;
    std::vector<std::vector<Page>> table_;  // by face and level: 2^level x 2^level, rows from the south
};

}  // namespace planet::gl
