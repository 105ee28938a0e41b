// Explains why a chunk is drawn, not drawn, or not split. Pure functions over a planet's last step.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planet/planet.h"

namespace planet {

enum class ChunkState : std::uint8_t {
    Drawn,
    Split,          // its children or chunks below them are drawn in its place
    CulledFrustum,  // it, or a chunk above it, lies outside the view
    CulledHorizon,  // it, or a chunk above it, lies below the horizon
    Resident,       // loaded, but a chunk above it is drawn
    Requested,      // queued
    Loading,        // being read
    NotResident,    // in the file, not asked for
    Failed,         // could not be read; decidedByNotSplit says whether for good
    NotInFile,      // no such chunk: deeper than the leaves
};

enum class WhyNotSplit : std::uint8_t {
    IsSplit,
    NotDrawn,    // there is nothing to split
    GoodEnough,  // eps <= tau
    Leaf,
    LevelLimit,       // LodSettings::maxLevel
    WaitingForMorph,  // it must first slide back to its own surface
    SeamLimit,        // a neighbour would be too much coarser for stitched seams
    WaitingInQueue,   // for its children
    WaitingForRead,
    WaitingForBudget,
    WaitingForRetry,  // its children could not be read, and will be asked for again
    ChildrenFailed,   // for good
};

struct ChunkExplanation {
    ChunkId id;
    ChunkState state = ChunkState::NotResident;
    WhyNotSplit notSplit = WhyNotSplit::NotDrawn;
    // The chunk that the state comes from: itself, or the one above it that is drawn, culled, waited for,
    // could not be read or is a leaf.
    ChunkId decidedBy;
    // Why that chunk is not split, if it is drawn; or whether it waits in the queue or for its read.
    WhyNotSplit decidedByNotSplit = WhyNotSplit::NotDrawn;
    double decidedByEpsPx = 0;  // that one's; 0 where it is not resident
    NodeIndex node = noNode;    // the chunk's own, where it is resident
    // The following are known if the chunk is resident.
    float deltaGM = 0;  // metres; exact with resident children and heights as the file has them, else a bound
    bool deltaGIsBound = false;
    float deltaCM = 0;      // metres
    float deltaTightM = 0;  // metres, [0, deltaCM]
    double distanceM = 0;   // from the lod view's eye to its bounds
    double epsPx = 0;
    double switchDistanceM = 0;  // d_m: nearer than this it must be replaced by its children
    float morph = 0;
    bool mergeWaits =
        false;  // of a chunk that is split: no longer needed, but its children still slide onto it
    // The place in the queue, from 1, of the request that would load the chunk, the first missing one above
    // it, or else its children; nothing if there is no such request.
    std::optional<std::size_t> queuePlace;
    std::size_t queueLength = 0;
    double tauPx = 0;
    ErrorMetric metric = ErrorMetric::Additive;
};

// The results of a planet's last step.
struct StepFacts {
    const ChunkTree& tree;
    const Selection& selection;
    const View& lodView;
    const LodSettings& lod;
    std::span<const PagingRequest> pageIns;  // pending, the most urgent first
};
ChunkExplanation explainChunk(const StepFacts& facts, const ChunkId& id);

// Uses the queue of all views, because it decides when a chunk arrives.
ChunkExplanation explainChunk(const Planet& planet, const ChunkId& id, std::size_t view = 0);

// Returns the drawn neighbours of a chunk by edge, west to north, of any level, near to far.
std::array<std::vector<ChunkId>, edgeCount> drawnNeighbours(const Selection& selection, const ChunkId& id);

}  // namespace planet
