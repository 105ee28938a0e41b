#include "planet/measure/precision_probe.h"

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>
#include <limits>

namespace planet {

namespace {

// Mirrors the shader's positionOf in floats, except for the order of slides.
struct ShaderVertices {
    const PlanetShape& shape;
    const VertexFrame& frame;
    const ChunkId& id;
    StepsView heights;

    glm::vec3 own(glm::ivec2 vertex) const {
        const std::int32_t spacing = fineCellsPerVertex(shape, id.level);
        const auto gridU = (static_cast<std::int32_t>(id.x) * chunkCells(shape) + vertex.x) * spacing;
        const auto gridV = (static_cast<std::int32_t>(id.y) * chunkCells(shape) + vertex.y) * spacing;
        const auto index = static_cast<std::size_t>(vertex.y * chunkSize(shape) + vertex.x);
        return vertexFromEyeM(frame, id.face, gridU, gridV, heights[index]);
    }
    // Mixes the vertices of a blend. The sum starts from one part, because the rounded shares do not add up
    // to exactly 1.
    glm::vec3 blended(const VertexBlend& blend) const {
        const glm::vec3 last = own(blend.parts[blend.count - 1].vertex);
        glm::vec3 sum = last;
        for (std::size_t i = 0; i + 1 < blend.count; ++i)
            sum += static_cast<float>(blend.parts[i].share) * (own(blend.parts[i].vertex) - last);
        return sum;
    }
};

FloatPosition measured(const glm::vec3& fromEyeM, const glm::dvec3& trueFromEyeM, const View& view) {
    const glm::dvec3 drawn(fromEyeM);
    FloatPosition position;
    position.positionM = view.eyeM + drawn;
    position.errorM = glm::length(drawn - trueFromEyeM);
    const double shortestM = std::min(glm::length(drawn), glm::length(trueFromEyeM));
    if (shortestM > 0)
        position.errorPx =
            screenScalePx(view) * glm::length(glm::normalize(drawn) - glm::normalize(trueFromEyeM));
    return position;
}

}  // namespace

VertexPrecision vertexPrecision(const PlanetShape& shape, const VertexFrame& frame, const DrawItem& item,
                                StepsView heights, bool stitched, const View& view, glm::ivec2 vertex) {
    assert(heights.size() == static_cast<std::size_t>(chunkVertexCount(shape)));
    VertexPrecision precision;
    precision.chunk = item.id;
    precision.vertex = vertex;
    precision.positionM = drawnVertex(shape, item, heights, stitched, vertex.x, vertex.y).positionM;
    const glm::dvec3 fromEyeM = precision.positionM - view.eyeM;
    precision.distanceM = glm::length(fromEyeM);
    const ShaderVertices shader{shape, frame, item.id, heights};
    const VertexBlend blend = vertexBlend(shape, item, stitched, vertex.x, vertex.y);
    precision.shader = measured(shader.blended(blend), fromEyeM, view);
    const glm::vec3 plainM = glm::vec3(precision.positionM) - glm::vec3(view.eyeM);
    precision.fromCentre = measured(plainM, fromEyeM, view);
    return precision;
}

VertexPrecision worstPrecision(const PlanetShape& shape, const VertexFrame& frame, const DrawItem& item,
                               StepsView heights, bool stitched, const View& view) {
    VertexPrecision worst;
    worst.shader.errorPx = -1;
    for (int row = 0; row < chunkSize(shape); ++row) {
        for (int column = 0; column < chunkSize(shape); ++column) {
            const VertexPrecision here =
                vertexPrecision(shape, frame, item, heights, stitched, view, {column, row});
            if (here.shader.errorPx > worst.shader.errorPx) worst = here;
        }
    }
    return worst;
}

glm::ivec2 nearestVertex(const PlanetShape& shape, const DrawItem& item, StepsView heights, bool stitched,
                         const glm::dvec3& pointM) {
    glm::ivec2 nearest{0, 0};
    double shortestM = std::numeric_limits<double>::infinity();
    const DrawnGrid grid = drawnGrid(shape, item, heights, stitched);
    for (int row = 0; row <= grid.cells; ++row) {
        for (int column = 0; column <= grid.cells; ++column) {
            const auto index = static_cast<std::size_t>(row * (grid.cells + 1) + column);
            const double distanceM = glm::length(grid.positionM[index] - pointM);
            if (distanceM >= shortestM) continue;
            shortestM = distanceM;
            nearest = {column, row};
        }
    }
    return nearest;
}

}  // namespace planet
