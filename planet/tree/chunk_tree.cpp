#include "planet/tree/chunk_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "planet/base/try.h"
#include "planet/sphere/geometric_error.h"
#include "planet/tree/node_groups.h"

namespace planet {

namespace {

struct Limits {
    std::int32_t minStep;
    std::int32_t maxStep;
    float deltaCM;
    float deltaTightM;
};

tl::unexpected<Error> invalid(const ChunkId& id, const std::string& what) {
    return badInput(fmt::format("chunk {}: {}", toString(id), what));
}

// Checks a chunk without its heights.
Result<void> checkChunk(const PlanetShape& shape, const ChunkData& data, const ChunkId& id,
                        const Limits& limits) {
    if (data.id != id)
        return invalid(id, fmt::format("id: {} is wrong; expected {}", toString(data.id), toString(id)));
    if (!(data.deltaCM >= 0 && data.deltaCM <= limits.deltaCM)) {
        return invalid(id, fmt::format("delta_c: {} m is out of range; expected [0, {}] m", data.deltaCM,
                                       limits.deltaCM));
    }
    const float mostTightM = std::min(data.deltaCM, limits.deltaTightM);
    if (!(data.deltaTightM >= 0 && data.deltaTightM <= mostTightM)) {
        return invalid(id, fmt::format("tight metric: {} m is out of range; expected [0, {}] m",
                                       data.deltaTightM, mostTightM));
    }
    if (data.minStep > data.maxStep || data.minStep < limits.minStep || data.maxStep > limits.maxStep) {
        return invalid(id, fmt::format("extremes: steps {} to {} are out of range; expected [{}, {}]",
                                       data.minStep, data.maxStep, limits.minStep, limits.maxStep));
    }
    if (id.level >= deepestLevelOf(shape) && data.children.exists())
        return invalid(id, "has children below the finest level; expected none");
    return {};
}

// Returns A_l + A_l+1 + ... down to the parents of the deepest leaves that the shape allows.
double curvatureErrorsM(const PlanetShape& shape, int fromLevel) {
    double sum = 0;
    for (int level = fromLevel; level < deepestLevelOf(shape); ++level) sum += curvatureErrorM(shape, level);
    return sum;
}

// Computes the values that depend on the node's directions, its stored steps and metrics, and the tree's
// exaggeration.
void setMeasures(const ChunkTree& tree, ChunkNode& node) {
    const PlanetShape& shape = tree.shape;
    const double lowM = heightM(shape, node.minStep);
    const double highM = heightM(shape, node.maxStep);
    node.minHeightM = static_cast<float>(lowM);
    node.maxHeightM = static_cast<float>(highM);
    const ChunkDirections directions{node.bounds.box.axes, node.directionLow, node.directionHigh,
                                     node.bounds.cone};
    node.bounds = chunkBounds(directions, shape.radiusM, lowM, highM);
    node.deltaCM = node.storedDeltaCM;
    node.deltaTightM = node.storedDeltaTightM;
    // Exaggeration leaves no error at a leaf, whose own samples are the finest.
    if (tree.exaggeration == 1 || !node.children.exists()) return;
    const double bent = std::abs(tree.exaggeration - 1) * curvatureErrorsM(shape, node.id.level);
    // A hostile file may have the largest of floats.
    constexpr double largestM = std::numeric_limits<float>::max();
    node.deltaCM = roundedUp(std::min(tree.exaggeration * node.storedDeltaCM + bent, largestM));
    const float tightM = roundedUp(std::min(tree.exaggeration * node.storedDeltaTightM + bent, largestM));
    node.deltaTightM = std::min(tightM, node.deltaCM);
}

// Returns the part of the ground that a node draws. Heights are those baked.
GroundArea groundOf(const ChunkTree& tree, const ChunkNode& node) {
    return {node.bounds.cone, heightM(tree.storedShape, node.minStep),
            heightM(tree.storedShape, node.maxStep)};
}

// Sets the demands of a node's resident children and of everything below them. parts: those in the node.
void setDemandsBelow(ChunkTree& tree, NodeIndex parent, const RegionSet::Parts& parts) {
    if (tree.nodes[parent].childrenState != ChildrenState::Resident) return;
    for (NodeIndex q = 0; q < quadrantCount; ++q) {
        const NodeIndex index = tree.nodes[parent].firstChild + q;
        ChunkNode& node = tree.nodes[index];
        const GroundArea ground = groundOf(tree, node);
        node.demand = withinParent(tree.regions->demandIn(ground, parts), tree.nodes[parent].demand);
        setDemandsBelow(tree, index, tree.regions->partsIn(ground, parts));
    }
}

// Returns the parts of the regions that matter in a node, narrowed along its ancestors.
RegionSet::Parts partsAt(const ChunkTree& tree, NodeIndex node) {
    std::vector<NodeIndex> path;
    for (NodeIndex at = node; at != noNode; at = tree.nodes[at].parent) path.push_back(at);
    RegionSet::Parts parts = tree.regions->allParts();
    for (auto at = path.rbegin(); at != path.rend() && !parts.empty(); ++at)
        parts = tree.regions->partsIn(groundOf(tree, tree.nodes[*at]), parts);
    return parts;
}

void setOccluder(ChunkTree& tree) {
    const double lowestM = tree.shape.radiusM + heightM(tree.shape, tree.minStep);
    tree.occluderRadiusM = radiusInsideTriangles(lowestM, chunkCells(tree.shape));
}

ChunkNode makeNode(const ChunkTree& tree, ChunkData&& data, NodeIndex parent, std::uint32_t slot) {
    ChunkNode node;
    node.id = data.id;
    node.storedDeltaCM = data.deltaCM;
    node.storedDeltaTightM = data.deltaTightM;
    node.minStep = data.minStep;
    node.maxStep = data.maxStep;
    const ChunkDirections directions = chunkDirections(node.id);
    node.bounds.box.axes = directions.axes;
    node.bounds.cone = directions.cone;
    node.directionLow = directions.low;
    node.directionHigh = directions.high;
    node.parent = parent;
    node.childrenState = data.children.exists() ? ChildrenState::Absent : ChildrenState::None;
    node.children = data.children;
    setMeasures(tree, node);
    node.slot = slot;
    node.heights = std::make_shared<const Steps>(std::move(data.heights));
    return node;
}

// The point where a ray from the planet's centre meets the plane of a triangle. inside: the smallest of its
// three barycentric coordinates, negative outside the triangle.
struct TriangleHit {
    double radiusM = 0;
    double inside = -std::numeric_limits<double>::infinity();
};

TriangleHit hitTriangle(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b,
                        const glm::dvec3& c) {
    // Positions are relative to one corner, because the edges are far shorter than the planet's radius.
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 normal = glm::cross(ab, ac);
    const double radiusM = glm::dot(normal, a) / glm::dot(normal, direction);
    const glm::dvec3 at = radiusM * direction - a;
    const double squared = glm::dot(normal, normal);
    const double alongAb = glm::dot(glm::cross(at, ac), normal) / squared;
    const double alongAc = glm::dot(glm::cross(ab, at), normal) / squared;
    return {radiusM, std::min({alongAb, alongAc, 1 - alongAb - alongAc})};
}

// Returns the hit that lies further inside its triangle, of the two triangles of a cell. The diagonal runs
// from the south-west to the north-east corner.
TriangleHit hitCell(const PlanetShape& shape, const ChunkNode& node, int column, int row,
                    const glm::dvec3& direction) {
    const FaceSquare square = faceSquareOf(node.id);
    const int cells = chunkCells(shape);
    const auto vertex = [&](int i, int j) {
        const double u = square.u + square.side * i / cells;
        const double v = square.v + square.side * j / cells;
        const auto at = static_cast<std::size_t>(j * (cells + 1) + i);
        return positionM(shape, sphereFromCube(cubePoint(node.id.face, u, v)),
                         heightM(shape, (*node.heights)[at]));
    };
    const glm::dvec3 southWest = vertex(column, row);
    const glm::dvec3 northEast = vertex(column + 1, row + 1);
    const TriangleHit south = hitTriangle(direction, southWest, vertex(column + 1, row), northEast);
    const TriangleHit north = hitTriangle(direction, southWest, northEast, vertex(column, row + 1));
    return south.inside >= north.inside ? south : north;
}

NodeIndex finestNodeAt(const ChunkTree& tree, const FacePoint& point) {
    auto index = static_cast<NodeIndex>(point.face);
    while (tree.nodes[index].childrenState == ChildrenState::Resident) {
        const ChunkId child = chunkAt(point, tree.nodes[index].id.level + 1);
        index = tree.nodes[index].firstChild + static_cast<NodeIndex>(quadrantOf(child));
    }
    return index;
}

}  // namespace

Result<ChunkTree> makeChunkTree(const PlanetShape& shape, std::int32_t minStep, std::int32_t maxStep,
                                std::array<ChunkData, faceCount>&& roots) {
    const double lowestM = shape.radiusM + heightM(shape, minStep);
    if (!(lowestM > 0)) {
        return badInput(
            fmt::format("the lowest height, {} m, lies below the centre of a planet of radius {} m",
                        heightM(shape, minStep), shape.radiusM));
    }
    ChunkTree tree;
    tree.shape = tree.storedShape = shape;
    tree.minStep = minStep;
    tree.maxStep = maxStep;
    tree.allChunks = chunkCountOf(shape);
    setOccluder(tree);
    for (const Face face : allFaces) {
        const auto index = static_cast<std::uint32_t>(face);
        const ChunkId id{face, 0, 0, 0};
        constexpr float anyM = std::numeric_limits<float>::max();
        const Limits limits{minStep, maxStep, anyM, anyM};
        TRY(checkChunk(shape, roots[index], id, limits));
        TRY(checkHeights(shape, roots[index]));
        tree.nodes.push_back(makeNode(tree, std::move(roots[index]), noNode, index));
    }
    tree.residentChunks = faceCount;
    return tree;
}

void setExaggeration(ChunkTree& tree, double factor) {
    assert(factor > 0 && factor <= largestExaggeration(tree));
    tree.exaggeration = factor;
    tree.shape.quantumM = factor * tree.storedShape.quantumM;
    tree.shape.baseHeightM = factor * tree.storedShape.baseHeightM;
    setOccluder(tree);
    forEachNode(tree, [&](NodeIndex index, const ChunkNode&) { setMeasures(tree, tree.nodes[index]); });
}

void setRegions(ChunkTree& tree, std::shared_ptr<const RegionSet> regions) {
    tree.regions = std::move(regions);
    if (!tree.regions) {
        forEachNode(tree, [&](NodeIndex index, const ChunkNode&) { tree.nodes[index].demand = {}; });
        return;
    }
    for (NodeIndex root = 0; root < faceCount; ++root) {
        ChunkNode& node = tree.nodes[root];
        const GroundArea ground = groundOf(tree, node);
        node.demand = tree.regions->demandIn(ground, tree.regions->allParts());
        setDemandsBelow(tree, root, tree.regions->partsIn(ground, tree.regions->allParts()));
    }
}

std::vector<RegionEffect> regionEffects(const ChunkTree& tree, NodeIndex node) {
    if (!tree.regions) return {};
    return tree.regions->effectsIn(groundOf(tree, tree.nodes[node]), partsAt(tree, node));
}

double largestExaggeration(const ChunkTree& tree) {
    constexpr double most = 100;
    constexpr double deepest = 0.99;  // of the radius
    const double lowestM = heightM(tree.storedShape, tree.minStep);
    if (lowestM >= 0) return most;
    return std::clamp(deepest * tree.storedShape.radiusM / -lowestM, 1.0, most);
}

// Along a line of the cube, a vertex at parameter 0 between neighbours at -1 and 1 is off their middle by at
// most half of the largest second derivative between them. An edge's neighbours are o = half a cell away
// along u or v, so that derivative is o^2 |d_uu| <= 1.5 o^2 (bounds.cpp). A diagonal's neighbours are o away
// along both: the derivative is o^2 |d_uu + 2 d_uv + d_vv|. It is 1 o^2 in the middle of a face and largest
// at the corners u = -v = 1. There the first component is -10/3 / (2 sqrt(1/3)) = -2.887 and the others are
// +-0.144, so it is 2.894 o^2.
double curvatureErrorM(const PlanetShape& shape, int level) {
    constexpr double mostBent = 2.9;
    const double offset = std::ldexp(1.0, -level) / chunkCells(shape);  // half of a cell; a face is 2 wide
    return shape.radiusM * offset * offset * mostBent / 2;
}

Result<void> checkHeights(const PlanetShape& shape, const ChunkData& data) {
    const auto expected = static_cast<std::size_t>(chunkVertexCount(shape));
    if (data.heights.size() != expected)
        return invalid(data.id, fmt::format("{} heights; expected {}", data.heights.size(), expected));
    const auto [lowest, highest] = lowestAndHighest(data.heights);
    if (lowest < data.minStep || highest > data.maxStep) {
        return invalid(
            data.id, fmt::format("heights: steps {} to {} are out of range; expected its extremes, [{}, {}]",
                                 lowest, highest, data.minStep, data.maxStep));
    }
    return {};
}

Result<void> checkChildren(const ChunkTree& tree, NodeIndex parent,
                           const std::array<ChunkData, quadrantCount>& children) {
    const ChunkNode& above = tree.nodes[parent];
    const Limits limits{above.minStep, above.maxStep, above.storedDeltaCM, above.storedDeltaTightM};
    for (int q = 0; q < quadrantCount; ++q) {
        const ChunkData& data = children[static_cast<std::size_t>(q)];
        TRY(checkChunk(tree.shape, data, childOf(above.id, q), limits));
    }
    return {};
}

NodeIndex addChildren(ChunkTree& tree, NodeIndex parent, std::array<ChunkData, quadrantCount>&& children,
                      const std::array<std::uint32_t, quadrantCount>& slots) {
    if (tree.nodes[parent].childrenState == ChildrenState::Absent)
        changeState(tree.nodes[parent].childrenState, ChildrenState::Requested);
    const NodeIndex first = takeGroup(tree);
    for (std::uint32_t q = 0; q < quadrantCount; ++q) {
        assert(children[q].id == childOf(tree.nodes[parent].id, static_cast<int>(q)));
        tree.nodes[first + q] = makeNode(tree, std::move(children[q]), parent, slots[q]);
    }
    tree.nodes[parent].firstChild = first;
    changeState(tree.nodes[parent].childrenState, ChildrenState::Resident);
    if (tree.regions) setDemandsBelow(tree, parent, partsAt(tree, parent));
    tree.residentChunks += quadrantCount;
    return first;
}

void removeChildren(ChunkTree& tree, NodeIndex parent) {
    freeGroup(tree, parent);
    tree.residentChunks -= quadrantCount;
}

NodeIndex findNode(const ChunkTree& tree, const ChunkId& id) {
    return findResident(tree, id);
}

void forEachNode(const ChunkTree& tree, const std::function<void(NodeIndex, const ChunkNode&)>& visit) {
    std::vector<NodeIndex> open = {0, 1, 2, 3, 4, 5};
    while (!open.empty()) {
        const NodeIndex index = open.back();
        open.pop_back();
        const ChunkNode& node = tree.nodes[index];
        visit(index, node);
        if (node.childrenState != ChildrenState::Resident) continue;
        for (NodeIndex q = 0; q < quadrantCount; ++q) open.push_back(node.firstChild + q);
    }
}

double residentHeightM(const ChunkTree& tree, const glm::dvec3& direction) {
    const glm::dvec3 unit = glm::normalize(direction);
    const FacePoint point = facePointFromDirection(unit);
    const ChunkNode& node = tree.nodes[finestNodeAt(tree, point)];
    const FaceSquare square = faceSquareOf(node.id);
    const int cells = chunkCells(tree.shape);
    const auto cellOf = [&](double t, double from) {
        return std::clamp(static_cast<int>(std::floor((t - from) / square.side * cells)), 0, cells - 1);
    };
    const int column = cellOf(point.u, square.u);
    const int row = cellOf(point.v, square.v);
    TriangleHit best = hitCell(tree.shape, node, column, row, unit);
    if (best.inside >= 0) return best.radiusM - tree.shape.radiusM;
    // The edges of triangles are straight in space but not in (u, v), so a ray close to a cell's edge may hit
    // the neighbouring cell.
    for (int j = std::max(0, row - 1); j <= std::min(cells - 1, row + 1); ++j) {
        for (int i = std::max(0, column - 1); i <= std::min(cells - 1, column + 1); ++i) {
            const TriangleHit hit = hitCell(tree.shape, node, i, j, unit);
            if (hit.inside > best.inside) best = hit;
        }
    }
    return best.radiusM - tree.shape.radiusM;
}

double sampledHeightM(const ChunkTree& tree, const glm::dvec3& direction) {
    const FacePoint point = facePointFromDirection(glm::normalize(direction));
    const ChunkNode& node = tree.nodes[finestNodeAt(tree, point)];
    const FaceSquare square = faceSquareOf(node.id);
    const int cells = chunkCells(tree.shape);
    const double x = std::clamp((point.u - square.u) / square.side, 0.0, 1.0) * cells;
    const double y = std::clamp((point.v - square.v) / square.side, 0.0, 1.0) * cells;
    const int column = std::min(static_cast<int>(x), cells - 1);
    const int row = std::min(static_cast<int>(y), cells - 1);
    const auto sampleM = [&](int i, int j) {
        return heightM(tree.shape, (*node.heights)[static_cast<std::size_t>(j * (cells + 1) + i)]);
    };
    const auto rowM = [&](int j) {
        return std::lerp(sampleM(column, j), sampleM(column + 1, j), x - column);
    };
    return std::lerp(rowM(row), rowM(row + 1), y - row);
}

std::size_t chunkBytesCpu(const PlanetShape& shape) {
    // The object of heights and its reference counts are in another allocation.
    constexpr std::size_t sharing = sizeof(Steps) + 2 * sizeof(void*);
    return static_cast<std::size_t>(chunkVertexCount(shape)) * stepBytesOf(shape) + sizeof(ChunkNode) +
           sharing;
}

std::size_t chunkBytesGpu(const PlanetShape& shape) {
    return static_cast<std::size_t>(chunkVertexCount(shape)) * stepBytesOf(shape);
}

}  // namespace planet
