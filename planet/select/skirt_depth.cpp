#include "planet/select/skirt_depth.h"

#include <algorithm>

#include "planet/select/screen_error.h"

namespace planet {

namespace {

// Returns the error of a chunk with a morph towards its parent, metres. ownM: without the morph.
float boundM(const ChunkTree& tree, ErrorMetric metric, NodeIndex node, float ownM, float morph) {
    if (morph == 0) return ownM;
    const NodeIndex parent = tree.nodes[node].parent;
    if (parent == noNode) return ownM;
    return ownM + morph * (deltaOf(tree.nodes[parent], metric) - ownM);
}

}  // namespace

float mostApartM(const ChunkTree& tree, ErrorMetric metric, const DrawItem& finer, Edge finerEdge,
                 const DrawItem& coarser, Edge coarserEdge) {
    const bool level = finer.id.level == coarser.id.level;
    const float morph = finer.edgeMorph[static_cast<std::size_t>(finerEdge)];
    const float coarserMorph = level ? morph : coarser.edgeMorph[static_cast<std::size_t>(coarserEdge)];
    const float finerM = boundM(tree, metric, finer.node, finer.deltaCM, morph);
    if (level || !isSparse(tree))
        return finerM + boundM(tree, metric, coarser.node, coarser.deltaCM, coarserMorph);
    const NodeIndex beside = ancestorAt(tree, finer.node, coarser.id.level);
    const float besideM = deltaOf(tree.nodes[beside], metric);
    return finerM + boundM(tree, metric, beside, besideM, coarserMorph);
}

NodeIndex ancestorAt(const ChunkTree& tree, NodeIndex finer, int level) {
    NodeIndex at = finer;
    while (tree.nodes[at].id.level > level) at = tree.nodes[at].parent;
    return at;
}

float leastSkirtDepthM(const ChunkTree& tree, const DrawItem& item) {
    return std::max(static_cast<float>(2 * fileQuantumM(tree.shape)), 1e-6f * item.distanceM);
}

float automaticSkirtDepthM(const ChunkTree& tree, const DrawItem& item, float apartM, double factor) {
    if (factor <= 0) return 0;
    return std::max(leastSkirtDepthM(tree, item), static_cast<float>(factor * apartM));
}

}  // namespace planet
