// Tiles of colours or of normals on the GPU, and the page table through which shaders find them (virtual
// texturing, after Barrett, "Sparse virtual textures", GDC 2008).
//
// The pool is a texture array with one tile per layer; the layer is the tile's slot. The page table has a
// texel for each possible tile of each level. It names the finest resident tile that covers it: the tile
// itself, an ancestor, or none. So one lookup finds the best tile for any place at any level. The six roots
// also exist with mipmaps, for a planet that is small in the picture. With software rendering, those mipmaps of colours
// lie in the same array as the tiles too, because one sampler for all costs less there.
//
// All calls require the same current context; one thread.
#pragma once

#include <bit>
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

// The slot in pages over which no tile is resident.
inline constexpr std::uint32_t noTile = 0xFFFF;

inline constexpr int coarsestRootMipmap = std::bit_width(static_cast<unsigned>(tileTexels)) - 1;  // one texel

// Returns the largest number of tiles that the context can hold in one pool.
std::uint32_t mostColourTiles();

class TilePool {
public:
    // Create an empty pool. The Error says what the context cannot hold.
    static Result<TilePool> create(const ColourPoolConfig& config);
    static Result<TilePool> create(const NormalPoolConfig& config);

    // Applies the changes in order; the first one resets the pool.
    void follow(std::span<const TileChange> changes);

    int leafLevel() const { return leafLevel_; }
    GLuint tiles() const { return tiles_.name(); }
    GLuint pages() const { return pages_.name(); }
    GLuint roots() const { return roots_.name(); }
    // Returns whether tiles stay BC1 on the GPU; without BC1 support they are unpacked.
    bool isCompressed() const { return texels_.isCompressed; }
    // Returns whether the last six layers of the tiles hold the mipmaps of the roots, one face per layer.
    bool hasMipmapsInTiles() const { return texels_.mipmapsInTiles; }
    float anisotropy() const { return anisotropy_; }  // of the sampler, >= 1
    std::size_t bytes() const;

private:
    // The formats of the textures on the GPU and of the texels uploaded; roots have their own.
    struct Texels {
        GLenum internalFormat = 0;
        GLenum rootsInternalFormat = 0;
        GLenum format = 0;
        GLenum type = 0;
        bool isCompressed = false;
        bool mipmapsInTiles = false;
        std::size_t tileBytes = 0;  // on the GPU
        std::size_t rootBytes = 0;
        std::optional<ColourFormat> colours{};  // format of the incoming tiles; unset: normals
        const char* name = "";
    };
    // A texel of the page table: the tile for its level, and the one for the level above, so that shaders find both
    // at once.
    struct Page {
        std::uint16_t slot = noTile;
        std::uint16_t level = 0;
        std::uint16_t coarserSlot = noTile;
        std::uint16_t coarserLevel = 0;
    };

    TilePool() = default;
    static Result<TilePool> make(const Texels& texels, int leafLevel, std::uint32_t tileCapacity);
    void allocate();
    void reset();
    void upload(std::uint32_t slot, const TileData& tile);
    void uploadRoot(const TileData& root);
    void copyMipmaps(Face face);
    std::vector<std::uint8_t> unpacked(const TileData& tile) const;
    void setPages(const ChunkId& tile, std::uint16_t slot, std::uint16_t tileLevel);
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
