// What a renderer would hold of a planet's tiles, and what tests ask of it: of colours as of normals.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <vector>

#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "tests/support/planet_fixture.h"

namespace planet {

struct HeldTiles {
    std::map<std::uint32_t, ChunkId> tiles;  // by slot

    // Each tile that arrives finds its slot empty.
    void follow(const std::vector<TileChange>& changes, const std::function<void(const TileData&)>& arrived) {
        for (const TileChange& change : changes) {
            if (change.resets) tiles.clear();
            if (change.gone) {
                std::erase_if(tiles, [&](const auto& slot) {
                    return slot.second.level == change.gone->level + 1 &&
                           parentOf(slot.second) == *change.gone;
                });
            }
            for (std::uint32_t i = 0; i < change.arrived.size(); ++i) {
                const TileData& tile = change.arrived[i];
                EXPECT_FALSE(tiles.contains(change.firstSlot + i)) << toString(tile.id);
                tiles[change.firstSlot + i] = tile.id;
                arrived(tile);
            }
        }
    }
};

// Each resident tile has a slot of its own that holds it, and nothing else is held.
inline void expectHolds(const TileTree& tree, std::uint32_t tileCapacity, const HeldTiles& held) {
    std::size_t resident = 0;
    for (NodeIndex i = 0; i < tree.nodes.size(); ++i) {
        if (i >= faceCount && tree.nodes[i].parent == noNode) continue;
        ++resident;
        const auto slot = held.tiles.find(tree.nodes[i].slot);
        ASSERT_TRUE(slot != held.tiles.end()) << toString(tree.nodes[i].id);
        EXPECT_EQ(slot->second, tree.nodes[i].id);
    }
    EXPECT_EQ(held.tiles.size(), resident);
    EXPECT_EQ(tree.residentTiles, resident);
    EXPECT_LE(resident, tileCapacity);
}

// Steps a planet of simulated time and lets one of recorded time, otherwise the same, do again what the
// loaders did. Returns how many blocks of a kind arrived.
inline std::size_t followExactly(Planet& planet, Planet& other, BlockKind kind, int steps, double stepS,
                                 const std::function<ViewInput(int step)>& viewOf,
                                 const std::function<void(int step)>& compare) {
    planet.tools().keepMoves(true);
    other.tools().keepMoves(true);
    std::size_t ofKind = 0;
    for (int i = 0; i < steps; ++i) {
        const ViewInput input = viewOf(i);
        planet.step({&input, 1}, noUpload, stepS);
        const PagingMoves moves = planet.tools().takeMoves();
        EXPECT_TRUE(other.tools().follow(moves)) << i;
        other.step({&input, 1}, noUpload, stepS);
        const PagingMoves again = other.tools().takeMoves();
        EXPECT_EQ(again.requested, moves.requested) << i;
        EXPECT_EQ(again.arrived, moves.arrived) << i;
        compare(i);
        if (testing::Test::HasFailure()) return ofKind;
        for (const PagingMoves::Arrival& arrival : moves.arrived) ofKind += arrival.block.kind == kind;
    }
    return ofKind;
}

}  // namespace planet
