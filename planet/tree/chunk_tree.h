// The resident part of the six quadtrees: plain data that selection reads and paging grows and prunes.
// One thread at a time.
//
// Exaggeration by a factor e draws each height h as e h, on the same sphere. A vertex that a chunk of level l
// lacks lies off the middle of the edge that replaces it by A + B: A as on the bare sphere, R times how far
// Nowell's map bends there, and B, which is linear in the heights. Exaggerated it is off by
//
//   |A + e B| = |e (A + B) + (1 - e) A| <= e |A + B| + |e - 1| |A|,     |A| <= A_l  (curvatureErrorM)
//
// and adding that up from a chunk's level L to its leaves' parents, the first term gives e times the stored
// delta_c. So delta_c = e stored + |e - 1| (A_L + A_L+1 + ... ) is a true bound again, 0 at a leaf, never
// grows from parent to child, and is the stored one where e = 1. The same holds of the tight metric, a
// chunk's distance from the finest samples: on the bare sphere that is at most A_L + A_L+1 + ... too. So it
// is e stored + |e - 1| (A_L + A_L+1 + ...), or delta_c where that is less, being a bound as well.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "planet/format/chunk_file_types.h"
#include "planet/sphere/bounds.h"
#include "planet/tree/block_state.h"
#include "planet/tree/node_index.h"

namespace planet {

// Shared with loader threads, which refine a parent's heights while the tree may already have dropped it.
using SharedHeights = std::shared_ptr<const std::vector<std::int16_t>>;

// A chunk that is loaded and drawable.
struct ChunkNode {
    ChunkId id;
    float deltaCM = 0;            // metres, exaggeration counted in
    float storedDeltaCM = 0;      // as the file has it
    float deltaTightM = 0;        // the tight metric, exaggeration counted in; at most deltaCM
    float storedDeltaTightM = 0;  // as the file has it
    float minHeightM = 0;         // over all finest samples below
    float maxHeightM = 0;
    std::int16_t minStep = 0;  // the same, as stored
    std::int16_t maxStep = 0;
    ChunkBounds bounds;
    glm::dvec3 directionLow{0, 0, 0};  // along the axes of its box, so that bounds follow heights cheaply
    glm::dvec3 directionHigh{0, 0, 0};
    NodeIndex parent = noNode;
    NodeIndex firstChild = noNode;  // four in a row, in quadrant order
    ChildrenState childrenState = ChildrenState::None;
    BlockLocation children;           // in the file
    std::uint32_t slot = 0;           // in the pool of heights
    SharedHeights heights;            // never null
    std::uint64_t lastUsedFrame = 0;  // last frame that selection visited it
    double loadedAtS = 0;             // when it became resident, seconds since the planet was opened
    std::uint32_t loadOrder = 0;      // 0 for the roots, then 1 for the first block, 2, ...
};

struct ChunkTree {
    PlanetShape shape;         // exaggeration counted in
    PlanetShape storedShape;   // as the file has it
    double exaggeration = 1;   // heights are drawn this many times as high
    std::int16_t minStep = 0;  // over the whole planet
    std::int16_t maxStep = 0;
    double occluderRadiusM = 0;         // of a sphere that lies inside every surface the tree can draw
    std::vector<ChunkNode> nodes;       // the first six are the roots, in face order; then free or in fours
    std::vector<NodeIndex> freeGroups;  // first nodes of groups of four that are free
    std::size_t residentChunks = 0;
};

// The tree with its six roots, given in face order; they stay resident and take slots 0 to 5. The Error names
// a root that is not what checkChunk wants, or a planet whose lowest height lies below its centre.
Result<ChunkTree> makeChunkTree(const PlanetShape& shape, std::int16_t minStep, std::int16_t maxStep,
                                std::array<ChunkData, faceCount>&& roots);

// Draws heights this many times as high, (0, largestExaggeration]: shape, and every node's heights, bounds
// and both metrics follow, as will those of nodes added later.
void setExaggeration(ChunkTree& tree, double factor);

// 100, or less where that would bring the lowest ground nearer to the planet's centre than a hundredth of its
// radius; never less than 1.
double largestExaggeration(const ChunkTree& tree);

// A_l above: the farthest that a vertex of the bare sphere, lacking at a level, lies from the middle of the
// edge or diagonal that replaces it, metres; an upper bound.
double curvatureErrorM(const PlanetShape& shape, int level);

// Whether four chunks may become the children of a node: the right ids and number of heights, heights within
// the chunk's range and that within the parent's, delta_c and the tight metric no larger than the parent's,
// and the tight one no larger than delta_c. What bounds and
// selection rely on.
Result<void> checkChildren(const ChunkTree& tree, NodeIndex parent,
                           const std::array<ChunkData, quadrantCount>& children);

// Adds the four children of a node whose children are Requested, in the given slots; returns the first. They
// must pass checkChildren. Where nobody has a queue they may be Absent too.
NodeIndex addChildren(ChunkTree& tree, NodeIndex parent, std::array<ChunkData, quadrantCount>&& children,
                      const std::array<std::uint32_t, quadrantCount>& slots);

// Removes a node's four resident children, none of which may have resident children of its own.
void removeChildren(ChunkTree& tree, NodeIndex parent);

// The node of an id, or noNode if it is not resident.
NodeIndex findNode(const ChunkTree& tree, const ChunkId& id);

// Calls visit for every resident node, parents before their children.
void forEachNode(const ChunkTree& tree, const std::function<void(NodeIndex, const ChunkNode&)>& visit);

// The height of the finest resident surface in a direction of any length but 0, metres above the planet's
// radius: where a ray from the planet's centre meets the very triangles that are drawn.
double residentHeightM(const ChunkTree& tree, const glm::dvec3& direction);

// The height that the finest resident samples give in a direction of any length but 0, metres above the
// planet's radius: bilinear between the four corners of its cell, along the sphere. The triangles that are
// drawn sag below it, on a root chunk by kilometres.
double sampledHeightM(const ChunkTree& tree, const glm::dvec3& direction);

// What one resident chunk costs: its node and heights in memory, and its heights in the pool on the GPU.
std::size_t chunkBytesCpu(const PlanetShape& shape);
std::size_t chunkBytesGpu(const PlanetShape& shape);

}  // namespace planet
