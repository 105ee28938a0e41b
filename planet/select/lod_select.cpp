#include "planet/select/lod_select.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <unordered_set>

#include "planet/select/drawn_bound.h"
#include "planet/select/screen_error.h"
#include "planet/select/skirt_depth.h"
#include "planet/sphere/culling.h"
#include "planet/tree/chunk_table.h"

namespace planet {

namespace {

// The state of a chunk in the previous frame.
struct Shown {
    float morph = 0;
    std::array<float, edgeCount> edgeMorph{};
    std::array<bool, edgeCount> onCoarser{};  // stitched: the edge showed a coarser chunk's vertices
};

// The parts of the previous selection that this one uses.
struct Memory {
    std::optional<ChunkTable> splits;  // for hysteresis and fading
    std::optional<ChunkTable> drawn;   // for fading: the index of each chunk in `shown`
    std::vector<Shown> shown;
    float fadeStep = 0;  // largest change of a morph in this frame, [0, 1]

    bool fades() const { return drawn.has_value(); }
    bool wasSplit(const ChunkId& id) const { return splits && splits->contains(id); }
    // Returns null if the chunk was not drawn.
    const Shown* find(const ChunkId& id) const {
        const std::uint32_t* found = drawn ? drawn->find(id) : nullptr;
        return found ? &shown[*found] : nullptr;
    }
};

// Values shared by all nodes of a frame.
struct Frame {
    const ChunkTree& tree;
    const LodSettings& settings;
    glm::dvec3 eyeM;
    Culling culling;
    double scalePx;     // K'
    double reach;       // K = K' / τ: d_m is δ times this
    double mergeReach;  // the same for split chunks: K' / (τ (1 - hysteresis))
    Memory before;
    std::unordered_set<NodeIndex> seamLimit;  // drawn although they could be split, for stitched seams
};

// Values that a node takes from its parent.
struct Above {
    double epsPx = 0;        // 0 for a root
    double deltaM = 0;       // by the metric, metres
    double tauFactor = 1;    // of its regions
    bool mustSplit = false;  // a region's least level demands the node, whatever the parent's error
    bool justSplit = false;  // drawn in the previous frame, so the node starts on its surface
    bool merging = false;    // it, or an ancestor, waits to replace its children
};

// A node in the view.
struct Seen {
    NodeIndex index = noNode;
    double deltaM = 0;  // by the metric, metres
    double distanceM = 0;
    double tauFactor = 1;  // of its regions
    RegionLimit limit = RegionLimit::None;
};

// Returns the natural morph: 1 if the parent is about to replace the chunk, 0 if it is far from that.
//
// The chunk must show its own surface when it is exchanged with its children, so it must not slide while its
// ε exceeds τ (1 - hysteresis). The parent's ε is at least δ(parent) / δ times the chunk's if the parent's
// box contains the chunk's; otherwise the ratio of the two ε is smaller. Without hysteresis, a ratio of 1
// leaves no range and needs none, because the two surfaces are equal. With hysteresis, a short range would
// itself be a pop, so at least a quarter of it is kept.
//
// Regions change nothing of this: a chunk's factor on τ is never less than its parent's, so δ / factor takes the place of
// δ. A parent that a least level splits is never about to replace its children.
double naturalMorph(const LodSettings& settings, const Above& above, const Seen& seen, double epsPx) {
    if (!settings.morph || above.epsPx == 0 || above.mustSplit) return 0;
    const double overTau = above.epsPx / (settings.tauPx * above.tauFactor);
    if (overTau <= 1) return 1;
    double range = settings.morphRange;
    if (epsPx > 0) {
        const double ratio =
            std::min(above.deltaM / seen.deltaM, above.epsPx / epsPx) * (seen.tauFactor / above.tauFactor);
        range = std::min(range, std::max(ratio * (1 - settings.hysteresis) - 1, (ratio - 1) / 4));
    }
    return range > 0 ? std::max(0.0, (1 + range - overTau) / range) : 0;
}

float faded(const Memory& before, float last, float target) {
    constexpr float rounding = 1e-6f;  // so that the sum of many steps ends exactly
    if (std::abs(target - last) <= before.fadeStep + rounding) return target;
    return target > last ? last + before.fadeStep : last - before.fadeStep;
}

// Moves a morph from its value in the previous frame towards its target. last: null if it was not drawn then.
float fadedMorph(const Memory& before, const ChunkId& id, const Shown* last, const Above& above,
                 float target) {
    if (!before.fades()) return target;
    if (above.justSplit) return 1;
    if (last) return faded(before, last->morph, target);
    return before.wasSplit(id) ? 0 : target;
}

// The visited nodes of a frame, by their places in Selection::touched.
struct Walk {
    explicit Walk(Selection& selection) : out(selection) {
        // The last frame says how many to expect.
        indexOf.reserve(out.touched.capacity());
        children.reserve(out.splits.capacity());
        placeOf.reserve(out.draw.capacity());
        shownBefore.reserve(out.draw.capacity());
        cellSpanM.reserve(out.draw.capacity());
    }

