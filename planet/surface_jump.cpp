#include "planet/surface_jump.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "planet/drawn_surface.h"

namespace planet {

namespace {

// A view as points are projected into it.
struct Screen {
    const View& view;
    double scalePx;  // K'
};

struct ScreenPoint {
    glm::dvec2 px{0, 0};  // from the picture's middle, right and up
    bool inFront = false;
    bool inPicture = false;
};

ScreenPoint onScreen(const Screen& screen, const glm::dvec3& fromEyeM) {
    const View& view = screen.view;
    const double aheadM = -glm::dot(fromEyeM, view.back);
    if (aheadM <= 0) return {};
    const glm::dvec2 px =
        screen.scalePx / aheadM * glm::dvec2(glm::dot(fromEyeM, view.right), glm::dot(fromEyeM, view.up));
    return {px, true, 2 * std::abs(px.x) <= view.widthPx && 2 * std::abs(px.y) <= view.heightPx};
}

// Adds places up, one by one.
struct Sum {
    const Screen& screen;
    SurfaceJump jump{};
    double totalPx = 0;

    void add(const ChunkId& chunk, const glm::dvec3& beforeM, const glm::dvec3& afterM) {
        const glm::dvec3 before = beforeM - screen.view.eyeM;
        const glm::dvec3 after = afterM - screen.view.eyeM;
        const ScreenPoint from = onScreen(screen, before);
        const ScreenPoint to = onScreen(screen, after);
        if (!from.inFront || !to.inFront || (!from.inPicture && !to.inPicture)) return;
        const double px = glm::length(to.px - from.px);
        const double facingPx = screen.scalePx * glm::length(glm::normalize(after) - glm::normalize(before));
        if (px > jump.largestPx || jump.places == 0) {
            jump.largestPx = px;
            jump.worstPlaceM = afterM;
            jump.worstChunk = chunk;
        }
        jump.largestFacingPx = std::max(jump.largestFacingPx, facingPx);
        totalPx += px;
        ++jump.places;
    }

    SurfaceJump done() {
        if (jump.places > 0) jump.meanPx = totalPx / jump.places;
        return jump;
    }
};

DrawnGrid gridOf(const PlanetShape& shape, const DrawnChunk& chunk) {
    return drawnGrid(shape, chunk.item, *chunk.heights, chunk.stitched);
}

// What is drawn at a grid point of the chunk, whether or not its own vertex is still there.
glm::dvec3 drawnAt(const DrawnGrid& grid, int column, int row) {
    const auto index = static_cast<std::size_t>(row * (grid.cells + 1) + column);
    return grid.place[index] == glm::dvec2(column, row) ? grid.positionM[index] : pointOn(grid, column, row);
}

// In cells, from a cell's south-west corner: within either triangle, however its cell is cut.
constexpr std::array<glm::dvec2, 2> triangleMiddles = {{{2.0 / 3, 1.0 / 3}, {1.0 / 3, 2.0 / 3}}};

void addFiner(const DrawnGrid& coarser, const DrawnGrid& finer, bool coarserIsAfter, Sum& sum) {
    assert(finer.id.face == coarser.id.face && finer.id.level > coarser.id.level);
    const int levels = finer.id.level - coarser.id.level;
    const double scale = 1.0 / (1 << levels);
    const double firstColumn = (finer.id.x - (coarser.id.x << levels)) * scale * finer.cells;
    const double firstRow = (finer.id.y - (coarser.id.y << levels)) * scale * finer.cells;
    const auto add = [&](glm::dvec2 place, const glm::dvec3& fine) {
        const glm::dvec3 coarse = pointOn(coarser, firstColumn + place.x * scale, firstRow + place.y * scale);
        sum.add(finer.id, coarserIsAfter ? fine : coarse, coarserIsAfter ? coarse : fine);
    };
    for (int row = 0; row <= finer.cells; ++row) {
        for (int column = 0; column <= finer.cells; ++column) add({column, row}, drawnAt(finer, column, row));
    }
    if (!coarser.stitched && !finer.stitched) return;
    for (int row = 0; row < finer.cells; ++row) {
        for (int column = 0; column < finer.cells; ++column) {
            for (const glm::dvec2& middle : triangleMiddles) {
                const glm::dvec2 place = glm::dvec2(column, row) + middle;
                add(place, pointOn(finer, place.x, place.y));
            }
        }
    }
}

}  // namespace

SurfaceJump surfaceJump(const PlanetShape& shape, const DrawnChunk& coarser,
                        std::span<const DrawnChunk> finer, bool coarserIsAfter, const View& view) {
    const Screen screen{view, screenScalePx(view)};
    const DrawnGrid coarse = gridOf(shape, coarser);
    Sum sum{screen};
    for (const DrawnChunk& chunk : finer) addFiner(coarse, gridOf(shape, chunk), coarserIsAfter, sum);
    return sum.done();
}

SurfaceJump edgeJump(const PlanetShape& shape, const DrawnChunk& before, const DrawnChunk& after, Edge edge,
                     const View& view) {
    assert(before.item.id == after.item.id);
    const Screen screen{view, screenScalePx(view)};
    const bool upright = edge == Edge::West || edge == Edge::East;
    const bool isFar = edge == Edge::East || edge == Edge::North;
    const int cells = chunkCells(shape);
    Sum sum{screen};
    if (before.stitched || after.stitched) {
        // What else of the chunk morphs in these rows is no doing of the edge's.
        const auto index = static_cast<std::size_t>(edge);
        DrawnChunk edgeAfter = before;
        edgeAfter.stitched = after.stitched;
        edgeAfter.item.coarserBy[index] = after.item.coarserBy[index];
        edgeAfter.item.edgeMorph[index] = after.item.edgeMorph[index];
        const DrawnGrid from = gridOf(shape, before);
        const DrawnGrid to = gridOf(shape, edgeAfter);
        for (int inward = 0; inward <= 2 * stitchedRingCells; ++inward) {
            const double across = isFar ? cells - 0.5 * inward : 0.5 * inward;
            for (int i = 0; i <= 2 * cells; ++i) {
                const double along = 0.5 * i;
                const glm::dvec2 at = upright ? glm::dvec2(across, along) : glm::dvec2(along, across);
                sum.add(before.item.id, pointOn(from, at.x, at.y), pointOn(to, at.x, at.y));
            }
        }
    } else {
        const int across = isFar ? cells : 0;
        const auto vertexOf = [&](const DrawnChunk& chunk, glm::ivec2 at) {
            return drawnVertex(shape, chunk.item, *chunk.heights, false, at.x, at.y).positionM;
        };
        for (int along = 0; along <= cells; ++along) {
            const glm::ivec2 at = upright ? glm::ivec2(across, along) : glm::ivec2(along, across);
            sum.add(before.item.id, vertexOf(before, at), vertexOf(after, at));
        }
    }
    return sum.done();
}

}  // namespace planet
