#include "planet/chunk_explanation.h"

#include <algorithm>
#include <cassert>

#include "planet/select/screen_error.h"

namespace planet {

namespace {

// The node of a chunk or of an ancestor, and its fate in the last selection, if it was visited.
struct PathNode {
    NodeIndex node = noNode;
    std::optional<NodeFate> fate;
};

// Returns the resident nodes from the root down to the chunk.
std::vector<PathNode> pathTo(const ChunkTree& tree, const Selection& selection, const ChunkId& id) {
    std::vector<PathNode> path = {{static_cast<NodeIndex>(id.face), std::nullopt}};
    for (int level = 1; level <= id.level; ++level) {
        const ChunkNode& above = tree.nodes[path.back().node];
        if (above.childrenState != ChildrenState::Resident) break;
        const auto quadrant = static_cast<NodeIndex>(quadrantOf(ancestorOf(id, level)));
        path.push_back({above.firstChild + quadrant, std::nullopt});
    }
    std::size_t next = 0;
    for (const VisitedNode& visited : selection.touched) {  // parents first
        if (visited.node != path[next].node) continue;
        path[next].fate = visited.fate;
        if (++next == path.size()) break;
    }
    return path;
}

class Explainer {
public:
    Explainer(const StepFacts& facts, const ChunkId& id)
        : facts_(facts), id_(id), path_(pathTo(facts.tree, facts.selection, id)) {
        scalePx_ = screenScalePx(facts.lodView);
        out_.id = id;
        out_.decidedBy = id;
        out_.queueLength = facts.pageIns.size();
        out_.tauPx = facts.lod.tauPx;
        out_.metric = facts.lod.metric;
    }

    ChunkExplanation explain() {
        if (path_.size() == id_.level + 1u) {
            fillMeasures();
            explainByFate(ChunkState::Resident);
        } else if (deepest().childrenState == ChildrenState::None) {
            out_.state = ChunkState::NotInFile;
            out_.decidedBy = deepest().id;
        } else if (id_.level > deepestLevelOf(facts_.tree.shape)) {
            out_.state = ChunkState::NotInFile;
            out_.decidedBy = ancestorOf(id_, deepestLevelOf(facts_.tree.shape));
        } else {
            explainMissing();
        }
        if (const NodeIndex node = findNode(facts_.tree, out_.decidedBy); node != noNode) {
            out_.decidedByEpsPx = epsPx(facts_.tree.nodes[node]);
            out_.decidedByTauPx = tauPx(facts_.tree.nodes[node]);
            out_.regions = regionEffects(facts_.tree, out_.node == noNode ? node : out_.node);
        }
        return out_;
    }

private:
    const ChunkNode& deepest() const { return facts_.tree.nodes[path_.back().node]; }

    double distanceOf(const ChunkNode& node) const { return distanceToM(node, facts_.lodView.eyeM); }
    double epsPx(const ChunkNode& node) const {
        return epsPxOf(node, facts_.lodView.eyeM, scalePx_, facts_.lod.metric);
    }
    double tauPx(const ChunkNode& node) const {
        return facts_.lod.tauPx * static_cast<double>(node.demand.tauFactor);
    }
    // Returns d_m times the factor of the regions, computed as in selection, so that both agree bit for bit.
    double reachM(const ChunkNode& node) const {
        return deltaOf(node, facts_.lod.metric) * (scalePx_ / facts_.lod.tauPx);
    }
    double switchDistanceM(const ChunkNode& node) const {
        return reachM(node) / static_cast<double>(node.demand.tauFactor);
    }
    bool isWithinTau(const ChunkNode& node) const {
        return reachM(node) <= distanceOf(node) * static_cast<double>(node.demand.tauFactor);
    }

    std::optional<std::size_t> placeInQueue(const ChunkId& parent) const {
        const auto found =
            std::find_if(facts_.pageIns.begin(), facts_.pageIns.end(),
                         [&](const PagingRequest& request) { return request.parent == parent; });
        if (found == facts_.pageIns.end()) return std::nullopt;
        return static_cast<std::size_t>(found - facts_.pageIns.begin()) + 1;
    }

    // Returns the first chunk from the root down that was not split, and so is drawn or culled; null if all
    // are split, or if nothing has been selected yet.
    const PathNode* decider() const {
        const auto found = std::find_if(path_.begin(), path_.end(),
                                        [](const PathNode& node) { return node.fate != NodeFate::Split; });
        return found == path_.end() || !found->fate ? nullptr : &*found;
    }

    void fillMeasures() {
        const ChunkNode& node = deepest();
        out_.node = path_.back().node;
        out_.deltaCM = node.deltaCM;
        out_.deltaTightM = node.deltaTightM;
        out_.distanceM = distanceOf(node);
        out_.epsPx = epsPx(node);
        out_.switchDistanceM = switchDistanceM(node);
        out_.demand = node.demand;
        out_.metric = metricBy(node.demand.metric, facts_.lod.metric);
        out_.queuePlace = placeInQueue(id_);
        float below = 0;
        const bool childrenKnown = node.childrenState == ChildrenState::Resident;
        for (NodeIndex q = 0; childrenKnown && q < quadrantCount; ++q) {
            below = std::max(below, facts_.tree.nodes[node.firstChild + q].deltaCM);
        }
        out_.deltaGM = node.deltaCM - below;
        out_.deltaGIsBound =
            (!childrenKnown && node.childrenState != ChildrenState::None) || facts_.tree.exaggeration != 1;
        for (const DrawItem& item : facts_.selection.draw) {
            if (item.id == id_) out_.morph = item.morph;
        }
    }

