#include "planet/lod_select.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

namespace planet {

namespace {

// What every node of one frame is compared with.
struct Frame {
    const ChunkTree& tree;
    const LodSettings& settings;
    glm::dvec3 eyeM;
    Frustum frustum;
    Horizon horizon;
    double scalePx;  // K'
    double reach;    // K = K' / tau: d_m is delta_c times this
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

void draw(const Frame& frame, NodeIndex index, double nodeDistanceM, Selection& out) {
    const ChunkNode& node = frame.tree.nodes[index];
    DrawItem item;
    item.node = index;
    item.id = node.id;
    item.slot = node.slot;
    item.epsPx = static_cast<float>(node.deltaCM * frame.scalePx / nodeDistanceM);
    item.distanceM = static_cast<float>(nodeDistanceM);
    item.deltaCM = node.deltaCM;
    out.draw.push_back(item);
    out.counters.deepestLevel = std::max<std::uint32_t>(out.counters.deepestLevel, node.id.level);
    out.counters.worstEpsPx = std::max(out.counters.worstEpsPx, item.epsPx);
}

void visit(const Frame& frame, NodeIndex index, OpenTests open, Selection& out) {
    const ChunkNode& node = frame.tree.nodes[index];
    ++out.counters.visited;
    out.touched.push_back(index);
    const Culled culled = cull(frame, node, open);
    if (culled != Culled::No) {
        ++(culled == Culled::ByFrustum ? out.counters.culledFrustum : out.counters.culledHorizon);
        return;
    }
    const double nodeDistanceM = std::max(distanceM(node.bounds.box, frame.eyeM), nearestM);
    const bool goodEnough = node.deltaCM * frame.reach <= nodeDistanceM;
    const bool mayBeSplit =
        node.childrenState != ChildrenState::None && node.id.level < frame.settings.maxLevel;
    if (goodEnough || !mayBeSplit) return draw(frame, index, nodeDistanceM, out);
    const ChildrenRequest wanted{index, node.id,
                                 static_cast<float>(node.deltaCM * frame.reach / nodeDistanceM)};
    if (node.childrenState == ChildrenState::Resident) {
        out.splits.push_back(wanted);
        for (NodeIndex q = 0; q < quadrantCount; ++q) visit(frame, node.firstChild + q, open, out);
        return;
    }
    draw(frame, index, nodeDistanceM, out);
    ++out.counters.waiting;
    if (node.childrenState != ChildrenState::Failed) out.requests.push_back(wanted);
}

// Finds a drawn chunk by its id: open addressing, at most half full. Never made of no chunks at all.
class DrawnTable {
public:
    explicit DrawnTable(const std::vector<DrawItem>& items)
        : entries_(std::bit_ceil(items.size() * 2)), shift_(64 - std::countr_zero(entries_.size())) {
        for (std::uint32_t i = 0; i < items.size(); ++i) {
            const std::uint64_t key = keyOf(items[i].id);
            entries_[placeOf(key)] = {key, i};
        }
    }

    // Where the chunk is in the draw list, or nothing.
    const std::uint32_t* find(const ChunkId& id) const {
        const Entry& entry = entries_[placeOf(keyOf(id))];
        return entry.key == noKey ? nullptr : &entry.item;
    }

private:
    static constexpr std::uint64_t noKey = ~std::uint64_t{0};
    struct Entry {
        std::uint64_t key = noKey;
        std::uint32_t item = 0;
    };

    // Of the key, or of the empty place where it would go.
    std::size_t placeOf(std::uint64_t key) const {
        auto place = static_cast<std::size_t>((key * 0x9E3779B97F4A7C15u) >> shift_);
        while (entries_[place].key != noKey && entries_[place].key != key) {
            place = (place + 1) & (entries_.size() - 1);
        }
        return place;
    }

    std::vector<Entry> entries_;
    int shift_;
};

// The drawn chunk beyond an edge, of the same level or the first coarser one; finer ones find this chunk
// themselves.
const std::uint32_t* drawnNeighbour(const DrawnTable& drawn, const ChunkId& id, Edge edge,
                                    int coarsestLevel) {
    ChunkId other = neighbourOf(id, edge);
    const std::uint32_t* found = drawn.find(other);
    while (!found && other.level > coarsestLevel) {
        other = parentOf(other);
        found = drawn.find(other);
    }
    return found;
}

// Both sides of an edge get a skirt that covers both errors, so whichever of the two lies higher there, its
// skirt reaches below the other.
void setSkirtDepths(const PlanetShape& shape, double skirtFactor, std::vector<DrawItem>& items) {
    if (skirtFactor == 0 || items.empty()) return;
    int coarsestLevel = maxLevel;
    for (DrawItem& item : items) {
        coarsestLevel = std::min<int>(coarsestLevel, item.id.level);
        // Edges that agree exactly still part by rounding, of heights and of pixels.
        item.skirtDepthM = std::max(static_cast<float>(2 * shape.quantumM), 1e-6f * item.distanceM);
    }
    const DrawnTable drawn(items);
    for (DrawItem& item : items) {
        for (int edge = 0; edge < edgeCount; ++edge) {
            const std::uint32_t* found =
                drawnNeighbour(drawn, item.id, static_cast<Edge>(edge), coarsestLevel);
            if (!found) continue;
            DrawItem& other = items[*found];
            const auto depth = static_cast<float>(skirtFactor * (item.deltaCM + other.deltaCM));
            item.skirtDepthM = std::max(item.skirtDepthM, depth);
            other.skirtDepthM = std::max(other.skirtDepthM, depth);
        }
    }
}

void clear(Selection& out) {
    out.draw.clear();
    out.requests.clear();
    out.splits.clear();
    out.touched.clear();
    out.counters = {};
}

}  // namespace

void selectChunks(const ChunkTree& tree, const View& lodView, const LodSettings& settings, Selection& out) {
    assert(settings.tauPx > 0 && settings.skirtFactor >= 0);
    clear(out);
    const double scalePx = screenScalePx(lodView);
    const Frame frame{tree,
                      settings,
                      lodView.eyeM,
                      frustumOf(lodView),
                      horizonOf(lodView.eyeM, tree.occluderRadiusM),
                      scalePx,
                      scalePx / settings.tauPx};
    OpenTests all{};
    all.planes.fill(settings.frustumCulling);
    all.horizon = settings.horizonCulling;
    for (NodeIndex root = 0; root < faceCount; ++root) visit(frame, root, all, out);

    // Before sorting, while neighbours lie close together in memory.
    setSkirtDepths(tree.shape, settings.skirtFactor, out.draw);
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