    Selection& out;
    std::array<std::uint32_t, faceCount> roots{};                    // their places
    std::vector<std::uint32_t> indexOf;                              // by place: in `draw` or in `splits`
    std::vector<std::array<std::uint32_t, quadrantCount>> children;  // by index in `splits`: their places
    std::vector<std::uint32_t> placeOf;                              // by index in `draw`
    std::vector<const Shown*> shownBefore;                           // by index in `draw`; null: not drawn
    std::vector<double> cellSpanM;                                   // by index in `draw`
};

void draw(const Frame& frame, const Seen& seen, const Above& above, bool splitWaits, std::uint32_t place,
          Walk& walk) {
    Selection& out = walk.out;
    const ChunkNode& node = frame.tree.nodes[seen.index];
    const double epsPx = seen.deltaM * frame.scalePx / seen.distanceM;
    const double natural = naturalMorph(frame.settings, above, seen, epsPx);
    const float target = above.merging ? 1 : splitWaits ? 0 : static_cast<float>(natural);
    DrawItem& item = out.draw.emplace_back();
    item.node = seen.index;
    item.id = node.id;
    item.slot = node.slot;
    item.epsPx = static_cast<float>(epsPx);
    item.parentEpsPx = static_cast<float>(above.epsPx);
    item.distanceM = static_cast<float>(seen.distanceM);
    item.deltaCM = static_cast<float>(seen.deltaM);
    item.parentDeltaM = static_cast<float>(above.deltaM);
    item.tauFactor = static_cast<float>(seen.tauFactor);
    item.limit = seen.limit;
    const Shown* const last = frame.before.find(node.id);
    item.morph = fadedMorph(frame.before, node.id, last, above, target);
    item.splitWaits = splitWaits;
    item.mergeWaits = above.merging;
    walk.indexOf[place] = static_cast<std::uint32_t>(out.draw.size() - 1);
    walk.placeOf.push_back(place);
    walk.shownBefore.push_back(last);
    walk.cellSpanM.push_back(cellSpanM(frame.tree.shape, node));
    out.counters.fading += item.morph != target || splitWaits || above.merging;
    out.counters.deepestLevel = std::max<std::uint32_t>(out.counters.deepestLevel, node.id.level);
    out.counters.worstEpsPx = std::max(out.counters.worstEpsPx, item.epsPx);
}

// Returns whether hysteresis keeps a node split. This applies only if the children are still resident;
// nothing is requested for it.
bool staysSplit(const Frame& frame, const ChunkNode& node, const Seen& seen) {
    return frame.settings.hysteresis > 0 && node.childrenState == ChildrenState::Resident &&
           seen.deltaM * frame.mergeReach > seen.distanceM * seen.tauFactor && frame.before.wasSplit(node.id);
}

// Returns whether the node should be drawn as its children.
bool wantsSplit(const Frame& frame, const Seen& seen, const Above& above) {
    const ChunkNode& node = frame.tree.nodes[seen.index];
    if (node.childrenState == ChildrenState::None || node.id.level >= frame.settings.maxLevel) return false;
    if (above.merging || (!frame.seamLimit.empty() && frame.seamLimit.contains(seen.index))) return false;
    if (seen.limit != RegionLimit::None) return seen.limit == RegionLimit::Least;
    return seen.deltaM * frame.reach > seen.distanceM * seen.tauFactor || staysSplit(frame, node, seen);
}

bool edgeShowed(const Memory& before, const ChunkId& id, const ChunkId& towards, float morph) {
    const Shown* shown = before.find(id);
    const std::optional<Edge> edge = shown ? edgeTowards(id, towards) : std::nullopt;
    return !edge || shown->edgeMorph[static_cast<std::size_t>(*edge)] == morph;
}

// Returns whether the chunks of the children's level beyond an edge show the same edge as the chunk.
bool finerNeighboursFit(const Memory& before, const ChunkId& id, Edge edge) {
    const ChunkId beyond = neighbourOf(id, edge);
    for (int q = 0; q < quadrantCount; ++q) {
        const ChunkId child = childOf(id, q);
        const ChunkId other = neighbourOf(child, edge);
        if (parentOf(other) == beyond && !edgeShowed(before, other, child, 1)) return false;
    }
    return true;
}

// Returns whether the split would be visible: the node does not yet show its own surface, or a finer
// neighbour does not yet show the same edge.
bool splitMustWait(const Memory& before, const ChunkId& id, const Above& above) {
    if (!before.fades()) return false;
    if (above.justSplit) return true;
    const Shown* shown = before.find(id);
    if (!shown) return false;
    if (shown->morph != 0) return true;
    return std::any_of(allEdges.begin(), allEdges.end(), [&](Edge edge) {
        const auto e = static_cast<std::size_t>(edge);
        return (shown->edgeMorph[e] != 0 && !shown->onCoarser[e]) || !finerNeighboursFit(before, id, edge);
    });
}

// Returns whether a chunk showed its parent's surface, including the edges, or was not drawn.
bool showedItsParent(const Memory& before, const ChunkId& id) {
    if (before.wasSplit(id)) return false;
    const Shown* shown = before.find(id);
    if (!shown) return true;
    if (shown->morph != 1) return false;
    for (std::size_t e = 0; e < edgeCount; ++e) {
        if (shown->edgeMorph[e] != 1 && !shown->onCoarser[e]) return false;
    }
    return true;
}

// Returns whether the merge of a node would be visible: its children do not yet show its surface, or a
// neighbour does not yet show the same edge. Culled children show nothing.
bool mergeMustWait(const Frame& frame, NodeIndex index) {
    const ChunkNode& node = frame.tree.nodes[index];
    const Memory& before = frame.before;
    if (!before.fades() || node.childrenState != ChildrenState::Resident || !before.wasSplit(node.id)) {
        return false;
    }
    if (!frame.seamLimit.empty() && frame.seamLimit.contains(index)) return false;
    for (int q = 0; q < quadrantCount; ++q) {
        if (!showedItsParent(before, childOf(node.id, q))) return true;
    }
    return std::any_of(allEdges.begin(), allEdges.end(), [&](Edge edge) {
        return !edgeShowed(before, neighbourOf(node.id, edge), node.id, 0);
    });
}

// Asks for what selection reads of nodes in sequence, which a large tree rarely has in the cache.
void prefetch(const ChunkNode* nodes, std::size_t count) {
    constexpr std::size_t lineBytes = 64;
    constexpr std::size_t readBytes = offsetof(ChunkNode, storedDeltaCM);
    for (std::size_t i = 0; i < count; ++i) {
        const auto* const bytes = reinterpret_cast<const char*>(nodes + i);
        for (std::size_t at = 0; at < readBytes; at += lineBytes) __builtin_prefetch(bytes + at);
    }
}

float priorityOf(const Frame& frame, const Seen& seen) {
    if (seen.limit == RegionLimit::Most) return 0;
    const auto overTau = static_cast<float>(seen.deltaM * frame.reach / (seen.distanceM * seen.tauFactor));
    return seen.limit == RegionLimit::Least ? std::max(overTau, leastLevelPriority) : overTau;
}

void visit(const Frame& frame, NodeIndex index, OpenTests open, const Above& above, Walk& walk) {
    const ChunkNode& node = frame.tree.nodes[index];
    Selection& out = walk.out;
    ++out.counters.visited;
    const auto place = static_cast<std::uint32_t>(out.touched.size());
    out.touched.push_back({index, NodeFate::Drawn});
    walk.indexOf.push_back(0);
    const Culled culled = cull(frame.culling, node.bounds, open);
    if (culled != Culled::No) {
        out.touched[place].fate =
            culled == Culled::ByFrustum ? NodeFate::CulledFrustum : NodeFate::CulledHorizon;
        ++(culled == Culled::ByFrustum ? out.counters.culledFrustum : out.counters.culledHorizon);
        return;
    }
    const Seen seen{index, deltaOf(node, frame.settings.metric), distanceToM(node, frame.eyeM),
                    static_cast<double>(node.demand.tauFactor), limitOf(node)};
    const bool wantsToSplit = wantsSplit(frame, seen, above);
    const bool merging = !wantsToSplit && mergeMustWait(frame, index);
    if (!wantsToSplit && !merging) return draw(frame, seen, above, false, place, walk);
    const ChildrenRequest wanted{index, node.id, priorityOf(frame, seen), seen.limit == RegionLimit::Least};
    if (node.childrenState != ChildrenState::Resident) {
        draw(frame, seen, above, false, place, walk);
        ++out.counters.waiting;
        if (node.childrenState != ChildrenState::Failed) out.requests.push_back(wanted);
        return;
    }
    if (!merging && splitMustWait(frame.before, node.id, above))
        return draw(frame, seen, above, true, place, walk);
    out.touched[place].fate = NodeFate::Split;
    prefetch(&frame.tree.nodes[node.firstChild], quadrantCount);
    const std::size_t split = out.splits.size();
    walk.indexOf[place] = static_cast<std::uint32_t>(split);
    walk.children.emplace_back();
    out.splits.push_back(wanted);
    const Above here{seen.deltaM * frame.scalePx / seen.distanceM,
                     seen.deltaM,
                     seen.tauFactor,
                     seen.limit == RegionLimit::Least,
                     frame.before.find(node.id) != nullptr,
                     merging};
    for (NodeIndex q = 0; q < quadrantCount; ++q) {
        walk.children[split][q] = static_cast<std::uint32_t>(out.touched.size());
        visit(frame, node.firstChild + q, open, here, walk);
    }
}

// The places of the visited nodes beyond the edges of a node: of its level, or coarser if that one was not split.
using PlacesBeside = std::array<std::uint32_t, edgeCount>;

// The face beyond an edge of another face. `quadrants` maps each quadrant at that edge to the one that touches it from the
// other side. The children of any two neighbours across the edge meet in the same way.
struct FaceBeyond {
    Face face = Face::PosX;
    std::array<std::uint8_t, quadrantCount> quadrants{};
};
using FaceNeighbours = std::array<std::array<FaceBeyond, edgeCount>, faceCount>;

FaceNeighbours findFaceNeighbours() {
    FaceNeighbours neighbours{};
    for (const Face face : allFaces) {
        const ChunkId root{face, 0, 0, 0};
        for (const Edge edge : allEdges) {
            FaceBeyond& beyond = neighbours[static_cast<std::size_t>(face)][static_cast<std::size_t>(edge)];
            beyond.face = neighbourOf(root, edge).face;
            for (int q = 0; q < quadrantCount; ++q)
                beyond.quadrants[static_cast<std::size_t>(q)] =
                    static_cast<std::uint8_t>(quadrantOf(neighbourOf(childOf(root, q), edge)));
        }
    }
    return neighbours;
}

// Finds the neighbours of all visited nodes, parents first, from those of their parents. This takes no search in the
// tree, and no hashing.
std::vector<PlacesBeside> placesBeside(const Walk& walk) {
    static const FaceNeighbours faceNeighbours = findFaceNeighbours();
    const std::vector<VisitedNode>& touched = walk.out.touched;
    std::vector<PlacesBeside> beside(touched.size());
    for (const Face face : allFaces) {
        const auto f = static_cast<std::size_t>(face);
        const std::uint32_t begin = walk.roots[f];
        const std::uint32_t end =
            f + 1 < faceCount ? walk.roots[f + 1] : static_cast<std::uint32_t>(touched.size());
        const std::array<FaceBeyond, edgeCount>& facesBeyond = faceNeighbours[f];
        for (std::size_t e = 0; e < edgeCount; ++e)
            beside[begin][e] = walk.roots[static_cast<std::size_t>(facesBeyond[e].face)];
        for (std::uint32_t place = begin; place < end; ++place) {
            if (touched[place].fate != NodeFate::Split) continue;
            const std::array<std::uint32_t, quadrantCount>& children = walk.children[walk.indexOf[place]];
            for (std::size_t e = 0; e < edgeCount; ++e) {
                // Edges are in the order west, east, south, north, and quadrants count along u first.
                const std::size_t flipped = e < 2 ? 1 : 2;
                const bool isHighEdge = e % 2 == 1;
                const std::uint32_t other = beside[place][e];
                const bool otherIsSplit = touched[other].fate == NodeFate::Split;
                const bool isOnFace = begin <= other && other < end;
                for (std::size_t q = 0; q < quadrantCount; ++q) {
                    const bool isAtEdge = ((q & flipped) != 0) == isHighEdge;
                    std::uint32_t& found = beside[children[q]][e];
                    if (!isAtEdge) {
                        found = children[q ^ flipped];
                    } else if (!otherIsSplit) {
                        found = other;
                    } else {
                        const std::size_t beyond = isOnFace ? q ^ flipped : facesBeyond[e].quadrants[q];
                        found = walk.children[walk.indexOf[other]][beyond];
                    }
                }
            }
        }
    }
    return beside;
}

// The neighbour beyond an edge of a drawn chunk.
struct Beyond {
    static constexpr std::uint32_t nothing = noNeighbour;
    std::uint32_t item = nothing;  // the drawn chunk there, of the same level or coarser
    Edge back = Edge::West;        // of a coarser chunk: its edge that both share
    bool finer = false;            // finer chunks are drawn there
};

// Finds the neighbours of the drawn chunks, and sets the morphs, stitches and skirts of their edges.
class EdgeJoiner {
public:
    EdgeJoiner(const Frame& frame, const Walk& walk)
        : frame_(frame),
          settings_(frame.settings),
          fades_(settings_.morph && settings_.fadeS > 0),
          walk_(walk),
          out_(walk.out),
          beyond_(out_.draw.size()),
          starts_(out_.draw.size()) {}

