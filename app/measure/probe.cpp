#include "app/measure/probe.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace worldy {

namespace {

const planet::DrawItem* itemOf(const planet::Selection& selection, const planet::ChunkId& chunk) {
    const auto found = std::find_if(selection.draw.begin(), selection.draw.end(),
                                    [&](const planet::DrawItem& item) { return item.id == chunk; });
    return found == selection.draw.end() ? nullptr : &*found;
}

double highestRadiusM(const ProbeInput& input) {
    double highestM = 0;
    for (const planet::DrawItem& item : input.selection.draw)
        highestM = std::max(highestM, static_cast<double>(input.tree.nodes[item.node].maxHeightM));
    return input.tree.shape.radiusM + highestM;
}

DepthSteps depthSteps(const ProbeInput& input, const glm::dvec3& positionM) {
    using namespace planet::gl;
    const double radiusM = input.tree.shape.radiusM;
    DepthSteps steps;
    steps.reversedInUse = input.projection.reversedZ;
    steps.aheadM = -glm::dot(positionM - input.view.eyeM, input.view.back);
    const Projection reversed = steps.reversedInUse
                                    ? input.projection
                                    : reversedProjection(input.view, 0.1 * std::min(radiusM / 6.371e6, 1.0));
    const Projection fallback = steps.reversedInUse
                                    ? fallbackProjection(input.view, radiusM, highestRadiusM(input))
                                    : input.projection;
    const auto stepAt = [&](const Projection& projection) {
        if (steps.aheadM < projection.nearM) return std::numeric_limits<double>::infinity();
        return depthStepM(projection, steps.aheadM);
    };
    steps.reversedFloatM = stepAt(reversed);
    steps.fallbackM = stepAt(fallback);
    return steps;
}

}  // namespace

ProbedVertex probeHit(const ProbeInput& input, const planet::SurfaceHit& hit) {
    const planet::DrawItem& item = *itemOf(input.selection, hit.id);
    const planet::PlanetShape& shape = input.tree.shape;
    const planet::StepsView heights = *input.tree.nodes[item.node].heights;
    const glm::ivec2 vertex = planet::nearestVertex(shape, item, heights, input.stitched, hit.positionM);
    const planet::VertexPrecision precision =
        planet::vertexPrecision(shape, planet::vertexFrame(shape, input.view.eyeM), item, heights,
                                input.stitched, input.view, vertex);
    return {precision, depthSteps(input, precision.positionM)};
}

std::optional<ProbedVertex> probeWorst(const ProbeInput& input, const planet::ChunkId& chunk) {
    const planet::DrawItem* item = itemOf(input.selection, chunk);
    if (!item) return std::nullopt;
    const planet::PlanetShape& shape = input.tree.shape;
    const planet::VertexPrecision precision =
        planet::worstPrecision(shape, planet::vertexFrame(shape, input.view.eyeM), *item,
                               *input.tree.nodes[item->node].heights, input.stitched, input.view);
    return ProbedVertex{precision, depthSteps(input, precision.positionM)};
}

}  // namespace worldy
