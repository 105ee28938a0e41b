// Blocks that cannot be read: tried again with longer and longer waits, then failed for good, remembered and
// shown until told to be tried again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "planet/paging/block_failures.h"
#include "planet/planet_tools.h"
#include "planet/tree/block_state.h"
#include "tests/support/planet_fixture.h"

namespace planet {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double retryStepS = 1.0 / 64;  // exact
const ChunkId posXRoot{Face::PosX, 0, 0, 0};

// A planet with colours of which told blocks fail, and which notes when each was read. Read by one thread at
// a time: that of simulated time, or the only loader.
struct Flaky {
    struct Failures {
        int left = 0;  // reads that fail from here on; below 0: all
        ErrorKind kind = ErrorKind::Io;
    };
    std::map<BlockId, Failures> failing;
    std::map<BlockId, std::vector<double>> readAtS;
    double nowS = 0;
    Planet* planet = nullptr;

    std::optional<Error> next(const BlockId& block) {
        readAtS[block].push_back(nowS);
        const auto found = failing.find(block);
        if (found == failing.end() || found->second.left == 0) return std::nullopt;
        if (found->second.left > 0) --found->second.left;
        return Error{found->second.kind, "fake.chk: " + toString(block) + ": the disk is bad"};
    }

    static TileData tile(const ChunkId& id) {
        TileData made{id, {}, std::vector<std::byte>(colourTileBytes(ColourFormat::Bc1))};
        if (id.level < 4) made.children = {1000, 77};
        return made;
    }

    PlanetSource source() {
        PlanetSource made = fakePyramid().source();
        made.loadChildren = [this](const ChunkId& parent, BlockLocation location,
                                   StepsView heights) -> Result<SiblingBlock> {
            if (auto error = next(parent)) return tl::unexpected(std::move(*error));
            return fakePyramid().load(parent, location, heights);
        };
        made.colour = ColourPyramid{.format = ColourFormat::Bc1, .leafLevel = 4, .roots = {}, .source = {}};
        for (const Face face : allFaces)
            made.colourRoots[static_cast<std::size_t>(face)] = tile({face, 0, 0, 0});
        made.loadColours = [this](const ChunkId& parent, BlockLocation) -> Result<TileBlock> {
            if (auto error = next({parent, BlockKind::Colours})) return tl::unexpected(std::move(*error));
            TileBlock block;
            for (int q = 0; q < quadrantCount; ++q)
                block[static_cast<std::size_t>(q)] = tile(childOf(parent, q));
            return block;
        };
        return made;
    }

    std::size_t reads(const BlockId& block) const {
        const auto found = readAtS.find(block);
        return found == readAtS.end() ? 0 : found->second.size();
    }
};

PagingSettings simulatedRetry(const RetryRules& retry) {
    PagingSettings settings;
    settings.time = PagingTime::Simulated;
    settings.retry = retry;
    return settings;
}

ViewInput inputOf(const View& view, bool colours = false) {
    return {.lodView = view, .lod = fineSettings(), .colours = {.enabled = colours, .texelsPerPixel = 1}};
}

void fly(Planet& planet, Flaky& flaky, double seconds, bool colours = false,
         const View& view = viewAt(10, 20)) {
    const ViewInput input = inputOf(view, colours);
    for (double flownS = 0; flownS < seconds; flownS += retryStepS) {
        flaky.nowS += retryStepS;
        planet.step({&input, 1}, noUpload, retryStepS);
    }
}

TEST(BlockState, TheDiagramHasTheseStepsAndNoOthers) {
    using enum ChildrenState;
    const std::map<ChildrenState, std::vector<ChildrenState>> steps = {
        {None, {}},
        {Absent, {Requested, AwaitingRetry, Failed}},
        {Requested, {Absent, Resident, AwaitingRetry, Failed}},
        {Resident, {Absent}},
        {AwaitingRetry, {Absent}},
        {Failed, {Absent}},
    };
    for (const auto& [from, allowed] : steps) {
        for (const auto& [to, ignored] : steps) {
            const bool there = std::find(allowed.begin(), allowed.end(), to) != allowed.end();
            EXPECT_EQ(isStep(from, to), there) << static_cast<int>(from) << " to " << static_cast<int>(to);
        }
    }
}

// Where there are assertions: not in a release.
TEST(BlockStateDeathTest, AStepThatIsNotInTheDiagramAsserts) {
    ChildrenState state = ChildrenState::Absent;
    EXPECT_DEBUG_DEATH(changeState(state, ChildrenState::Resident), "isStep");
}

TEST(Retries, delaysDoubleUntilTheBlockFailsPermanently) {
    Flaky flaky;
    flaky.failing[posXRoot] = {.left = -1};
    const auto planet = Planet::open(flaky.source(), simulatedRetry({.retries = 3, .delayS = 0.5})).value();
    fly(*planet, flaky, 20);
    // A read that is asked for in one step ends in the next.
    const std::vector<double>& atS = flaky.readAtS[posXRoot];
    ASSERT_THAT(atS, SizeIs(4));
    EXPECT_DOUBLE_EQ(atS[1] - atS[0], 0.5 + retryStepS);
    EXPECT_DOUBLE_EQ(atS[2] - atS[1], 1.0 + retryStepS);
    EXPECT_DOUBLE_EQ(atS[3] - atS[2], 2.0 + retryStepS);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 4u);
    EXPECT_EQ(planet->paging().failedPermanently(), 1u);
    EXPECT_EQ(planet->paging().awaitingRetry(), 0u);
    EXPECT_EQ(planet->tree().nodes[0].childrenState, ChildrenState::Failed);
    ASSERT_THAT(planet->inspect().failedBlocks(), SizeIs(1));
    const FailedBlock failed = planet->inspect().failedBlocks()[0];
    EXPECT_EQ(failed, (FailedBlock{posXRoot, 4, "fake.chk: x_pos/0/0/0: the disk is bad", std::nullopt}));
    EXPECT_THAT(planet->takeProblems(), ElementsAre(HasSubstr("the disk is bad (tried 4 times)")));
}

