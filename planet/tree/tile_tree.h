// The resident part of the six quadtrees of tiles, of colours or of normals: plain data that selection reads
// and paging grows and prunes. The renderer holds the texels; a tile is a slot in its pool. One thread at a
// time.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planet/format/chunk_file_types.h"
#include "planet/format/tile_layout.h"
#include "planet/sphere/bounds.h"
#include "planet/tree/block_state.h"
#include "planet/tree/node_index.h"

namespace planet {

struct TileNode {
    ChunkId id;
    ChunkDirections directions;
    NodeIndex parent = noNode;
    NodeIndex firstChild = noNode;  // four in sequence, in quadrant order
    ChildrenState childrenState = ChildrenState::None;
    BlockLocation children;           // in the file
    bool hasFailed = false;           // its children could not be read and are resident as a checker pattern
    std::uint32_t slot = 0;           // in the pool of tiles
    std::uint64_t lastUsedFrame = 0;  // last frame that selection visited it
};

struct TileTree {
    int leafLevel = -1;  // -1: no tiles
    // From heights: children have no location in the file, and exist where heights are finer.
    bool isDerived = false;
    std::vector<TileNode> nodes;        // first the six roots, in face order; the rest free or in fours
    std::vector<NodeIndex> freeGroups;  // first nodes of free groups of four
    std::size_t residentTiles = 0;
};

// Makes the tree of six roots, given in face order. They stay resident and take slots 0 to 5. leafLevel: [0,
// maxTileLevel].
TileTree makeTileTree(int leafLevel, bool isDerived, const std::array<TileData, faceCount>& roots);

// Adds the four children of a node, which must be Requested, in consecutive slots from firstSlot. Returns the
// first node.
NodeIndex addTiles(TileTree& tree, NodeIndex parent, const std::array<TileData, quadrantCount>& children,
                   std::uint32_t firstSlot);

// Removes a node's four resident children, none of which may have resident children of its own.
void removeTiles(TileTree& tree, NodeIndex parent);

// Returns the node of an id, or noNode if it is not resident.
NodeIndex findTile(const TileTree& tree, const ChunkId& id);

}  // namespace planet
