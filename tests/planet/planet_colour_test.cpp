// Tiles of colour beside chunks in one planet: what is wanted, what is resident, and what a pool is told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "planet/paging/tile_paging.h"
#include "planet/planet_tools.h"
#include "planet/select/tile_select.h"
#include "tests/support/held_tiles.h"
#include "tests/support/planet_fixture.h"

namespace planet {
namespace {

using testing::HasSubstr;

constexpr int leafOfFile = 6;

// A tile whose texels begin with its own name.
TileData fakeTile(const ChunkId& id) {
    TileData tile{id, {}, std::vector<std::byte>(colourTileBytes(ColourFormat::Bc1))};
    if (id.level < leafOfFile) tile.children = {1000 + keyOf(id) % 100'000, 77};
    const std::uint64_t key = keyOf(id);
    std::memcpy(tile.texels.data(), &key, sizeof key);
    return tile;
}

Result<TileBlock> loadFakeTiles(const ChunkId& parent, BlockLocation location) {
    if (location != fakeTile(parent).children) return badInput("wrong place for " + toString(parent));
    TileBlock block;
    for (int q = 0; q < quadrantCount; ++q) block[static_cast<std::size_t>(q)] = fakeTile(childOf(parent, q));
    return block;
}

PlanetSource colouredSource(LoadColours load = loadFakeTiles) {
    PlanetSource source = fakePyramid().source();
    source.colour =
        ColourPyramid{.format = ColourFormat::Bc1, .leafLevel = leafOfFile, .roots = {}, .source = {}};
    for (const Face face : allFaces)
        source.colourRoots[static_cast<std::size_t>(face)] = fakeTile({face, 0, 0, 0});
    source.loadColours = std::move(load);
    return source;
}

PagingSettings roomForColourTiles(std::uint32_t tiles) {
    PagingSettings settings;
    settings.budgetBytes = 2 * bytesOf(20'000);
    settings.colourShare = 0.5;
    settings.maxColourTiles = tiles;
    return settings;
}

ViewInput coloured(const View& view, double texelsPerPixel = 1) {
    return {.lodView = view,
            .lod = fineSettings(),
            .colours = {.enabled = true, .texelsPerPixel = texelsPerPixel}};
}

bool colouredSettled(Planet& planet, const View& view, double texelsPerPixel = 1) {
    const ViewInput input = coloured(view, texelsPerPixel);
    return planet.settle({&input, 1}, noUpload, timeoutS);
}

struct ColourPool : HeldTiles {
    std::set<ChunkId> checkers;

    void follow(Planet& planet) {
        HeldTiles::follow(planet.takeTileChanges(BlockKind::Colours), [this](const TileData& tile) {
            if (tile.texels == checkerTexels(ColourFormat::Bc1)) checkers.insert(tile.id);
        });
    }
};

void expectHolds(const Planet& planet, const ColourPool& pool) {
    expectHolds(planet.tiles(BlockKind::Colours), planet.paging()[BlockKind::Colours].capacity, pool);
}

// The tiles that a view shows, whatever may be resident under them.
std::set<ChunkId> shown(const Planet& planet) {
    const TileTree& tree = planet.tiles(BlockKind::Colours);
    std::set<ChunkId> ids;
    for (const NodeIndex i : planet.views()[0].colours.touched) ids.insert(tree.nodes[i].id);
    for (const ChildrenRequest& split : planet.views()[0].colours.splits) ids.erase(split.parentId);
    return ids;
}

TEST(PlanetColours, SettlesOnAsManyTexelsAsAreWantedOrAsThereAre) {
    const auto planet = Planet::open(colouredSource(), roomForColourTiles(800)).value();
    ColourPool pool;
    const View view = viewAt(20, 30, 40'000, -70);
    for (const double wanted : {0.4, 0.8, 1.2}) {
        ASSERT_TRUE(colouredSettled(*planet, view, wanted));
        pool.follow(*planet);
        expectHolds(*planet, pool);
        const TileSelection& selection = planet->views()[0].colours;
        EXPECT_TRUE(selection.requests.empty());
        EXPECT_EQ(selection.counters.waiting, 0u);
        EXPECT_GT(selection.counters.deepestLevel, 1u);
        EXPECT_GE(selection.counters.fewestTexelsPerPixel, wanted);
    }
}

TEST(PlanetColours, ATexelIsAsWideAsTheMapStretchesItAtMost) {
    const PlanetShape& shape = fakePyramid().shape;
    for (const int level : {0, 3, 6}) {
        const int cells = colourTileCells << level;
        const auto at = [&](int column, int row) {
            return shape.radiusM *
                   sphereFromCube(cubePoint(Face::PosY, 2.0 * column / cells - 1, 2.0 * row / cells - 1));
        };
        double widestM = 0;
        for (int i = 0; i < 64; ++i) {
            const int column = i * (cells - 1) / 63;
            for (const int row : {0, cells / 3, cells / 2})
                widestM = std::max(widestM, glm::length(at(column + 1, row) - at(column, row)));
        }
        EXPECT_LE(widestM, texelM(shape, level) * (1 + 1e-9));
        EXPECT_GE(widestM, texelM(shape, level) * 0.99);
    }
}

TEST(PlanetColours, ChunksAreChosenAsIfThereWereNone) {
    const auto withColours = Planet::open(colouredSource(), roomForColourTiles(800)).value();
    const auto plain = openFake();
    for (const double altitudeM : {1e7, 1e6, 1e5}) {
        const View view = viewAt(10, 50, altitudeM);
        ASSERT_TRUE(colouredSettled(*withColours, view));
        ASSERT_TRUE(plain->settle(view, fineSettings(), noUpload, timeoutS));
        EXPECT_EQ(drawn(*withColours), drawn(*plain));
    }
    EXPECT_EQ(withColours->paging()[BlockKind::Heights].resident,
              plain->paging()[BlockKind::Heights].resident);
}

TEST(PlanetColours, OffTheyAskForNothing) {
    const auto planet = Planet::open(colouredSource(), roomForColourTiles(800)).value();
    ASSERT_TRUE(planet->settle(viewAt(10, 50, 1e5), fineSettings(), noUpload, timeoutS));
    EXPECT_EQ(planet->tiles(BlockKind::Colours).residentTiles, 6u);
    EXPECT_EQ(planet->paging()[BlockKind::Colours].loaded, 0u);
}

TEST(PlanetColours, TheShareIsKeptOverAFlightAndTheMostWantedIsResident) {
    PagingSettings settings = roomForColourTiles(6 + 4 * 20);
    settings.time = PagingTime::Simulated;
    settings.badDisk = {.latencyMs = 20, .seed = 5};
    const auto planet = Planet::open(colouredSource(), settings).value();
    ColourPool pool;
    for (int i = 0; i < 400; ++i) {
        const ViewInput input = coloured(viewAt(20 + 0.05 * i, 30 + 0.4 * i, 60'000 - 100 * i, -60));
        planet->step({&input, 1}, noUpload, 1.0 / 60);
        pool.follow(*planet);
        expectHolds(*planet, pool);
        if (HasFailure()) return;
    }
    EXPECT_GT(planet->paging()[BlockKind::Colours].evicted, 10u);
    ASSERT_TRUE(colouredSettled(*planet, viewAt(40, 190, 2e4, -60), 2));
    pool.follow(*planet);
    expectHolds(*planet, pool);
    // What waits is wanted no more than half as much again as what is there.
    ASSERT_GT(planet->paging()[BlockKind::Colours].budgetWaits, 0u);
    const TileSelection& selection = planet->views()[0].colours;
    float leastSplit = 1e9f;
    for (const ChildrenRequest& split : selection.splits) leastSplit = std::min(leastSplit, split.priority);
    ASSERT_FALSE(selection.requests.empty());
    EXPECT_LE(selection.requests.front().priority, 1.5f * leastSplit);
}

TEST(PlanetColours, ABlockThatCannotBeReadIsALoudCheckerAndTheRestGoesOn) {
    std::atomic<bool> broken = true;
    const ChunkId bad{Face::PosX, 1, 1, 1};
    PagingSettings settings = roomForColourTiles(800);
    settings.retry.retries = 0;
    const auto planet =
        Planet::open(colouredSource([&](const ChunkId& parent, BlockLocation location) {
                         if (broken && parent == bad)
                             return Result<TileBlock>(ioError("colours of x_pos/1/1/1 are gone"));
                         return loadFakeTiles(parent, location);
                     }),
                     settings)
            .value();
    ColourPool pool;
    const View view = viewAt(20, 20, 40'000, -70);
    ASSERT_TRUE(colouredSettled(*planet, view));
    pool.follow(*planet);
    expectHolds(*planet, pool);
    EXPECT_THAT(planet->takeProblems(), testing::ElementsAre(HasSubstr("x_pos/1/1/1 are gone")));
    ASSERT_EQ(pool.checkers.size(), 4u);
    for (const ChunkId& id : pool.checkers) EXPECT_EQ(parentOf(id), bad);
    EXPECT_EQ(planet->paging()[BlockKind::Colours].failed, 1u);
    broken = false;
    pool.checkers.clear();
    planet->tools().retryFailed();
    ASSERT_TRUE(colouredSettled(*planet, view));
    pool.follow(*planet);
    expectHolds(*planet, pool);
    EXPECT_TRUE(pool.checkers.empty());
    EXPECT_TRUE(planet->takeProblems().empty());
    EXPECT_GT(planet->views()[0].colours.counters.deepestLevel, 2u);
}

TEST(PlanetColours, DroppedOrReloadedTheyComeAgain) {
    const auto planet = Planet::open(colouredSource(), roomForColourTiles(800)).value();
    ColourPool pool;
    const View view = viewAt(20, 20, 40'000, -70);
    ASSERT_TRUE(colouredSettled(*planet, view));
    pool.follow(*planet);
    const std::set<ChunkId> before = shown(*planet);
    const auto comesAgain = [&] {
        pool.follow(*planet);
        EXPECT_EQ(pool.tiles.size(), 6u);
        ASSERT_TRUE(colouredSettled(*planet, view));
        pool.follow(*planet);
        expectHolds(*planet, pool);
        EXPECT_EQ(shown(*planet), before);
    };
    planet->tools().dropAll();
    comesAgain();
    planet->reloadTiles(BlockKind::Colours);
    comesAgain();
    planet->tools().reset();
    comesAgain();
    PagingSettings fewer = planet->pagingSettings();
    fewer.maxColourTiles = 500;
    ASSERT_TRUE(planet->setPaging(fewer));
    EXPECT_EQ(planet->paging()[BlockKind::Colours].capacity, 498u);
    comesAgain();
}

void expectTotalsOfEachKindAddUp(const Planet& planet) {
    const BlockCounters& heights = planet.paging()[BlockKind::Heights];
    EXPECT_EQ(faceCount + quadrantCount * (heights.loaded - heights.evicted), heights.resident);
    const BlockCounters& colours = planet.paging()[BlockKind::Colours];
    EXPECT_EQ(faceCount + quadrantCount * (colours.loaded - colours.evicted), colours.resident);
    EXPECT_EQ(planet.paging().bytesRead(), heights.bytesRead + colours.bytesRead);
}

TEST(PlanetColours, TotalsOfEachKindCountThatKindAlone) {
    PagingSettings settings = roomForColourTiles(6 + 4 * 20);
    settings.time = PagingTime::Simulated;
    const auto planet = Planet::open(colouredSource(), settings).value();
    for (int i = 0; i < 200; ++i) {
        const ViewInput input = coloured(viewAt(20 + 0.1 * i, 30 + 0.8 * i, 60'000 - 200 * i, -60));
        planet->step({&input, 1}, noUpload, 1.0 / 60);
        expectTotalsOfEachKindAddUp(*planet);
        if (HasFailure()) return;
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].loaded, 0u);
    EXPECT_GT(planet->paging()[BlockKind::Colours].evicted, 10u);
    planet->tools().dropAll();
    expectTotalsOfEachKindAddUp(*planet);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].evicted, planet->paging()[BlockKind::Heights].loaded);
    EXPECT_EQ(planet->paging()[BlockKind::Colours].evicted, planet->paging()[BlockKind::Colours].loaded);
    planet->setPaging(roomForColourTiles(6 + 4 * 24)).value();
    expectTotalsOfEachKindAddUp(*planet);
    ASSERT_TRUE(colouredSettled(*planet, viewAt(20, 20, 40'000, -70)));
    expectTotalsOfEachKindAddUp(*planet);
    ASSERT_GT(planet->paging()[BlockKind::Heights].loaded, planet->paging()[BlockKind::Heights].evicted);
    planet->tools().reset();
    const ViewInput far = coloured(viewAt(20, 20, 1e8));
    planet->step({&far, 1}, noUpload, 0);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].resident, faceCount);
    expectTotalsOfEachKindAddUp(*planet);
}

TEST(PlanetColours, ACheckerPatternIsNeitherLoadedNorEvicted) {
    PagingSettings settings = roomForColourTiles(800);
    settings.retry.retries = 0;
    const auto planet = Planet::open(colouredSource([](const ChunkId& parent, BlockLocation location) {
                                         if (parent.level > 0) return Result<TileBlock>(ioError("gone"));
                                         return loadFakeTiles(parent, location);
                                     }),
                                     settings)
                            .value();
    ASSERT_TRUE(colouredSettled(*planet, viewAt(20, 20, 40'000, -70)));
    const std::uint64_t loaded = planet->paging()[BlockKind::Colours].loaded;
    EXPECT_LE(loaded, faceCount);
    EXPECT_GT(planet->paging()[BlockKind::Colours].resident, faceCount + quadrantCount * loaded);
    planet->tools().dropAll();
    EXPECT_EQ(planet->paging()[BlockKind::Colours].evicted, loaded);
}

TEST(PlanetColours, SettingsThatLeaveTooLittleRoomAreRefused) {
    const auto tooFew = Planet::open(colouredSource(), roomForColourTiles(20));
    ASSERT_FALSE(tooFew);
    EXPECT_THAT(tooFew.error().message,
                HasSubstr("budget too small for this planet: 20 colour tiles; expected at least"));
    PagingSettings settings = roomForColourTiles(800);
    settings.colourShare = 0.95;
    const auto tooLarge = Planet::open(colouredSource(), settings);
    ASSERT_FALSE(tooLarge);
    EXPECT_THAT(tooLarge.error().message, HasSubstr("colour share: 0.95 is out of range"));
    EXPECT_TRUE(
        Planet::open(fakePyramid().source(), roomForColourTiles(1)));  // without colours it does not matter
}

TEST(PlanetColours, AreUnpackedOnlyWhereEnoughOfThemFit) {
    const std::size_t tileBytes = colourTileBytes(ColourFormat::Lossless);
    const auto openWith = [](std::size_t colourBytes, bool unpacked) {
        PagingSettings settings = roomForColourTiles(2048);
        settings.budgetBytes = 2 * colourBytes;
        settings.unpackedColours = unpacked;
        return Planet::open(colouredSource(), settings).value();
    };
    const auto roomy = openWith(250 * tileBytes, true);
    EXPECT_TRUE(roomy->paging()[BlockKind::Colours].unpacked);
    EXPECT_LE(roomy->paging()[BlockKind::Colours].capacity, 250u);
    EXPECT_GE(roomy->paging()[BlockKind::Colours].capacity, 246u);
    EXPECT_FALSE(openWith(250 * tileBytes, false)->paging()[BlockKind::Colours].unpacked);
    const auto narrow = openWith(150 * tileBytes, true);
    EXPECT_FALSE(narrow->paging()[BlockKind::Colours].unpacked);
    EXPECT_GT(narrow->paging()[BlockKind::Colours].capacity, 250u);

    // A change of the budget repacks the tiles that are resident.
    const View view = viewAt(20, 20, 4e6, -90);
    ColourPool pool;
    ASSERT_TRUE(colouredSettled(*roomy, view));
    pool.follow(*roomy);
    PagingSettings less = roomy->pagingSettings();
    less.budgetBytes = 2 * 150 * tileBytes;
    ASSERT_TRUE(roomy->setPaging(less));
    EXPECT_FALSE(roomy->paging()[BlockKind::Colours].unpacked);
    ASSERT_TRUE(colouredSettled(*roomy, view));
    pool.follow(*roomy);
    expectTotalsOfEachKindAddUp(*roomy);
}

// As a recording does: what the loaders did is done again on a planet whose time is recorded.
TEST(PlanetColours, ARecordingOfThemIsFollowedExactly) {
    PagingSettings settings = roomForColourTiles(6 + 4 * 30);
    settings.time = PagingTime::Simulated;
    settings.badDisk = {.latencyMs = 30, .failureRate = 0.05, .shuffledOrder = true, .seed = 9};
    const auto planet = Planet::open(colouredSource(), settings).value();
    settings.time = PagingTime::Recorded;
    const auto other = Planet::open(colouredSource(), settings).value();
    const std::size_t ofColours = followExactly(
        *planet, *other, BlockKind::Colours, 200, 1.0 / 60,
        [](int i) { return coloured(viewAt(20, 30 + 0.3 * i, 40'000, -60)); },
        [&](int i) { EXPECT_EQ(shown(*other), shown(*planet)) << i; });
    EXPECT_GT(ofColours, 20u);
    EXPECT_GT(planet->paging()[BlockKind::Colours].failed, 0u);
}

// A tile that holds the eye in its bounds is wanted more than the one above it, whose bounds may not.
TEST(PlanetColours, ABlockIsNotDroppedForWhatIsToComeUnderIt) {
    TilePaging tiles(BlockKind::Colours);
    tiles.leafLevel = leafOfFile;
    tiles.checkers = ColourFormat::Bc1;
    for (const Face face : allFaces) tiles.roots[static_cast<std::size_t>(face)] = fakeTile({face, 0, 0, 0});
    tiles.begin(faceCount + quadrantCount, 0);
    PagingQueue queue;
    PagingRun run{.frame = 1};
    const auto request = [&](const ChunkId& parent, float priority,
                             const std::vector<MergedRequest>& splits) {
        const MergedRequest wanted{findTile(tiles.tree, parent), parent, priority};
        tiles.request(queue, {{wanted}, splits}, run);
    };
    const ChunkId root{Face::PosX, 0, 0, 0}, child = childOf(root, 2);
    request(root, 2, {});
    std::optional<PagingRequest> taken = queue.pop({root, BlockKind::Colours});
    ASSERT_TRUE(taken);
    tiles.finish({*taken, loadFakeTiles(root, fakeTile(root).children).value()}, run, noUpload);
    tiles.use({0, findTile(tiles.tree, child)}, 1);
    const MergedRequest split{findTile(tiles.tree, root), root, 2};
    request(child, 100, {split});
    EXPECT_EQ(queue.count(PagingType::PageIn), 0u);
    EXPECT_EQ(tiles.counters().budgetWaits, 1u);
    EXPECT_NE(findTile(tiles.tree, child), noNode);
    // Elsewhere it yields.
    const ChunkId other{Face::NegX, 0, 0, 0};
    request(other, 100, {split});
    EXPECT_TRUE(queue.find({other, BlockKind::Colours}));
    EXPECT_EQ(findTile(tiles.tree, child), noNode);
}

TEST(PlanetColours, AChunksBlockAndATilesOfTheSameNameAreTwoRequests) {
    PagingQueue queue;
    const ChunkId id{Face::PosX, 1, 0, 1};
    EXPECT_EQ(queue.submit({.parent = id, .priority = 1}), SubmitOutcome::Added);
    EXPECT_EQ(queue.submit({.parent = id, .kind = BlockKind::Colours, .priority = 2}), SubmitOutcome::Added);
    EXPECT_EQ(queue.count(PagingType::PageIn), 2u);
    EXPECT_EQ(queue.worst(PagingType::PageIn)->kind, BlockKind::Heights);
    EXPECT_EQ(queue.worst(PagingType::PageIn, BlockKind::Colours)->priority, 2);
    EXPECT_EQ(queue.popBest(PagingType::PageIn)->kind, BlockKind::Colours);
    EXPECT_EQ(queue.worst(PagingType::PageIn, BlockKind::Colours), nullptr);
    EXPECT_TRUE(queue.find(id));
    EXPECT_FALSE(queue.find({id, BlockKind::Colours}));
}

}  // namespace
}  // namespace planet
