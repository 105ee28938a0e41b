#include "planet/measure/edge_gaps.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "planet/select/drawn_surface.h"
#include "planet/select/skirt_depth.h"
#include "planet/tree/chunk_table.h"

namespace planet {

namespace {

bool isUpright(Edge edge) {
    return edge == Edge::West || edge == Edge::East;
}

// Returns the position of a cube point along a chunk's edge, [0, 1], exactly.
double alongEdge(const ChunkId& id, Edge edge, const glm::dvec3& cube) {
    const FaceSquare square = faceSquareOf(id);
    const FaceAxes& axes = faceAxes(id.face);
    return isUpright(edge) ? (glm::dot(cube, axes.v) - square.v) / square.side
                           : (glm::dot(cube, axes.u) - square.u) / square.side;
}

glm::dvec3 endOfEdge(const ChunkId& id, Edge edge, bool farEnd) {
    const FaceSquare square = faceSquareOf(id);
    const double end = farEnd ? square.side : 0;
    switch (edge) {
        case Edge::West:
            return cubePoint(id.face, square.u, square.v + end);
        case Edge::East:
            return cubePoint(id.face, square.u + square.side, square.v + end);
        case Edge::South:
            return cubePoint(id.face, square.u + end, square.v);
        case Edge::North:
            break;
    }
    return cubePoint(id.face, square.u + end, square.v + square.side);
}

// An edge as it is drawn.
struct EdgeLine {
    std::vector<double> along;  // [0, 1], non-decreasing
    std::vector<glm::dvec3> positionM;
};

EdgeLine edgeLine(const DrawnGround& ground, const DrawItem& item, Edge edge) {
    const int cells = chunkCells(ground.shape);
    const StepsView heights = ground.heights(item);
    EdgeLine line;
    for (int i = 0; i <= cells; ++i) {
        const int column = edge == Edge::West ? 0 : edge == Edge::East ? cells : i;
        const int row = edge == Edge::South ? 0 : edge == Edge::North ? cells : i;
        const DrawnVertex vertex = drawnVertex(ground.shape, item, heights, ground.stitched, column, row);
        line.along.push_back((isUpright(edge) ? vertex.place.y : vertex.place.x) / cells);
        line.positionM.push_back(vertex.positionM);
    }
    return line;
}

glm::dvec3 pointAt(const EdgeLine& line, double along) {
    const auto above = std::upper_bound(line.along.begin(), line.along.end(), along);
    if (above == line.along.begin()) return line.positionM.front();
    const auto before = static_cast<std::size_t>(above - line.along.begin()) - 1;
    if (above == line.along.end() || line.along[before] == along) return line.positionM[before];
    const double share = (along - line.along[before]) / (*above - line.along[before]);
    return glm::mix(line.positionM[before], line.positionM[before + 1], share);
}

// Returns the distance of two points in a view turned to face them, pixels.
double facingPx(const View& view, double scalePx, const glm::dvec3& a, const glm::dvec3& b) {
    return scalePx * glm::length(glm::normalize(a - view.eyeM) - glm::normalize(b - view.eyeM));
}

// Returns the distance in the flat picture, pixels; 0 unless the first point lies in the picture and the
// other one in front of the camera.
double screenPx(const View& view, double scalePx, const glm::dvec3& a, const glm::dvec3& b) {
    const auto inCamera = [&](const glm::dvec3& p) {
        const glm::dvec3 fromEye = p - view.eyeM;
        return glm::dvec3(glm::dot(fromEye, view.right), glm::dot(fromEye, view.up),
                          -glm::dot(fromEye, view.back));
    };
    const glm::dvec3 p = inCamera(a);
    const glm::dvec3 q = inCamera(b);
    if (p.z <= 0 || q.z <= 0) return 0;
    const glm::dvec2 atP = scalePx / p.z * glm::dvec2(p);
    const glm::dvec2 atQ = scalePx / q.z * glm::dvec2(q);
    if (std::abs(atP.x) > view.widthPx / 2.0 || std::abs(atP.y) > view.heightPx / 2.0) return 0;
    return glm::length(atP - atQ);
}

void measureAt(const glm::dvec3& finer, const glm::dvec3& coarser, const View& view, double scalePx,
               EdgeGap& gap) {
    if (finer == coarser) return;
    const double apartM = glm::length(finer - coarser);
    const double aboveM = glm::length(finer) - glm::length(coarser);
    if (apartM > gap.gapM) {
        gap.gapM = apartM;
        gap.placeM = finer;
    }
    gap.radialM = std::max(gap.radialM, std::abs(aboveM));
    gap.finerAboveM = std::max(gap.finerAboveM, aboveM);
    gap.coarserAboveM = std::max(gap.coarserAboveM, -aboveM);
    gap.facingPx = std::max(gap.facingPx, facingPx(view, scalePx, finer, coarser));
    gap.screenPx = std::max(gap.screenPx, screenPx(view, scalePx, finer, coarser));
}

EdgeGap gapOf(const DrawnGround& ground, const DrawnPair& pair, const View& view, double scalePx) {
    const DrawItem& finer = ground.items[pair.finer];
    const DrawItem& coarser = ground.items[pair.coarser];
    EdgeGap gap;
    gap.pair = pair;
    gap.finer = finer.id;
    gap.coarser = coarser.id;
    gap.finerSkirtM = finer.skirtDepthM;
    gap.coarserSkirtM = coarser.skirtDepthM;
    const EdgeLine own = edgeLine(ground, finer, pair.finerEdge);
    const EdgeLine other = edgeLine(ground, coarser, pair.coarserEdge);
    gap.placeM = own.positionM[own.positionM.size() / 2];
    const auto [begin, end] = pair.span;
    for (std::size_t i = 0; i < own.along.size(); ++i)
        measureAt(own.positionM[i], pointAt(other, begin + (end - begin) * own.along[i]), view, scalePx, gap);
    for (std::size_t i = 0; i < other.along.size(); ++i) {
        const double along = (other.along[i] - begin) / (end - begin);
        if (along >= 0 && along <= 1) measureAt(pointAt(own, along), other.positionM[i], view, scalePx, gap);
    }
    return gap;
}

// Returns the largest possible distance between each item and its neighbours.
std::vector<float> mostApartOfEachM(const ChunkTree& tree, ErrorMetric metric,
                                    std::span<const DrawItem> items, std::span<const DrawnPair> pairs) {
    std::vector<float> apartM(items.size(), 0);
    for (const DrawnPair& pair : pairs) {
        const float bothM = mostApartM(tree, metric, items[pair.finer], pair.finerEdge, items[pair.coarser],
                                       pair.coarserEdge);
        apartM[pair.finer] = std::max(apartM[pair.finer], bothM);
        apartM[pair.coarser] = std::max(apartM[pair.coarser], bothM);
    }
    return apartM;
}

}  // namespace

HeightsOf heightsIn(const ChunkTree& tree) {
    return [&tree](const DrawItem& item) { return tree.nodes[item.node].heights->view(); };
}

std::vector<DrawnPair> drawnPairs(std::span<const DrawItem> items) {
    ChunkTable drawn(items.size());
    int coarsestLevel = maxLevel;
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        drawn.add(items[i].id, i);
        coarsestLevel = std::min<int>(coarsestLevel, items[i].id.level);
    }
    std::vector<DrawnPair> pairs;
    for (std::uint32_t i = 0; i < items.size(); ++i) {
        const ChunkId& id = items[i].id;
        for (const Edge edge : allEdges) {
            const ChunkId beside = neighbourOf(id, edge);
            const std::uint32_t* found = drawn.findHolder(beside, coarsestLevel);
            if (!found) continue;
            const ChunkId& other = items[*found].id;
            if (other.level == id.level && other < id) continue;
            const Edge otherEdge = edgeTowards(beside, id).value();
            pairs.push_back({i,
                             *found,
                             edge,
                             otherEdge,
                             {alongEdge(other, otherEdge, endOfEdge(id, edge, false)),
                              alongEdge(other, otherEdge, endOfEdge(id, edge, true))}});
        }
    }
    return pairs;
}