    bool splitWaits(const ChunkNode& node) const {
        const std::vector<DrawItem>& draw = facts_.selection.draw;
        return std::any_of(draw.begin(), draw.end(),
                           [&](const DrawItem& item) { return item.splitWaits && item.id == node.id; });
    }

    // Returns whether the merge of a split chunk waits.
    bool mergeWaits(const ChunkNode& node) const {
        if (limitOf(node) == RegionLimit::Least && node.id.level < facts_.lod.maxLevel) return false;
        const double keptWithinM = switchDistanceM(node) / (1 - facts_.lod.hysteresis);
        return limitOf(node) == RegionLimit::Most || node.id.level >= facts_.lod.maxLevel ||
               keptWithinM <= distanceOf(node);
    }

    // Returns why a drawn chunk is not split.
    WhyNotSplit whyNotSplit(const ChunkNode& node) const {
        const bool isLeaf = node.childrenState == ChildrenState::None;
        if (isLeaf && node.id.level < deepestLevelOf(facts_.tree.shape)) return WhyNotSplit::SourceLimit;
        if (limitOf(node) != RegionLimit::Least && isWithinTau(node)) return WhyNotSplit::GoodEnough;
        if (isLeaf) return WhyNotSplit::Leaf;
        if (node.id.level >= facts_.lod.maxLevel) return WhyNotSplit::LevelLimit;
        if (limitOf(node) == RegionLimit::Most) return WhyNotSplit::RegionLimit;
        switch (node.childrenState) {
            case ChildrenState::Resident:
                return splitWaits(node) ? WhyNotSplit::WaitingForMorph : WhyNotSplit::SeamLimit;
            case ChildrenState::AwaitingRetry:
                return WhyNotSplit::WaitingForRetry;
            case ChildrenState::Failed:
                return WhyNotSplit::ChildrenFailed;
            case ChildrenState::Requested:
                return placeInQueue(node.id) ? WhyNotSplit::WaitingInQueue : WhyNotSplit::WaitingForRead;
            default:
                break;
        }
        return WhyNotSplit::WaitingForBudget;
    }

    // Explains a chunk by the selection: it is drawn or split, or an ancestor is drawn or culled. A chunk
    // that is not resident or was not visited keeps the given state.
    void explainByFate(ChunkState under) {
        out_.state = under;
        const PathNode* by = decider();
        if (!by) {
            if (out_.node == noNode || path_.back().fate != NodeFate::Split) return;
            out_.state = ChunkState::Split;
            out_.mergeWaits = mergeWaits(deepest());
            out_.notSplit = out_.decidedByNotSplit = WhyNotSplit::IsSplit;
            return;
        }
        const ChunkNode& node = facts_.tree.nodes[by->node];
        out_.decidedBy = node.id;
        if (by->fate == NodeFate::CulledFrustum) out_.state = ChunkState::CulledFrustum;
        if (by->fate == NodeFate::CulledHorizon) out_.state = ChunkState::CulledHorizon;
        if (by->fate != NodeFate::Drawn) return;
        out_.decidedByNotSplit = whyNotSplit(node);
        if (node.id != id_) return;
        out_.state = ChunkState::Drawn;
        out_.notSplit = out_.decidedByNotSplit;
    }

    // Explains a chunk that is in the file and not resident, by the block under the deepest resident chunk.
    void explainMissing() {
        const ChunkNode& above = deepest();
        const ChunkId next = ancestorOf(id_, above.id.level + 1);
        out_.queuePlace = placeInQueue(above.id);
        const bool awaitsRetry = above.childrenState == ChildrenState::AwaitingRetry;
        if (awaitsRetry || above.childrenState == ChildrenState::Failed) {
            out_.state = ChunkState::Failed;
            out_.decidedBy = next;
            out_.decidedByNotSplit = awaitsRetry ? WhyNotSplit::WaitingForRetry : WhyNotSplit::ChildrenFailed;
        } else if (above.childrenState == ChildrenState::Requested) {
            const bool queued = out_.queuePlace.has_value();
            out_.state = queued ? ChunkState::Requested : ChunkState::Loading;
            if (next != id_) out_.state = ChunkState::NotResident;
            out_.decidedBy = next;
            out_.decidedByNotSplit = queued ? WhyNotSplit::WaitingInQueue : WhyNotSplit::WaitingForRead;
        } else {
            explainByFate(ChunkState::NotResident);
        }
    }

    const StepFacts& facts_;
    const ChunkId id_;
    const std::vector<PathNode> path_;
    double scalePx_ = 0;
    ChunkExplanation out_;
};

}  // namespace

ChunkExplanation explainChunk(const StepFacts& facts, const ChunkId& id) {
    assert(id.level <= maxLevel && (id.x >> id.level) == 0 && (id.y >> id.level) == 0);
    return Explainer(facts, id).explain();
}

std::array<std::vector<ChunkId>, edgeCount> drawnNeighbours(const Selection& selection, const ChunkId& id) {
    std::array<ChunkId, edgeCount> beyond;
    for (std::size_t e = 0; e < edgeCount; ++e) beyond[e] = neighbourOf(id, static_cast<Edge>(e));
    std::array<std::vector<ChunkId>, edgeCount> beside;
    for (const DrawItem& item : selection.draw) {
        const ChunkId& other = item.id;
        for (std::size_t e = 0; e < edgeCount; ++e) {
            if (other.level <= id.level) {
                if (ancestorOf(beyond[e], other.level) == other) beside[e].push_back(other);
                continue;
            }
            if (ancestorOf(other, id.level) != beyond[e]) continue;
            for (int back = 0; back < edgeCount; ++back) {
                if (ancestorOf(neighbourOf(other, static_cast<Edge>(back)), id.level) != id) continue;
                beside[e].push_back(other);
                break;
            }
        }
    }
    return beside;
}

}  // namespace planet
