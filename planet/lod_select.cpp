#include "planet/lod_select.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <unordered_set>

#include "planet/chunk_table.h"

namespace planet {

namespace {

// What every node of one frame is compared with.
struct Frame {
    const ChunkTree& tree;
    const LodSettings& settings;
    glm::dvec3 eyeM;
    Frustum frustum;
    Horizon horizon;
    double scalePx;                           // K'
    double reach;                             // K = K' / tau: d_m is delta_c times this
    double mergeReach;                        // the same for what was split: K' / (tau (1 - hysteresis))
    std::optional<ChunkTable> splitBefore;    // what hysteresis remembers; nothing without it
    std::unordered_set<NodeIndex> seamLimit;  // drawn though they could be split, for stitched seams
};

// What a node needs to know of its parent.
struct Above {
    double epsPx = 0;    // 0 for a root
    double deltaCM = 0;  // metres
};

// The tests a node still has to take: one that holds its parent wholly holds it too.
struct OpenTests {
    std::array<bool, std::tuple_size_v<Frustum>> planes;
    bool horizon;
};

enum class Culled { No, ByFrustum, ByHorizon };

Culled cull(const Frame& frame, const ChunkNode& node, OpenTests& open) {
    for (std::size_t i = 0; i < open.planes.size(); ++i) {
        if (!open.planes[i]) continue;
        const Containment where = classify(node.bounds.box, frame.frustum[i]);
        if (where == Containment::Outside) return Culled::ByFrustum;
        open.planes[i] = where == Containment::Crossing;
    }
    if (open.horizon) {
        const Containment where = classify(node.bounds, frame.horizon);
        if (where == Containment::Outside) return Culled::ByHorizon;
        open.horizon = where == Containment::Crossing;
    }
    return Culled::No;
}

// 1 where the parent is about to take the chunk's place, 0 where it is far from it.
//
// The chunk must show its own surface when its own children take its place, or it theirs: so it may not have
// begun to slide while its eps is over tau (1 - hysteresis). The parent's eps is at least delta_c(parent) /
// delta_c times the chunk's, where the parent's box holds the chunk's; where it does not, the ratio of the
// eps themselves is the smaller. Without hysteresis a ratio of 1 leaves no range, and needs none: the two
// surfaces are the same. With it, a range too short would be a pop of its own, so a quarter of it is kept.
double morphOf(const LodSettings& settings, const Above& above, double deltaCM, double epsPx) {
    if (!settings.morph || above.epsPx == 0) return 0;
    const double overTau = above.epsPx / settings.tauPx;
    if (overTau <= 1) return 1;
    double range = settings.morphRange;
    if (epsPx > 0) {
        const double ratio = std::min(above.deltaCM / deltaCM, above.epsPx / epsPx);
        range = std::min(range, std::max(ratio * (1 - settings.hysteresis) - 1, (ratio - 1) / 4));
    }
    return range > 0 ? std::max(0.0, (1 + range - overTau) / range) : 0;
}

void draw(const Frame& frame, NodeIndex index, double nodeDistanceM, const Above& above, Selection& out) {
    const ChunkNode& node = frame.tree.nodes[index];
    const double epsPx = node.deltaCM * frame.scalePx / nodeDistanceM;
    DrawItem item;
    item.node = index;
    item.id = node.id;
    item.slot = node.slot;
    item.epsPx = static_cast<float>(epsPx);
    item.parentEpsPx = static_cast<float>(above.epsPx);
    item.distanceM = static_cast<float>(nodeDistanceM);
    item.deltaCM = node.deltaCM;
    item.morph = static_cast<float>(morphOf(frame.settings, above, node.deltaCM, epsPx));
    out.draw.push_back(item);
    out.counters.deepestLevel = std::max<std::uint32_t>(out.counters.deepestLevel, node.id.level);
    out.counters.worstEpsPx = std::max(out.counters.worstEpsPx, item.epsPx);
}

// Only where the children are still there: hysteresis keeps what is, and asks for nothing.
bool staysSplit(const Frame& frame, const ChunkNode& node, double nodeDistanceM) {
    return frame.splitBefore && node.childrenState == ChildrenState::Resident &&
           node.deltaCM * frame.mergeReach > nodeDistanceM && frame.splitBefore->contains(node.id);
}

void visit(const Frame& frame, NodeIndex index, OpenTests open, const Above& above, Selection& out) {
    const ChunkNode& node = frame.tree.nodes[index];
    ++out.counters.visited;
    const std::size_t place = out.touched.size();
    out.touched.push_back({index, NodeFate::Drawn});
    const Culled culled = cull(frame, node, open);
    if (culled != Culled::No) {
        out.touched[place].fate =
            culled == Culled::ByFrustum ? NodeFate::CulledFrustum : NodeFate::CulledHorizon;
        ++(culled == Culled::ByFrustum ? out.counters.culledFrustum : out.counters.culledHorizon);
        return;
    }
    const double nodeDistanceM = distanceToM(node, frame.eyeM);
    const bool goodEnough = node.deltaCM * frame.reach <= nodeDistanceM;
    const bool mayBeSplit = node.childrenState != ChildrenState::None &&
                            node.id.level < frame.settings.maxLevel &&
                            (frame.seamLimit.empty() || !frame.seamLimit.contains(index));
    if (!mayBeSplit || (goodEnough && !staysSplit(frame, node, nodeDistanceM))) {
        return draw(frame, index, nodeDistanceM, above, out);
    }
    const ChildrenRequest wanted{index, node.id,
                                 static_cast<float>(node.deltaCM * frame.reach / nodeDistanceM)};
    if (node.childrenState == ChildrenState::Resident) {
        out.touched[place].fate = NodeFate::Split;
        out.splits.push_back(wanted);
        const Above here{node.deltaCM * frame.scalePx / nodeDistanceM, node.deltaCM};
        for (NodeIndex q = 0; q < quadrantCount; ++q) visit(frame, node.firstChild + q, open, here, out);
        return;
    }
    draw(frame, index, nodeDistanceM, above, out);
    ++out.counters.waiting;
    if (node.childrenState != ChildrenState::Failed) out.requests.push_back(wanted);
}

// The drawn chunk beyond an edge, of the same level or the first coarser one; finer ones find this chunk
// themselves.
const std::uint32_t* drawnNeighbour(const ChunkTable& drawn, const ChunkId& id, Edge edge,
                                    int coarsestLevel) {
    ChunkId other = neighbourOf(id, edge);
    const std::uint32_t* found = drawn.find(other);
    while (!found && other.level > coarsestLevel) {
        other = parentOf(other);
        found = drawn.find(other);
    }
    return found;
}

// How far a chunk that slides that much towards its parent may be from the truth, metres.
float boundM(const ChunkTree& tree, const DrawItem& item, float morph) {
    if (morph == 0) return item.deltaCM;
    const NodeIndex parent = tree.nodes[item.node].parent;
    if (parent == noNode) return item.deltaCM;
    return item.deltaCM + morph * (tree.nodes[parent].deltaCM - item.deltaCM);
}

// Both sides of an edge get a skirt that covers both errors, so whichever of the two lies higher there, its
// skirt reaches below the other.
void deepenSkirts(const ChunkTree& tree, double skirtFactor, Edge edge, DrawItem& item, DrawItem& other) {
    const bool level = item.id.level == other.id.level;
    const float morph = item.edgeMorph[static_cast<std::size_t>(edge)];
    const float bothM = boundM(tree, item, level ? morph : item.morph) + boundM(tree, other, morph);
    const auto depth = static_cast<float>(skirtFactor * bothM);
    item.skirtDepthM = std::max(item.skirtDepthM, depth);
    other.skirtDepthM = std::max(other.skirtDepthM, depth);
}

void joinEdge(DrawItem& item, Edge edge, const DrawItem& other, Selection& out) {
    float& morph = item.edgeMorph[static_cast<std::size_t>(edge)];
    const int levels = item.id.level - other.id.level;
    morph = levels == 0 ? std::max(morph, other.morph) : other.morph;
    if (levels == 0) return;
    item.coarserBy[static_cast<std::size_t>(edge)] = static_cast<std::uint8_t>(levels);
    out.seams.push_back({item.id, other.id, edge});
    out.counters.widestSeam = std::max(out.counters.widestSeam, static_cast<std::uint32_t>(levels));
}

// What the edges of the drawn chunks have beyond them, and what hides the gap there.
void joinEdges(const ChunkTree& tree, const LodSettings& settings, Selection& out) {
    const bool automatic = settings.seams == SeamMode::Skirts &&
                           settings.skirtDepth == SkirtDepth::Automatic && settings.skirtFactor > 0;
    const bool fixed = settings.seams == SeamMode::Skirts && settings.skirtDepth == SkirtDepth::Fixed;
    ChunkTable drawn(out.draw.size());
    int coarsestLevel = maxLevel;
    for (std::uint32_t i = 0; i < out.draw.size(); ++i) {
        DrawItem& item = out.draw[i];
        drawn.add(item.id, i);
        coarsestLevel = std::min<int>(coarsestLevel, item.id.level);
        item.edgeMorph.fill(item.morph);
        if (fixed) item.skirtDepthM = static_cast<float>(settings.skirtDepthM);
        // Edges that agree exactly still part by rounding, of heights and of pixels.
        if (automatic) {
            item.skirtDepthM = std::max(static_cast<float>(2 * tree.shape.quantumM), 1e-6f * item.distanceM);
        }
    }
    for (DrawItem& item : out.draw) {
        for (int e = 0; e < edgeCount; ++e) {
            const auto edge = static_cast<Edge>(e);
            const std::uint32_t* found = drawnNeighbour(drawn, item.id, edge, coarsestLevel);
            if (!found) continue;
            DrawItem& other = out.draw[*found];
            joinEdge(item, edge, other, out);
            if (automatic) deepenSkirts(tree, settings.skirtFactor, edge, item, other);
        }
    }
}

// For each seam that is too wide to be stitched, the chunk that must be drawn instead of the finer one: its
// ancestor of the finest level that can be stitched to the coarser one. No finer drawing can do without any
// of them, since the coarser one would only be coarser. False if there is none.
bool limitSeams(Frame& frame, const Selection& selection) {
    const int widest = frame.tree.shape.chunkCellsLog2 - 1;
    const std::size_t before = frame.seamLimit.size();
    for (const LevelSeam& seam : selection.seams) {
        if (seam.finer.level - seam.coarser.level <= widest) continue;
        ChunkId above = seam.finer;
        while (above.level > seam.coarser.level + widest) above = parentOf(above);
        frame.seamLimit.insert(findNode(frame.tree, above));
    }
    return frame.seamLimit.size() > before;
}

void clear(Selection& out) {
    out.draw.clear();
    out.requests.clear();
    out.splits.clear();
    out.seams.clear();
    out.touched.clear();
    out.counters = {};
}

void selectOnce(const Frame& frame, Selection& out) {
    clear(out);
    OpenTests all{};
    all.planes.fill(frame.settings.frustumCulling);
    all.horizon = frame.settings.horizonCulling;
    for (NodeIndex root = 0; root < faceCount; ++root) visit(frame, root, all, {}, out);
    // Before sorting, while neighbours lie close together in memory.
    joinEdges(frame.tree, frame.settings, out);
}

std::optional<ChunkTable> rememberedSplits(const LodSettings& settings, const Selection& before) {
    if (settings.hysteresis == 0) return std::nullopt;
    ChunkTable table(before.splits.size());
    for (const ChildrenRequest& split : before.splits) table.add(split.parentId, split.parent);
    return table;
}

}  // namespace

double distanceToM(const ChunkNode& node, const glm::dvec3& eyeM) {
    return std::max(distanceM(node.bounds.box, eyeM), nearestM);
}

double epsPxOf(const ChunkNode& node, const glm::dvec3& eyeM, double screenScalePx) {
    return node.deltaCM * screenScalePx / distanceToM(node, eyeM);
}

void selectChunks(const ChunkTree& tree, const View& lodView, const LodSettings& settings, Selection& out) {
    assert(settings.tauPx > 0 && settings.skirtFactor >= 0 && settings.skirtDepthM >= 0);
    assert(settings.hysteresis >= 0 && settings.hysteresis <= 0.9 && settings.morphRange > 0);
    const double scalePx = screenScalePx(lodView);
    Frame frame{tree,
                settings,
                lodView.eyeM,
                frustumOf(lodView),
                horizonOf(lodView.eyeM, tree.occluderRadiusM),
                scalePx,
                scalePx / settings.tauPx,
                scalePx / (settings.tauPx * (1 - settings.hysteresis)),
                rememberedSplits(settings, out),
                {}};
    selectOnce(frame, out);
    // Each round draws fewer and coarser chunks, so there is a last one; almost always it is the first.
    while (settings.seams == SeamMode::Stitched && limitSeams(frame, out)) selectOnce(frame, out);

    std::sort(out.draw.begin(), out.draw.end(), [](const DrawItem& a, const DrawItem& b) {
        return a.distanceM != b.distanceM ? a.distanceM < b.distanceM : a.id < b.id;
    });
    std::sort(out.requests.begin(), out.requests.end(),
              [](const ChildrenRequest& a, const ChildrenRequest& b) {
                  return a.priority != b.priority ? a.priority > b.priority : a.parentId < b.parentId;
              });
    out.counters.drawn = static_cast<std::uint32_t>(out.draw.size());
}

}  // namespace planet
