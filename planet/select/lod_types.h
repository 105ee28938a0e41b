// The settings and the result of a selection of chunks (lod_select.h), as plain data.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planet/sphere/chunk_id.h"
#include "planet/tree/error_metric.h"
#include "planet/tree/node_index.h"

namespace planet {

enum class SeamMode : std::uint8_t { None, Skirts, Stitched };
enum class SkirtDepth : std::uint8_t { Automatic, Fixed };

struct LodSettings {
    ErrorMetric metric = ErrorMetric::Additive;
    double tauPx = 2;  // tolerance τ, pixels, > 0; larger: fewer triangles, more visible error
    // A split chunk stays split until ε <= τ (1 - hysteresis); [0, 0.9]. Larger: fewer flips, more triangles.
    double hysteresis = 0.1;
    int maxLevel = planet::maxLevel;  // chunks of this level are not split, in regions too; [0, maxLevel]
    bool frustumCulling = true;       // off: chunks outside the frustum are drawn and loaded too
    bool horizonCulling = true;       // off: chunks below the horizon are drawn and loaded too
    bool morph = true;                // off: chunks pop when their level changes
    // The share of τ over which a chunk slides onto its parent's surface, (0, 4]. Larger: slower, and a
    // larger part of the picture is coarser than necessary.
    double morphRange = 0.3;
    // With morph: the seconds of a chunk's whole slide if its level changes at once, because of late
    // children, a new τ or a fast camera. [0, 10]; 0: at once, with a pop.
    double fadeS = 0.25;
    SeamMode seams = SeamMode::Skirts;
    SkirtDepth skirtDepth = SkirtDepth::Automatic;
    double skirtDepthM = 1000;  // of Fixed, metres, >= 0; cracks show if it is less than the gaps
    // For Automatic: the ratio of the skirt depth to (δc of the chunk + the largest δc of its drawn
    // neighbours). At 1 no crack shows, because each surface is within its δc of the finest data; beside a
    // coarser leaf, δc is that of the data across the edge (skirt_depth.h). 0: no skirts.
    double skirtFactor = 1;

    bool operator==(const LodSettings&) const = default;
};

// The effect of a region's levels on a drawn chunk, whatever its error.
enum class RegionLimit : std::uint8_t {
    None,
    Least,  // its level is below the least one, so its children are wanted
    Most,   // its level is the largest one
};

struct DrawItem {
    NodeIndex node = noNode;
    ChunkId id;
    std::uint32_t slot = 0;    // in the pool of heights
    float epsPx = 0;           // screen-space error ε, pixels
    float parentEpsPx = 0;     // of the parent; 0 for a root
    float drawnBoundPx = 0;    // bound of the drawn surface with its morph (drawn_bound.h); else epsPx
    float distanceM = 0;       // from the eye to the bounding volume; nearestM inside it (screen_error.h)
    float nearestSampleM = 0;  // lower bound of the distance to finest samples (drawn_bound.h); 0: unknown
    float deltaCM = 0;         // metres, by LodSettings::metric
    float parentDeltaM = 0;    // of the parent; 0 for a root
    float skirtDepthM = 0;     // metres, towards the planet's centre; 0 unless seams are Skirts
    float morph = 0;           // [0, 1]: 0 own surface, 1 the parent's
    // The factor on τ there, of the planet's regions (region.h): the chunk is good enough while ε <= τ tauFactor.
    float tauFactor = 1;
    bool splitWaits = false;  // its split waits until it has been drawn with just its own surface
    // The merge of an ancestor waits until all chunks below it show its surface.
    bool mergeWaits = false;
    RegionLimit limit = RegionLimit::None;
    // The levels by which the drawn neighbour is coarser, by edge, west to north; 0 if it is not coarser.
    std::array<std::uint8_t, edgeCount> coarserBy{};
    // In a sparse planet, beside a coarser neighbour, by edge: the error of this chunk's ancestor of that
    // level, metres, which bounds the distance of the neighbour's edge from the finest data on this side
    // (skirt_depth.h). Otherwise 0.
    std::array<float, edgeCount> rimDeltaM{};
    // The morph of the vertices of each edge. Two chunks of one level have the same value on both sides: the
    // larger of their morphs. Next to a coarser chunk with Stitched seams, it is that chunk's morph and
    // applies to that chunk's vertices. Otherwise it is the chunk's own morph; with fading it is 1 while the
    // coarser chunk has 0 there. Both then show the coarser chunk's edge, so neither edge changes when the
    // two get the same level.
    std::array<float, edgeCount> edgeMorph{};
};

// Two drawn neighbours of different levels.
struct LevelSeam {
    ChunkId finer;
    ChunkId coarser;
    Edge edge = Edge::West;  // of the finer one
};

// The result of visiting a node.
enum class NodeFate : std::uint8_t { Drawn, Split, CulledFrustum, CulledHorizon };
struct VisitedNode {
    NodeIndex node = noNode;
    NodeFate fate = NodeFate::Drawn;

    bool operator==(const VisitedNode&) const = default;
};

// Above what a chunk at the tolerance has: a region's least level counts as an error of twice that.
inline constexpr float leastLevelPriority = 2;

// A request to draw a node as its children.
struct ChildrenRequest {
    NodeIndex parent = noNode;
    ChunkId parentId;
    // ε / τ of the parent: by how much it exceeds the tolerance; larger first. In a region, τ is that of the region, and
    // below its least level the priority is at least leastLevelPriority.
    float priority = 0;
    bool isBelowLeastLevel = false;  // a region's least level demands it, whatever its error
};

struct SelectionCounters {
    std::uint32_t visited = 0;        // visited nodes
    std::uint32_t culledFrustum = 0;  // subtrees culled by each test
    std::uint32_t culledHorizon = 0;
    std::uint32_t drawn = 0;  // chunks
    // Triangles of the drawn chunks. If any chunk has a skirt depth, all have skirts; otherwise none has.
    std::uint64_t groundTriangles = 0;
    std::uint64_t skirtTriangles = 0;
    std::uint32_t waiting = 0;       // drawn although ε > τ, because children are missing
    std::uint32_t deepestLevel = 0;  // of the drawn chunks
    // Drawn chunks and their edges that differ from a selection without memory: their morph is not natural,
    // or a split or merge waits.
    std::uint32_t fading = 0;
    float worstEpsPx = 0;  // of the drawn chunks
    float worstDrawnBoundPx = 0;
    std::uint32_t widestSeam = 0;  // largest level difference of two drawn neighbours

    std::uint64_t triangles() const { return groundTriangles + skirtTriangles; }
};

struct Selection {
    std::vector<DrawItem> draw;             // near to far
    std::vector<ChildrenRequest> requests;  // highest priority first; children absent or requested
    std::vector<ChildrenRequest> splits;    // with resident children, parents first
    std::vector<LevelSeam> seams;
    // All visited nodes: the drawn ones, their ancestors, and the culled siblings of both. They must be resident to draw
    // this view again. A split node is followed by its four children, each with all that is below it; `splits` has the
    // same order.
    std::vector<VisitedNode> touched;
    SelectionCounters counters;
};

}  // namespace planet
