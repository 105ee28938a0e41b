#include "planet/measure/lod_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "tests/support/fake_selection.h"
#include "tests/support/random_view.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

constexpr ChunkId posZRoot{Face::PosZ, 0, 0, 0};

// A selection of what is drawn and what is split above it, culled chunks in neither.
Selection selectionOf(const std::vector<ChunkId>& drawn, const std::vector<ChunkId>& splits) {
    Selection selection;
    for (const ChunkId& id : drawn) {
        DrawItem item;
        item.id = id;
        selection.draw.push_back(item);
    }
    for (const ChunkId& id : splits) selection.splits.push_back({noNode, id, 1});
    return selection;
}

std::vector<ChunkId> childrenOf(const ChunkId& id) {
    return {childOf(id, 0), childOf(id, 1), childOf(id, 2), childOf(id, 3)};
}

Selection whole() {
    return selectionOf({posZRoot}, {});
}
Selection inChildren() {
    return selectionOf(childrenOf(posZRoot), {posZRoot});
}

struct Seen {
    ChunkId chunk;
    LodChangeType type;
    auto operator<=>(const Seen&) const = default;
};

std::vector<Seen> seen(const LodChanges& changes) {
    std::vector<Seen> all;
    for (const LodChange& change : changes.recent()) all.push_back({change.chunk, change.type});
    return all;
}

TEST(LodChanges, ASplitAndAMergeAreCountedOnce) {
    LodChanges changes;
    changes.add(whole(), 0);
    EXPECT_TRUE(changes.recent().empty());
    changes.add(inChildren(), 2);
    changes.add(inChildren(), 2.1);
    EXPECT_THAT(seen(changes), testing::ElementsAre(Seen{posZRoot, LodChangeType::Split}));
    EXPECT_EQ(changes.splitsPerS(), 1);
    EXPECT_EQ(changes.mergesPerS(), 0);
    changes.add(whole(), 4);
    changes.add(whole(), 4.1);
    EXPECT_THAT(seen(changes), testing::ElementsAre(Seen{posZRoot, LodChangeType::Split},
                                                    Seen{posZRoot, LodChangeType::Merge}));
    EXPECT_EQ(changes.recent().back().timeS, 4);
    EXPECT_EQ(changes.splitsPerS(), 0);
    EXPECT_EQ(changes.mergesPerS(), 1);
}

TEST(LodChanges, TheFirstSelectionChangesNothing) {
    LodChanges changes;
    changes.add(inChildren(), 5);
    EXPECT_TRUE(changes.recent().empty());
}

TEST(LodChanges, WhatIsCulledOrComesIntoViewIsNoChange) {
    const Selection nothing = selectionOf({}, {});
    LodChanges changes;
    changes.add(whole(), 0);
    changes.add(nothing, 1);
    changes.add(inChildren(), 2);  // split while out of view
    changes.add(nothing, 3);
    changes.add(whole(), 4);
    // One child is culled, then the others, then all are back.
    changes.add(nothing, 5);
    changes.add(inChildren(), 6);
    changes.add(selectionOf({childOf(posZRoot, 1), childOf(posZRoot, 2), childOf(posZRoot, 3)}, {posZRoot}),
                7);
    changes.add(inChildren(), 8);
    EXPECT_TRUE(changes.recent().empty());
}

TEST(LodChanges, AJumpOverSeveralLevelsCountsEachChunk) {
    const ChunkId child = childOf(posZRoot, 2);
    const ChunkId grandchild = childOf(child, 1);
    std::vector<ChunkId> drawn = childrenOf(grandchild);
    for (const int q : {0, 2, 3}) drawn.push_back(childOf(child, q));
    for (const int q : {0, 1, 3}) drawn.push_back(childOf(posZRoot, q));
    const Selection deep = selectionOf(drawn, {posZRoot, child, grandchild});
    LodChanges changes;
    changes.add(whole(), 0);
    changes.add(deep, 1);
    EXPECT_EQ(changes.splitsPerS(), 3);
    changes.add(whole(), 5);
    EXPECT_EQ(changes.mergesPerS(), 3);
    EXPECT_THAT(seen(changes),
                testing::UnorderedElementsAre(
                    Seen{posZRoot, LodChangeType::Split}, Seen{child, LodChangeType::Split},
                    Seen{grandchild, LodChangeType::Split}, Seen{posZRoot, LodChangeType::Merge},
                    Seen{child, LodChangeType::Merge}, Seen{grandchild, LodChangeType::Merge}));
    EXPECT_EQ(changes.thrashTotal(), 0u);
}

TEST(LodChanges, AChunkThatFlipsBackWithinASecondThrashes) {
    LodChanges changes;
    changes.add(whole(), 10);
    changes.add(inChildren(), 11);
    changes.add(whole(), 11.9);
    EXPECT_EQ(changes.thrashTotal(), 1u);
    EXPECT_FALSE(changes.recent().front().thrash);
    EXPECT_TRUE(changes.recent().back().thrash);
    changes.add(inChildren(), 12.5);
    EXPECT_EQ(changes.thrashTotal(), 2u);
    EXPECT_EQ(changes.thrashRecent(), 2u);
}

