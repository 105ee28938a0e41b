// What a Planet does about blocks that could not be read.
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planet/planet.h"
#include "planet/planet_state.h"

namespace planet {

namespace {

// Whoever never asks for them must not pay for them.
constexpr std::size_t mostProblemsKept = 1000;

}  // namespace

void PlanetState::tell(std::string problem) {
    if (problems.size() < mostProblemsKept) problems.push_back(std::move(problem));
}

std::optional<double> PlanetState::untilRetryS() const {
    std::optional<double> first;
    for (const BlockFailures* known : {&failures, &colours.failures, &normals.failures}) {
        const std::optional<double> atS = known->nextRetryS();
        if (atS) first = std::min(first.value_or(*atS), *atS);
    }
    if (first) *first = std::max(*first - sinceAnewS, 0.0);
    return first;
}

void PlanetState::retryAll() {
    failures.clear();
    for (ChunkNode& node : tree.nodes) {
        if (node.childrenState == ChildrenState::Failed || node.childrenState == ChildrenState::AwaitingRetry)
            changeState(node.childrenState, ChildrenState::Absent);
    }
    colours.retryAll();
    normals.retryAll();
}

void PlanetState::retryOne(const BlockId& block) {
    if (block.kind != BlockKind::Heights) return tilesOf(block.kind).retryOne(block.parent);
    failures.forget(block.parent);
    const NodeIndex node = findNode(tree, block.parent);
    if (node == noNode) return;
    ChildrenState& state = tree.nodes[node].childrenState;
    if (state == ChildrenState::Failed || state == ChildrenState::AwaitingRetry)
        changeState(state, ChildrenState::Absent);
}

void PlanetState::forgetFailures() {
    failures.clear();
    colours.failures.clear();
    normals.failures.clear();
}

std::vector<FailedBlock> Planet::failedBlocks() const {
    std::vector<FailedBlock> all;
    state_->failures.appendTo(all, BlockKind::Heights, state_->sinceAnewS);
    state_->colours.failures.appendTo(all, BlockKind::Colours, state_->sinceAnewS);
    state_->normals.failures.appendTo(all, BlockKind::Normals, state_->sinceAnewS);
    return all;
}

void Planet::retryFailed() {
    PlanetState& state = *state_;
    state.changed = true;
    state.retryAll();
    if (state.normals.isOn() && state.deriveNormalRoots()) beginNormalsAnew();
    state.count();
}

void Planet::retryFailed(const BlockId& block) {
    state_->changed = true;
    state_->retryOne(block);
    state_->count();
}

}  // namespace planet
