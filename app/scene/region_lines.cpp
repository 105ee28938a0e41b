#include "app/scene/region_lines.h"

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "app/scene/overlay_colours.h"
#include "planet/gl/draw/debug_shapes.h"
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

}  // namespace worldy