TEST(LodChanges, AChunkThatFlipsBackLaterDoesNotThrash) {
    LodChanges changes;
    double timeS = 0;
    for (int i = 0; i < 6; ++i, timeS += 1.1) changes.add(i % 2 ? inChildren() : whole(), timeS);
    EXPECT_EQ(changes.recent().size(), 5u);
    EXPECT_EQ(changes.thrashTotal(), 0u);
}

TEST(LodChanges, TwoChunksThatTakeTurnsDoNotThrash) {
    const ChunkId other{Face::NegX, 0, 0, 0};
    const auto both = [&](bool rootSplit, bool otherSplit) {
        std::vector<ChunkId> drawn = rootSplit ? childrenOf(posZRoot) : std::vector<ChunkId>{posZRoot};
        const std::vector<ChunkId> more = otherSplit ? childrenOf(other) : std::vector<ChunkId>{other};
        drawn.insert(drawn.end(), more.begin(), more.end());
        std::vector<ChunkId> splits;
        if (rootSplit) splits.push_back(posZRoot);
        if (otherSplit) splits.push_back(other);
        return selectionOf(drawn, splits);
    };
    LodChanges changes;
    changes.add(both(false, true), 0);
    changes.add(both(true, true), 0.1);
    changes.add(both(true, false), 0.2);
    EXPECT_EQ(changes.recent().size(), 2u);
    EXPECT_EQ(changes.thrashTotal(), 0u);
}

TEST(LodChanges, OldChangesAreForgottenAndTheTotalIsNot) {
    LodChanges changes;
    changes.add(whole(), 0);
    changes.add(inChildren(), 0.5);
    changes.add(whole(), 1);
    changes.add(whole(), 1 + LodChanges::keptS);
    EXPECT_EQ(changes.recent().size(), 1u);
    EXPECT_EQ(changes.thrashRecent(), 1u);
    changes.add(whole(), 1.1 + LodChanges::keptS);
    EXPECT_TRUE(changes.recent().empty());
    EXPECT_EQ(changes.thrashRecent(), 0u);
    EXPECT_EQ(changes.thrashTotal(), 1u);
    changes.add(inChildren(), 1.2 + LodChanges::keptS);
    EXPECT_EQ(changes.recent().size(), 1u);
    EXPECT_EQ(changes.thrashTotal(), 1u);
}

TEST(LodChanges, ClearAndATimeBeforeTheLastForgetEverything) {
    LodChanges changes;
    changes.add(whole(), 5);
    changes.add(inChildren(), 6);
    changes.add(whole(), 6.5);
    changes.add(inChildren(), 1);
    EXPECT_TRUE(changes.recent().empty());
    EXPECT_EQ(changes.thrashTotal(), 0u);
    changes.add(whole(), 2);
    EXPECT_EQ(changes.recent().size(), 1u);
    changes.clear();
    changes.add(inChildren(), 2.1);
    EXPECT_TRUE(changes.recent().empty());
    EXPECT_EQ(changes.splitsPerS(), 0);
}

// A chunk covered by one that is drawn, by its definition.
bool covered(const std::set<ChunkId>& drawn, ChunkId id) {
    while (!drawn.contains(id) && id.level > 0) id = parentOf(id);
    return drawn.contains(id);
}

TEST(LodChanges, OfRealSelectionsEachChangeIsFound) {
    std::mt19937 random(61);
    std::size_t found = 0;
    for (int i = 0; i < 120; ++i) {
        View view = randomView(random, 1e5);
        LodChanges changes;
        LodSettings settings = suddenLod();
        std::set<ChunkId> drawn;
        std::set<ChunkId> splits;
        for (int frame = 0; frame < 4; ++frame) {
            settings.tauPx = 1 + static_cast<double>(random() % 8);
            view.eyeM *= 1.02;
            const Selection selection = select(wholeTree(), view, settings);
            changes.add(selection, frame * 20.0);
            const auto ids = drawnIds(selection);
            std::set<ChunkId> drawnNow(ids.begin(), ids.end());
            std::set<ChunkId> splitsNow = splitIds(selection);
            std::set<Seen> expected;
            for (const ChunkId& id : splitsNow) {
                if (!splits.contains(id) && covered(drawn, id)) expected.insert({id, LodChangeType::Split});
            }
            for (const ChunkId& id : splits) {
                if (!splitsNow.contains(id) && covered(drawnNow, id))
                    expected.insert({id, LodChangeType::Merge});
            }
            const std::vector<Seen> got = seen(changes);
            EXPECT_EQ(std::set<Seen>(got.begin(), got.end()), expected);
            EXPECT_EQ(got.size(), expected.size());
            found += got.size();
            drawn = std::move(drawnNow);
            splits = std::move(splitsNow);
        }
    }
    EXPECT_GT(found, 500u);
}

}  // namespace
}  // namespace planet
