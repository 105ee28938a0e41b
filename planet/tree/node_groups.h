// Makes room for four siblings in a quadtree's list of nodes. Internal to the library.
#pragma once

#include "planet/sphere/chunk_id.h"
#include "planet/tree/node_index.h"

namespace planet {

// Returns the first of four nodes in a row that are free, or new. Tree: has nodes and freeGroups, like
// ChunkTree.
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

}  // namespace planet
