#include "app/scene/overlay_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/scene/overlay_colours.h"
#include "planet/sphere/cube_sphere.h"

namespace worldy {

namespace {

constexpr planet::LineColour hoverColour = {255, 255, 255, 230};
constexpr planet::LineColour selectedColour = {255, 176, 32, 255};
// Colours of chunks that stay coarse because their children could not be read.
constexpr planet::LineColour failedColour = {255, 60, 50, 255};
constexpr planet::LineColour awaitingRetryColour = {255, 190, 60, 255};

// Returns the size of two pixels at the chunk's distance. Lifted by it, an outline is not hidden by its own
// ground.
double liftM(const planet::ChunkNode& node, const planet::View& view) {
    const double away = std::max(planet::distanceM(node.bounds.box, view.eyeM), 10.0);
    return 2 * away / planet::screenScalePx(view);
}

glm::dvec3 edgePointM(const planet::ChunkTree& tree, const planet::ChunkNode& node, planet::Edge edge, int i,
                      double lift) {
    const int last = planet::chunkCells(tree.shape);
    const int column = edge == planet::Edge::West ? 0 : edge == planet::Edge::East ? last : i;
    const int row = edge == planet::Edge::South ? 0 : edge == planet::Edge::North ? last : i;
    const planet::FaceSquare square = planet::faceSquareOf(node.id);
    const double cell = square.side / last;
    const glm::dvec3 direction = planet::sphereFromCube(
        planet::cubePoint(node.id.face, square.u + column * cell, square.v + row * cell));
    const std::int32_t step = (*node.heights)[static_cast<std::size_t>(row * (last + 1) + column)];
    return planet::positionM(tree.shape, direction, planet::heightM(tree.shape, step) + lift);
}

// Returns yellow for a difference of one level, orange for two, magenta for three and more.
planet::LineColour seamColour(int levels) {
    if (levels <= 1) return {255, 220, 60, 255};
    return levels == 2 ? planet::LineColour{255, 140, 20, 255} : planet::LineColour{255, 40, 200, 255};
}

void appendSeam(const planet::ChunkTree& tree, const planet::LevelSeam& seam, const planet::View& view,
                planet::Lines& lines) {
    const planet::NodeIndex index = planet::findNode(tree, seam.finer);
    if (index == planet::noNode) return;
    const planet::ChunkNode& node = tree.nodes[index];
    const planet::LineColour colour = seamColour(seam.finer.level - seam.coarser.level);
    const int cells = planet::chunkCells(tree.shape);
    const int stride = cells / 16;
    const double lift = liftM(node, view);
    for (int i = 0; i < cells; i += stride) {
        lines.push_back({edgePointM(tree, node, seam.edge, i, lift), colour});
        lines.push_back({edgePointM(tree, node, seam.edge, i + stride, lift), colour});
    }
}

void appendFocus(const planet::ChunkTree& tree, const planet::ChunkId& id, const planet::LineColour& colour,
                 const planet::View& view, planet::Lines& lines) {
    const planet::NodeIndex index = planet::findNode(tree, id);
    if (index == planet::noNode) return;
    const planet::ChunkNode& node = tree.nodes[index];
    planet::appendOutline(tree, node, liftM(node, view), colour, lines);
}

void appendFailed(const planet::ChunkTree& tree, const planet::ChunkNode& node, const planet::View& view,
                  planet::Lines& lines) {
    const bool permanent = node.childrenState == planet::ChildrenState::Failed;
    if (!permanent && node.childrenState != planet::ChildrenState::AwaitingRetry) return;
    planet::appendOutline(tree, node, liftM(node, view), permanent ? failedColour : awaitingRetryColour,
                          lines);
}

}  // namespace

planet::Lines overlayLines(const planet::ChunkTree& tree, const planet::Selection& selection,
                           const planet::View& renderView, const ViewSettings& settings) {
    planet::Lines lines;
    if (settings.overlay.bounds) {
        for (const planet::DrawItem& item : selection.draw) {
            planet::appendBox(tree.nodes[item.node].bounds.box, colourBytes(levelColour(item.id.level), 200),
                              lines);
        }
    }
    if (settings.overlay.outlines) {
        for (const planet::DrawItem& item : selection.draw)
            appendFailed(tree, tree.nodes[item.node], renderView, lines);
    }
    if (settings.overlay.lodSeams) {
        for (const planet::LevelSeam& seam : selection.seams) appendSeam(tree, seam, renderView, lines);
    }
    return lines;
}

planet::Lines focusLines(const planet::ChunkTree& tree, const ChunkFocus& focus,
                         const planet::View& renderView) {
    planet::Lines lines;
    if (focus.hovered) appendFocus(tree, *focus.hovered, hoverColour, renderView, lines);
    if (focus.selected) appendFocus(tree, *focus.selected, selectedColour, renderView, lines);
    return lines;
}

}  // namespace worldy
