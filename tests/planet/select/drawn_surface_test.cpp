#include "planet/select/drawn_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "tests/support/seam_patchwork.h"

namespace planet {
namespace {

std::vector<DrawItem> patchworkItems(std::uint32_t seed) {
    std::vector<DrawItem> items;
    for (const ChunkId& id : seamPatchwork()) {
        DrawItem item;
        item.id = id;
        items.push_back(item);
    }
    std::mt19937 random(seed);
    morphAtRandom(items, random);
    return items;
}

DrawnGrid gridOf(const DrawItem& item, bool stitched) {
    const PlanetShape shape = smallChunks();
    return drawnGrid(shape, item, chunkSteps(shape, item.id, mountains), stitched);
}

// In units of a cell, so that it means the same at every level.
double distanceInCells(const DrawnGrid& grid, const glm::dvec3& a, const glm::dvec3& b) {
    const double cellM = smallChunks().radiusM * faceSquareOf(grid.id).side / grid.cells;
    return glm::length(a - b) / cellM;
}

TEST(DrawnSurface, aPointOnAVertexIsThatVertex) {
    for (const bool stitched : {false, true}) {
        for (const DrawItem& item : patchworkItems(3)) {
            const DrawnGrid grid = gridOf(item, stitched);
            for (std::size_t i = 0; i < grid.place.size(); ++i) {
                const glm::dvec3 point = pointOn(grid, grid.place[i].x, grid.place[i].y);
                ASSERT_LT(distanceInCells(grid, point, grid.positionM[i]), 1e-9)
                    << toString(item.id) << " vertex " << i;
            }
        }
    }
}

TEST(DrawnSurface, everyPlaceIsCoveredAndNeighbouringPlacesLieSideBySide) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> any(0, 1);
    constexpr double aside = 1e-7;  // cells
    for (const bool stitched : {false, true}) {
        for (const DrawItem& item : patchworkItems(4)) {
            const DrawnGrid grid = gridOf(item, stitched);
            for (int i = 0; i < 40; ++i) {
                // On a line between two cells of the outermost ring or the one within, across either axis.
                const double line = static_cast<double>(i % 4 < 2 ? i % 4 : grid.cells - 3 + i % 4);
                const double along = any(random) * grid.cells;
                const bool upright = i % 8 < 4;
                const auto at = [&](double across) {
                    const double kept = std::clamp(across, 0.0, double{1} * grid.cells);
                    return upright ? pointOn(grid, kept, along) : pointOn(grid, along, kept);
                };
                // Mountains rise by a hundred cells on none of these levels.
                ASSERT_LT(distanceInCells(grid, at(line - aside), at(line + aside)), 200 * aside)
                    << toString(item.id) << " " << line << " " << along;
            }
        }
    }
}

TEST(DrawnSurface, aPointLiesOverItsPlaceAlsoInAStitchedRing) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> any(0, 16);
    for (const DrawItem& item : patchworkItems(5)) {
        const DrawnGrid grid = gridOf(item, true);
        const FaceSquare square = faceSquareOf(item.id);
        for (int i = 0; i < 30; ++i) {
            double x = any(random);
            double y = any(random);
            (i % 2 == 0 ? x : y) = std::fmod(i % 2 == 0 ? x : y, 1.0) + (i % 4 < 2 ? 0 : 15);
            const FacePoint found = facePointFromDirection(pointOn(grid, x, y));
            if (found.face != item.id.face) continue;  // on the cube's edge
            // Within what the map bends over the few cells of a triangle, and heights lean it.
            EXPECT_NEAR((found.u - square.u) / square.side * 16, x, 0.3) << toString(item.id);
            EXPECT_NEAR((found.v - square.v) / square.side * 16, y, 0.3) << toString(item.id);
        }
    }
}

// So that nothing moves when the chunk beyond changes its level.
TEST(DrawnSurface, anEdgeThatMorphsFullyIsAlreadyStitchedToOneLevelMore) {
    for (DrawItem item : patchworkItems(7)) {
        for (const Edge edge : {Edge::West, Edge::East, Edge::South, Edge::North}) {
            const auto e = static_cast<std::size_t>(edge);
            item.coarserBy.fill(0);
            item.edgeMorph.fill(0);
            // A finer chunk than its neighbour by so many levels there is only so far down, and a chunk's
            // sixteen cells end at every second vertex of what is three levels coarser.
            for (std::uint8_t levels = 0; levels < 3 && levels < item.id.level; ++levels) {
                item.coarserBy[e] = levels;
                item.edgeMorph[e] = 1;
                const DrawnGrid before = gridOf(item, true);
                item.coarserBy[e] = static_cast<std::uint8_t>(levels + 1);
                item.edgeMorph[e] = 0;
                const DrawnGrid after = gridOf(item, true);
                for (std::size_t i = 0; i < before.place.size(); ++i) {
                    ASSERT_EQ(before.place[i], after.place[i]) << toString(item.id) << " vertex " << i;
                    ASSERT_LT(distanceInCells(before, before.positionM[i], after.positionM[i]), 1e-9)
                        << toString(item.id) << " vertex " << i;
                }
            }
        }
    }
}

// Seen from either side a stitched edge is the same line.
TEST(DrawnSurface, stitchedNeighboursShareEveryPointOfTheirEdge) {
    const std::vector<DrawItem> items = patchworkItems(6);
    const Neighbourhood neighbourhood(items);
    int compared = 0;
    for (const DrawItem& item : items) {
        for (const Edge edge : allEdges) {
            const DrawItem* other = neighbourhood.beyond(item.id, edge);
            if (other == nullptr || other->id.face != item.id.face) continue;
            const DrawnGrid own = gridOf(item, true);
            const DrawnGrid across = gridOf(*other, true);
            const FaceSquare here = faceSquareOf(item.id);
            const FaceSquare there = faceSquareOf(other->id);
            for (const double along : {0.0, 0.9, 3.3, 6.25, 7.5, 11.11, 14.9, 16.0}) {
                const bool upright = edge == Edge::West || edge == Edge::East;
                const double far = edge == Edge::East || edge == Edge::North ? 16 : 0;
                const glm::dvec2 place = upright ? glm::dvec2(far, along) : glm::dvec2(along, far);
                const double u = here.u + here.side * place.x / 16;
                const double v = here.v + here.side * place.y / 16;
                const glm::dvec3 mine = pointOn(own, place.x, place.y);
                const glm::dvec3 theirs =
                    pointOn(across, (u - there.u) / there.side * 16, (v - there.v) / there.side * 16);
                EXPECT_LT(distanceInCells(own, mine, theirs), 1e-9)
                    << toString(item.id) << " beside " << toString(other->id) << " at " << along;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace planet
