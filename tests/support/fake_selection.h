// Selections from the fake pyramid, for tests of selecting and of what looks at what was selected.
#pragma once

#include <map>
#include <random>
#include <set>
#include <unordered_set>

#include "planet/select/lod_select.h"
#include "tests/support/fake_pyramid.h"
#include "tests/support/sudden_lod.h"

namespace planet {

// Everything resident.
inline const ChunkTree& wholeTree() {
    static const ChunkTree tree = residentTree(fakePyramid(), deepestLevelOf(fakePyramid().shape));
    return tree;
}

// Whole down to a level, below it but for holes in what is resident, at random: one in so many.
inline ChunkTree patchyTree(std::mt19937& random, int wholeToLevel, unsigned oneIn) {
    ChunkTree tree = residentTree(fakePyramid(), wholeToLevel);
    for (NodeIndex i = 0; i < tree.nodes.size(); ++i) {
        if (tree.nodes[i].childrenState != ChildrenState::Absent || random() % oneIn == 0) continue;
        addFakeChildren(tree, i);
    }
    return tree;
}

inline LodSettings withoutCulling(double tauPx) {
    LodSettings settings = suddenLod();
    settings.tauPx = tauPx;
    settings.frustumCulling = settings.horizonCulling = false;
    return settings;
}

inline Selection select(const ChunkTree& tree, const View& view, const LodSettings& settings) {
    Selection selection;
    selectChunks(tree, view, settings, selection);
    return selection;
}

using ItemsById = std::map<ChunkId, DrawItem>;
inline ItemsById itemsOf(const Selection& selection) {
    ItemsById items;
    for (const DrawItem& item : selection.draw) items[item.id] = item;
    return items;
}

inline std::unordered_set<ChunkId> drawnIds(const Selection& selection) {
    std::unordered_set<ChunkId> ids;
    for (const DrawItem& item : selection.draw) ids.insert(item.id);
    return ids;
}

inline std::set<ChunkId> splitIds(const Selection& selection) {
    std::set<ChunkId> ids;
    for (const ChildrenRequest& split : selection.splits) ids.insert(split.parentId);
    return ids;
}

}  // namespace planet
