// A clipmap over the tiles of colour: where its windows stand, and which texels they gain when the viewer
// moves (Tanner, Migdal, Jones, "The clipmap: a virtual mipmap", SIGGRAPH 1998; toroidal update as in Losasso
// and Hoppe, "Geometry clipmaps", SIGGRAPH 2004).
//
// Texels are those of the colour quadtree (colour_tile.h): of level l a face has (colourTileCells << l) + 1 a
// side, counted from 0, and the border of its outermost tiles around them. Levels that fit into a window are
// kept whole, for all six faces. Of each finer level a window of sizePx x sizePx texels follows the viewer.
// Over a face's edge the window goes on on the next face, which has a window of its own for its part, placed
// as if that face were folded up into the plane of the viewer's: so a level costs two or three windows at
// edges and corners, and one elsewhere. A texel is stored at its coordinates modulo sizePx: nothing that
// stays is moved or made again.
//
// No GL. Pure functions and plain data, one thread at a time.
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
inline constexpr int clipmapStepTexels = 8;     // windows move by whole steps, so that small moves are free
inline constexpr int clipmapMarginTexels = 16;  // not drawn from: what a step and an anisotropic filter want

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
    int wholeLevel = 0;  // this and all coarser ones are kept whole

    int movingLevels() const { return leafLevel - wholeLevel; }
    bool operator==(const ClipmapLayout&) const = default;
};
// A size that is no power of two or out of range is taken as the next smaller or the nearest that is.
ClipmapLayout clipmapLayout(int sizePx, int leafLevel);

// What it takes on the GPU: the levels that are kept whole, and each window.
std::size_t clipmapBaseBytes(const ClipmapLayout& layout);
std::size_t clipmapWindowBytes(const ClipmapLayout& layout);
// The base's texture: for each face the finest whole level in the corner, the others in a row above it.
glm::ivec2 clipmapBaseSize(const ClipmapLayout& layout);
glm::ivec2 clipmapBaseCorner(const ClipmapLayout& layout, int level);

// The place under the viewer.
struct ClipmapCentre {
    glm::dvec3 cube{1, 0, 0};  // on the cube [-1, 1]^3
    Face home = Face::PosX;    // its face
};
ClipmapCentre clipmapCentre(const glm::dvec3& eyeM);  // not (0, 0, 0)

// A face's texels of a level, border included.
TexelRect faceTexels(int level);
// Those that show a tile or what is below it: the border where the tile lies at the face's edge, but of two
// tiles that share texels only the eastern and northern one's. Level: the tile's or finer.
TexelRect texelsUnder(const ChunkId& tile, int level);
// The texels of a face that the window of a level that is not whole holds; none: empty.
TexelRect clipmapWindow(const ClipmapLayout& layout, const ClipmapCentre& centre, Face face, int level);

// What a window holds that it did not before: at most four rectangles, none over another.
std::vector<TexelRect> texelsThatCameIn(const TexelRect& before, const TexelRect& now);

// Where texels are stored: a rectangle no larger than the window, cut where it wraps around.
struct TorusPiece {
    TexelRect texels;
    int column = 0;  // [0, sizePx)
    int row = 0;
};
std::vector<TorusPiece> onTorus(const TexelRect& texels, int sizePx);

// How far a place, [0, 1] across a face, is from the viewer in half sides of a face, as windows reach: along
// the larger axis on the viewer's face, over the edge added up on the next. Continuous all over the cube.
double clipmapDistance(const ClipmapCentre& centre, Face face, const glm::dvec2& place);
// The finest level that may be drawn there, wholeLevel or more; between two whole numbers two levels are
// mixed, so that the border of a window does not show. The shaders' own, for tests.
double clipmapFinest(const ClipmapLayout& layout, double distance);
// How far a window of level 0 would reach, in half sides of a face; each finer one reaches half as far.
double clipmapReach(const ClipmapLayout& layout);
inline constexpr double clipmapFade = 0.125;  // share of its reach over which a window fades into the coarser

// A rectangle of texels that is to be filled, from the tiles that are resident.
struct ClipmapUpdate {
    Face face = Face::PosX;
    int level = 0;
    TexelRect texels;
    bool byMoving = false;  // else because tiles arrived or went

    bool operator==(const ClipmapUpdate&) const = default;
};

// The windows as they stand. A window's layer is where its texels are stored.
class ClipmapWindows {
public:
    explicit ClipmapWindows(const ClipmapLayout& layout);

    // The four tiles under one have arrived or gone; or a root itself.
    void changeBlock(const ChunkId& parent);
    void changeRoot(Face face);
    // All that is stored is lost.
    void forget();

    // Puts the windows where they belong, those of levels finer than the finest one wanted away; a level is
    // kept for one more, so that it does not come and go. Returns what is to be filled, within the windows
    // and the whole levels.
    std::vector<ClipmapUpdate> move(const ClipmapCentre& centre, int finestLevel);

    const ClipmapLayout& layout() const { return layout_; }
    const ClipmapCentre& centre() const { return centre_; }
    int finestLevel() const { return finest_; }  // that has windows, or wholeLevel
    // Of a level that is not whole: what is stored of a face.
    const TexelRect& window(Face face, int level) const { return at(face, level).texels; }
    int layerOf(Face face, int level) const { return at(face, level).layer; }  // -1: none
    int layerCount() const { return layerCount_; }                             // layers are below this

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
