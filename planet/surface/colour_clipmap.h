// A clipmap over the colour tiles: the places of its windows, and the texels that they gain when the viewer
// moves (Tanner, Migdal, Jones, "The clipmap: a virtual mipmap", SIGGRAPH 1998; toroidal update as in Losasso
// and Hoppe, "Geometry clipmaps", SIGGRAPH 2004).
//
// Texels are those of the colour quadtree (colour_tile.h). At level l, a face has (colourTileCells << l) + 1
// texels per side, counted from 0, plus the border of its outermost tiles. Levels that fit into a window are
// kept whole, for all six faces. At each finer level, a window of sizePx x sizePx texels follows the viewer.
// Beyond a face's edge, the window continues on the next face, which has a separate window for its part,
// placed as if that face were unfolded into the plane of the viewer's face. So a level takes two or three
// windows at edges and corners, and one elsewhere. A texel is stored at its coordinates modulo sizePx, so
// texels that stay in the window are neither moved nor filled again.
//
// Contains no GL. Pure functions and plain data, one thread at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "planet/format/colour_tile.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"

namespace planet {

inline constexpr int smallestClipmapPx = 256;
inline constexpr int largestClipmapPx = 4096;
inline constexpr int clipmapStepTexels = 8;     // windows move by whole steps, so small moves are free
inline constexpr int clipmapMarginTexels = 16;  // not drawn from: room for a step and an anisotropic filter

struct TexelRect {
    int x = 0;  // of the first column
    int y = 0;
    int width = 0;
    int height = 0;

    bool isEmpty() const { return width <= 0 || height <= 0; }
    std::int64_t count() const { return isEmpty() ? 0 : std::int64_t{width} * height; }
    bool operator==(const TexelRect&) const = default;
};
TexelRect intersectionOf(const TexelRect& a, const TexelRect& b);

struct ClipmapLayout {
    int sizePx = 1024;   // a power of two, [smallestClipmapPx, largestClipmapPx]
    int leafLevel = 0;   // of the quadtree
    int wholeLevel = 0;  // this level and all coarser ones are kept whole

    int movingLevels() const { return leafLevel - wholeLevel; }
    bool operator==(const ClipmapLayout&) const = default;
};
// Returns the layout. An invalid size is replaced by the next smaller power of two or the nearest valid one.
ClipmapLayout clipmapLayout(int sizePx, int leafLevel);

// Return the GPU memory of the levels that are kept whole, and of each window.
std::size_t clipmapBaseBytes(const ClipmapLayout& layout);
std::size_t clipmapWindowBytes(const ClipmapLayout& layout);
// Describes the base's texture: for each face the finest whole level in the corner, the others in a row above
// it.
glm::ivec2 clipmapBaseSize(const ClipmapLayout& layout);
glm::ivec2 clipmapBaseCorner(const ClipmapLayout& layout, int level);

// The place on the cube under the viewer.
struct ClipmapCentre {
    glm::dvec3 cube{1, 0, 0};  // on the cube [-1, 1]^3
    Face home = Face::PosX;    // its face
};
ClipmapCentre clipmapCentre(const glm::dvec3& eyeM);  // not (0, 0, 0)

// Returns a face's texels at a level, including the border.
TexelRect faceTexels(int level);
// Returns the texels that show a tile or its descendants, including the border if the tile lies at the face's
// edge. Texels that two tiles share belong to the eastern or northern one only. level: the tile's or finer.
TexelRect texelsUnder(const ChunkId& tile, int level);
// Returns the texels of a face in the window of a level that is not whole; empty if it has no window.
TexelRect clipmapWindow(const ClipmapLayout& layout, const ClipmapCentre& centre, Face face, int level);

// Returns the texels that a window has gained: at most four disjoint rectangles.
std::vector<TexelRect> texelsThatCameIn(const TexelRect& before, const TexelRect& now);

// The storage of texels: a rectangle no larger than the window, cut where it wraps around.
struct TorusPiece {
    TexelRect texels;
    int column = 0;  // [0, sizePx)
    int row = 0;
};
std::vector<TorusPiece> onTorus(const TexelRect& texels, int sizePx);

// Returns the reach of a window of level 0, in half sides of a face. Each finer level reaches half as far.
double clipmapReach(const ClipmapLayout& layout);
inline constexpr double clipmapFade = 0.125;  // share of a window's reach over which it fades

// A rectangle of texels to fill from the resident tiles.
struct ClipmapUpdate {
    Face face = Face::PosX;
    int level = 0;
    TexelRect texels;
    bool byMoving = false;  // false: because tiles arrived or were evicted

    bool operator==(const ClipmapUpdate&) const = default;
};

// The current windows. A window's layer is the storage of its texels.
class ClipmapWindows {
public:
    explicit ClipmapWindows(const ClipmapLayout& layout);

    // Mark texels as changed because the four tiles under a parent, or a root, have arrived or been evicted.
    void changeBlock(const ChunkId& parent);
    void changeRoot(Face face);
    // Discards all stored texels.
    void forget();

    // Moves the windows to the viewer and removes those of levels finer than finestLevel. One level more is
    // kept, so that it does not appear and disappear in turns. Returns the texels to fill, within the windows
    // and the whole levels.
    std::vector<ClipmapUpdate> move(const ClipmapCentre& centre, int finestLevel);

    const ClipmapLayout& layout() const { return layout_; }
    const ClipmapCentre& centre() const { return centre_; }
    int finestLevel() const { return finest_; }  // finest level with windows, or wholeLevel
    // Returns the stored texels of a face, at a level that is not whole.
    const TexelRect& window(Face face, int level) const { return at(face, level).texels; }
    int layerOf(Face face, int level) const { return at(face, level).layer; }  // -1: none
    int layerCount() const { return layerCount_; }                             // all layers are below it

private:
    struct Window {
        TexelRect texels;
        int layer = -1;
        std::vector<TexelRect> changed;  // since the last move
    };
    const Window& at(Face face, int level) const;
    Window& at(Face face, int level);
    void change(const ChunkId& tile, int coarsest);
    void place(Window& window, const TexelRect& now);
    void moveWindow(Face face, int level, std::vector<ClipmapUpdate>& updates);
    void fillWhole(Face face, int level, std::vector<ClipmapUpdate>& updates);

    ClipmapLayout layout_;
    ClipmapCentre centre_;
    int finest_ = 0;
    int layerCount_ = 0;
    std::vector<int> freeLayers_;  // below layerCount_
    std::array<std::array<Window, maxColourLevel + 1>, faceCount> windows_;
};

}  // namespace planet
