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

// Returns a node's error bound by either metric, metres.
inline float deltaOf(const ChunkNode& node, ErrorMetric metric) {
    return metric == ErrorMetric::Tight ? node.deltaTightM : node.deltaCM;
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
