#include "planet/sphere/chunk_id.h"

#include <gtest/gtest.h>

#include <set>

#include "planet/tree/chunk_table.h"

namespace planet {
namespace {

std::vector<ChunkId> allOfLevel(int level) {
    std::vector<ChunkId> ids;
    for (const Face face : allFaces) {
        for (std::uint32_t y = 0; y < 1u << level; ++y) {
            for (std::uint32_t x = 0; x < 1u << level; ++x) {
                ids.push_back({face, static_cast<std::uint8_t>(level), x, y});
            }
        }
    }
    return ids;
}

TEST(ChunkId, KeysAreUnique) {
    std::set<std::uint64_t> keys;
    std::size_t count = 0;
    for (int level = 0; level <= 4; ++level) {
        for (const ChunkId& id : allOfLevel(level)) {
            keys.insert(keyOf(id));
            ++count;
        }
    }
    EXPECT_EQ(keys.size(), count);
}

TEST(ChunkId, ChildrenKnowTheirParentAndQuadrant) {
    for (const ChunkId& id : allOfLevel(2)) {
        for (int quadrant = 0; quadrant < quadrantCount; ++quadrant) {
            const ChunkId child = childOf(id, quadrant);
            EXPECT_EQ(parentOf(child), id);
            EXPECT_EQ(quadrantOf(child), quadrant);
        }
    }
}

// Two chunks touch when two corners of one's edge are corners of the other.
int sharedCorners(const ChunkId& a, const ChunkId& b) {
    const auto corners = [](const ChunkId& id) {
        const FaceSquare s = faceSquareOf(id);
        std::array<glm::dvec3, 4> points;
        int n = 0;
        for (const double u : {s.u, s.u + s.side}) {
            for (const double v : {s.v, s.v + s.side})
                points[static_cast<std::size_t>(n++)] = cubePoint(id.face, u, v);
        }
        return points;
    };
    int shared = 0;
    for (const glm::dvec3& p : corners(a)) {
        for (const glm::dvec3& q : corners(b)) shared += p == q;
    }
    return shared;
}

TEST(ChunkId, NeighboursShareAnEdgeAndAreMutualAcrossFaces) {
    for (int level = 0; level <= 3; ++level) {
        for (const ChunkId& id : allOfLevel(level)) {
            std::set<ChunkId> neighbours;
            for (int edge = 0; edge < edgeCount; ++edge) {
                const ChunkId other = neighbourOf(id, static_cast<Edge>(edge));
                EXPECT_EQ(sharedCorners(id, other), 2) << toString(id) << " and " << toString(other);
                EXPECT_EQ(other.level, id.level);
                EXPECT_EQ(edgeTowards(id, other), static_cast<Edge>(edge));
                neighbours.insert(other);
                bool mutual = false;
                for (int back = 0; back < edgeCount; ++back)
                    mutual |= neighbourOf(other, static_cast<Edge>(back)) == id;
                EXPECT_TRUE(mutual);
            }
            EXPECT_EQ(neighbours.size(), 4u);
            EXPECT_EQ(edgeTowards(id, id), std::nullopt);
        }
    }
}

TEST(ChunkId, AncestorOfALevelIsTheChunkThatHoldsIt) {
    const ChunkId id{Face::NegZ, 5, 19, 30};
    EXPECT_EQ(ancestorOf(id, 5), id);
    EXPECT_EQ(ancestorOf(id, 9), id);
    EXPECT_EQ(ancestorOf(id, 3), (ChunkId{Face::NegZ, 3, 4, 7}));
    EXPECT_EQ(ancestorOf(id, 0), (ChunkId{Face::NegZ, 0, 0, 0}));
}

TEST(ChunkTable, FindsTheFinestThatHoldsAChunk) {
    const ChunkId id{Face::NegZ, 5, 19, 30};
    ChunkTable table(2);
    table.add(ancestorOf(id, 3), 30);
    EXPECT_EQ(*table.findHolder(id, 3), 30u);
    EXPECT_EQ(*table.findHolder(ancestorOf(id, 3), 3), 30u);
    EXPECT_EQ(table.findHolder(ancestorOf(id, 2), 2), nullptr);
    EXPECT_EQ(table.findHolder({Face::NegZ, 5, 0, 0}, 3), nullptr);
    table.add(id, 50);
    EXPECT_EQ(*table.findHolder(id, 3), 50u);
    EXPECT_EQ(*table.findHolder(ancestorOf(id, 4), 3), 30u);
}

TEST(ChunkId, TextRoundTripsAndNonsenseIsRefused) {
    for (const ChunkId& id : allOfLevel(3)) EXPECT_EQ(chunkIdFromString(toString(id)), id);
    for (const char* nonsense : {"", "x_pos", "x_pos/1/0", "x_pos/1/2/0", "x_pos/0/0/0/0", "q_pos/0/0/0",
                                 "x_pos/25/0/0", "x_pos/-1/0/0", "x_pos/1/0/x"}) {
        EXPECT_EQ(chunkIdFromString(nonsense), std::nullopt) << nonsense;
    }
}

}  // namespace
}  // namespace planet
