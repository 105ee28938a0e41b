// The values of an atlas over the planet: cells, coarser squares and finer ones.
#include "app/scene/atlas_drape.h"

#include <gtest/gtest.h>

#include <limits>

#include "app/scene/overlay_colours.h"

namespace worldy {
namespace {

using planet::AtlasCell;
using planet::AtlasMeasure;
using planet::ChunkId;
using planet::Face;

AtlasCell cellOf(const ChunkId& id, double triangles, std::uint8_t altitude = 0) {
    AtlasCell cell{id, altitude, {}};
    cell.values.fill(std::numeric_limits<double>::quiet_NaN());
    cell.values[static_cast<std::size_t>(AtlasMeasure::Triangles)] = triangles;
    return cell;
}

const std::vector<AtlasCell> cells = {cellOf({Face::PosX, 1, 0, 0}, 10), cellOf({Face::PosX, 1, 1, 0}, 20),
                                      cellOf({Face::PosX, 1, 0, 1}, 30), cellOf({Face::PosX, 2, 2, 2}, 90),
                                      cellOf({Face::PosX, 2, 3, 2}, 40), cellOf({Face::PosX, 1, 0, 0}, 7, 1)};

TEST(AtlasDrape, CellsHaveTheirValuesAndSoHasAllBelowThem) {
    const AtlasDrape drape = drapeOf(cells, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(valueAt(drape, {Face::PosX, 1, 0, 0}), 10);
    EXPECT_EQ(valueAt(drape, {Face::PosX, 5, 3, 3}), 10);
    EXPECT_EQ(valueAt(drape, {Face::PosX, 2, 2, 2}), 90);
}

TEST(AtlasDrape, CoarserSquaresHaveTheLargestValueBelow) {
    const AtlasDrape drape = drapeOf(cells, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(valueAt(drape, {Face::PosX, 1, 1, 1}), 90);
    EXPECT_EQ(valueAt(drape, {Face::PosX, 0, 0, 0}), 90);
}

TEST(AtlasDrape, TellsWhatSeveralCellsCover) {
    const AtlasDrape drape = drapeOf(cells, AtlasMeasure::Triangles, 0);
    EXPECT_TRUE(isCoarserThanCells(drape, {Face::PosX, 0, 0, 0}));
    EXPECT_TRUE(isCoarserThanCells(drape, {Face::PosX, 1, 1, 1}));
    EXPECT_FALSE(isCoarserThanCells(drape, {Face::PosX, 1, 0, 0}));
    EXPECT_FALSE(isCoarserThanCells(drape, {Face::PosX, 3, 4, 4}));
    EXPECT_FALSE(isCoarserThanCells(drape, {Face::NegY, 0, 0, 0}));
}

TEST(AtlasDrape, NothingIsKnownOfOtherFacesMeasuresAndAltitudes) {
    EXPECT_FALSE(valueAt(drapeOf(cells, AtlasMeasure::Triangles, 0), {Face::NegY, 0, 0, 0}));
    EXPECT_TRUE(drapeOf(cells, AtlasMeasure::PopPx, 0).values.empty());
    EXPECT_EQ(valueAt(drapeOf(cells, AtlasMeasure::Triangles, 1), {Face::PosX, 0, 0, 0}), 7);
}

TEST(AtlasDrape, TheScaleEndsAtTheExtremesOfFewValues) {
    const AtlasDrape drape = drapeOf(cells, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(drape.least, 10);
    EXPECT_EQ(drape.most, 90);
    EXPECT_FALSE(drape.isClamped);
    EXPECT_EQ(shareOf(drape, 50), 0.5);
    EXPECT_EQ(shareOf(drape, 1000), 1);
    EXPECT_EQ(valueOf(drape, 0.5), 50);
}

TEST(AtlasDrape, ARareHugeValueDoesNotSpoilTheScale) {
    std::vector<AtlasCell> many;
    for (std::uint32_t i = 0; i < 256; ++i)
        many.push_back(cellOf({Face::PosX, 4, i % 16, i / 16}, i == 7 ? 1e9 : 5 + i / 256.0));
    const AtlasDrape drape = drapeOf(many, AtlasMeasure::Triangles, 0);
    EXPECT_LT(drape.most, 6);
    EXPECT_TRUE(drape.isClamped);
}

TEST(AtlasDrape, WhatHasNoBoundIsOnNoScaleAndHasAColourOfItsOwn) {
    constexpr double noBound = std::numeric_limits<double>::infinity();
    std::vector<AtlasCell> some = cells;
    some.push_back(cellOf({Face::NegY, 1, 0, 0}, noBound));
    const AtlasDrape drape = drapeOf(some, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(drape.most, 90);
    EXPECT_FALSE(drape.isClamped);
    EXPECT_TRUE(drape.hasUnbounded);
    EXPECT_EQ(atlasColour(&drape, {Face::NegY, 0, 0, 0}), unboundedColour);
    EXPECT_EQ(atlasColour(&drape, {Face::PosX, 2, 2, 2}), rampColour(1));
    EXPECT_FALSE(drapeOf(cells, AtlasMeasure::Triangles, 0).hasUnbounded);
}

const std::vector<AtlasCell> changes = {cellOf({Face::PosX, 1, 0, 0}, -8), cellOf({Face::PosX, 1, 1, 0}, 2),
                                        cellOf({Face::PosX, 1, 0, 1}, 0),  cellOf({Face::PosX, 1, 1, 1}, 0),
                                        cellOf({Face::NegY, 1, 0, 0}, -4), cellOf({Face::NegY, 1, 1, 0}, 0)};

TEST(AtlasDrape, ChangesHaveAScaleThatIsAsLongBelowZeroAsAbove) {
    const AtlasDrape drape = changeDrapeOf(changes, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(drape.least, -8);
    EXPECT_EQ(drape.most, 8);
    EXPECT_FALSE(drape.isClamped);
    EXPECT_EQ(shareOf(drape, 0), 0.5);
    EXPECT_EQ(atlasColour(&drape, {Face::PosX, 1, 0, 0}), changeColour(0));
    EXPECT_EQ(atlasColour(&drape, {Face::PosX, 1, 0, 1}), changeColour(0.5));
}

TEST(AtlasDrape, ASquareWithBothShowsWhatGotWorse) {
    const AtlasDrape drape = changeDrapeOf(changes, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(valueAt(drape, {Face::PosX, 0, 0, 0}), 2);
    EXPECT_EQ(valueAt(drape, {Face::NegY, 0, 0, 0}), -4);
}

TEST(AtlasDrape, WithoutAnyChangeEverythingHasTheColourOfNone) {
    const std::vector<AtlasCell> same = {cellOf({Face::PosX, 1, 0, 0}, 0)};
    const AtlasDrape drape = changeDrapeOf(same, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(drape.most, 0);
    EXPECT_EQ(atlasColour(&drape, {Face::PosX, 1, 0, 0}), changeColour(0.5));
}

TEST(AtlasDrape, LostAndGainedBoundsAreOnNoScaleAndHaveColoursOfTheirOwn) {
    constexpr double noBound = std::numeric_limits<double>::infinity();
    std::vector<AtlasCell> some = changes;
    some.push_back(cellOf({Face::PosY, 1, 0, 0}, noBound));
    some.push_back(cellOf({Face::NegZ, 1, 0, 0}, -noBound));
    const AtlasDrape drape = changeDrapeOf(some, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(drape.most, 8);
    EXPECT_TRUE(drape.hasUnbounded);
    EXPECT_TRUE(drape.hasGained);
    EXPECT_EQ(drape.cellsOnScale, changes.size());
    EXPECT_EQ(atlasColour(&drape, {Face::PosY, 1, 0, 0}), unboundedColour);
    EXPECT_EQ(atlasColour(&drape, {Face::NegZ, 1, 0, 0}), gainedColour);
}

TEST(AtlasDrape, ColoursAreThoseOfTheRampAndGreyWhereNothingIsKnown) {
    const AtlasDrape drape = drapeOf(cells, AtlasMeasure::Triangles, 0);
    EXPECT_EQ(atlasColour(&drape, {Face::PosX, 2, 2, 2}), rampColour(1));
    EXPECT_EQ(atlasColour(&drape, {Face::PosX, 3, 0, 0}), rampColour(0));
    EXPECT_EQ(atlasColour(&drape, {Face::NegY, 2, 2, 2}), unmeasuredColour);
    EXPECT_EQ(atlasColour(nullptr, {Face::PosX, 2, 2, 2}), unmeasuredColour);
}

}  // namespace
}  // namespace worldy
