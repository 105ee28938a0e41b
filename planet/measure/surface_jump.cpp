#include "planet/measure/surface_jump.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "planet/select/drawn_surface.h"

namespace planet {

namespace {

// The projection of a view and the sea drawn in it.
struct Screen {
    const View& view;
    double scalePx;                      // K'
    std::optional<double> seaRadiusM{};  // from the planet's centre
};

Screen screenOf(const PlanetShape& shape, const View& view, std::optional<double> seaM) {
    Screen screen{view, screenScalePx(view)};
    if (seaM) screen.seaRadiusM = shape.radiusM + *seaM;
    return screen;
}

struct ScreenPoint {
    glm::dvec2 px{0, 0};  // from the picture's middle, right and up
    bool inFront = false;
    bool inPicture = false;
};

// A place before and after the switch.
struct ComparedPlace {
    glm::dvec2 px{0, 0};       // on screen, after
    glm::dvec2 movedPx{0, 0};  // its motion on screen
    bool inFront = false;      // in front of the camera before and after; otherwise there is no jump
    bool counts = false;
    bool underSea = false;  // before and after
};

ScreenPoint onScreen(const Screen& screen, const glm::dvec3& fromEyeM) {
    const View& view = screen.view;
    const double aheadM = -glm::dot(fromEyeM, view.back);
    if (aheadM <= 0) return {};
    const glm::dvec2 px =
        screen.scalePx / aheadM * glm::dvec2(glm::dot(fromEyeM, view.right), glm::dot(fromEyeM, view.up));
    return {px, true, 2 * std::abs(px.x) <= view.widthPx && 2 * std::abs(px.y) <= view.heightPx};
}

// Returns whether a point counts as under the sea. Triangles between vertices at sea level dip below it by
// less than roundingM at neighbouring levels.
bool isUnderSea(const Screen& screen, const glm::dvec3& pointM) {
    constexpr double roundingM = 1e-3;
    return screen.seaRadiusM && glm::length(pointM) <= *screen.seaRadiusM + roundingM;
}

// A corner of a triangle that is clipped at the picture's border.
struct JumpCorner {
    glm::dvec2 px{0, 0};
    glm::dvec2 movedPx{0, 0};
};

// Clips to the inner side of one border of the picture: side * px[axis] <= limit.
std::vector<JumpCorner> clippedAt(const std::vector<JumpCorner>& polygon, int axis, double side,
                                  double limit) {
    std::vector<JumpCorner> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const JumpCorner& from = polygon[i];
        const JumpCorner& to = polygon[(i + 1) % polygon.size()];
        const double fromBeyond = side * from.px[axis] - limit;
        const double toBeyond = side * to.px[axis] - limit;
        if (fromBeyond <= 0) kept.push_back(from);
        if ((fromBeyond <= 0) == (toBeyond <= 0)) continue;
        const double share = fromBeyond / (fromBeyond - toBeyond);
        kept.push_back(
            {from.px + share * (to.px - from.px), from.movedPx + share * (to.movedPx - from.movedPx)});
    }
    return kept;
}

// Returns the mean length, over a triangle, of a vector that is linear between the corners. It is less than
// the mean of the corners' lengths if they move in opposite directions, so it is sampled in the middles of
// smaller triangles.
double meanLength(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    constexpr int along = 6;
    double total = 0;
    for (int row = 0; row < along; ++row) {
        for (int i = 0; i < 2 * (along - row) - 1; ++i) {
            const int column = i / 2;
            const double third = i % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
            const double s = (column + third) / along;
            const double t = (row + third) / along;
            total += glm::length(a + s * (b - a) + t * (c - a));
        }
    }
    return total / (along * along);
}

// Adds up places and the triangles between them.
struct Sum {
    const Screen& screen;
    SurfaceJump jump{};
    double totalPx = 0;
    bool anyUnderSea = false;
    double areaPx = 0;      // pixels squared
    double areaJumpPx = 0;  // jump times area