TEST(Retries, ABlockThatComesAfterAllIsForgottenAsIfItHadNeverFailed) {
    Flaky flaky;
    flaky.failing[posXRoot] = {.left = 2};
    const auto planet = Planet::open(flaky.source(), simulatedRetry({.retries = 3, .delayS = 0.5})).value();
    fly(*planet, flaky, 0.25);
    ASSERT_THAT(planet->inspect().failedBlocks(), SizeIs(1));
    EXPECT_EQ(planet->inspect().failedBlocks()[0].attempts, 1u);
    ASSERT_TRUE(planet->inspect().failedBlocks()[0].retryInS);
    EXPECT_GT(*planet->inspect().failedBlocks()[0].retryInS, 0.2);
    EXPECT_LT(*planet->inspect().failedBlocks()[0].retryInS, 0.5);
    EXPECT_EQ(planet->tree().nodes[0].childrenState, ChildrenState::AwaitingRetry);
    EXPECT_EQ(planet->paging().awaitingRetry(), 1u);
    EXPECT_FALSE(planet->settled());
    fly(*planet, flaky, 3);
    EXPECT_TRUE(planet->settled());
    EXPECT_EQ(flaky.reads(posXRoot), 3u);
    EXPECT_THAT(planet->inspect().failedBlocks(), IsEmpty());
    EXPECT_THAT(planet->takeProblems(), IsEmpty());
    EXPECT_EQ(planet->paging().awaitingRetry(), 0u);
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), fineSettings()));
}

TEST(Retries, corruptBlocksFailPermanentlyAtOnce) {
    Flaky flaky;
    flaky.failing[posXRoot] = {.left = -1, .kind = ErrorKind::BadInput};
    const auto planet = Planet::open(flaky.source(), simulatedRetry({})).value();
    fly(*planet, flaky, 20);
    EXPECT_EQ(flaky.reads(posXRoot), 1u);
    ASSERT_THAT(planet->inspect().failedBlocks(), SizeIs(1));
    EXPECT_FALSE(planet->inspect().failedBlocks()[0].retryInS);
    EXPECT_THAT(planet->takeProblems(), ElementsAre(testing::EndsWith("the disk is bad")));
}

