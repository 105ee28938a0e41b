// The resident part of the six quadtrees: plain data that selection reads and paging grows and prunes.
// One thread at a time.
//
// Exaggeration by a factor e draws each height h as e h, on the same sphere. A vertex that a chunk of level l
// lacks is off the middle of the edge that replaces it by A + B. A is the offset on the bare sphere, R times
// the bend of Nowell's mapping there; B is linear in the heights. With exaggeration the offset is
//
//   |A + e B| = |e (A + B) + (1 - e) A| <= e |A + B| + |e - 1| |A|,     |A| <= A_l  (curvatureErrorM)
//
// Summed from a chunk's level L to its leaves' parents, the first term is e times the stored δc. So δc = e
// stored + |e - 1| (A_L + A_L+1 + ...) is again a true bound. It is 0 at a leaf, never increases from parent
// to child, and equals the stored one at e = 1. The same holds for the tight metric, a chunk's distance from
// the finest samples: on the bare sphere it is also at most A_L + A_L+1 + ... So the tight metric is e stored
// + |e - 1| (A_L + A_L+1 + ...), or δc if that is less, because δc is a bound too. In a sparse planet, the
// sum goes down to the deepest level of the planet, which is at least as deep as the leaves below the chunk.
// A leaf of any level has no error.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "planet/format/chunk_file_types.h"
#include "planet/sphere/bounds.h"
#include "planet/tree/block_state.h"
#include "planet/tree/chunk_demand.h"
#include "planet/tree/node_index.h"
#include "planet/tree/region_set.h"

namespace planet {

// Loader threads share the heights: they refine a parent's heights even after the tree has dropped it.
using SharedHeights = std::shared_ptr<const Steps>;

// A chunk that is loaded and drawable. The first members are what selection reads of every visited node.
struct ChunkNode {
    ChunkId id;
    float deltaCM = 0;      // metres, exaggerated
    float deltaTightM = 0;  // the tight metric, metres, exaggerated; at most deltaCM
    float minHeightM = 0;   // over all finest samples below
    float maxHeightM = 0;
    NodeIndex parent = noNode;
    NodeIndex firstChild = noNode;  // four in sequence, in quadrant order
    std::uint32_t slot = 0;         // in the pool of heights
    std::uint32_t loadOrder = 0;  // 0 for the roots, then 1 for the first block, 2, ...; here it fills a gap
    ChildrenState childrenState = ChildrenState::None;
    ChunkDemand demand;  // of the tree's regions
    ChunkBounds bounds;
    float storedDeltaCM = 0;      // as in the file
    float storedDeltaTightM = 0;  // as in the file
    std::int32_t minStep = 0;     // over all finest samples below, in stored steps
    std::int32_t maxStep = 0;
    glm::dvec3 directionLow{0, 0, 0};  // along its box's axes; makes updating bounds cheap
    glm::dvec3 directionHigh{0, 0, 0};
    BlockLocation children;           // in the file
    SharedHeights heights;            // never null
    std::uint64_t lastUsedFrame = 0;  // last frame that selection visited it
    double loadedAtS = 0;             // time when it became resident, seconds since the planet was opened
};

struct ChunkTree {
    PlanetShape shape;         // exaggerated
    PlanetShape storedShape;   // as in the file
    double exaggeration = 1;   // factor on all heights
    std::int32_t minStep = 0;  // over the whole planet
    std::int32_t maxStep = 0;
    std::uint64_t allChunks = 0;               // of the planet, resident or not
    double occluderRadiusM = 0;                // of a sphere inside every surface the tree can draw
    std::shared_ptr<const RegionSet> regions;  // null without regions
    std::vector<ChunkNode> nodes;       // first the six roots, in face order; the rest free or in fours
    std::vector<NodeIndex> freeGroups;  // first nodes of free groups of four
    std::size_t residentChunks = 0;
};

// Returns whether some leaves lie above the deepest level.
inline bool isSparse(const ChunkTree& tree) {
    return tree.allChunks < chunkCountOf(tree.shape);
}

// Makes the tree of six roots, given in face order. They stay resident and take slots 0 to 5. The planet
// counts as dense; set allChunks if it is not. The Error names an invalid root, or a lowest height below the
// planet's centre.
Result<ChunkTree> makeChunkTree(const PlanetShape& shape, std::int32_t minStep, std::int32_t maxStep,
                                std::array<ChunkData, faceCount>&& roots);

// Exaggerates heights by a factor, (0, largestExaggeration]: updates the shape, and the heights, bounds and
// metrics of all nodes. Applies to nodes added later too.
void setExaggeration(ChunkTree& tree, double factor);

// Returns 100, or less if that would bring the lowest ground closer to the planet's centre than 1 % of its
// radius; at least 1.
double largestExaggeration(const ChunkTree& tree);

// Sets the regions, which must be made for tree.storedShape, or null for none: updates the demands of all nodes. Applies to
// nodes added later too.
void setRegions(ChunkTree& tree, std::shared_ptr<const RegionSet> regions);
// Returns what the regions that touch a node do there, in their order.
std::vector<RegionEffect> regionEffects(const ChunkTree& tree, NodeIndex node);

// Returns an upper bound of A_l, metres: the largest distance on the bare sphere between a vertex that a
// level lacks and the middle of the edge or diagonal that replaces it.
double curvatureErrorM(const PlanetShape& shape, int level);

// Checks what a chunk says of its heights: their number, and that they lie within its range. Any thread.
Result<void> checkHeights(const PlanetShape& shape, const ChunkData& data);

// Checks, before four chunks become the children of a node, what else bounds and selection rely on: the ids; a
// range within the parent's; δc and the tight metric no larger than the parent's, and the tight metric no larger
// than δc.
Result<void> checkChildren(const ChunkTree& tree, NodeIndex parent,
                           const std::array<ChunkData, quadrantCount>& children);

// Adds the four children of a node, in the given slots, and returns the first one. The children must be
// Requested, or Absent if no queue is used, and must pass checkHeights and checkChildren.
NodeIndex addChildren(ChunkTree& tree, NodeIndex parent, std::array<ChunkData, quadrantCount>&& children,
                      const std::array<std::uint32_t, quadrantCount>& slots);

// Removes a node's four resident children, none of which may have resident children of its own.
void removeChildren(ChunkTree& tree, NodeIndex parent);

// Returns the node of an id, or noNode if it is not resident.
NodeIndex findNode(const ChunkTree& tree, const ChunkId& id);

// Calls visit for every resident node, parents before their children.
void forEachNode(const ChunkTree& tree, const std::function<void(NodeIndex, const ChunkNode&)>& visit);

// Returns the height of the finest resident surface in a direction of any length but 0, metres above the
// planet's radius: where a ray from the planet's centre meets the drawn triangles.
double residentHeightM(const ChunkTree& tree, const glm::dvec3& direction);

// Returns the height of the finest resident samples in a direction of any length but 0, metres above the
// planet's radius, interpolated bilinearly between the four corners of the cell, along the sphere. The drawn
// triangles lie below it, on a root chunk by kilometres.
double sampledHeightM(const ChunkTree& tree, const glm::dvec3& direction);

// Return the bytes of one resident chunk: its node and heights in memory, and its heights in the GPU's pool. In a file with fractions
// of its quantum, steps of 32 bits are assumed in memory; most chunks need 16.
std::size_t chunkBytesCpu(const PlanetShape& shape);
std::size_t chunkBytesGpu(const PlanetShape& shape);

}  // namespace planet
