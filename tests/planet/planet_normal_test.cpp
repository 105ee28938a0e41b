// Tiles of normals beside chunks in one planet: what is wanted, what is resident, and what a pool is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <set>

#include "planet/paging/normal_tile.h"
#include "planet/planet_tools.h"
#include "tests/support/held_tiles.h"
#include "tests/support/made_chunks.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/sudden_lod.h"

namespace planet {
namespace {

using test::MadeChunks;
using testing::HasSubstr;

double hillsM(const glm::dvec3& d) {
    return 900 * std::sin(3 * d.x + 1) * std::cos(4 * d.y) + 200 * std::sin(31 * d.z + 9 * d.x);
}

// 1024 cells a face: tiles of levels 0 to 2.
MadeChunks madeChunks(int faceCellsLog2 = 10) {
    return {{.radiusM = 1e5,
             .quantumM = 0.1,
             .baseHeightM = 0,
             .faceCellsLog2 = faceCellsLog2,
             .chunkCellsLog2 = 5},
            hillsM};
}

PagingSettings roomForNormalTiles(std::uint32_t tiles) {
    PagingSettings settings;
    settings.budgetBytes = std::size_t{128} << 20;
    settings.normals = true;
    settings.normalShare = 0.5;
    settings.maxNormalTiles = tiles;
    return settings;
}

ViewInput litFinely(const View& view, double texelsPerPixel = 1) {
    LodSettings coarse = suddenLod();
    coarse.tauPx = 200;
    return {.lodView = view, .lod = coarse, .normals = {.enabled = true, .texelsPerPixel = texelsPerPixel}};
}

bool litSettled(Planet& planet, const View& view, double texelsPerPixel = 1) {
    const ViewInput input = litFinely(view, texelsPerPixel);
    return planet.settle({&input, 1}, noUpload, timeoutS);
}

struct NormalPool : HeldTiles {
    void follow(Planet& planet) {
        HeldTiles::follow(planet.takeTileChanges(BlockKind::Normals), [](const TileData& tile) {
            EXPECT_EQ(tile.texels.size(), normalTileBytes) << toString(tile.id);
        });
    }
};

void expectHolds(const Planet& planet, const NormalPool& pool) {
    expectHolds(planet.tiles(BlockKind::Normals), planet.paging()[BlockKind::Normals].capacity, pool);
}

TEST(PlanetNormals, SettleOnAsManyTexelsAsAreWantedWhateverTheChunks) {
    const MadeChunks made = madeChunks();
    const auto planet = Planet::open(made.source(), roomForNormalTiles(200)).value();
    NormalPool pool;
    for (const double wanted : {0.3, 0.6, 1.0}) {
        ASSERT_TRUE(litSettled(*planet, viewAt(20, 30, 240'000, -80), wanted));
        pool.follow(*planet);
        expectHolds(*planet, pool);
        const TileCounters& seen = planet->views()[0].normals.counters;
        EXPECT_EQ(seen.waiting, 0u);
        EXPECT_GE(seen.fewestTexelsPerPixel, wanted);
        EXPECT_GT(seen.deepestLevel, 0u);
    }
    EXPECT_EQ(planet->selection().counters.deepestLevel, 0u);
    EXPECT_GT(planet->paging()[BlockKind::Normals].bytesRead, 0u);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].bytesRead, 0u);
    EXPECT_EQ(planet->paging().bytesRead(), planet->paging()[BlockKind::Normals].bytesRead);
    const PagingEvent& last = planet->inspect().pagingHistory().back();
    EXPECT_EQ(last.kind, BlockKind::Normals);
    EXPECT_THAT(toString(BlockId{last.parent, last.kind}), HasSubstr(" (normals)"));
}

TEST(PlanetNormals, OffTheyTakeNoRoomAndComeAndGoLive) {
    const MadeChunks made = madeChunks();
    PagingSettings settings = roomForNormalTiles(200);
    settings.budgetBytes = std::size_t{64} << 20;  // less than all chunks and tiles
    settings.normals = false;
    const auto planet = Planet::open(made.source(), settings).value();
    const std::uint32_t allSlots = planet->paging()[BlockKind::Heights].capacity;
    NormalPool pool;
    const View view = viewAt(20, 30, 60'000, -80);
    ASSERT_TRUE(litSettled(*planet, view));
    EXPECT_TRUE(planet->tiles(BlockKind::Normals).nodes.empty());
    EXPECT_EQ(planet->paging()[BlockKind::Normals].capacity, 0u);
    EXPECT_EQ(planet->paging()[BlockKind::Normals].bytesRead, 0u);
    EXPECT_TRUE(planet->takeTileChanges(BlockKind::Normals).empty());
    EXPECT_EQ(normalLeafLevel(planet->tree().storedShape), 2);

    settings.normals = true;
    ASSERT_TRUE(planet->setPaging(settings).value());
    EXPECT_LT(planet->paging()[BlockKind::Heights].capacity, allSlots);
    ASSERT_TRUE(litSettled(*planet, view));
    pool.follow(*planet);
    expectHolds(*planet, pool);
    EXPECT_GT(pool.tiles.size(), 6u);

    settings.normals = false;
    ASSERT_TRUE(planet->setPaging(settings).value());
    EXPECT_EQ(planet->paging()[BlockKind::Heights].capacity, allSlots);
    EXPECT_TRUE(planet->tiles(BlockKind::Normals).nodes.empty());
    EXPECT_EQ(planet->paging()[BlockKind::Normals].capacity, 0u);
    EXPECT_TRUE(planet->takeTileChanges(BlockKind::Normals).empty());
}

// A planet whose roots of normals take a while to read, as on a large file.
struct SlowlyRead {
    MadeChunks made = madeChunks();
    Gate gate;
    std::atomic<int> reads = 0;
    std::unique_ptr<Planet> planet;

    explicit SlowlyRead(PagingSettings settings) {
        PlanetSource source = made.source();
        source.loadChildren = [this, load = source.loadChildren](const ChunkId& parent,
                                                                 BlockLocation location, StepsView heights) {
            ++reads;
            gate.pass();
            return load(parent, location, heights);
        };
        settings.normals = false;
        planet = Planet::open(std::move(source), settings).value();
    }
    ~SlowlyRead() { gate.open(); }
};

TEST(PlanetNormals, TurnedOnTheyAreNotWaitedFor) {
    PagingSettings settings = roomForNormalTiles(200);
    SlowlyRead slow(settings);
    Planet& planet = *slow.planet;
    ASSERT_TRUE(planet.setPaging(settings).has_value());
    EXPECT_TRUE(planet.inspect().normalsArePending());
    const ViewInput input = litFinely(viewAt(20, 30, 60'000, -80));
    planet.step({&input, 1}, noUpload, 1.0 / 30);
    EXPECT_FALSE(planet.settled());
    EXPECT_EQ(planet.paging()[BlockKind::Normals].capacity, 0u);
    slow.gate.open();
    ASSERT_TRUE(litSettled(planet, input.lodView));
    EXPECT_FALSE(planet.inspect().normalsArePending());
    NormalPool pool;
    pool.follow(planet);
    expectHolds(planet, pool);
    EXPECT_GT(pool.tiles.size(), 6u);
}

TEST(PlanetNormals, TurnedOffAndOnTheirRootsAreKept) {
    PagingSettings settings = roomForNormalTiles(200);
    SlowlyRead slow(settings);
    slow.gate.open();
    Planet& planet = *slow.planet;
    const View view = viewAt(20, 30, 60'000, -80);
    ASSERT_TRUE(planet.setPaging(settings).has_value());
    ASSERT_TRUE(litSettled(planet, view));
    for (const bool on : {false, true}) {
        settings.normals = on;
        const int before = slow.reads;
        ASSERT_TRUE(planet.setPaging(settings).has_value());
        EXPECT_EQ(slow.reads, before);
        EXPECT_FALSE(planet.inspect().normalsArePending());
    }
    NormalPool pool;
    pool.follow(planet);
    EXPECT_EQ(pool.tiles.size(), 6u);
}

// A recording must not depend on when a thread ends.
TEST(PlanetNormals, WhereStepsAreRecordedTheirRootsAreThereAtOnce) {
    PagingSettings settings = roomForNormalTiles(200);
    SlowlyRead slow(settings);
    slow.gate.open();
    Planet& planet = *slow.planet;
    planet.tools().keepMoves(true);
    ASSERT_TRUE(planet.setPaging(settings).has_value());
    EXPECT_FALSE(planet.inspect().normalsArePending());
    EXPECT_GT(planet.paging()[BlockKind::Normals].capacity, 0u);
}

TEST(PlanetNormals, ARecordingThatBeginsWhileTheyAreDerivedWaitsForThem) {
    PagingSettings settings = roomForNormalTiles(200);
    SlowlyRead slow(settings);
    Planet& planet = *slow.planet;
    ASSERT_TRUE(planet.setPaging(settings).has_value());
    EXPECT_TRUE(planet.inspect().normalsArePending());
    slow.gate.open();
    planet.tools().keepMoves(true);
    EXPECT_FALSE(planet.inspect().normalsArePending());
    EXPECT_GT(planet.paging()[BlockKind::Normals].capacity, 0u);
}

TEST(PlanetNormals, TheShareIsKeptOverAFlightAndNothingTakesTurns) {
    const MadeChunks made = madeChunks();
    PagingSettings settings = roomForNormalTiles(6 + 4 * 8);
    settings.time = PagingTime::Simulated;
    settings.badDisk = {.latencyMs = 20, .seed = 5};
    const auto planet = Planet::open(made.source(), settings).value();
    ASSERT_EQ(planet->paging()[BlockKind::Normals].capacity, 38u);
    NormalPool pool;
    for (int i = 0; i < 60; ++i) {
        const ViewInput input = litFinely(viewAt(20 + 0.1 * i, 30 + 1.5 * i, 40'000, -60));
        planet->step({&input, 1}, noUpload, 1.0 / 30);
        pool.follow(*planet);
        expectHolds(*planet, pool);
        if (HasFailure()) return;
    }
    EXPECT_GT(planet->paging()[BlockKind::Normals].evicted, 3u);
    const View still = viewAt(26, 120, 20'000, -60);
    ASSERT_TRUE(litSettled(*planet, still, 2));
    ASSERT_GT(planet->paging()[BlockKind::Normals].budgetWaits, 0u);
    const std::uint64_t loaded = planet->paging()[BlockKind::Normals].loaded;
    const ViewInput input = litFinely(still, 2);
    for (int i = 0; i < 60; ++i) planet->step({&input, 1}, noUpload, 1.0 / 30);
    EXPECT_EQ(planet->paging()[BlockKind::Normals].loaded, loaded);
}

TEST(PlanetNormals, ABlockOfHeightsThatCannotBeReadLeavesTheMeshAndSaysSo) {
    MadeChunks made = madeChunks();
    made.broken = ChunkId{Face::PosX, 4, 9, 9};
    const auto planet = Planet::open(made.source(), roomForNormalTiles(300)).value();
    NormalPool pool;
    const View view = viewAt(10, 10, 30'000, -80);
    ASSERT_TRUE(litSettled(*planet, view));
    pool.follow(*planet);
    expectHolds(*planet, pool);
    EXPECT_GT(planet->paging()[BlockKind::Normals].failed, 0u);
    const std::vector<std::string> problems = planet->takeProblems();
    ASSERT_FALSE(problems.empty());
    EXPECT_THAT(problems.front(), HasSubstr("normals of tile x_pos/"));
    EXPECT_THAT(problems.front(), HasSubstr("made.chk: the block of chunk x_pos/4/9/9 is damaged"));
    const std::uint64_t failed = planet->paging()[BlockKind::Normals].failed;
    made.broken.reset();
    planet->tools().retryFailed();
    ASSERT_TRUE(litSettled(*planet, view));
    EXPECT_EQ(planet->paging()[BlockKind::Normals].failed, failed);
    EXPECT_EQ(planet->views()[0].normals.counters.waiting, 0u);
    EXPECT_TRUE(planet->takeProblems().empty());
}

TEST(PlanetNormals, ABlockThatADiskFailsToReadIsTriedAgain) {
    MadeChunks made = madeChunks();
    made.broken = ChunkId{Face::PosX, 4, 9, 9};
    made.brokenBy = ErrorKind::Io;
    PagingSettings settings = roomForNormalTiles(300);
    settings.time = PagingTime::Simulated;
    settings.retry = {.retries = 3, .delayS = 0.5};
    const auto planet = Planet::open(made.source(), settings).value();
    const ViewInput input = litFinely(viewAt(10, 10, 30'000, -80));
    const auto awaiting = [&] {
        std::size_t ofNormals = 0;
        for (const FailedBlock& failed : planet->inspect().failedBlocks())
            ofNormals += failed.block.kind == BlockKind::Normals && failed.retryInS;
        return ofNormals;
    };
    for (int i = 0; i < 100 && awaiting() == 0; ++i) planet->step({&input, 1}, noUpload, 1.0 / 60);
    ASSERT_GT(awaiting(), 0u);
    EXPECT_GT(planet->paging()[BlockKind::Normals].failed, 0u);
    EXPECT_FALSE(planet->settled());
    made.broken.reset();
    ASSERT_TRUE(planet->settle({&input, 1}, noUpload, 100));
    EXPECT_TRUE(planet->inspect().failedBlocks().empty());
    EXPECT_TRUE(planet->takeProblems().empty());
    EXPECT_EQ(planet->views()[0].normals.counters.waiting, 0u);
    // And where the disk stays as it is the light is the mesh's.
    made.broken = ChunkId{Face::PosX, 4, 9, 9};
    const auto broken = Planet::open(made.source(), settings).value();
    ASSERT_TRUE(broken->settle({&input, 1}, noUpload, 100));
    EXPECT_GT(broken->paging().failedPermanently(), 0u);
    EXPECT_EQ(broken->paging().awaitingRetry(), 0u);
    for (const FailedBlock& failed : broken->inspect().failedBlocks()) EXPECT_EQ(failed.attempts, 4u);
    NormalPool pool;
    pool.follow(*broken);
    expectHolds(*broken, pool);
}

TEST(PlanetNormals, AFaceWhoseOwnTileCannotBeDerivedIsWithoutUntilItCan) {
    MadeChunks made = madeChunks(9);
    made.broken = ChunkId{Face::NegZ, 0, 0, 0};
    const auto planet = Planet::open(made.source(), roomForNormalTiles(30)).value();
    const auto arrivals = [&] {
        std::set<ChunkId> arrived;
        for (const TileChange& change : planet->takeTileChanges(BlockKind::Normals))
            for (const TileData& tile : change.arrived) arrived.insert(tile.id);
        return arrived;
    };
    // Those beside it need its samples too.
    EXPECT_EQ(arrivals(), (std::set<ChunkId>{{Face::PosZ, 0, 0, 0}}));
    EXPECT_EQ(planet->takeProblems().size(), 5u);
    made.broken.reset();
    planet->tools().retryFailed();
    EXPECT_EQ(arrivals().size(), 6u);
    EXPECT_TRUE(planet->takeProblems().empty());
}

TEST(PlanetNormals, WithoutRoomOrSamplesForATileTheRestGoesOn) {
    const MadeChunks made = madeChunks();
    PagingSettings tight = roomForNormalTiles(20);
    const auto planet = Planet::open(made.source(), tight).value();
    EXPECT_THAT(planet->takeProblems(),
                testing::ElementsAre(
                    HasSubstr("budget too small for this planet: 20 normal tiles; expected at least")));
    EXPECT_EQ(planet->paging()[BlockKind::Normals].capacity, 0u);
    ASSERT_TRUE(litSettled(*planet, viewAt(10, 10)));
    tight.uploadLimitMs = 3;
    EXPECT_TRUE(planet->setPaging(tight));
    EXPECT_TRUE(planet->takeProblems().empty());  // told once

    const auto small = Planet::open(fakePyramid().source(), roomForNormalTiles(2000)).value();
    EXPECT_EQ(normalLeafLevel(small->tree().storedShape), fakePyramid().shape.faceCellsLog2 - 8);
    const MadeChunks tiny = madeChunks(7);
    const auto without = Planet::open(tiny.source(), roomForNormalTiles(2000)).value();
    EXPECT_EQ(normalLeafLevel(without->tree().storedShape), -1);
    ASSERT_TRUE(litSettled(*without, viewAt(10, 10)));
    EXPECT_TRUE(without->takeTileChanges(BlockKind::Normals).empty());

    PagingSettings wrong = roomForNormalTiles(200);
    wrong.normalShare = 0.95;
    const auto refused = Planet::open(made.source(), wrong);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("normal share: 0.95 is out of range"));
}

TEST(PlanetNormals, DroppedOrReloadedTheyComeAgain) {
    const MadeChunks made = madeChunks();
    const auto planet = Planet::open(made.source(), roomForNormalTiles(126)).value();
    NormalPool pool;
    const View view = viewAt(20, 20, 60'000, -70);
    ASSERT_TRUE(litSettled(*planet, view));
    pool.follow(*planet);
    const auto before = pool.tiles.size();
    ASSERT_GT(before, 6u);
    const auto comesAgain = [&] {
        pool.follow(*planet);
        EXPECT_EQ(pool.tiles.size(), 6u);
        ASSERT_TRUE(litSettled(*planet, view));
        pool.follow(*planet);
        expectHolds(*planet, pool);
        EXPECT_EQ(pool.tiles.size(), before);
    };
    planet->tools().dropAll();
    comesAgain();
    planet->reloadTiles(BlockKind::Normals);
    comesAgain();
    planet->tools().reset();
    comesAgain();
}

TEST(PlanetNormals, ARecordingOfThemIsFollowedExactly) {
    const MadeChunks made = madeChunks();
    PagingSettings settings = roomForNormalTiles(6 + 4 * 6);
    settings.time = PagingTime::Simulated;
    settings.badDisk = {.latencyMs = 30, .failureRate = 0.1, .shuffledOrder = true, .seed = 9};
    const auto planet = Planet::open(made.source(), settings).value();
    settings.time = PagingTime::Recorded;
    const auto other = Planet::open(made.source(), settings).value();
    const std::size_t ofNormals = followExactly(
        *planet, *other, BlockKind::Normals, 60, 1.0 / 30,
        [](int i) { return litFinely(viewAt(20, 30 + 2 * i, 60'000, -60)); }, [](int) {});
    EXPECT_GT(ofNormals, 5u);
}

}  // namespace
}  // namespace planet