TEST(Retries, AreAskedForByNameOrAllTogether) {
    Flaky flaky;
    const ChunkId other{Face::PosY, 0, 0, 0};
    flaky.failing[posXRoot] = flaky.failing[other] = {.left = -1};
    LodSettings all = fineSettings();
    all.frustumCulling = all.horizonCulling = false;
    all.tauPx = 0.02;
    const auto planet = Planet::open(flaky.source(), simulatedRetry({.retries = 0})).value();
    ASSERT_TRUE(planet->settle(viewAt(10, 20), all, noUpload, 100));
    ASSERT_THAT(planet->inspect().failedBlocks(), SizeIs(2));
    planet->tools().retryFailed(posXRoot);
    EXPECT_FALSE(planet->settled());
    EXPECT_THAT(planet->inspect().failedBlocks(), SizeIs(1));
    ASSERT_TRUE(planet->settle(viewAt(10, 20), all, noUpload, 100));
    EXPECT_EQ(flaky.reads(posXRoot), 2u);
    EXPECT_EQ(flaky.reads(other), 1u);
    flaky.failing.clear();
    planet->tools().retryFailed();
    EXPECT_THAT(planet->inspect().failedBlocks(), IsEmpty());
    ASSERT_TRUE(planet->settle(viewAt(10, 20), all, noUpload, 100));
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), all));
    // Of blocks that have not failed, or that there are not, nothing comes.
    planet->tools().retryFailed(posXRoot);
    planet->tools().retryFailed(BlockId({Face::PosX, 20, 5, 5}));
    planet->tools().retryFailed({{Face::PosX, 9, 5, 5}, BlockKind::Colours});
    planet->tools().retryFailed({{Face::PosX, 9, 5, 5}, BlockKind::Normals});
    ASSERT_TRUE(planet->settle(viewAt(10, 20), all, noUpload, 100));
    EXPECT_EQ(flaky.reads(posXRoot), 3u);
}

// A permanently failed block is not retried each time its parent is loaded again.
TEST(Retries, permanentFailuresAreRememberedWhileTheParentIsEvicted) {
    Flaky flaky;
    const ChunkId bad = childOf(posXRoot, 1);
    flaky.failing[bad] = {.left = -1};
    PagingSettings settings = simulatedRetry({.retries = 1, .delayS = 0.1});
    settings.budgetBytes = bytesOf(90);
    PlanetSource withoutColours = flaky.source();
    withoutColours.colour.reset();
    const auto planet = Planet::open(std::move(withoutColours), settings).value();
    const View toIt = viewAt(0, 30, 2e4);
    ASSERT_TRUE(planet->settle(toIt, fineSettings(), noUpload, 100));
    ASSERT_EQ(flaky.reads(bad), 2u);
    int times = 0;
    for (int i = 0; i < 6; ++i) {
        for (int k = 0; k < 4; ++k)
            ASSERT_TRUE(planet->settle(viewAt(0, 200 + 7 * k, 2e4), fineSettings(), noUpload, 100));
        times += findNode(planet->tree(), bad) == noNode;
        EXPECT_THAT(planet->inspect().failedBlocks(), SizeIs(1));
        ASSERT_TRUE(planet->settle(toIt, fineSettings(), noUpload, 100));
        const NodeIndex node = findNode(planet->tree(), bad);
        ASSERT_NE(node, noNode);
        EXPECT_EQ(planet->tree().nodes[node].childrenState, ChildrenState::Failed);
    }
    EXPECT_GT(times, 2);
    EXPECT_EQ(flaky.reads(bad), 2u);
    planet->tools().dropAll();
    EXPECT_THAT(planet->inspect().failedBlocks(), IsEmpty());
    ASSERT_TRUE(planet->settle(toIt, fineSettings(), noUpload, 100));
    EXPECT_EQ(flaky.reads(bad), 4u);
    planet->tools().reset();
    EXPECT_THAT(planet->inspect().failedBlocks(), IsEmpty());
    EXPECT_EQ(planet->paging().failedPermanently(), 0u);
    ASSERT_TRUE(planet->settle(toIt, fineSettings(), noUpload, 100));
    EXPECT_EQ(flaky.reads(bad), 6u);
}

TEST(Retries, ADiskThatFailsEveryReadIsNotFlooded) {
    Flaky flaky;
    PagingSettings settings = simulatedRetry({});
    settings.badDisk.failureRate = 1;
    const auto planet = Planet::open(flaky.source(), settings).value();
    planet->tools().keepMoves(true);
    std::map<BlockId, int> asked;
    for (int i = 0; i < 3000; ++i) {
        const ViewInput input = inputOf(viewAt(10, 0.12 * i), true);
        planet->step({&input, 1}, noUpload, retryStepS);
        for (const BlockId& block : planet->tools().takeMoves().requested) ++asked[block];
    }
    EXPECT_GT(asked.size(), 6u);
    for (const auto& [block, times] : asked) EXPECT_LE(times, 5) << toString(block);
    EXPECT_LE(planet->paging()[BlockKind::Heights].failed, 5 * asked.size());
    EXPECT_EQ(planet->paging().failedPermanently() + planet->paging().awaitingRetry(), asked.size());
    EXPECT_EQ(planet->paging()[BlockKind::Heights].loaded, 0u);
}