    void join() {
        findNeighbours();
        fillEdgeMorphs();
        if (settings_.seams == SeamMode::Stitched) takeCoarserEdges();
        if (settings_.seams == SeamMode::Skirts) fillSkirts();
        fillBounds();
    }

private:
    // The morphs from which a drawn chunk's edges start.
    struct Start {
        bool known = false;
        bool switched = false;    // drawn since this frame, replacing its children or its parent
        bool mergesNext = false;  // only its and its siblings' sliding delays the merge
        std::array<float, edgeCount> edgeMorph{};
    };

    Start startOf(const DrawItem& item, const Shown* last) const {
        Start start;
        const Memory& before = frame_.before;
        if (!before.fades()) return start;
        start.known = start.switched = true;
        if (last) {
            start.edgeMorph = last->edgeMorph;
            start.switched = false;
        } else if (!before.wasSplit(item.id)) {
            if (item.id.level > 0 && before.find(parentOf(item.id))) {
                start.edgeMorph.fill(1);
            } else {
                start.known = start.switched = false;
            }
        }
        start.mergesNext = item.mergeWaits;
        for (int q = 0; start.mergesNext && q < quadrantCount; ++q) {
            start.mergesNext = !before.wasSplit(childOf(parentOf(item.id), q));
        }
        return start;
    }

