// The settings and the result of a selection of chunks (lod_select.h), as plain data.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planet/sphere/chunk_id.h"
#include "planet/tree/node_index.h"

namespace planet {

enum class SeamMode : std::uint8_t { None, Skirts, Stitched };
enum class SkirtDepth : std::uint8_t { Automatic, Fixed };

// The error bound of a chunk. Additive: delta_c, a sum over the levels under it; conservative. Tight: the
// largest measured distance of the surface of the chunk, or of one under it, from the finest data; fewer
// triangles for the same tau.
enum class ErrorMetric : std::uint8_t { Additive, Tight };

struct LodSettings {
    ErrorMetric metric = ErrorMetric::Additive;
    double tauPx = 2;  // tolerance, pixels, > 0; larger: fewer triangles, more visible error
    // A split chunk stays split until eps <= tau (1 - hysteresis); [0, 0.9]; larger: fewer flips, more
    // triangles.
    double hysteresis = 0.1;
    int maxLevel = planet::maxLevel;  // chunks of this level are not split; [0, maxLevel]
    bool frustumCulling = true;       // off: chunks beside and behind the view are drawn and loaded too
    bool horizonCulling = true;       // off: chunks on the planet's far side are drawn and loaded too
    bool morph = true;                // off: chunks pop when their level changes
    // The share of tau over which a chunk slides onto its parent's surface, (0, 4]; larger: slower, and more
    // of the picture is coarser than necessary.
    double morphRange = 0.3;
    // With morph: the seconds of a chunk's whole slide if its level changes at once, because of late
    // children, a new tau or a fast camera. [0, 10]; 0: at once, with a pop.
    double fadeS = 0.25;
    SeamMode seams = SeamMode::Skirts;
    SkirtDepth skirtDepth = SkirtDepth::Automatic;
    double skirtDepthM = 1000;  // of Fixed, metres, >= 0; less than the gaps: cracks show
    // For Automatic: the ratio of the skirt depth to (delta_c of the chunk + the largest delta_c among its
    // drawn neighbours). At 1 no crack shows, because each surface is within its delta_c of the finest data.
    // 0: no skirts.
    double skirtFactor = 1;

    bool operator==(const LodSettings&) const = default;
};

struct DrawItem {
    NodeIndex node = noNode;
    ChunkId id;
    std::uint32_t slot = 0;    // in the pool of heights
    float epsPx = 0;           // error on screen, pixels
    float parentEpsPx = 0;     // the parent's; 0 for a root
    float drawnBoundPx = 0;    // bound of what is drawn, morph included (drawn_bound.h); epsPx without morph
    float distanceM = 0;       // from the eye to the bounding volume; nearestM inside it (screen_error.h)
    float nearestSampleM = 0;  // no finest sample is nearer to the eye, metres (drawn_bound.h); 0: not known
    float deltaCM = 0;         // metres, by LodSettings::metric
    float parentDeltaM = 0;    // the parent's; 0 for a root
    float skirtDepthM = 0;     // metres, towards the planet's centre; 0 unless seams are Skirts
    float morph = 0;           // [0, 1]: 0 own surface, 1 the parent's
    bool splitWaits = false;   // its children would be drawn, but it has not shown just its own surface
    // A chunk above it should be drawn, but waits until all chunks below that one show its surface.
    bool mergeWaits = false;
    // The levels by which the drawn neighbour is coarser, by edge, west to north; 0 if it is not coarser.
    std::array<std::uint8_t, edgeCount> coarserBy{};
    // The morph of the vertices of each edge. Two chunks of one level have the same on both sides: the larger
    // of their morphs. Beside a coarser chunk, if seams are Stitched, it is that chunk's morph and applies to
    // that chunk's vertices. Otherwise it is the chunk's own morph, or with fading 1, while the coarser chunk
    // has 0 there: both then show the coarser chunk's edge, and neither edge changes when the two come to be
    // of one level.
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

// "This node should be drawn as its children."
struct ChildrenRequest {
    NodeIndex parent = noNode;
    ChunkId parentId;
    float priority = 0;  // eps / tau of the parent: how far it exceeds the tolerance by itself; larger first
};

struct SelectionCounters {
    std::uint32_t visited = 0;        // nodes looked at
    std::uint32_t culledFrustum = 0;  // subtrees cut off by each test
    std::uint32_t culledHorizon = 0;
    std::uint32_t drawn = 0;  // chunks
    // Triangles of the drawn chunks. All chunks have skirts as soon as one of them has a depth, else none.
    std::uint64_t groundTriangles = 0;
    std::uint64_t skirtTriangles = 0;
    std::uint32_t waiting = 0;       // drawn though eps > tau, for lack of children
    std::uint32_t deepestLevel = 0;  // of what is drawn
    // Drawn chunks, and edges of them, that differ from a selection without a memory: their morph is not
    // natural, or a split or merge waits.
    std::uint32_t fading = 0;
    float worstEpsPx = 0;  // of what is drawn
    float worstDrawnBoundPx = 0;
    std::uint32_t widestSeam = 0;  // the most levels by which two drawn neighbours differ

    std::uint64_t triangles() const { return groundTriangles + skirtTriangles; }
};

struct Selection {
    std::vector<DrawItem> draw;             // near to far
    std::vector<ChildrenRequest> requests;  // highest priority first; children absent or on their way
    std::vector<ChildrenRequest> splits;    // those whose children are resident, parents first
    std::vector<LevelSeam> seams;
    // All visited nodes, parents first: the drawn ones, their ancestors, and the culled siblings of both.
    // Drawing this view again needs them resident.
    std::vector<VisitedNode> touched;
    SelectionCounters counters;
};

}  // namespace planet