PairFinder::PairFinder(std::span<const DrawnPair> pairs, std::size_t itemCount)
    : pairs_(pairs), first_(itemCount + 1, 0), byItem_(2 * pairs.size()) {
    for (const DrawnPair& pair : pairs) {
        ++first_[pair.finer + 1];
        ++first_[pair.coarser + 1];
    }
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t i = 0; i < pairs.size(); ++i) {
        byItem_[next[pairs[i].finer]++] = i;
        byItem_[next[pairs[i].coarser]++] = i;
    }
}

std::optional<std::uint32_t> PairFinder::at(std::uint32_t item, Edge edge, double along) const {
    for (std::uint32_t i = first_[item]; i < first_[item + 1]; ++i) {
        const DrawnPair& pair = pairs_[byItem_[i]];
        if (pair.finer == item && pair.finerEdge == edge) return byItem_[i];
        if (pair.coarser != item || pair.coarserEdge != edge) continue;
        const auto [low, high] = std::minmax(pair.span[0], pair.span[1]);
        if (along >= low && along <= high) return byItem_[i];
    }
    return std::nullopt;
}

std::vector<EdgeGap> edgeGaps(const DrawnGround& ground, const View& view) {
    return edgeGaps(ground, drawnPairs(ground.items), view);
}

std::vector<EdgeGap> edgeGaps(const DrawnGround& ground, std::span<const DrawnPair> pairs, const View& view) {
    const double scalePx = screenScalePx(view);
    std::vector<EdgeGap> gaps;
    gaps.reserve(pairs.size());
    for (const DrawnPair& pair : pairs) gaps.push_back(gapOf(ground, pair, view, scalePx));
    std::stable_sort(gaps.begin(), gaps.end(),
                     [](const EdgeGap& a, const EdgeGap& b) { return a.gapM > b.gapM; });
    return gaps;
}