    void findNeighbours() {
        const std::vector<DrawItem>& draw = out_.draw;
        const std::vector<PlacesBeside> beside = placesBeside(walk_);
        for (std::uint32_t i = 0; i < draw.size(); ++i) {
            starts_[i] = startOf(draw[i], walk_.shownBefore[i]);
            for (std::size_t e = 0; e < edgeCount; ++e) {
                // Finds neighbours of the same level or coarser; finer neighbours find this chunk themselves.
                const std::uint32_t place = beside[walk_.placeOf[i]][e];
                if (out_.touched[place].fate != NodeFate::Drawn) continue;
                beyond_[i][e].item = walk_.indexOf[place];
                if (draw[beyond_[i][e].item].id.level < draw[i].id.level) noteSeam(i, e);
            }
        }
    }

    void noteSeam(std::uint32_t finer, std::size_t edge) {
        DrawItem& item = out_.draw[finer];
        Beyond& beyond = beyond_[finer][edge];
        const ChunkId coarser = out_.draw[beyond.item].id;
        const auto levels = static_cast<std::uint8_t>(item.id.level - coarser.level);
        item.coarserBy[edge] = levels;
        out_.seams.push_back({item.id, coarser, allEdges[edge]});
        out_.counters.widestSeam = std::max<std::uint32_t>(out_.counters.widestSeam, levels);
        const std::optional<Edge> back = edgeTowards(coarser, ancestorOf(item.id, coarser.level));
        assert(back);
        beyond.back = *back;
        if (isSparse(frame_.tree)) {
            const NodeIndex beside = ancestorAt(frame_.tree, item.node, coarser.level);
            item.rimDeltaM[edge] = deltaOf(frame_.tree.nodes[beside], settings_.metric);
        }
        beyond_[beyond.item][static_cast<std::size_t>(*back)].finer = true;
    }

