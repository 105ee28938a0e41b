// Chooses the tiles of colours or of normals for a view, independent of the drawn chunks.
//
// A texel of level l is at most s_l = 2 R / (tileCells 2^l) metres wide: Nowell's map gives the cube's
// grid its own spacing at the middle of a face's edges, and stretches it nowhere more (in a face's middle it
// is 0.71 of that). Seen from D metres it covers s_l K' / D pixels, so a tile is fine enough while
//
//   texels a pixel = D / (s_l K')  >=  the wanted,
//
// with K' as for chunks (view.h) and D the distance to the bounds of the ground under the tile, which follow
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
    // On: tiles are requested; take the changes of Planet::takeTileChanges(). Off: there are none below the
    // roots.
    bool enabled = false;
    // Larger: sharper, and four times the tiles for twice as many; [0.1, 4].
    double texelsPerPixel = 1;

    bool operator==(const TileSettings&) const = default;
};

struct TileCounters {
    std::uint32_t visited = 0;       // tiles looked at
    std::uint32_t waiting = 0;       // in view, and too coarse for lack of children
    std::uint32_t deepestLevel = 0;  // of what is in view
    float fewestTexelsPerPixel = 0;  // of what is in view; 0 where nothing is
};

struct TileSelection {
    // The priority is the factor by which the parent has too few texels per pixel. Highest first; nodes of
    // the tree of tiles.
    std::vector<ChildrenRequest> requests;
    std::vector<ChildrenRequest> splits;  // those whose children are resident and wanted, parents first
    std::vector<NodeIndex> touched;  // all visited, parents first: what is shown, and what stands above it
    TileCounters counters;
};

// Returns s_l above.
double texelM(const PlanetShape& shape, int level);

// Refills the selection, keeping its capacity. Culls as the settings of the chunks say.
void selectTiles(const TileTree& tiles, const ChunkTree& chunks, const View& lodView,
                 const TileSettings& settings, const LodSettings& lod, TileSelection& selection);

}  // namespace planet
