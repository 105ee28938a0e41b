#include "planet/select/drawn_bound.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "planet/select/drawn_surface.h"
#include "planet/select/screen_error.h"
#include "planet/sphere/bounds.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/tree/chunk_table.h"

namespace planet {

namespace {

// Returns the largest slide of the chunk's vertices, metres.
double mostSlideM(const DrawItem& item, ErrorMetric metric) {
    const auto parentM = static_cast<double>(item.parentDeltaM);
    return metric == ErrorMetric::Additive ? std::max(parentM - static_cast<double>(item.deltaCM), 0.0)
                                           : parentM;
}

double distanceOf(const DrawItem& item) {
    return static_cast<double>(std::max(item.distanceM, item.nearestSampleM));
}

// Returns the distance to the nearest vertex; the vertices of a leaf are the finest samples.
double nearestVertexM(const PlanetShape& shape, const ChunkNode& node, const glm::dvec3& eyeM) {
    const int cells = chunkCells(shape);
    const FaceSquare square = faceSquareOf(node.id);
    double nearestM = std::numeric_limits<double>::infinity();
    std::size_t index = 0;
    for (int row = 0; row <= cells; ++row) {
        for (int column = 0; column <= cells; ++column) {
            const double u = square.u + square.side * column / cells;
            const double v = square.v + square.side * row / cells;
            const glm::dvec3 direction = sphereFromCube(cubePoint(node.id.face, u, v));
            const glm::dvec3 vertexM = positionM(shape, direction, heightM(shape, (*node.heights)[index++]));
            nearestM = std::min(nearestM, glm::distance(vertexM, eyeM));
        }
    }
    return nearestM;
}

double edgeSlideM(std::span<const DrawItem> items, const DrawItem& item, std::size_t edge,
                  std::uint32_t neighbour, ErrorMetric metric) {
    const double own = mostSlideM(item, metric);
    if (neighbour == noNeighbour) return own;
    const DrawItem& other = items[neighbour];
    if (item.coarserBy[edge] == 0) return std::min(own, mostSlideM(other, metric));
    return std::min(own, static_cast<double>(std::max(other.deltaCM, item.rimDeltaM[edge])));
}

// Returns the bound inside a chunk and along its edges that are not stitched to a coarser chunk.
double ownBoundPx(std::span<const DrawItem> items, const DrawItem& item, const DrawnNeighbours& neighbours,
                  double spanM, double screenScalePx, ErrorMetric metric, bool stitched) {
    const auto eps = static_cast<double>(item.epsPx);
    const auto morph = static_cast<double>(item.morph);
    const auto deltaM = static_cast<double>(item.deltaCM);
    const double distanceM = distanceOf(item);
    const auto parentM = std::max(static_cast<double>(item.parentDeltaM), deltaM);
    const double parentPx =
        std::min(static_cast<double>(item.parentEpsPx),
                 static_cast<double>(item.parentDeltaM) * screenScalePx / std::max(distanceM, nearestM));
    const double inside = eps + morph * std::max(parentPx - eps, 0.0);
    const double slidM = morph * mostSlideM(item, metric);
    double mixedPx = 0;  // the two bounds along an edge
    double slidPx = 0;
    double gatheredPx = 0;
    for (std::size_t edge = 0; edge < edgeCount; ++edge) {
        if (stitched && item.coarserBy[edge] > 0) continue;
        const auto edgeMorph = static_cast<double>(item.edgeMorph[edge]);
        const bool gathers = stitched && gathersVertices(item, static_cast<Edge>(edge));
        if (edgeMorph == morph && !gathers) continue;
        const std::uint32_t neighbour = neighbours[edge];
        const double slideM = edgeSlideM(items, item, edge, neighbour, metric);
        const double besideM = neighbour == noNeighbour ? 0 : distanceOf(items[neighbour]) - spanM;
        const double pxPerM = screenScalePx / std::max(distanceM, besideM);
        mixedPx = std::max(
            mixedPx,
            ((1 - morph) * deltaM + morph * parentM + std::abs(edgeMorph - morph) * slideM) * pxPerM);
        slidPx = std::max(slidPx, (deltaM + std::max(slidM, edgeMorph * slideM)) * pxPerM);
        if (gathers) {
            gatheredPx = std::max(gatheredPx, eps + (edgeMorph + 1) * static_cast<double>(item.parentDeltaM) *
                                                        screenScalePx / distanceM);
        }
    }
    return std::max({inside, std::min(mixedPx, slidPx), gatheredPx});
}

// Returns the error of a coarser neighbour's edge against the finer data on this side.
float rimPx(const DrawItem& item, std::size_t edge, double screenScalePx) {
    const double px =
        static_cast<double>(item.rimDeltaM[edge]) * screenScalePx / std::max(distanceOf(item), nearestM);
    return static_cast<float>(px);
}

}  // namespace

// On the unit sphere, a step along either axis is at most as long as on the cube, whose faces have side 2.
double cellSpanM(const PlanetShape& shape, const ChunkNode& node) {
    const double cellSide = 2.0 / static_cast<double>(std::uint64_t{1} << node.id.level) / chunkCells(shape);
    const double highestM = shape.radiusM + static_cast<double>(node.maxHeightM);
    return 2 * cellSide * highestM + static_cast<double>(node.maxHeightM - node.minHeightM);
}

double nearestSampleM(const PlanetShape& shape, const ChunkNode& node, const glm::dvec3& eyeM) {
    const double eyeHeightM = glm::length(eyeM) - shape.radiusM;
    const double byHeightM = std::max(eyeHeightM - static_cast<double>(node.maxHeightM),
                                      static_cast<double>(node.minHeightM) - eyeHeightM);
    if (node.childrenState != ChildrenState::None) return std::max(byHeightM, 0.0);
    const double nearM = std::max(byHeightM, distanceM(node.bounds.box, eyeM));
    return nearM < cellSpanM(shape, node) ? nearestVertexM(shape, node, eyeM) : std::max(byHeightM, 0.0);
}

void fillDrawnBounds(std::span<DrawItem> items, std::span<const DrawnNeighbours> neighbours,
                     std::span<const double> cellSpansM, double screenScalePx, ErrorMetric metric,
                     bool stitched) {
    assert(items.size() == neighbours.size() && items.size() == cellSpansM.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        items[i].drawnBoundPx = static_cast<float>(
            ownBoundPx(items, items[i], neighbours[i], cellSpansM[i], screenScalePx, metric, stitched));
    }
    if (!stitched) return;
    std::vector<float> own;
    own.reserve(items.size());
    for (const DrawItem& item : items) own.push_back(item.drawnBoundPx);
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (std::size_t edge = 0; edge < edgeCount; ++edge) {
            if (items[i].coarserBy[edge] == 0 || neighbours[i][edge] == noNeighbour) continue;
            const float coarserPx = std::max(own[neighbours[i][edge]], rimPx(items[i], edge, screenScalePx));
            items[i].drawnBoundPx = std::max(items[i].drawnBoundPx, own[i] + coarserPx);
        }
    }
}

void fillDrawnBounds(std::span<DrawItem> items, std::span<const double> cellSpansM, double screenScalePx,
                     ErrorMetric metric, bool stitched) {
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
    fillDrawnBounds(items, neighbours, cellSpansM, screenScalePx, metric, stitched);
}

}  // namespace planet
