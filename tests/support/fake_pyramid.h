// A planet without a chunk file: every chunk of a small planet, made from a formula, with true errors and
// height ranges.
#pragma once

#include <algorithm>
#include <array>
#include <unordered_map>

#include "planet/paging/pager.h"
#include "planet/planet.h"

namespace planet {

struct FakePyramid {
    PlanetShape shape;
    std::int32_t minStep = 0;
    std::int32_t maxStep = 0;
    std::unordered_map<ChunkId, ChunkData> chunks;

    const ChunkData& at(const ChunkId& id) const { return chunks.at(id); }

    std::array<ChunkData, faceCount> roots() const {
        std::array<ChunkData, faceCount> all;
        for (const Face face : allFaces) all[static_cast<std::size_t>(face)] = at({face, 0, 0, 0});
        return all;
    }

    SiblingBlock childrenOf(const ChunkId& parent) const {
        SiblingBlock block;
        for (int q = 0; q < quadrantCount; ++q) block[static_cast<std::size_t>(q)] = at(childOf(parent, q));
        return block;
    }

    // Fails, as a reader would, when it is given another chunk's place or heights.
    Result<SiblingBlock> load(const ChunkId& parent, BlockLocation location, StepsView parentHeights) const {
        const ChunkData& above = at(parent);
        if (location != above.children) return badInput("wrong place for " + toString(parent));
        if (!std::equal(parentHeights.begin(), parentHeights.end(), above.heights.begin(),
                        above.heights.end())) {
            return badInput("wrong heights for " + toString(parent));
        }
        return childrenOf(parent);
    }

    PlanetSource source() const {
        PlanetSource made;
        made.shape = shape;
        made.minStep = minStep;
        made.maxStep = maxStep;
        made.roots = roots();
        made.loadChildren = [this](const ChunkId& parent, BlockLocation location, StepsView heights) {
            return load(parent, location, heights);
        };
        return made;
    }
};

// A planet of radius 100 km with 16 cells a chunk.
FakePyramid makeFakePyramid(int leafLevelWanted);

// One for all tests of a program; levels 0 to 4.
inline const FakePyramid& fakePyramid() {
    static const FakePyramid pyramid = makeFakePyramid(4);
    return pyramid;
}

inline LoadChildren pyramidLoader() {
    return [](const ChunkId& parent, BlockLocation location, StepsView heights) {
        return fakePyramid().load(parent, location, heights);
    };
}

// A node's children from the pyramid, each in the slot of its own index.
inline void addFakeChildren(ChunkTree& tree, NodeIndex parent, const FakePyramid& pyramid = fakePyramid()) {
    const auto next = static_cast<std::uint32_t>(tree.nodes.size());
    addChildren(tree, parent, pyramid.childrenOf(tree.nodes[parent].id),
                {next, next + 1, next + 2, next + 3});
}

// The tree with everything resident down to a level, each node in the slot of its own index.
inline ChunkTree residentTree(const FakePyramid& pyramid, int toLevel) {
    ChunkTree tree = makeChunkTree(pyramid.shape, pyramid.minStep, pyramid.maxStep, pyramid.roots()).value();
    for (NodeIndex i = 0; i < tree.nodes.size(); ++i) {
        const ChunkNode& node = tree.nodes[i];
        if (node.id.level >= toLevel || node.childrenState == ChildrenState::None) continue;
        addFakeChildren(tree, i, pyramid);
    }
    return tree;
}

inline glm::dvec3 vertexM(const PlanetShape& shape, const ChunkId& id, int column, int row, double height) {
    const FaceSquare square = faceSquareOf(id);
    const int cells = chunkCells(shape);
    return positionM(shape,
                     sphereFromCube(cubePoint(id.face, square.u + square.side * column / cells,
                                              square.v + square.side * row / cells)),
                     height);
}

inline glm::dvec3 vertexM(const PlanetShape& shape, const ChunkData& chunk, int column, int row) {
    const auto at = static_cast<std::size_t>(row * chunkSize(shape) + column);
    return vertexM(shape, chunk.id, column, row, heightM(shape, chunk.heights[at]));
}

}  // namespace planet
