// Chooses the tiles of colours or of normals for a view, independent of the drawn chunks.
//
// A texel of level l is at most s_l = 2 R / (tileCells 2^l) metres wide. Nowell's mapping keeps the spacing
// of the cube's grid at the middles of a face's edges, and is nowhere wider (in the middle of a face it is
// 0.71 of that). Seen from a distance of D metres, a texel covers s_l K' / D pixels. So a tile is fine enough
// while
//
//   texels per pixel = D / (s_l K')  >=  the setting,
//
// with K' as for chunks (view.h). D is the distance to the bounds of the ground under the tile, which follow
// the resident chunks there.
//
// A pure function of its arguments, as selectChunks is. Any thread.
#pragma once

#include <cstdint>
#include <vector>

#include "planet/select/lod_types.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"
#include "planet/tree/tile_tree.h"

namespace planet {

struct TileSettings {
    // On: tiles are requested; take the changes of Planet::takeTileChanges(). Off: only the roots are
    // resident.
    bool enabled = false;
    // [0.1, 4]. Larger: sharper; twice the value takes four times the tiles.
    double texelsPerPixel = 1;

    bool operator==(const TileSettings&) const = default;
};

struct TileCounters {
    std::uint32_t visited = 0;       // visited tiles
    std::uint32_t waiting = 0;       // in view, and too coarse because children are missing
    std::uint32_t deepestLevel = 0;  // of the tiles in view
    float fewestTexelsPerPixel = 0;  // of the tiles in view; 0 if there are none
};

struct TileSelection {
    // The priority is the factor by which the parent has too few texels per pixel. Highest first. The nodes
    // are those of the tree of tiles.
    std::vector<ChildrenRequest> requests;
    std::vector<ChildrenRequest> splits;  // with resident and wanted children, parents first
    std::vector<NodeIndex> touched;  // all visited nodes, parents first: the shown ones and their ancestors
    TileCounters counters;
};

// Returns s_l above, metres.
double texelM(const PlanetShape& shape, int level);

// Refills the selection, keeping its capacity. lod: the settings of the chunks, for culling.
void selectTiles(const TileTree& tiles, const ChunkTree& chunks, const View& lodView,
                 const TileSettings& settings, const LodSettings& lod, TileSelection& selection);

}  // namespace planet