    // With fading, both sides show the coarser chunk's own edge if they differ by one level.
    float targetOf(std::uint32_t index, std::size_t edge) const {
        const DrawItem& item = out_.draw[index];
        const Beyond& beyond = beyond_[index][edge];
        const bool level = beyond.item != Beyond::nothing && item.coarserBy[edge] == 0;
        const float natural = level ? std::max(item.morph, out_.draw[beyond.item].morph) : item.morph;
        if (!fades_) return natural;
        if (starts_[index].mergesNext || (level && starts_[beyond.item].mergesNext)) return 1;
        if (item.splitWaits || (level && out_.draw[beyond.item].splitWaits)) return 0;
        if (item.coarserBy[edge] > 0) return 1;
        return beyond.finer ? 0 : natural;
    }

    float edgeMorphOf(std::uint32_t index, std::size_t edge) const {
        const float target = targetOf(index, edge);
        const Beyond& beyond = beyond_[index][edge];
        const Start& start = starts_[index];
        const bool level = beyond.item != Beyond::nothing && out_.draw[index].coarserBy[edge] == 0;
        if (!level) return !start.known ? target : startedAt(start, start.edgeMorph[edge], target);
        // Both sides must compute the same morph.
        const Start& other = starts_[beyond.item];
        if (start.switched && other.switched) return std::max(start.edgeMorph[0], other.edgeMorph[0]);
        if (start.switched) return start.edgeMorph[edge];
        if (other.switched) return other.edgeMorph[0];
        if (start.known) return startedAt(start, start.edgeMorph[edge], target);
        if (!other.known) return target;
        const std::optional<Edge> back = edgeTowards(out_.draw[beyond.item].id, out_.draw[index].id);
        assert(back);
        return startedAt(other, other.edgeMorph[static_cast<std::size_t>(*back)], target);
    }

