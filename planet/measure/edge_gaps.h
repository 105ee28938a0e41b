// Measures the gaps between the edges of drawn neighbours and the skirt depth that covers them.
//
// Both edges between two drawn chunks are piecewise linear. So the vector between their points at the same
// place is piecewise linear too, and it is longest at a vertex of one of them.
//
// Skirts cover gaps along the radius. Edges also part sideways, by far less, because a coarse edge is a chord
// of the curve that the finer one follows. So the depth of the gap is a lower bound of the skirt depth. A gap
// seen from above may need more, which the crack meter measures.
//
// Pure functions, any thread.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "planet/select/lod_types.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/steps.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// Returns the heights of a drawn chunk, (cells + 1)^2 steps.
using HeightsOf = std::function<StepsView(const DrawItem&)>;
HeightsOf heightsIn(const ChunkTree& tree);  // the tree must outlive it

// The drawn ground, for meters without a renderer.
struct DrawnGround {
    PlanetShape shape;
    std::span<const DrawItem> items;
    HeightsOf heights;
    bool stitched = false;  // as in gl::RenderSettings
};

// Two drawn neighbours, as indices of the drawn items. If both have the same level, the one with the lower id
// counts as the finer.
struct DrawnPair {
    std::uint32_t finer = 0;
    std::uint32_t coarser = 0;
    Edge finerEdge = Edge::West;
    Edge coarserEdge = Edge::West;
    // The begin and end of the finer chunk's edge on the coarser one's, [0, 1] from the coarser edge's west
    // or south end. The end is smaller than the begin if the axes of two faces run in opposite directions.
    std::array<double, 2> span{0, 1};
};

// Returns each pair once, in the order of the items.
std::vector<DrawnPair> drawnPairs(std::span<const DrawItem> items);

// Finds pairs by their place.
class PairFinder {
public:
    PairFinder(std::span<const DrawnPair> pairs, std::size_t itemCount);
    // Returns the pair at a place along an item's edge, [0, 1] from the west or south; nothing if no chunk is
    // drawn beyond it.
    std::optional<std::uint32_t> at(std::uint32_t item, Edge edge, double along) const;

private:
    std::span<const DrawnPair> pairs_;
    std::vector<std::uint32_t> first_;  // first index into byItem_, by item
    std::vector<std::uint32_t> byItem_;
};

struct EdgeGap {
    DrawnPair pair;
    ChunkId finer;
    ChunkId coarser;
    double gapM = 0;      // largest distance between the edges at the same place, metres, >= 0
    double radialM = 0;   // largest difference of their distances from the planet's centre, metres, >= 0
    double screenPx = 0;  // largest distance in the flat picture, pixels, within the picture; 0: none
    double facingPx = 0;  // largest distance in a view turned to face it, pixels
    glm::dvec3 placeM{0, 0, 0};  // on the finer edge at gapM, metres from the planet's centre
    double finerAboveM = 0;      // largest height of each above the other, metres: its skirt must cover it
    double coarserAboveM = 0;
    float finerSkirtM = 0;  // as drawn
    float coarserSkirtM = 0;
};

// Return the gaps of all pairs, including those of 0, with the largest gapM first. Vertex positions are
// exact, so chunks of one level and one morph have a gap of 0.
std::vector<EdgeGap> edgeGaps(const DrawnGround& ground, const View& view);
std::vector<EdgeGap> edgeGaps(const DrawnGround& ground, std::span<const DrawnPair> pairs, const View& view);

// Returns the depth that each item's skirt needs to reach down to all neighbouring edges, metres; 0 for none.
std::vector<double> requiredSkirtDepthsM(std::span<const EdgeGap> gaps, std::size_t itemCount);

// Returns the skirt depths for a LodSettings::skirtFactor, as selection computes them, to try other factors
// on the same items. The items must be nodes of the tree.
std::vector<float> automaticSkirtDepthsM(const ChunkTree& tree, ErrorMetric metric,
                                         std::span<const DrawItem> items, std::span<const DrawnPair> pairs,
                                         double skirtFactor);

// The smallest depth and the smallest factor with which every item's skirt is deep enough.
struct RequiredSkirts {
    double depthM = 0;
    double factor = 0;  // infinity if no factor suffices: a chunk's error is wrong
};
RequiredSkirts requiredSkirts(const ChunkTree& tree, ErrorMetric metric, std::span<const DrawItem> items,
                              std::span<const DrawnPair> pairs, std::span<const EdgeGap> gaps);

}  // namespace planet
