// The screen-space error of a chunk: ε = δ K' / D, with δ by the metric, K' = screenScalePx(), and D the
// distance from the eye to the chunk's bounds. Pure functions, any thread.
#pragma once

#include <algorithm>
#include <glm/vec3.hpp>

#include "planet/select/lod_types.h"
#include "planet/sphere/bounds.h"
#include "planet/tree/chunk_tree.h"

namespace planet {

// The smallest distance D, metres. It keeps the error of a chunk that contains the eye finite.
inline constexpr double nearestM = 1e-3;

// Returns a node's error bound, metres, by the metric that the settings choose, or the regions there.
inline float deltaOf(const ChunkNode& node, ErrorMetric set) {
    return metricBy(node.demand.metric, set) == ErrorMetric::Tight ? node.deltaTightM : node.deltaCM;
}

// Returns what the levels of the regions there do to a node.
inline RegionLimit limitOf(const ChunkNode& node) {
    if (node.id.level < node.demand.leastLevel) return RegionLimit::Least;
    return node.id.level >= node.demand.mostLevel ? RegionLimit::Most : RegionLimit::None;
}

// Returns whether a drawn chunk is too coarse for the settings and the regions there, so that its children are wanted if
// it has any.
inline bool isTooCoarse(const DrawItem& item, const LodSettings& settings) {
    if (item.id.level >= settings.maxLevel || item.limit == RegionLimit::Most) return false;
    return item.limit == RegionLimit::Least ||
           static_cast<double>(item.epsPx) > settings.tauPx * static_cast<double>(item.tauFactor);
}

// Returns the distance from an eye to a node's bounds, metres, at least nearestM.
inline double distanceToM(const ChunkNode& node, const glm::dvec3& eyeM) {
    return std::max(distanceM(node.bounds.box, eyeM), nearestM);
}

// Returns a node's error on the screen, pixels.
inline double epsPxOf(const ChunkNode& node, const glm::dvec3& eyeM, double screenScalePx,
                      ErrorMetric metric) {
    return deltaOf(node, metric) * screenScalePx / distanceToM(node, eyeM);
}

}  // namespace planet