    float startedAt(const Start& start, float last, float target) const {
        return start.switched ? last : faded(frame_.before, last, target);
    }

    void fillEdgeMorphs() {
        for (std::uint32_t i = 0; i < out_.draw.size(); ++i) {
            for (std::size_t e = 0; e < edgeCount; ++e) {
                const float morph = edgeMorphOf(i, e);
                out_.draw[i].edgeMorph[e] = morph;
                out_.counters.fading += fades_ && morph != targetOf(i, e);
            }
        }
    }

    void takeCoarserEdges() {
        for (std::uint32_t i = 0; i < out_.draw.size(); ++i) {
            for (std::size_t e = 0; e < edgeCount; ++e) {
                if (out_.draw[i].coarserBy[e] == 0) continue;
                const Beyond& beyond = beyond_[i][e];
                out_.draw[i].edgeMorph[e] =
                    out_.draw[beyond.item].edgeMorph[static_cast<std::size_t>(beyond.back)];
            }
        }
    }

    void fillSkirts() {
        std::vector<DrawItem>& draw = out_.draw;
        if (settings_.skirtDepth == SkirtDepth::Fixed) {
            for (DrawItem& item : draw) item.skirtDepthM = static_cast<float>(settings_.skirtDepthM);
            return;
        }
        std::vector<float> apartM(draw.size(), 0);
        for (std::uint32_t i = 0; i < draw.size(); ++i) {
            for (std::size_t e = 0; e < edgeCount; ++e) {
                const Beyond& beyond = beyond_[i][e];
                if (beyond.item == Beyond::nothing) continue;
                const float bothM = mostApartM(frame_.tree, settings_.metric, draw[i], allEdges[e],
                                               draw[beyond.item], beyond.back);
                apartM[i] = std::max(apartM[i], bothM);
                apartM[beyond.item] = std::max(apartM[beyond.item], bothM);
            }
        }
        for (std::uint32_t i = 0; i < draw.size(); ++i) {
            draw[i].skirtDepthM =
                automaticSkirtDepthM(frame_.tree, draw[i], apartM[i], settings_.skirtFactor);
        }
    }

    // Returns 0 if nothing slides, because the bound does not depend on the distance then.
    float nearestSampleOf(const DrawItem& item) const {
        const bool slides = item.morph > 0 || std::any_of(item.edgeMorph.begin(), item.edgeMorph.end(),
                                                          [](float morph) { return morph > 0; });
        return slides ? static_cast<float>(
                            nearestSampleM(frame_.tree.shape, frame_.tree.nodes[item.node], frame_.eyeM))
                      : 0.0f;
    }

