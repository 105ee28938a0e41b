#include "planet/select/skirt_depth.h"

#include <algorithm>

#include "planet/select/screen_error.h"

namespace planet {

namespace {

// Returns the error of a chunk with a morph towards its parent, metres.
float boundM(const ChunkTree& tree, ErrorMetric metric, const DrawItem& item, float morph) {
    if (morph == 0) return item.deltaCM;
    const NodeIndex parent = tree.nodes[item.node].parent;
    if (parent == noNode) return item.deltaCM;
    return item.deltaCM + morph * (deltaOf(tree.nodes[parent], metric) - item.deltaCM);
}

}  // namespace

float mostApartM(const ChunkTree& tree, ErrorMetric metric, const DrawItem& finer, Edge finerEdge,
                 const DrawItem& coarser, Edge coarserEdge) {
    const bool level = finer.id.level == coarser.id.level;
    const float morph = finer.edgeMorph[static_cast<std::size_t>(finerEdge)];
    const float coarserMorph = level ? morph : coarser.edgeMorph[static_cast<std::size_t>(coarserEdge)];
    return boundM(tree, metric, finer, morph) + boundM(tree, metric, coarser, coarserMorph);
}

float leastSkirtDepthM(const ChunkTree& tree, const DrawItem& item) {
    return std::max(static_cast<float>(2 * tree.shape.quantumM), 1e-6f * item.distanceM);
}

float automaticSkirtDepthM(const ChunkTree& tree, const DrawItem& item, float apartM, double factor) {
    if (factor <= 0) return 0;
    return std::max(leastSkirtDepthM(tree, item), static_cast<float>(factor * apartM));
}

}  // namespace planet