TEST(Retries, OnlyBlocksThatAreWantedAreTriedAgain) {
    Flaky flaky;
    const ChunkId bad = childOf(posXRoot, 1);
    flaky.failing[bad] = {.left = 1};
    const auto planet = Planet::open(flaky.source(), simulatedRetry({.delayS = 1})).value();
    while (planet->paging().awaitingRetry() == 0) fly(*planet, flaky, retryStepS, false, viewAt(0, 30, 2e4));
    fly(*planet, flaky, 5, false, viewAt(0, 200, 2e4));
    EXPECT_EQ(flaky.reads(bad), 1u);
    EXPECT_TRUE(planet->settled());
    EXPECT_EQ(planet->inspect().failedBlocks()[0].retryInS, 0);
    fly(*planet, flaky, 2, false, viewAt(0, 30, 2e4));
    EXPECT_EQ(flaky.reads(bad), 2u);
    EXPECT_THAT(planet->inspect().failedBlocks(), IsEmpty());
}

TEST(Retries, aColourTileIsACheckerboardOnlyAfterItFailedPermanently) {
    Flaky flaky;
    const BlockId bad{posXRoot, BlockKind::Colours};
    flaky.failing[bad] = {.left = -1};
    const auto planet = Planet::open(flaky.source(), simulatedRetry({.retries = 1, .delayS = 1})).value();
    fly(*planet, flaky, 0.5, true);
    EXPECT_EQ(planet->tiles(BlockKind::Colours).nodes[0].childrenState, ChildrenState::AwaitingRetry);
    EXPECT_EQ(planet->paging()[BlockKind::Colours].failed, 1u);
    fly(*planet, flaky, 2, true);
    EXPECT_EQ(planet->tiles(BlockKind::Colours).nodes[0].childrenState, ChildrenState::Resident);
    EXPECT_TRUE(planet->tiles(BlockKind::Colours).nodes[0].hasFailed);
    EXPECT_EQ(planet->paging()[BlockKind::Colours].failed, 2u);
    EXPECT_THAT(planet->takeProblems(), ElementsAre(HasSubstr("(colours): the disk is bad (tried 2 times)")));
    // After reloadTiles() its failure is known, so it is not read.
    planet->reloadTiles(BlockKind::Colours);
    fly(*planet, flaky, 2, true);
    EXPECT_TRUE(planet->tiles(BlockKind::Colours).nodes[0].hasFailed);
    EXPECT_EQ(flaky.reads(bad), 2u);
    EXPECT_EQ(planet->paging()[BlockKind::Colours].failed, 2u);
    flaky.failing.clear();
    planet->tools().retryFailed(bad);
    EXPECT_FALSE(planet->tiles(BlockKind::Colours).nodes[0].hasFailed);
    fly(*planet, flaky, 2, true);
    EXPECT_EQ(planet->tiles(BlockKind::Colours).nodes[0].childrenState, ChildrenState::Resident);
    EXPECT_FALSE(planet->tiles(BlockKind::Colours).nodes[0].hasFailed);
    EXPECT_THAT(planet->inspect().failedBlocks(), IsEmpty());
}

TEST(Retries, SettlingWaitsForThemByTheClockWithoutSpinning) {
    Flaky flaky;
    flaky.failing[posXRoot] = {.left = 2};
    PagingSettings settings;
    settings.retry = {.retries = 2, .delayS = 0.1};
    const auto planet = Planet::open(flaky.source(), settings).value();
    ASSERT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, timeoutS));
    EXPECT_EQ(drawn(*planet), drawnOfWhole(viewAt(10, 20), fineSettings()));
    EXPECT_EQ(flaky.reads(posXRoot), 3u);
    // Frames: one for each arrival or retry, not as many as there is time for.
    EXPECT_LT(planet->tree().nodes[0].lastUsedFrame, 1000u);
}