std::vector<double> requiredSkirtDepthsM(std::span<const EdgeGap> gaps, std::size_t itemCount) {
    std::vector<double> depths(itemCount, 0);
    for (const EdgeGap& gap : gaps) {
        double& finer = depths[gap.pair.finer];
        double& coarser = depths[gap.pair.coarser];
        finer = std::max(finer, gap.finerAboveM);
        coarser = std::max(coarser, gap.coarserAboveM);
    }
    return depths;
}

std::vector<float> automaticSkirtDepthsM(const ChunkTree& tree, ErrorMetric metric,
                                         std::span<const DrawItem> items, std::span<const DrawnPair> pairs,
                                         double skirtFactor) {
    std::vector<float> depths = mostApartOfEachM(tree, metric, items, pairs);
    for (std::size_t i = 0; i < depths.size(); ++i)
        depths[i] = automaticSkirtDepthM(tree, items[i], depths[i], skirtFactor);
    return depths;
}

RequiredSkirts requiredSkirts(const ChunkTree& tree, ErrorMetric metric, std::span<const DrawItem> items,
                              std::span<const DrawnPair> pairs, std::span<const EdgeGap> gaps) {
    const std::vector<double> neededM = requiredSkirtDepthsM(gaps, items.size());
    const std::vector<float> apartM = mostApartOfEachM(tree, metric, items, pairs);
    RequiredSkirts required;
    for (std::size_t i = 0; i < items.size(); ++i) {
        required.depthM = std::max(required.depthM, neededM[i]);
        if (neededM[i] <= static_cast<double>(leastSkirtDepthM(tree, items[i]))) continue;
        const double factor = apartM[i] > 0 ? neededM[i] / static_cast<double>(apartM[i])
                                            : std::numeric_limits<double>::infinity();
        required.factor = std::max(required.factor, factor);
    }
    return required;
}

}  // namespace planet
