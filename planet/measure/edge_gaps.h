// How far the edges of drawn neighbours lie apart, and how deep a skirt has to hang to cover that.
//
// Both sides of an edge that two drawn chunks share are lines with straight pieces: so is the way from a
// point of one to the point of the other at the same place, and its length is largest at a vertex of either.
//
// A gap along the radius is what skirts are there for. Edges also part sideways, by far less: a coarse edge
// is a chord and the finer one follows the curve that it cuts short. So a skirt as deep as the gap is the
// least that can hold, and where a gap is seen from right above it may take more; the crack meter says.
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

// What an instrument has to know of the drawn ground, beside the renderer that holds it.
struct DrawnGround {
    PlanetShape shape;
    std::span<const DrawItem> items;
    HeightsOf heights;
    bool stitched = false;  // as in gl::RenderSettings
};

// Two drawn chunks side by side: indices of the drawn items. Of two of one level the finer is the one of the
// lower id.
struct DrawnPair {
    std::uint32_t finer = 0;
    std::uint32_t coarser = 0;
    Edge finerEdge = Edge::West;
    Edge coarserEdge = Edge::West;
    // Where the finer chunk's edge begins and ends on the coarser one's, [0, 1] from that one's west or south
    // end. The second is the smaller where the axes of two faces run against each other.
    std::array<double, 2> span{0, 1};
};

// Each pair once, in the order of the items.
std::vector<DrawnPair> drawnPairs(std::span<const DrawItem> items);

// Finds pairs by where they are.
class PairFinder {
public:
    PairFinder(std::span<const DrawnPair> pairs, std::size_t itemCount);
    // The pair beside an item's edge at a place along it, [0, 1] from the west or south; none where nothing
    // is drawn beyond.
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

// Of all pairs, those without a gap too; the largest gapM first. A vertex in the file's heights counts to the
// last bit: chunks of one level and one morph have a gap of 0.
std::vector<EdgeGap> edgeGaps(const DrawnGround& ground, const View& view);
std::vector<EdgeGap> edgeGaps(const DrawnGround& ground, std::span<const DrawnPair> pairs, const View& view);

// The depth that each item's skirt needs to reach down to all edges beside its own, metres; 0 for none.
std::vector<double> requiredSkirtDepthsM(std::span<const EdgeGap> gaps, std::size_t itemCount);

// What LodSettings::skirtFactor makes of the items' skirts: selection's own rule, told apart from the rest of
// selecting so that other factors can be tried on what was selected. The items must be nodes of the tree.
std::vector<float> automaticSkirtDepthsM(const ChunkTree& tree, ErrorMetric metric,
                                         std::span<const DrawItem> items, std::span<const DrawnPair> pairs,
                                         double skirtFactor);

// The smallest depth and the smallest factor by which every item's skirt is as deep as it needs to be.
struct RequiredSkirts {
    double depthM = 0;
    double factor = 0;  // infinity where none is enough: something is wrong with a chunk's error
};
RequiredSkirts requiredSkirts(const ChunkTree& tree, ErrorMetric metric, std::span<const DrawItem> items,
                              std::span<const DrawnPair> pairs, std::span<const EdgeGap> gaps);

}  // namespace planet