    ComparedPlace add(const ChunkId& chunk, const glm::dvec3& beforeM, const glm::dvec3& afterM) {
        const glm::dvec3 before = beforeM - screen.view.eyeM;
        const glm::dvec3 after = afterM - screen.view.eyeM;
        const ScreenPoint from = onScreen(screen, before);
        const ScreenPoint to = onScreen(screen, after);
        ComparedPlace place;
        place.px = to.px;
        place.inFront = from.inFront && to.inFront;
        if (!place.inFront) return place;
        place.movedPx = to.px - from.px;
        const double jumpPx = glm::length(place.movedPx);
        place.underSea = isUnderSea(screen, beforeM) && isUnderSea(screen, afterM);
        if (!from.inPicture && !to.inPicture) return place;
        anyUnderSea |= place.underSea;
        place.counts = !place.underSea;
        if (!place.counts) return place;
        const double facingPx = screen.scalePx * glm::length(glm::normalize(after) - glm::normalize(before));
        if (jumpPx > jump.largestPx || jump.places == 0) {
            jump.largestPx = jumpPx;
            jump.worstPlaceM = afterM;
            jump.worstChunk = chunk;
        }
        jump.largestFacingPx = std::max(jump.largestFacingPx, facingPx);
        totalPx += jumpPx;
        ++jump.places;
        return place;
    }

    void addTriangle(const std::array<const ComparedPlace*, 3>& places) {
        const auto all = [&](bool ComparedPlace::*flag) {
            return std::all_of(places.begin(), places.end(),
                               [&](const ComparedPlace* place) { return place->*flag; });
        };
        if (!all(&ComparedPlace::inFront) || all(&ComparedPlace::underSea)) return;
        std::array<JumpCorner, 3> corners;
        for (std::size_t i = 0; i < 3; ++i) corners[i] = {places[i]->px, places[i]->movedPx};
        const glm::dvec2 half(0.5 * screen.view.widthPx, 0.5 * screen.view.heightPx);
        const bool inside = std::all_of(corners.begin(), corners.end(), [&](const JumpCorner& corner) {
            return std::abs(corner.px.x) <= half.x && std::abs(corner.px.y) <= half.y;
        });
        if (inside) return addArea(corners[0], corners[1], corners[2]);
        std::vector<JumpCorner> polygon(corners.begin(), corners.end());
        for (int axis = 0; axis < 2; ++axis) {
            for (const double side : {-1.0, 1.0}) polygon = clippedAt(polygon, axis, side, half[axis]);
        }
        for (std::size_t i = 2; i < polygon.size(); ++i) addArea(polygon[0], polygon[i - 1], polygon[i]);
    }

    void addArea(const JumpCorner& a, const JumpCorner& b, const JumpCorner& c) {
        const glm::dvec2 ab = b.px - a.px;
        const glm::dvec2 ac = c.px - a.px;
        const double area = 0.5 * std::abs(ab.x * ac.y - ab.y * ac.x);
        areaPx += area;
        areaJumpPx += area * meanLength(a.movedPx, b.movedPx, c.movedPx);
    }

