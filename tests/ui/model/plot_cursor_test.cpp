#include "ui/model/plot_cursor.h"

#include <gtest/gtest.h>

#include "ui/model/net_cells.h"

namespace worldy::ui {
namespace {

using planet::ChunkId;
using planet::Face;

TEST(PlotCursor, anArrowMovesByOneSampleAPageByATenth) {
    EXPECT_EQ(movedCursor(50, 101, {.right = 1}), 51u);
    EXPECT_EQ(movedCursor(50, 101, {.right = -2}), 48u);
    EXPECT_EQ(movedCursor(50, 101, {.pagesDown = 1}), 60u);
    EXPECT_EQ(movedCursor(50, 101, {.pagesDown = -1}), 40u);
    EXPECT_EQ(movedCursor(1, 3, {.pagesDown = 1}), 2u) << "a page of few samples is one sample";
}

TEST(PlotCursor, theCursorStaysOnTheSamples) {
    EXPECT_EQ(movedCursor(0, 10, {.right = -1}), 0u);
    EXPECT_EQ(movedCursor(9, 10, {.right = 1}), 9u);
    EXPECT_EQ(movedCursor(5, 10, {.toFirst = true}), 0u);
    EXPECT_EQ(movedCursor(5, 10, {.toLast = true}), 9u);
    EXPECT_EQ(movedCursor(0, 1, {.right = 1, .pagesDown = 3}), 0u);
    EXPECT_EQ(movedCursor(7, 10, {.up = 1, .zoomIn = 1, .acts = true}), 7u);
}

constexpr planet::FacePoint inNorthEast{Face::PosX, 0.6, 0.6};

TEST(SteppedChunk, arrowsLeadToTheNeighbourThatTheNetShowsThere) {
    const ChunkId at{Face::PosX, 3, 2, 4};
    EXPECT_EQ(steppedChunk(at, {.right = 1}, inNorthEast, 10), (ChunkId{Face::PosX, 3, 3, 4}));
    EXPECT_EQ(steppedChunk(at, {.right = -1}, inNorthEast, 10), (ChunkId{Face::PosX, 3, 1, 4}));
    EXPECT_EQ(steppedChunk(at, {.up = 1}, inNorthEast, 10), (ChunkId{Face::PosX, 3, 2, 5}));
    const NetSquare here = netSquare(at), above = netSquare({Face::PosX, 3, 2, 5});
    EXPECT_LT(above.y, here.y);
    // Across the edge of a face: the net shows +y right of +x.
    EXPECT_EQ(steppedChunk(ChunkId{Face::PosX, 3, 7, 4}, {.right = 1}, inNorthEast, 10),
              (ChunkId{Face::PosY, 3, 0, 4}));
}

TEST(SteppedChunk, pagesLeadToTheParentAndToTheChildUnderTheCamera) {
    const ChunkId root{Face::PosX, 0, 0, 0};
    EXPECT_EQ(steppedChunk(root, {.pagesDown = 1}, inNorthEast, 10), (ChunkId{Face::PosX, 1, 1, 1}));
    EXPECT_EQ(steppedChunk(ChunkId{Face::PosY, 0, 0, 0}, {.pagesDown = 1}, inNorthEast, 10),
              (ChunkId{Face::PosY, 1, 0, 0}));
    EXPECT_EQ(steppedChunk(ChunkId{Face::PosX, 1, 1, 1}, {.pagesDown = -1}, inNorthEast, 10), root);
    EXPECT_EQ(steppedChunk(root, {.pagesDown = -1}, inNorthEast, 10), root);
    EXPECT_EQ(steppedChunk(root, {.pagesDown = 1}, inNorthEast, 0), root) << "there is no deeper level";
}

TEST(SteppedChunk, withoutASelectionAKeyLeadsToTheRootUnderTheCamera) {
    EXPECT_EQ(steppedChunk(std::nullopt, {.up = -1}, inNorthEast, 10), (ChunkId{Face::PosX, 0, 0, 0}));
    EXPECT_FALSE(steppedChunk(std::nullopt, {.zoomIn = 1, .toFirst = true}, inNorthEast, 10));
}

}  // namespace
}  // namespace worldy::ui
