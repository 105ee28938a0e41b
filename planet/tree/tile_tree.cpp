#include "planet/tree/tile_tree.h"

#include <cassert>

#include "planet/tree/node_groups.h"

namespace planet {

namespace {

TileNode makeNode(const TileTree& tree, const TileData& tile, NodeIndex parent, std::uint32_t slot) {
    const bool hasChildren =
        tree.isDerived ? tile.isRefined && tile.id.level < tree.leafLevel : tile.children.exists();
    TileNode node;
    node.id = tile.id;
    node.directions = chunkDirections(tile.id);
    node.parent = parent;
    node.childrenState = hasChildren ? ChildrenState::Absent : ChildrenState::None;
    node.children = tile.children;
    node.slot = slot;
    return node;
}

}  // namespace

TileTree makeTileTree(int leafLevel, bool isDerived, const std::array<TileData, faceCount>& roots) {
    assert(leafLevel >= 0 && leafLevel <= maxTileLevel);
    TileTree tree;
    tree.leafLevel = leafLevel;
    tree.isDerived = isDerived;
    for (const TileData& root : roots)
        tree.nodes.push_back(makeNode(tree, root, noNode, static_cast<std::uint32_t>(tree.nodes.size())));
    tree.residentTiles = faceCount;
    return tree;
}

NodeIndex addTiles(TileTree& tree, NodeIndex parent, const std::array<TileData, quadrantCount>& children,
                   std::uint32_t firstSlot) {
    assert(tree.nodes[parent].firstChild == noNode);
    const NodeIndex first = takeGroup(tree);
    for (std::uint32_t q = 0; q < quadrantCount; ++q) {
        assert(children[q].id == childOf(tree.nodes[parent].id, static_cast<int>(q)));
        tree.nodes[first + q] = makeNode(tree, children[q], parent, firstSlot + q);
    }
    tree.nodes[parent].firstChild = first;
    changeState(tree.nodes[parent].childrenState, ChildrenState::Resident);
    tree.residentTiles += quadrantCount;
    return first;
}

void removeTiles(TileTree& tree, NodeIndex parent) {
    freeGroup(tree, parent);
    tree.nodes[parent].hasFailed = false;
    tree.residentTiles -= quadrantCount;
}

NodeIndex findTile(const TileTree& tree, const ChunkId& id) {
    return findResident(tree, id);
}

}  // namespace planet
