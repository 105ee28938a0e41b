// Chooses what to draw: chunked LOD after Ulrich (SIGGRAPH 2002 course).
//
// A chunk whose error on screen eps = delta_c K' / D is over tau is replaced by its four children, once all
// four are resident; until then it is drawn itself and its children are asked for. So what is drawn covers
// the visible planet once: no hole, no overlap.
//
// A pure function of its arguments: no GL, no I/O, no clock; the same input gives the same answer. Any
// thread.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "planet/chunk_tree.h"
#include "planet/view.h"

namespace planet {

struct LodSettings {
    double tauPx = 2;                 // tolerance, pixels, > 0; larger: fewer triangles, more visible error
    int maxLevel = planet::maxLevel;  // chunks of this level are not split; [0, maxLevel]
    bool frustumCulling = true;       // off: chunks beside and behind the view are drawn and loaded too
    bool horizonCulling = true;       // off: chunks on the planet's far side are drawn and loaded too
    // Skirt depth / (delta_c of a chunk + delta_c of the drawn neighbour that differs most from the truth).
    // At 1 no crack shows, since neither surface is farther than its delta_c from the finest; 0: no skirts.
    double skirtFactor = 1;
};

struct DrawItem {
    NodeIndex node = noNode;
    ChunkId id;
    std::uint32_t slot = 0;  // in the pool of heights
    float epsPx = 0;         // error on screen, pixels
    float distanceM = 0;     // from the eye to the bounding volume; nearestM inside it
    float deltaCM = 0;       // metres
    float skirtDepthM = 0;   // metres, towards the planet's centre
};

// Distances stop here, so that the error on screen of a chunk that holds the eye stays a number.
inline constexpr double nearestM = 1e-3;

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
};

struct Selection {
    std::vector<DrawItem> draw;             // near to far
    std::vector<ChildrenRequest> requests;  // highest priority first; children absent or on their way
    std::vector<ChildrenRequest> splits;    // those whose children are resident, parents first
    std::vector<NodeIndex> touched;  // all visited, parents first: what is drawn, what stands above it, and
                                     // the culled siblings of either. Needed to draw this view again
    SelectionCounters counters;
};

// Refills out, keeping its capacity.
void selectChunks(const ChunkTree& tree, const View& lodView, const LodSettings& settings, Selection& out);

}  // namespace planet
