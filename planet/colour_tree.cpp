#include "planet/colour_tree.h"

#include <cassert>

namespace planet {

namespace {

ColourNode makeNode(const ColourTileData& tile, NodeIndex parent, std::uint32_t slot) {
    ColourNode node;
    node.id = tile.id;
    node.directions = chunkDirections(tile.id);
    node.parent = parent;
    node.childrenState = tile.children.exists() ? ChildrenState::Absent : ChildrenState::None;
    node.children = tile.children;
    node.slot = slot;
    return node;
}

NodeIndex takeGroup(ColourTree& tree) {
    if (!tree.freeGroups.empty()) {
        const NodeIndex first = tree.freeGroups.back();
        tree.freeGroups.pop_back();
        return first;
    }
    const auto first = static_cast<NodeIndex>(tree.nodes.size());
    tree.nodes.resize(tree.nodes.size() + quadrantCount);
    return first;
}

}  // namespace

ColourTree makeColourTree(int leafLevel, const std::array<ColourTileData, faceCount>& roots) {
    assert(leafLevel >= 0 && leafLevel <= maxColourLevel);
    ColourTree tree;
    tree.leafLevel = leafLevel;
    for (const ColourTileData& root : roots)
        tree.nodes.push_back(makeNode(root, noNode, static_cast<std::uint32_t>(tree.nodes.size())));
    tree.residentTiles = faceCount;
    return tree;
}

NodeIndex addTiles(ColourTree& tree, NodeIndex parent,
                   const std::array<ColourTileData, quadrantCount>& children, std::uint32_t firstSlot) {
    assert(tree.nodes[parent].firstChild == noNode);
    const NodeIndex first = takeGroup(tree);
    for (std::uint32_t q = 0; q < quadrantCount; ++q) {
        assert(children[q].id == childOf(tree.nodes[parent].id, static_cast<int>(q)));
        tree.nodes[first + q] = makeNode(children[q], parent, firstSlot + q);
    }
    tree.nodes[parent].firstChild = first;
    tree.nodes[parent].childrenState = ChildrenState::Resident;
    tree.residentTiles += quadrantCount;
    return first;
}

void removeTiles(ColourTree& tree, NodeIndex parent) {
    const NodeIndex first = tree.nodes[parent].firstChild;
    assert(tree.nodes[parent].childrenState == ChildrenState::Resident);
    for (NodeIndex child = first; child < first + quadrantCount; ++child) {
        assert(tree.nodes[child].firstChild == noNode);
        tree.nodes[child] = {};
    }
    tree.freeGroups.push_back(first);
    tree.nodes[parent].firstChild = noNode;
    tree.nodes[parent].childrenState = ChildrenState::Absent;
    tree.nodes[parent].hasFailed = false;
    tree.residentTiles -= quadrantCount;
}

NodeIndex findTile(const ColourTree& tree, const ChunkId& id) {
    auto index = static_cast<NodeIndex>(id.face);
    for (int level = 1; level <= id.level; ++level) {
        if (tree.nodes[index].childrenState != ChildrenState::Resident) return noNode;
        index = tree.nodes[index].firstChild + static_cast<NodeIndex>(quadrantOf(ancestorOf(id, level)));
    }
    return index;
}

}  // namespace planet
