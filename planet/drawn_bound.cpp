#include "planet/drawn_bound.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "planet/chunk_table.h"
#include "planet/drawn_surface.h"

namespace planet {

namespace {

// The farthest that one of the chunk's vertices slides, metres.
double mostSlideM(const DrawItem& item, ErrorMetric metric) {
    const auto parentM = static_cast<double>(item.parentDeltaM);
    return metric == ErrorMetric::Additive ? std::max(parentM - static_cast<double>(item.deltaCM), 0.0)
                                           : parentM;
}

double edgeSlideM(std::span<const DrawItem> items, const DrawItem& item, std::size_t edge,
                  std::uint32_t neighbour, ErrorMetric metric) {
    const double own = mostSlideM(item, metric);
    if (neighbour == noNeighbour) return own;
    const DrawItem& other = items[neighbour];
    return std::min(
        own, item.coarserBy[edge] > 0 ? static_cast<double>(other.deltaCM) : mostSlideM(other, metric));
}

// Of a chunk by itself: its inside, and those of its edges that are not stitched to a coarser chunk.
double ownBoundPx(std::span<const DrawItem> items, const DrawItem& item, const DrawnNeighbours& neighbours,
                  double screenScalePx, ErrorMetric metric, bool stitched) {
    const auto eps = static_cast<double>(item.epsPx);
    const auto morph = static_cast<double>(item.morph);
    const double inside = eps + morph * std::max(static_cast<double>(item.parentEpsPx) - eps, 0.0);
    const double pxPerM = screenScalePx / static_cast<double>(item.distanceM);
    double besideM = 0;                               // more than inside
    double slidM = morph * mostSlideM(item, metric);  // more than eps
    double gatheredPx = 0;
    for (std::size_t edge = 0; edge < edgeCount; ++edge) {
        if (stitched && item.coarserBy[edge] > 0) continue;
        const auto edgeMorph = static_cast<double>(item.edgeMorph[edge]);
        const bool gathers = stitched && gathersVertices(item, static_cast<Edge>(edge));
        if (edgeMorph == morph && !gathers) continue;
        const double slideM = edgeSlideM(items, item, edge, neighbours[edge], metric);
        besideM = std::max(besideM, std::abs(edgeMorph - morph) * slideM);
        slidM = std::max(slidM, edgeMorph * slideM);
        if (gathers) gatheredPx = std::max(gatheredPx, eps + (edgeMorph + 1) * item.parentDeltaM * pxPerM);
    }
    return std::max({inside, std::min(inside + besideM * pxPerM, eps + slidM * pxPerM), gatheredPx});
}

}  // namespace

void fillDrawnBounds(std::span<DrawItem> items, std::span<const DrawnNeighbours> neighbours,
                     double screenScalePx, ErrorMetric metric, bool stitched) {
    assert(items.size() == neighbours.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        items[i].drawnBoundPx =
            static_cast<float>(ownBoundPx(items, items[i], neighbours[i], screenScalePx, metric, stitched));
    }
    if (!stitched) return;
    std::vector<float> own;
    own.reserve(items.size());
    for (const DrawItem& item : items) own.push_back(item.drawnBoundPx);
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (std::size_t edge = 0; edge < edgeCount; ++edge) {
            if (items[i].coarserBy[edge] == 0 || neighbours[i][edge] == noNeighbour) continue;
            items[i].drawnBoundPx = std::max(items[i].drawnBoundPx, own[i] + own[neighbours[i][edge]]);
        }
    }
}

void fillDrawnBounds(std::span<DrawItem> items, double screenScalePx, ErrorMetric metric, bool stitched) {
    ChunkTable places(items.size());
    for (std::uint32_t i = 0; i < items.size(); ++i) places.add(items[i].id, i);
    std::vector<DrawnNeighbours> neighbours(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (std::size_t edge = 0; edge < edgeCount; ++edge) {
            const ChunkId beside = neighbourOf(items[i].id, static_cast<Edge>(edge));
            const std::uint32_t* found =
                places.find(ancestorOf(beside, items[i].id.level - items[i].coarserBy[edge]));
            neighbours[i][edge] = found ? *found : noNeighbour;
        }
    }
    fillDrawnBounds(items, neighbours, screenScalePx, metric, stitched);
}

}  // namespace planet
