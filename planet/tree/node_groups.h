// Adds, removes and finds nodes in the list of nodes of a quadtree. Internal to the library.
//
// Tree: a type with nodes and freeGroups, such as ChunkTree and TileTree.
#pragma once

#include <cassert>

#include "planet/sphere/chunk_id.h"
#include "planet/tree/block_state.h"
#include "planet/tree/node_index.h"

namespace planet {

// Returns the first of four consecutive nodes that are free, or new.
template <class Tree>
NodeIndex takeGroup(Tree& tree) {
    if (!tree.freeGroups.empty()) {
        const NodeIndex first = tree.freeGroups.back();
        tree.freeGroups.pop_back();
        return first;
    }
    const auto first = static_cast<NodeIndex>(tree.nodes.size());
    tree.nodes.resize(tree.nodes.size() + quadrantCount);
    return first;
}

// Frees the four children of a node. They must be resident, without resident children of their own.
template <class Tree>
void freeGroup(Tree& tree, NodeIndex parent) {
    auto& above = tree.nodes[parent];
    assert(above.childrenState == ChildrenState::Resident);
    for (NodeIndex child = above.firstChild; child < above.firstChild + quadrantCount; ++child) {
        assert(tree.nodes[child].firstChild == noNode);
        tree.nodes[child] = {};
    }
    tree.freeGroups.push_back(above.firstChild);
    above.firstChild = noNode;
    changeState(above.childrenState, ChildrenState::Absent);
}

// Returns the node of an id, or noNode if it is not resident.
template <class Tree>
NodeIndex findResident(const Tree& tree, const ChunkId& id) {
    auto index = static_cast<NodeIndex>(id.face);
    for (int level = 1; level <= id.level; ++level) {
        const auto& node = tree.nodes[index];
        if (node.childrenState != ChildrenState::Resident) return noNode;
        const int below = id.level - level;
        index = node.firstChild + ((id.x >> below) & 1) + 2 * ((id.y >> below) & 1);
    }
    return index;
}

}  // namespace planet
