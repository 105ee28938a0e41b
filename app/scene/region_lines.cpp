#include "app/scene/region_lines.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "app/scene/atlas_drape.h"
#include "app/scene/overlay_colours.h"
#include "planet/gl/draw/debug_shapes.h"
#include "planet/sphere/chunk_id.h"
#include "planet/sphere/cube_sphere.h"
#include "planet/sphere/planet_shape.h"
#include "planet/sphere/view.h"
#include "planet/tree/chunk_tree.h"
#include "planet/tree/region.h"

namespace worldy {

namespace {

// Appends a line through directions, draped over the finest resident samples.
void drape(const std::vector<glm::dvec3>& directions, const planet::LineColour& colour,
           const planet::ChunkTree& tree, const planet::View& view, planet::Lines& lines) {
    const double radiusM = tree.shape.radiusM;
    const double pixelRad = 1 / planet::screenScalePx(view);
    const double leastAlongM = radiusM * std::min(1.0, radiusM / glm::length(view.eyeM)) * 0.98;
    glm::dvec3 last{0, 0, 0};
    bool wasSeen = false;
    for (const glm::dvec3& direction : directions) {
        const bool isSeen = glm::dot(direction, view.eyeM) >= leastAlongM;
        glm::dvec3 point{0, 0, 0};
        if (isSeen) {
            const double groundM = planet::sampledHeightM(tree, direction);
            const glm::dvec3 ground = planet::positionM(tree.shape, direction, groundM);
            const double liftM = 2 * pixelRad * glm::length(ground - view.eyeM);
            point = planet::positionM(tree.shape, direction, groundM + liftM);
        }
        if (isSeen && wasSeen) {
            lines.push_back({last, colour});
            lines.push_back({point, colour});
        }
        last = point;
        wasSeen = isSeen;
    }
}

// Returns a line across a cell, from one point of its face to another, as directions.
std::vector<glm::dvec3> lineAcross(planet::Face face, const glm::dvec2& from, const glm::dvec2& to) {
    constexpr int pieces = 3;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i <= pieces; ++i) {
        const glm::dvec2 at = from + (to - from) * (static_cast<double>(i) / pieces);
        directions.push_back(planet::sphereFromCube(planet::cubePoint(face, at.x, at.y)));
    }
    return directions;
}

}  // namespace

void follow(RegionOutlines& outlines, const planet::ChunkTree& tree) {
    if (outlines.of == tree.regions) return;
    outlines = {tree.regions, {}};
    if (!tree.regions) return;
    for (const planet::Region& region : tree.regions->regions()) {
        outlines.lines.emplace_back();
        if (region.on) outlines.lines.back() = planet::outlinesOf(region, tree.shape.radiusM);
    }
}

planet::Lines regionLines(const RegionOutlines& outlines, const planet::ChunkTree& tree,
                          const planet::View& view) {
    planet::Lines lines;
    for (std::size_t i = 0; i < outlines.lines.size(); ++i) {
        const planet::LineColour colour = colourBytes(regionColour(i), 255);
        for (const std::vector<glm::dvec3>& line : outlines.lines[i]) drape(line, colour, tree, view, lines);
    }
    return lines;
}

planet::Lines draftLines(const planet::Region& draft, const planet::LineColour& colour,
                         const planet::ChunkTree& tree, const planet::View& view) {
    planet::Lines lines;
    for (const std::vector<glm::dvec3>& line : planet::outlinesOf(draft, tree.shape.radiusM))
        drape(line, colour, tree, view, lines);
    return lines;
}

planet::Lines atlasLines(const AtlasDrape& atlas, const planet::ChunkTree& tree, const planet::View& view) {
    constexpr int hatches = 12;
    planet::Lines lines;
    for (const auto& [cell, value] : atlas.values) {
        if (isCoarserThanCells(atlas, cell)) continue;
        const planet::FaceSquare square = planet::faceSquareOf(cell);
        const planet::LineColour colour = colourBytes(drapeColour(atlas, value), 255);
        // The gaps between cells are twice as wide as those between hatches.
        for (int i = 1; i < hatches; ++i) {
            const double along = square.side * i / hatches;
            const double inset = square.side / hatches;
            drape(lineAcross(cell.face, {square.u + inset, square.v + along},
                             {square.u + square.side - inset, square.v + along}),
                  colour, tree, view, lines);
        }
    }
    return lines;
}

}  // namespace worldy
