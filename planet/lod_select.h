// Chooses what to draw: chunked LOD after Ulrich (SIGGRAPH 2002 course).
//
// A chunk whose error on screen eps = delta_c K' / D is over tau is replaced by its four children, once all
// four are resident; until then it is drawn itself and its children are asked for. So what is drawn covers
// the visible planet once: no hole, no overlap.
//
// A pure function of its arguments: no GL, no I/O, no clock; the same input gives the same answer. Any
// thread.
//
// With hysteresis what was split stays split a little longer, so a view has a memory: its last Selection.
//
// Morphing slides a chunk onto its parent's surface before the parent takes its place: morph is 0 while
// the parent's eps is at least tau (1 + range) and 1 when it is tau or less. All four siblings have the same
// morph at that moment, so the switch moves nothing. The range is at most delta_c(parent) / delta_c - 1, less
// with hysteresis, so that a chunk has not begun to slide when it is itself exchanged for its children.
//
// Stitched seams: along an edge whose neighbour is coarser by d levels, the vertex shader moves vertex i to
// the nearest multiple of 2^d, so both sides have the same vertices. For that neighbours must not differ by
// more than log2(cells) - 1 levels; selection draws parents instead of what would.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "planet/chunk_tree.h"
#include "planet/view.h"

namespace planet {

enum class SeamMode : std::uint8_t { None, Skirts, Stitched };
enum class SkirtDepth : std::uint8_t { Automatic, Fixed };

struct LodSettings {
    double tauPx = 2;  // tolerance, pixels, > 0; larger: fewer triangles, more visible error
    // What is split stays split until eps <= tau (1 - hysteresis); [0, 0.9]; larger: fewer flips, more
    // triangles.
    double hysteresis = 0;
    int maxLevel = planet::maxLevel;  // chunks of this level are not split; [0, maxLevel]
    bool frustumCulling = true;       // off: chunks beside and behind the view are drawn and loaded too
    bool horizonCulling = true;       // off: chunks on the planet's far side are drawn and loaded too
    bool morph = false;               // off: chunks pop when their level changes
    // Share of tau over which a chunk slides onto its parent's surface, (0, 4]; larger: slower, and more of
    // the picture is coarser than it could be.
    double morphRange = 0.3;
    SeamMode seams = SeamMode::Skirts;
    SkirtDepth skirtDepth = SkirtDepth::Automatic;
    double skirtDepthM = 1000;  // of Fixed, metres, >= 0; less than the gaps: cracks show
    // Of Automatic: skirt depth / (delta_c of a chunk + delta_c of the drawn neighbour that differs most from
    // the truth). At 1 no crack shows, since neither surface is farther than its delta_c from the finest; 0:
    // no skirts.
    double skirtFactor = 1;
};

struct DrawItem {
    NodeIndex node = noNode;
    ChunkId id;
    std::uint32_t slot = 0;  // in the pool of heights
    float epsPx = 0;         // error on screen, pixels
    float parentEpsPx = 0;   // the parent's; 0 for a root
    float distanceM = 0;     // from the eye to the bounding volume; nearestM inside it
    float deltaCM = 0;       // metres
    float skirtDepthM = 0;   // metres, towards the planet's centre; 0 unless seams are Skirts
    float morph = 0;         // [0, 1]: 0 own surface, 1 the parent's
    // By edge, west to north. Levels that the drawn neighbour is coarser; 0 where it is not. And the morph
    // that both sides of the edge use: of two chunks of one level the larger, else the coarser one's own; it
    // is about the coarser one's vertices.
    std::array<std::uint8_t, edgeCount> coarserBy{};
    std::array<float, edgeCount> edgeMorph{};
};

// Two drawn chunks of different levels side by side.
struct LevelSeam {
    ChunkId finer;
    ChunkId coarser;
    Edge edge = Edge::West;  // of the finer one
};

// What became of a visited node.
enum class NodeFate : std::uint8_t { Drawn, Split, CulledFrustum, CulledHorizon };
struct VisitedNode {
    NodeIndex node = noNode;
    NodeFate fate = NodeFate::Drawn;

    bool operator==(const VisitedNode&) const = default;
};

// Distances stop here, so that the error on screen of a chunk that holds the eye stays a number.
inline constexpr double nearestM = 1e-3;

// From an eye to a node's bounds, metres; and the node's error on screen from there, pixels: eps = delta_c K'
// / D, K' as screenScalePx gives it.
double distanceToM(const ChunkNode& node, const glm::dvec3& eyeM);
double epsPxOf(const ChunkNode& node, const glm::dvec3& eyeM, double screenScalePx);

// "This node should be drawn as its children."
struct ChildrenRequest {
    NodeIndex parent = noNode;
    ChunkId parentId;
    float priority = 0;  // eps / tau of the parent: how far over the tolerance it is by itself; larger first
};

struct SelectionCounters {
    std::uint32_t visited = 0;        // nodes looked at
    std::uint32_t culledFrustum = 0;  // subtrees cut off by each test
    std::uint32_t culledHorizon = 0;
    std::uint32_t drawn = 0;         // chunks
    std::uint32_t waiting = 0;       // drawn though eps > tau, for lack of children
    std::uint32_t deepestLevel = 0;  // of what is drawn
    float worstEpsPx = 0;            // of what is drawn
    std::uint32_t widestSeam = 0;    // levels that two drawn neighbours differ at most
};

struct Selection {
    std::vector<DrawItem> draw;             // near to far
    std::vector<ChildrenRequest> requests;  // highest priority first; children absent or on their way
    std::vector<ChildrenRequest> splits;    // those whose children are resident, parents first
    std::vector<LevelSeam> seams;
    std::vector<VisitedNode> touched;  // all visited, parents first: what is drawn, what stands above it,
                                       // and the culled siblings of either. Needed to draw this view again
    SelectionCounters counters;
};

// Refills the selection, keeping its capacity. What it held is the last selection of this view, whose splits
// hysteresis remembers; an empty one has no memory.
void selectChunks(const ChunkTree& tree, const View& lodView, const LodSettings& settings,
                  Selection& selection);

}  // namespace planet
