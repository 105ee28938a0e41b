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
    Split,          // its children or their descendants are drawn instead
    CulledFrustum,  // it, or an ancestor, lies outside the frustum
    CulledHorizon,  // it, or an ancestor, lies below the horizon
    Resident,       // loaded, but an ancestor is drawn
    Requested,      // queued
    Loading,        // being read
    NotResident,    // in the file, not requested
    Failed,         // could not be read; decidedByNotSplit says whether permanently
    NotInFile,      // no such chunk: an ancestor is a leaf
};

enum class WhyNotSplit : std::uint8_t {
    IsSplit,
    NotDrawn,     // there is nothing to split
    GoodEnough,   // ε <= τ times the factor of the regions there
    SourceLimit,  // a leaf above the deepest level: no source is finer here
    Leaf,
    LevelLimit,       // LodSettings::maxLevel
    RegionLimit,      // the largest level of a region
    WaitingForMorph,  // it must first slide back to its own surface
    SeamLimit,        // a neighbour would be too coarse for stitched seams
    WaitingInQueue,   // its children are queued
    WaitingForRead,
    WaitingForBudget,
    WaitingForRetry,  // its children could not be read, and will be requested again
    ChildrenFailed,   // permanently
};

struct ChunkExplanation {
    ChunkId id;
    ChunkState state = ChunkState::NotResident;
    WhyNotSplit notSplit = WhyNotSplit::NotDrawn;
    // The chunk that determines the state: this one, or the ancestor that is drawn, culled, waited for,
    // unreadable or a leaf.
    ChunkId decidedBy;
    // Why decidedBy is not split, if it is drawn; or whether it waits in the queue or for its read.
    WhyNotSplit decidedByNotSplit = WhyNotSplit::NotDrawn;
    double decidedByEpsPx = 0;  // of decidedBy; 0 if it is not resident
    double decidedByTauPx = 0;  // τ times the factor there
    NodeIndex node = noNode;    // of this chunk, if it is resident
    // The following members are valid if the chunk is resident.
    float deltaGM = 0;  // metres; exact with resident children and unexaggerated heights, else a bound
    bool deltaGIsBound = false;
    float deltaCM = 0;      // metres
    float deltaTightM = 0;  // metres, [0, deltaCM]
    double distanceM = 0;   // from the LOD view's eye to its bounds
    double epsPx = 0;
    double switchDistanceM = 0;  // d_m: at a smaller distance its children must replace it
    ChunkDemand demand;          // of the regions; tauPx times its factor is the tolerance here
    float morph = 0;
    bool mergeWaits =
        false;  // the chunk is split and no longer needs it, but its children still slide onto it
    // The position in the queue, from 1, of the request that would load the chunk, its coarsest missing
    // ancestor, or else its children; nothing if there is no such request.
    std::optional<std::size_t> queuePlace;
    std::size_t queueLength = 0;
    double tauPx = 0;                            // of the settings
    ErrorMetric metric = ErrorMetric::Additive;  // of this chunk, or of the settings if it is not resident
    // The regions that touch this chunk, or else decidedBy if only that is resident, and what they do there.
    std::vector<RegionEffect> regions;

    double regionTauPx() const { return tauPx * static_cast<double>(demand.tauFactor); }
};

// The results of a planet's last step.
struct StepFacts {
    const ChunkTree& tree;
    const Selection& selection;
    const View& lodView;
    const LodSettings& lod;
    std::span<const PagingRequest> pageIns;  // pending, most urgent first
};
ChunkExplanation explainChunk(const StepFacts& facts, const ChunkId& id);

// Explains a chunk in one view. The queue is that of all views, because it decides when a chunk arrives.
ChunkExplanation explainChunk(const Planet& planet, const ChunkId& id, std::size_t view = 0);

// Returns the drawn neighbours of a chunk by edge, west to north, of any level, near to far.
std::array<std::vector<ChunkId>, edgeCount> drawnNeighbours(const Selection& selection, const ChunkId& id);

}  // namespace planet
