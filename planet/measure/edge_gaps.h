// Measures the gaps between the edges of drawn neighbours, and the skirt depth that covers them.
//
// Both sides of an edge between two drawn chunks are piecewise linear, so the vector between their points at
// the same place is too, and its length is largest at a vertex of either.
//
// Skirts cover gaps along the radius. Edges also part sideways, by far less, because a coarse edge is a chord
// of the curve that the finer one follows. So the depth of the gap is a lower bound of the skirt depth; a gap
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
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// The heights of a drawn chunk, (cells + 1)^2 steps.
using HeightsOf = std::function<std::span<const std::int16_t>(const DrawItem&)>;
HeightsOf heightsIn(const ChunkTree& tree);  // the tree must outlive it

// The drawn ground, for instruments without a renderer.
struct DrawnGround {
    PlanetShape shape;
    std::span<const DrawItem> items;
    HeightsOf heights;
    bool stitched = false;  // as in gl::RenderSettings
};

// Two drawn neighbours, as indices of the drawn items. Of two chunks of one level, the one with the lower id
// counts as the finer.
struct DrawnPair {
    std::uint32_t finer = 0;
    std::uint32_t coarser = 0;
    Edge finerEdge = Edge::West;
    Edge coarserEdge = Edge::West;
    // The begin and end of the finer chunk's edge on the coarser one's, [0, 1] from that one's west or south
    // end. The end is the smaller if the axes of two faces run against each other.
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
    std::vector<std::uint32_t> first_;  // of each item in byItem_
    std::vector<std::uint32_t> byItem_;
};

struct EdgeGap {
    DrawnPair pair;
    ChunkId finer;
    ChunkId coarser;
    double gapM = 0;      // the largest distance between the edges at the same place, metres, >= 0
    double radialM = 0;   // the largest difference of their distances from the planet's centre, >= 0
    double screenPx = 0;  // the largest distance in the flat picture, pixels, of what lies in it; 0: nothing
    double facingPx = 0;  // the largest as seen by a view turned to face it
    glm::dvec3 placeM{0, 0, 0};  // on the finer edge, where gapM is; metres from the planet's centre
    double finerAboveM = 0;      // how far each stands above the other at most: what its skirt has to cover
    double coarserAboveM = 0;
    float finerSkirtM = 0;  // as deep as they are drawn
    float coarserSkirtM = 0;
};

// Return the gaps of all pairs, also those of 0; the largest gapM first. Vertices are exact, so chunks of one
// level and one morph have a gap of 0.
std::vector<EdgeGap> edgeGaps(const DrawnGround& ground, const View& view);
std::vector<EdgeGap> edgeGaps(const DrawnGround& ground, std::span<const DrawnPair> pairs, const View& view);

// Returns the depth that each item's skirt needs to reach down to all neighbouring edges, metres; 0 for none.
std::vector<double> requiredSkirtDepthsM(std::span<const EdgeGap> gaps, std::size_t itemCount);

// Returns the skirt depths for a LodSettings::skirtFactor, by the rule of selection, so that other factors
// can be tried on the same items. The items must be nodes of the tree.
std::vector<float> automaticSkirtDepthsM(const ChunkTree& tree, ErrorMetric metric,
                                         std::span<const DrawItem> items, std::span<const DrawnPair> pairs,
                                         double skirtFactor);

// The smallest depth, and the smallest factor, with which every item's skirt is deep enough.
struct RequiredSkirts {
    double depthM = 0;
    double factor = 0;  // infinity where none is enough: something is wrong with a chunk's error
};
RequiredSkirts requiredSkirts(const ChunkTree& tree, ErrorMetric metric, std::span<const DrawItem> items,
                              std::span<const DrawnPair> pairs, std::span<const EdgeGap> gaps);

}  // namespace planet
