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
// Fading does the same where the view, the tolerance or the disk is too fast for that: with a memory, a
// chunk's morph moves towards where it should be, its natural value, by at most elapsed time / fadeS a frame.
// A chunk is replaced by its children only once it was drawn with morph 0, and they begin with morph 1; they
// are replaced by it only once all four were drawn with morph 1 or not at all, and it begins with morph 0.
// Until then the switch waits, and what waits slides there; edges have morphs of their own, for which the
// same holds. So a switch moves nothing, a change over several levels takes fadeS for each, and what was not
// in the picture before begins at its natural value.
// What still pops: children that are no longer resident, or that stitched seams do not allow, are gone at
// once; and one edge of a chunk moves if a coarser chunk beside it is split in the very frame in which it
// takes its children's place, or in which it is split itself and what comes of the other there is culled.
//
// Stitched seams: along an edge whose neighbour is coarser by d levels, the vertex shader moves each vertex
// onto a multiple of 2^d, so both sides have the same vertices; drawn_surface.h says which, and how they go
// there before the neighbour changes its level. For that neighbours must not differ by more than
// log2(cells) - 1 levels; selection draws parents instead of what would.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "planet/chunk_tree.h"
#include "planet/view.h"

namespace planet {

enum class SeamMode : std::uint8_t { None, Skirts, Stitched };
enum class SkirtDepth : std::uint8_t { Automatic, Fixed };

// Which bound of a chunk's error is looked at. Additive: delta_c, a sum over the levels under it; safe and
// loose. Tight: the largest distance that was measured between the chunk's surface, or that of one under it,
// and the finest data; fewer triangles for the same tau.
enum class ErrorMetric : std::uint8_t { Additive, Tight };

struct LodSettings {
    ErrorMetric metric = ErrorMetric::Additive;
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
    // With morph: seconds that a chunk takes to slide all the way where its level changes at once: children
    // that come late, a new tau, a fast camera. [0, 10]; 0: at once, with a pop.
    double fadeS = 0;
    SeamMode seams = SeamMode::Skirts;
    SkirtDepth skirtDepth = SkirtDepth::Automatic;
    double skirtDepthM = 1000;  // of Fixed, metres, >= 0; less than the gaps: cracks show
    // Of Automatic: skirt depth / (delta_c of a chunk + delta_c of the drawn neighbour that differs most from
    // the truth). At 1 no crack shows, since neither surface is farther than its delta_c from the finest; 0:
    // no skirts.
    double skirtFactor = 1;

    bool operator==(const LodSettings&) const = default;
};

struct DrawItem {
    NodeIndex node = noNode;
    ChunkId id;
    std::uint32_t slot = 0;   // in the pool of heights
    float epsPx = 0;          // error on screen, pixels
    float parentEpsPx = 0;    // the parent's; 0 for a root
    float drawnBoundPx = 0;   // bound of what is drawn, morph counted in (drawn_bound.h); epsPx without morph
    float distanceM = 0;      // from the eye to the bounding volume; nearestM inside it
    float deltaCM = 0;        // metres, by the metric that was asked for
    float parentDeltaM = 0;   // the parent's; 0 for a root
    float skirtDepthM = 0;    // metres, towards the planet's centre; 0 unless seams are Skirts
    float morph = 0;          // [0, 1]: 0 own surface, 1 the parent's
    bool splitWaits = false;  // its children would be drawn, but it did not show just its own surface yet
    // One above it would be drawn, but what is below that one did not show its surface yet.
    bool mergeWaits = false;
    // By edge, west to north. Levels that the drawn neighbour is coarser; 0 where it is not. And the morph of
    // the edge's vertices, the same on both sides of two chunks of one level: the larger of their morphs.
    // Beside a coarser chunk, if seams are Stitched, it is that one's and about that one's vertices; else the
    // chunk's own, which is its morph, or with fading 1, while the coarser one's is 0 there: so both show the
    // coarser one's edge, and neither's changes when they come to be of one level.
    std::array<std::uint8_t, edgeCount> coarserBy{};
    std::array<float, edgeCount> edgeMorph{};
};

// Two drawn chunks of different levels side by side.
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

// Distances stop here, so that the error on screen of a chunk that holds the eye stays a number.
inline constexpr double nearestM = 1e-3;

// A node's bound of its error by either metric, metres.
float deltaOf(const ChunkNode& node, ErrorMetric metric);

// From an eye to a node's bounds, metres; and the node's error on screen from there, pixels: eps = delta K' /
// D, with delta by the metric and K' as screenScalePx gives it.
double distanceToM(const ChunkNode& node, const glm::dvec3& eyeM);
double epsPxOf(const ChunkNode& node, const glm::dvec3& eyeM, double screenScalePx, ErrorMetric metric);

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
    std::uint32_t drawn = 0;  // chunks
    // Of the drawn chunks. Skirts are drawn at all chunks as soon as one of them has a depth, else at none.
    std::uint64_t groundTriangles = 0;
    std::uint64_t skirtTriangles = 0;
    std::uint32_t waiting = 0;       // drawn though eps > tau, for lack of children
    std::uint32_t deepestLevel = 0;  // of what is drawn
    std::uint32_t fading = 0;        // drawn chunks, and edges of them, that are not yet as they would be
                                     // without a memory: morph not natural, or a split or merge waits
    float worstEpsPx = 0;            // of what is drawn
    float worstDrawnBoundPx = 0;
    std::uint32_t widestSeam = 0;  // levels that two drawn neighbours differ at most

    std::uint64_t triangles() const { return groundTriangles + skirtTriangles; }
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
// hysteresis and fading remember; an empty one has no memory. elapsedS: seconds since it was made, >= 0;
// infinity ends every fade.
void selectChunks(const ChunkTree& tree, const View& lodView, const LodSettings& settings,
                  Selection& selection, double elapsedS = std::numeric_limits<double>::infinity());

}  // namespace planet