    SurfaceJump done() {
        // A surface seen edge-on has no area.
        if (areaPx > 0)
            jump.meanPx = areaJumpPx / areaPx;
        else if (jump.places > 0)
            jump.meanPx = totalPx / jump.places;
        if (jump.places == 0) jump.meanPx = 0;
        jump.underSea = jump.places == 0 && anyUnderSea;
        return jump;
    }
};

// Returns the drawn position of a vertex: vertices below the sea are drawn at its level.
glm::dvec3 aboveSea(const Screen& screen, const glm::dvec3& positionM) {
    const double radiusM = glm::length(positionM);
    if (!screen.seaRadiusM || radiusM >= *screen.seaRadiusM) return positionM;
    return *screen.seaRadiusM / radiusM * positionM;
}

DrawnGrid gridOf(const PlanetShape& shape, const DrawnChunk& chunk, const Screen& screen) {
    DrawnGrid grid = drawnGrid(shape, chunk.item, *chunk.heights, chunk.stitched);
    for (glm::dvec3& positionM : grid.positionM) positionM = aboveSea(screen, positionM);
    return grid;
}

// Returns the drawn point at a grid point of the chunk, even if its vertex has moved away.
glm::dvec3 drawnAt(const DrawnGrid& grid, int column, int row) {
    const auto index = static_cast<std::size_t>(row * (grid.cells + 1) + column);
    return grid.place[index] == glm::dvec2(column, row) ? grid.positionM[index] : pointOn(grid, column, row);
}

// Places in a cell, from its south-west corner: one within each triangle, for either diagonal.
constexpr std::array<glm::dvec2, 2> triangleMiddles = {{{2.0 / 3, 1.0 / 3}, {1.0 / 3, 2.0 / 3}}};

void addFiner(const DrawnGrid& coarser, const DrawnGrid& finer, bool coarserIsAfter, Sum& sum) {
    assert(finer.id.face == coarser.id.face && finer.id.level > coarser.id.level);
    const int levels = finer.id.level - coarser.id.level;
    const double scale = 1.0 / (1 << levels);
    const double firstColumn = (finer.id.x - (coarser.id.x << levels)) * scale * finer.cells;
    const double firstRow = (finer.id.y - (coarser.id.y << levels)) * scale * finer.cells;
    const auto add = [&](glm::dvec2 place, const glm::dvec3& fine) {
        const glm::dvec3 coarse = pointOn(coarser, firstColumn + place.x * scale, firstRow + place.y * scale);
        return sum.add(finer.id, coarserIsAfter ? fine : coarse, coarserIsAfter ? coarse : fine);
    };
    std::vector<ComparedPlace> places;
    places.reserve(finer.positionM.size());
    for (int row = 0; row <= finer.cells; ++row) {
        for (int column = 0; column <= finer.cells; ++column)
            places.push_back(add({column, row}, drawnAt(finer, column, row)));
    }
    for (int row = 0; row < finer.cells; ++row) {
        for (int column = 0; column < finer.cells; ++column) {
            for (const CellTriangle& triangle : cellTriangles(column, row, finer.cells)) {
                const auto& [a, b, c] = triangle.vertices;
                sum.addTriangle({&places[a], &places[b], &places[c]});
            }
        }
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
                        std::span<const DrawnChunk> finer, bool coarserIsAfter, const View& view,
                        std::optional<double> seaM) {
    const Screen screen = screenOf(shape, view, seaM);
    const DrawnGrid coarse = gridOf(shape, coarser, screen);
    Sum sum{screen};
    for (const DrawnChunk& chunk : finer) addFiner(coarse, gridOf(shape, chunk, screen), coarserIsAfter, sum);
    return sum.done();
}

SurfaceJump edgeJump(const PlanetShape& shape, const DrawnChunk& before, const DrawnChunk& after, Edge edge,
                     const View& view, std::optional<double> seaM) {
    assert(before.item.id == after.item.id);
    const Screen screen = screenOf(shape, view, seaM);
    const bool upright = edge == Edge::West || edge == Edge::East;
    const bool isFar = edge == Edge::East || edge == Edge::North;
    const int cells = chunkCells(shape);
    Sum sum{screen};
    if (before.stitched || after.stitched) {
        // Takes only the edge from `after`: the other vertices in these rows morph independently of it.
        const auto index = static_cast<std::size_t>(edge);
        DrawnChunk edgeAfter = before;
        edgeAfter.stitched = after.stitched;
        edgeAfter.item.coarserBy[index] = after.item.coarserBy[index];
        edgeAfter.item.edgeMorph[index] = after.item.edgeMorph[index];
        const DrawnGrid from = gridOf(shape, before, screen);
        const DrawnGrid to = gridOf(shape, edgeAfter, screen);
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
            return aboveSea(screen,
                            drawnVertex(shape, chunk.item, *chunk.heights, false, at.x, at.y).positionM);
        };
        for (int along = 0; along <= cells; ++along) {
            const glm::ivec2 at = upright ? glm::ivec2(across, along) : glm::ivec2(along, across);
            sum.add(before.item.id, vertexOf(before, at), vertexOf(after, at));
        }
    }
    return sum.done();
}

}  // namespace planet