TEST(Retries, SettlingGivesUpAtItsTimeoutOrAtOnceWhilePaused) {
    Flaky flaky;
    flaky.failing[posXRoot] = {.left = -1};
    PagingSettings settings;
    settings.retry = {.retries = 1, .delayS = 60};
    const auto planet = Planet::open(flaky.source(), settings).value();
    EXPECT_FALSE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 0.2));
    EXPECT_EQ(flaky.reads(posXRoot), 1u);
    settings.paused = true;
    ASSERT_TRUE(planet->setPaging(settings));
    EXPECT_FALSE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 1e6));
    // By simulated time a long wait is no wait.
    settings.paused = false;
    settings.time = PagingTime::Simulated;
    ASSERT_TRUE(planet->setPaging(settings));
    EXPECT_TRUE(planet->settle(viewAt(10, 20), fineSettings(), noUpload, 100));
    EXPECT_EQ(flaky.reads(posXRoot), 2u);
    EXPECT_EQ(planet->paging().failedPermanently(), 1u);
}

TEST(Retries, SettingsOutOfRangeAreRefused) {
    Flaky flaky;
    for (const RetryRules& bad : {RetryRules{.retries = -1},
                                  {.retries = 11},
                                  {.delayS = -0.1},
                                  {.delayS = 61},
                                  {.delayS = std::numeric_limits<double>::quiet_NaN()}}) {
        const auto refused = Planet::open(flaky.source(), simulatedRetry(bad));
        ASSERT_FALSE(refused);
        EXPECT_THAT(refused.error().message, HasSubstr("is out of range; expected [0, "));
    }
    EXPECT_TRUE(Planet::open(flaky.source(), simulatedRetry({.retries = 10, .delayS = 60})));
}

TEST(Retries, OnlyTheLatestAreRemembered) {
    BlockFailures failures;
    const auto block = [](std::uint32_t i) { return ChunkId{Face::PosX, 13, i, i}; };
    for (std::uint32_t i = 0; i < 5000; ++i)
        failures.failed(block(i), {i % 2 ? ErrorKind::Io : ErrorKind::BadInput, "bad"}, i, {});
    EXPECT_EQ(failures.count(), 4096u);
    EXPECT_EQ(failures.countPermanent(), 2048u);
    EXPECT_EQ(failures.stateAt(block(0), 5000), ChildrenState::Absent);
    EXPECT_EQ(failures.stateAt(block(4998), 5000), ChildrenState::Failed);
    EXPECT_EQ(failures.stateAt(block(4999), 4999), ChildrenState::AwaitingRetry);
}

// What a planet says of its blocks must fit together, whatever happens.
void expectConsistent(const Planet& planet) {
    std::map<BlockId, FailedBlock> known;
    for (FailedBlock& block : planet.inspect().failedBlocks()) known[block.block] = std::move(block);
    std::size_t permanent = 0;
    for (const auto& [id, block] : known) permanent += !block.retryInS;
    EXPECT_EQ(planet.paging().failedPermanently(), permanent);
    EXPECT_EQ(planet.paging().awaitingRetry(), known.size() - permanent);
    const auto expectKnown = [&](const BlockId& id, ChildrenState state, bool checkers) {
        if (state == ChildrenState::None) return;  // a checker, or a leaf
        const auto found = known.find(id);
        const bool isKnown = found != known.end();
        const bool isPermanent = isKnown && !found->second.retryInS;
        EXPECT_EQ(state == ChildrenState::Failed || checkers, isPermanent && state != ChildrenState::Absent)
            << toString(id) << " in state " << static_cast<int>(state);
        if (state == ChildrenState::AwaitingRetry) {
            EXPECT_TRUE(isKnown && !isPermanent) << toString(id);
        }
        if (state == ChildrenState::Resident && !checkers) {
            EXPECT_FALSE(isKnown) << toString(id);
        }
    };
    forEachNode(planet.tree(),
                [&](NodeIndex, const ChunkNode& node) { expectKnown(node.id, node.childrenState, false); });
    const TileTree& tiles = planet.tiles(BlockKind::Colours);
    for (NodeIndex i = 0; i < tiles.nodes.size(); ++i) {
        const TileNode& node = tiles.nodes[i];
        if (i >= faceCount && node.parent == noNode) continue;
        expectKnown({node.id, BlockKind::Colours}, node.childrenState, node.hasFailed);
    }
}

double facesDrawn(const Planet& planet) {
    double faces = 0;
    for (const DrawItem& item : planet.selection().draw) faces += std::ldexp(1.0, -2 * item.id.level);
    return faces;
}