    void fillBounds() {
        std::vector<DrawnNeighbours> neighbours(beyond_.size());
        for (std::size_t i = 0; i < beyond_.size(); ++i) {
            for (std::size_t e = 0; e < edgeCount; ++e) neighbours[i][e] = beyond_[i][e].item;
        }
        // Without morph, an item's bound is its ε.
        for (DrawItem& item : out_.draw)
            if (settings_.morph) item.nearestSampleM = nearestSampleOf(item);
        // The bound of the tight metric holds for a mixture of both too.
        const bool isMixed = frame_.tree.regions && frame_.tree.regions->choosesMetrics();
        fillDrawnBounds(out_.draw, neighbours, walk_.cellSpanM, frame_.scalePx,
                        isMixed ? ErrorMetric::Tight : settings_.metric,
                        settings_.seams == SeamMode::Stitched);
        for (const DrawItem& item : out_.draw)
            out_.counters.worstDrawnBoundPx = std::max(out_.counters.worstDrawnBoundPx, item.drawnBoundPx);
    }

    const Frame& frame_;
    const LodSettings& settings_;
    const bool fades_;
    const Walk& walk_;
    Selection& out_;
    std::vector<std::array<Beyond, edgeCount>> beyond_;  // by index in draw
    std::vector<Start> starts_;
};

// Finds the replacement of the finer chunk for each seam that is too wide to stitch: its finest ancestor that
// can be stitched to the coarser chunk. Every valid selection needs these replacements, because the coarser
// chunk can only become coarser. Returns false if there are none.
bool limitSeams(Frame& frame, const Selection& selection) {
    const int widest = frame.tree.shape.chunkCellsLog2 - 1;
    const std::size_t before = frame.seamLimit.size();
    for (const LevelSeam& seam : selection.seams) {
        if (seam.finer.level - seam.coarser.level <= widest) continue;
        frame.seamLimit.insert(findNode(frame.tree, ancestorOf(seam.finer, seam.coarser.level + widest)));
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
    Walk walk(out);
    const OpenTests all = openTests(frame.settings.frustumCulling, frame.settings.horizonCulling);
    for (NodeIndex root = 0; root < faceCount; ++root) {
        walk.roots[root] = static_cast<std::uint32_t>(out.touched.size());
        visit(frame, root, all, {}, walk);
    }
    // This runs before sorting, while neighbours lie close together in memory.
    EdgeJoiner(frame, walk).join();
}

// An item's place in the order near to far: the bits of its distance above its index in `draw`. The distance is not
// negative, so its bits are in the order of the distances.
using DistanceKey = std::uint64_t;

constexpr int indexBits = 32;

DistanceKey distanceKey(float distanceM, std::uint32_t index) {
    return DistanceKey{std::bit_cast<std::uint32_t>(distanceM)} << indexBits | index;
}

std::uint32_t indexOf(DistanceKey key) {
    return static_cast<std::uint32_t>(key);
}

// Sorts many keys one byte of the distances after the other (LSD radix sort), which takes no comparisons.
void sortKeys(std::vector<DistanceKey>& keys) {
    constexpr std::size_t few = 256;  // for which counting takes longer than comparing
    if (keys.size() < few) return std::sort(keys.begin(), keys.end());
    constexpr std::size_t bytes = 4, values = 256;
    const auto byteOf = [](DistanceKey key, std::size_t byte) {
        return static_cast<std::size_t>(key >> (indexBits + 8 * byte)) % values;
    };
    std::array<std::array<std::uint32_t, values>, bytes>
        next{};  // first counts, then where the next key goes
    for (const DistanceKey key : keys) {
        for (std::size_t byte = 0; byte < bytes; ++byte) ++next[byte][byteOf(key, byte)];
    }
    std::vector<DistanceKey> sorted(keys.size());
    for (std::size_t byte = 0; byte < bytes; ++byte) {
        if (next[byte][byteOf(keys[0], byte)] == keys.size()) continue;  // all are equal
        std::exclusive_scan(next[byte].begin(), next[byte].end(), next[byte].begin(), std::uint32_t{0});
        for (const DistanceKey key : keys) sorted[next[byte][byteOf(key, byte)]++] = key;
        keys.swap(sorted);
    }
}

// Sorts the items near to far, and those at the same distance by id. Items are large, so their order is found first, and
// then each is copied once.
void sortByDistance(std::vector<DrawItem>& draw) {
    std::vector<DistanceKey> keys(draw.size());
    for (std::uint32_t i = 0; i < draw.size(); ++i) keys[i] = distanceKey(draw[i].distanceM, i);
    sortKeys(keys);
    for (auto begin = keys.begin(); begin != keys.end();) {
        const DistanceKey beyond = (*begin >> indexBits) + 1;
        const auto end =
            std::find_if(begin + 1, keys.end(), [&](DistanceKey key) { return key >> indexBits >= beyond; });
        std::sort(begin, end,
                  [&](DistanceKey a, DistanceKey b) { return draw[indexOf(a)].id < draw[indexOf(b)].id; });
        begin = end;
    }
    std::vector<DrawItem> sorted;
    sorted.reserve(draw.capacity());  // the next frame needs about as much
    for (const DistanceKey key : keys) sorted.push_back(draw[indexOf(key)]);
    draw.swap(sorted);
}

void countTriangles(const ChunkTree& tree, Selection& out) {
    const auto cells = static_cast<std::uint64_t>(chunkCells(tree.shape));
    const auto chunks = static_cast<std::uint64_t>(out.draw.size());
    const bool skirts = std::any_of(out.draw.begin(), out.draw.end(),
                                    [](const DrawItem& item) { return item.skirtDepthM > 0; });
    out.counters.groundTriangles = chunks * 2 * cells * cells;
    out.counters.skirtTriangles = skirts ? chunks * edgeCount * 2 * cells : 0;
}

Memory memoryOf(const Selection& before, const LodSettings& settings, double elapsedS) {
    Memory memory;
    const bool fades =
        settings.morph && settings.fadeS > 0 && std::isfinite(elapsedS) && !before.draw.empty();
    if (settings.hysteresis > 0 || fades) {
        memory.splits.emplace(before.splits.size());
        for (const ChildrenRequest& split : before.splits) memory.splits->add(split.parentId, split.parent);
    }
    if (!fades) return memory;
    memory.fadeStep = static_cast<float>(std::min(1.0, elapsedS / settings.fadeS));
    memory.drawn.emplace(before.draw.size());
    memory.shown.reserve(before.draw.size());
    for (const DrawItem& item : before.draw) {
        memory.drawn->add(item.id, static_cast<std::uint32_t>(memory.shown.size()));
        Shown& shown = memory.shown.emplace_back(Shown{item.morph, item.edgeMorph, {}});
        for (std::size_t e = 0; settings.seams == SeamMode::Stitched && e < edgeCount; ++e) {
            shown.onCoarser[e] = item.coarserBy[e] > 0;
            if (shown.onCoarser[e]) shown.edgeMorph[e] = 1;  // equals its own edge at 1, at one level
        }
    }
    return memory;
}

}  // namespace

void selectChunks(const ChunkTree& tree, const View& lodView, const LodSettings& settings, Selection& out,
                  double elapsedS) {
    assert(settings.tauPx > 0 && settings.skirtFactor >= 0 && settings.skirtDepthM >= 0);
    assert(settings.hysteresis >= 0 && settings.hysteresis <= 0.9 && settings.morphRange > 0);
    assert(settings.fadeS >= 0 && elapsedS >= 0);
    const double scalePx = screenScalePx(lodView);
    Frame frame{tree,
                settings,
                lodView.eyeM,
                {frustumOf(lodView), horizonOf(lodView.eyeM, tree.occluderRadiusM)},
                scalePx,
                scalePx / settings.tauPx,
                scalePx / (settings.tauPx * (1 - settings.hysteresis)),
                memoryOf(out, settings, elapsedS),
                {}};
    selectOnce(frame, out);
    // Each round draws fewer and coarser chunks, so the loop ends, usually after the first round.
    while (settings.seams == SeamMode::Stitched && limitSeams(frame, out)) selectOnce(frame, out);

    sortByDistance(out.draw);
    std::sort(out.requests.begin(), out.requests.end(),
              [](const ChildrenRequest& a, const ChildrenRequest& b) {
                  return a.priority != b.priority ? a.priority > b.priority : a.parentId < b.parentId;
              });
    out.counters.drawn = static_cast<std::uint32_t>(out.draw.size());
    countTriangles(tree, out);
}

}  // namespace planet