TEST(Retries, OverARandomFlightWithATightBudgetAllThatIsSaidOfBlocksFitsTogether) {
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        Flaky flaky;
        PagingSettings settings = simulatedRetry({.retries = 2, .delayS = 0.05});
        settings.badDisk = {.latencyMs = 20, .failureRate = 0.35, .seed = seed};
        settings.budgetBytes = bytesOf(200);
        settings.colourShare = 0.9;
        settings.maxColourTiles = 60;
        settings.loaderThreads = 3;
        auto opened = Planet::open(flaky.source(), settings);
        if (!opened) {
            settings.budgetBytes = std::size_t{8} << 20;
            opened = Planet::open(flaky.source(), settings);
        }
        ASSERT_TRUE(opened) << opened.error().message;
        Planet& planet = **opened;
        std::mt19937 random(seed);
        for (int i = 0; i < 1200; ++i) {
            ViewInput input = inputOf(viewAt(20 * std::sin(i * 0.01), i * 0.3, 2e4 + 50 * (i % 200)), true);
            input.lod.frustumCulling = input.lod.horizonCulling = false;
            planet.step({&input, 1}, noUpload, retryStepS);
            ASSERT_EQ(facesDrawn(planet), 6) << i;
            if (random() % 150 == 0) planet.tools().retryFailed();
            if (random() % 100 == 0 && !planet.inspect().failedBlocks().empty())
                planet.tools().retryFailed(
                    planet.inspect().failedBlocks()[random() % planet.inspect().failedBlocks().size()].block);
            if (random() % 300 == 0) planet.tools().dropAll();
            if (random() % 300 == 0) planet.reloadTiles(BlockKind::Colours);
            if (random() % 400 == 0) planet.tools().reset();
            if (random() % 100 == 0) {
                settings.maxColourTiles = 40 + static_cast<std::uint32_t>(random() % 60);
                settings.retry.retries = static_cast<int>(random() % 4);
                ASSERT_TRUE(planet.setPaging(settings));
            }
            expectConsistent(planet);
            if (HasFailure()) FAIL() << "seed " << seed << ", frame " << i;
        }
        EXPECT_GT(planet.paging()[BlockKind::Heights].failed, 100u);
        EXPECT_GT(planet.paging()[BlockKind::Heights].evicted, 20u);
    }
}

// A replay begins at another time of the planet, and has only what was recorded of each failure.
TEST(Retries, ARecordingWithThemIsFollowedExactly) {
    Flaky flaky;
    flaky.failing[posXRoot] = {.left = 2};
    flaky.failing[ChunkId{Face::PosZ, 0, 0, 0}] = {.left = -1, .kind = ErrorKind::BadInput};
    flaky.failing[BlockId(posXRoot, BlockKind::Colours)] = {.left = -1};
    PagingSettings settings = simulatedRetry({.retries = 2, .delayS = 0.3});
    settings.badDisk = {.latencyMs = 10, .failureRate = 0.2, .seed = 3};
    const auto planet = Planet::open(flaky.source(), settings).value();
    settings.time = PagingTime::Recorded;
    Flaky healthy;
    const auto replay = Planet::open(healthy.source(), settings).value();
    const ViewInput before = inputOf(viewAt(80, 0));
    for (int i = 0; i < 10; ++i) replay->step({&before, 1}, noUpload, 0.1 / 3);
    replay->tools().reset();
    planet->tools().keepMoves(true);
    replay->tools().keepMoves(true);
    for (int i = 0; i < 600; ++i) {
        ViewInput input = inputOf(viewAt(20 + 0.1 * i, 30 + 0.3 * i), true);
        input.lod.frustumCulling = input.lod.horizonCulling = false;
        planet->step({&input, 1}, noUpload, 1.0 / 60 + 1e-4 * (i % 7));
        const PagingMoves moves = planet->tools().takeMoves();
        ASSERT_TRUE(replay->tools().follow(moves)) << i;
        replay->step({&input, 1}, noUpload, planet->lastStep().elapsedS);
        const PagingMoves again = replay->tools().takeMoves();
        ASSERT_EQ(again.requested, moves.requested) << i;
        ASSERT_EQ(again.arrived, moves.arrived) << i;
        ASSERT_EQ(drawn(*replay), drawn(*planet)) << i;
    }
    EXPECT_GT(planet->paging()[BlockKind::Heights].failed, 20u);
    EXPECT_GT(planet->paging().failedPermanently(), 1u);
    EXPECT_EQ(replay->paging().failedPermanently(), planet->paging().failedPermanently());
}

}  // namespace
}  // namespace planet
