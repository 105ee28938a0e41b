// Faults that are planted are found, named and placed, and a clean trace has none. tests/trace/geomipmap_client.c is an
// engine with faults to order; the traces that are made here are spheres.
#include "planet/trace/trace_faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <set>

#include "planet/sphere/chunk_id.h"
#include "planet/trace/trace_index.h"
#include "tests/support/trace_events.h"

namespace planet {
namespace {

using Kind = TraceFaultKind;

std::vector<TraceFault> faultsIn(const std::filesystem::path& file, const TraceFaultLimits& limits = {}) {
    auto trace = TraceFile::open(file);
    if (!trace) {
        ADD_FAILURE() << trace.error().message;
        return {};
    }
    TraceState state;
    TraceFaultFinder finder(limits);
    const auto sink = [&](const TraceEvent& event) {
        if (state.add(event)) finder.add(state);
    };
    EXPECT_TRUE(trace->seek(0, sink));
    for (;;) {
        const auto more = trace->next(sink);
        EXPECT_TRUE(more);
        if (!more || !*more) break;
    }
    finder.finish(state);
    return finder.faults();
}

// ---- the second client ----

struct ClientFlight {
    unsigned long long first = 0, last = 0;  // frames in which the fault is planted
    std::vector<TraceFault> faults;
};

ClientFlight fly(const std::string& fault) {
    const tests::TemporaryFolder folder;
    const std::filesystem::path file = folder / "terrain.lodtrace";
    const std::string command = std::string(GEOMIPMAP_CLIENT_BINARY) + " " + file.string() + " " + fault;
    const std::unique_ptr<FILE, int (*)(FILE*)> output(popen(command.c_str(), "r"), pclose);
    std::array<char, 64> name{};
    ClientFlight flown;
    EXPECT_EQ(std::fscanf(output.get(), "%63s %llu %llu", name.data(), &flown.first, &flown.last), 3);
    EXPECT_EQ(name.data(), fault);
    flown.faults = faultsIn(file);
    return flown;
}

constexpr std::uint64_t faultyPatch = 2330;  // and its finer levels 2331 to 2333

bool isOfPatch(std::uint64_t id) {
    return id >= faultyPatch && id < faultyPatch + 4;
}

// Expects faults of one kind at the faulty patch only, and returns the first.
const TraceFault& faultAt(const ClientFlight& flown, Kind kind) {
    static const TraceFault none;
    for (const TraceFault& fault : flown.faults)
        EXPECT_TRUE(isOfPatch(fault.node) || isOfPatch(fault.other)) << fault.sentence;
    const auto found = std::find_if(flown.faults.begin(), flown.faults.end(),
                                    [&](const TraceFault& fault) { return fault.kind == kind; });
    if (found != flown.faults.end()) return *found;
    ADD_FAILURE() << "no fault of the kind: " << traceFaultName(kind);
    return none;
}

TEST(GeomipmapClient, aCleanFlightHasNoFaults) {
    for (const TraceFault& fault : fly("none").faults) ADD_FAILURE() << fault.sentence;
}

TEST(GeomipmapClient, aNodeDrawnWithItsChildIsFound) {
    const ClientFlight flown = fly("drawn_twice");
    ASSERT_EQ(flown.faults.size(), 1u);
    const TraceFault& fault = faultAt(flown, Kind::DrawnTwice);
    EXPECT_EQ(fault.node, faultyPatch + 2);
    EXPECT_EQ(fault.other, faultyPatch + 1);
    EXPECT_EQ(fault.firstFrame, flown.first);
    EXPECT_EQ(fault.lastFrame, flown.last);
    EXPECT_EQ(fault.view, 0);
    EXPECT_EQ(fault.sentence,
              "2332 is drawn although its parent 2331 is drawn too, in 10 frames from 40 to 49");
}

TEST(GeomipmapClient, aHoleIsFound) {
    const ClientFlight flown = fly("hole");
    ASSERT_EQ(flown.faults.size(), 1u);
    const TraceFault& fault = faultAt(flown, Kind::Hole);
    EXPECT_EQ(fault.node, faultyPatch);
    EXPECT_EQ(fault.other, 1u);
    EXPECT_EQ(fault.firstFrame, flown.first);
    EXPECT_EQ(fault.lastFrame, flown.last);
}

TEST(GeomipmapClient, thrashIsFound) {
    const ClientFlight flown = fly("thrash");
    const TraceFault& fault = faultAt(flown, Kind::Thrash);
    EXPECT_EQ(fault.node, faultyPatch + 1);
    EXPECT_GE(fault.value, 9);
    EXPECT_LE(fault.firstFrame, flown.first + 4);
    EXPECT_GE(fault.lastFrame, flown.last - 4);
    EXPECT_LE(fault.lastFrame, flown.last + 1);
}

TEST(GeomipmapClient, aLatePageIsFoundAndWhatItStarves) {
    const ClientFlight flown = fly("late_page");
    const TraceFault& late = faultAt(flown, Kind::LatePage);
    EXPECT_EQ(late.node, faultyPatch + 2);
    EXPECT_EQ(late.firstFrame, flown.first);
    EXPECT_EQ(late.lastFrame, flown.last);
    EXPECT_NEAR(late.value, 1.0, 1e-9);  // 60 frames of 1 / 60 s
    const TraceFault& starved = faultAt(flown, Kind::Starvation);
    EXPECT_EQ(starved.node, faultyPatch + 1);
    EXPECT_EQ(starved.other, faultyPatch + 2);
    EXPECT_EQ(starved.lastFrame, flown.last - 1);
}

TEST(GeomipmapClient, aSkippedLevelIsFound) {
    const ClientFlight flown = fly("skipped_level");
    const TraceFault& fault = faultAt(flown, Kind::LevelStep);
    EXPECT_EQ(fault.other, faultyPatch);
    EXPECT_EQ(fault.firstFrame, flown.first);
    EXPECT_EQ(fault.lastFrame, flown.last);
    EXPECT_GE(fault.value, 2);
}

TEST(GeomipmapClient, aSelectionThatIgnoresItsTauIsFound) {
    const ClientFlight flown = fly("ignores_tau");
    ASSERT_EQ(flown.faults.size(), 1u);
    const TraceFault& fault = flown.faults[0];
    EXPECT_EQ(fault.kind, Kind::TooCoarse);
    EXPECT_EQ(fault.limit, 2);
    EXPECT_GT(fault.value, 5);  // it uses 6 px
    EXPECT_LE(fault.value, 6);
    EXPECT_EQ(fault.lastFrame, 120u);
    EXPECT_GT(fault.count, 10u);
}

// ---- a quadtree of faces, in memory ----

TraceNode quadtreeNode(std::uint32_t level, std::uint32_t x, std::uint32_t y) {
    TraceNode node;
    node.id = lod_trace_quadtree_id(0, level, x, y);
    node.isTold = true;
    node.hasParent = level > 0;
    if (level > 0) node.parent = lod_trace_quadtree_id(0, level - 1, x / 2, y / 2);
    node.level = level;
    node.bounds.shape = TraceBoundsShape::Sphere;
    const double size = 8.0 / (1u << level);
    node.bounds.centre = {(x + 0.5) * size - 4, (y + 0.5) * size - 4, -10};
    node.bounds.radius = size / std::sqrt(2.0);
    node.error = 4 * size;
    return node;
}

// Makes traces of a quadtree of four levels, frame by frame.
class MadeTrace {
public:
    // ids: nothing if the engine describes nothing.
    explicit MadeTrace(std::optional<TraceIds> ids = TraceIds::Quadtree) {
        TraceDescription description;
        description.ids = ids.value_or(TraceIds::Opaque);
        if (ids) add(description);
        TraceNodeIndex index = 0;
        for (std::uint32_t level = 0; level < 4; ++level)
            for (std::uint32_t y = 0; y < 1u << level; ++y)
                for (std::uint32_t x = 0; x < 1u << level; ++x)
                    add(TraceNodeTold{index++, quadtreeNode(level, x, y)});
    }
    void set(const std::string& name, double value) {
        add(TraceNamed{names_, name});
        add(TraceSet{names_++, value});
    }
    TraceNodeIndex node(std::uint32_t level, std::uint32_t x, std::uint32_t y) const {
        return state.find(lod_trace_quadtree_id(0, level, x, y));
    }
    // Draws a frame; between is called after its begin.
    void frame(const std::vector<TraceNodeIndex>& drawn, const std::function<void()>& between = {}) {
        add(TraceFrameBegan{++number_, number_ * 10'000'000, static_cast<double>(number_) * 0.01});
        TraceView view;
        view.projection[0][0] = 1;
        view.projection[2][3] = -1;
        view.projection[3][3] = 0;
        view.width = 1000;
        view.height = 1000;
        add(TraceViewTold{0, view});
        for (const TraceNodeIndex one : drawn) add(TraceDrawn{.view = 0, .node = one});
        if (between) between();
        add(TraceFrameEnded{number_ * 10'000'000 + 1, 1, 1});
    }
    void add(const TraceEvent& event) {
        if (state.add(event)) finder.add(state);
    }
    std::vector<Kind> kinds() const {
        std::vector<Kind> found;
        for (const TraceFault& fault : finder.faults()) found.push_back(fault.kind);
        return found;
    }

    TraceState state;
    TraceFaultFinder finder;

private:
    std::uint64_t number_ = 0;
    TraceNameIndex names_ = 0;
};

std::vector<TraceNodeIndex> wholeLevel(const MadeTrace& trace, std::uint32_t level) {
    std::vector<TraceNodeIndex> nodes;
    for (std::uint32_t y = 0; y < 1u << level; ++y)
        for (std::uint32_t x = 0; x < 1u << level; ++x) nodes.push_back(trace.node(level, x, y));
    return nodes;
}

TEST(TraceFaults, neighboursOfOneLevelDifferenceAreFine) {
    for (const TraceIds ids : {TraceIds::Quadtree, TraceIds::Opaque}) {
        MadeTrace trace(ids);
        // Level 1, with one quarter of level 2.
        trace.frame({trace.node(1, 1, 0), trace.node(1, 0, 1), trace.node(1, 1, 1), trace.node(2, 0, 0),
                     trace.node(2, 1, 0), trace.node(2, 0, 1), trace.node(2, 1, 1)});
        EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
    }
}

TEST(TraceFaults, aStepOfTwoLevelsIsFoundByIdsAndByBounds) {
    for (const TraceIds ids : {TraceIds::Quadtree, TraceIds::Opaque}) {
        MadeTrace trace(ids);
        // The quarter (1, 1) of level 2 is split once more; its children (3, 2) and (3, 3) touch the east neighbour of
        // level 1, and (2, 3) and (3, 3) the north one.
        trace.frame({trace.node(1, 1, 0), trace.node(1, 0, 1), trace.node(1, 1, 1), trace.node(2, 0, 0),
                     trace.node(2, 1, 0), trace.node(2, 0, 1), trace.node(3, 2, 2), trace.node(3, 3, 2),
                     trace.node(3, 2, 3), trace.node(3, 3, 3)});
        ASSERT_EQ(trace.kinds(), (std::vector<Kind>(4, Kind::LevelStep)));
        for (const TraceFault& fault : trace.finder.faults()) {
            EXPECT_EQ(fault.value, 2);
            EXPECT_TRUE(fault.other == quadtreeNode(1, 1, 0).id || fault.other == quadtreeNode(1, 0, 1).id);
        }
    }
}

// The faces of a sphere of radius 10, with nodes as wide as a quarter of the equator at level 0.
TraceNode cubeNode(const ChunkId& id) {
    TraceNode node;
    node.id = keyOf(id);
    node.isTold = true;
    node.level = id.level;
    const FaceSquare square = faceSquareOf(id);
    const auto at = [&](double u, double v) {
        return 10.0 *
               sphereFromCube(cubePoint(id.face, square.u + u * square.side, square.v + v * square.side));
    };
    node.bounds = {.shape = TraceBoundsShape::Sphere, .centre = at(0.5, 0.5)};
    for (const double u : {0.0, 1.0})
        for (const double v : {0.0, 1.0})
            node.bounds.radius = std::max(node.bounds.radius, glm::length(at(u, v) - node.bounds.centre));
    return node;
}

// Draws two nodes of a sphere, and returns what is found.
std::vector<TraceFault> faultsOnSphere(TraceNode fine, const TraceNode& coarse) {
    TraceState state;
    TraceFaultFinder finder;
    TraceDescription description;
    description.shape = TraceShape::Sphere;
    description.radius = 10;
    description.ids = TraceIds::Quadtree;
    for (const TraceEvent& event : std::initializer_list<TraceEvent>{
             description, TraceNodeTold{0, fine}, TraceNodeTold{1, coarse}, TraceFrameBegan{1, 1, 0},
             TraceDrawn{.node = 0}, TraceDrawn{.node = 1}, TraceFrameEnded{2, 1, -1}})
        if (state.add(event)) finder.add(state);
    return finder.faults();
}

TEST(TraceFaults, aStepAcrossTheEdgeOfAFaceIsFound) {
    for (const Face face : allFaces) {
        for (const Edge edge : allEdges) {
            const ChunkId fine{face, 6,
                               edge == Edge::West   ? 0u
                               : edge == Edge::East ? 63u
                                                    : 20u,
                               edge == Edge::South   ? 0u
                               : edge == Edge::North ? 63u
                                                     : 20u};
            const ChunkId beyond = neighbourOf(fine, edge);
            ASSERT_NE(beyond.face, face);
            const auto found = faultsOnSphere(cubeNode(fine), cubeNode(ancestorOf(beyond, 4)));
            ASSERT_EQ(found.size(), 1u) << toString(fine);
            EXPECT_EQ(found[0].kind, Kind::LevelStep);
            EXPECT_EQ(found[0].value, 2);
            EXPECT_TRUE(faultsOnSphere(cubeNode(fine), cubeNode(ancestorOf(beyond, 5))).empty());
            // An engine whose faces are turned has another node there.
            TraceNode elsewhere = cubeNode(ancestorOf(beyond, 4));
            elsewhere.bounds.centre = -elsewhere.bounds.centre;
            EXPECT_TRUE(faultsOnSphere(cubeNode(fine), elsewhere).empty());
            elsewhere.bounds = {};
            TraceNode bare = cubeNode(fine);
            bare.bounds = {};
            EXPECT_EQ(faultsOnSphere(bare, elsewhere).size(), 1u);
        }
    }
}

// All pairs are the measure. The nodes lie on a plane, so a sweep along any axis must find them.
TEST(TraceFaults, stepsAmongManyNodesAreThoseOfAllPairs) {
    for (const int up : {0, 1, 2}) {
        MadeTrace trace(TraceIds::Opaque);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> share(0, 1);
        std::vector<TraceNodeIndex> drawn;
        std::vector<TraceNode> nodes;
        for (std::uint32_t i = 0; i < 300; ++i) {
            TraceNode node = quadtreeNode(i % 6, 0, 0);
            node.id = 1'000'000 + i;
            node.hasParent = false;
            for (const int axis : {0, 1, 2}) node.bounds.centre[axis] = (30 - 10 * axis) * share(random);
            std::swap(node.bounds.centre[0], node.bounds.centre[up]);
            drawn.push_back(static_cast<TraceNodeIndex>(trace.state.nodes().size()));
            trace.add(TraceNodeTold{drawn.back(), node});
            nodes.push_back(node);
        }
        trace.frame(drawn);
        std::set<std::pair<std::uint64_t, std::uint64_t>> expected, found;
        for (const TraceNode& fine : nodes)
            for (const TraceNode& coarse : nodes)
                if (fine.level >= coarse.level + 2 &&
                    glm::length(fine.bounds.centre - coarse.bounds.centre) <=
                        1.001 * std::hypot(fine.bounds.radius, coarse.bounds.radius))
                    expected.insert({fine.id, coarse.id});
        for (const TraceFault& fault : trace.finder.faults())
            if (fault.kind == Kind::LevelStep) found.insert({fault.node, fault.other});
        EXPECT_GT(expected.size(), 50u);
        EXPECT_EQ(found, expected);
    }
}

// It took a second for each frame when all pairs were compared.
TEST(TraceFaults, stepsAmongSixteenThousandNodesAreFoundQuickly) {
    MadeTrace trace(TraceIds::Opaque);
    std::vector<TraceNodeIndex> drawn;
    const auto draw = [&](std::uint32_t level, std::uint32_t x, std::uint32_t y) {
        TraceNode node = quadtreeNode(level, x, y);
        node.hasParent = false;
        drawn.push_back(static_cast<TraceNodeIndex>(trace.state.nodes().size()));
        trace.add(TraceNodeTold{drawn.back(), node});
    };
    // Level 7, with one node of level 5 in place of 16.
    for (std::uint32_t y = 0; y < 128; ++y)
        for (std::uint32_t x = 0; x < 128; ++x)
            if (x / 4 != 10 || y / 4 != 10) draw(7, x, y);
    draw(5, 10, 10);
    for (int frame = 0; frame < 10; ++frame) trace.frame(drawn);
    EXPECT_EQ(trace.kinds(), std::vector<Kind>(16, Kind::LevelStep));
}

// An engine that culls a child need not load it.
TEST(TraceFaults, aStarvedNodeWaitsForTheChildThatIsBeingLoaded) {
    MadeTrace trace;
    trace.set("tau", 0.01);
    trace.add(TracePaged{.step = TraceStep::Requested, .node = trace.node(1, 1, 0)});
    for (int frame = 0; frame < 60; ++frame) trace.frame({trace.node(0, 0, 0)});
    trace.frame({trace.node(0, 0, 0)},
                [&] { trace.add(TracePaged{.step = TraceStep::Arrived, .node = trace.node(1, 1, 0)}); });
    std::vector<std::uint64_t> missing;
    for (const TraceFault& fault : trace.finder.faults())
        if (fault.kind == Kind::Starvation) missing.push_back(fault.other);
    EXPECT_EQ(missing, std::vector<std::uint64_t>{quadtreeNode(1, 1, 0).id});
}

TEST(TraceFaults, aHoleIsOneOnlyIfItIsInViewAndNotCulled) {
    MadeTrace trace;
    const std::vector<TraceNodeIndex> three = {trace.node(1, 0, 0), trace.node(1, 1, 0), trace.node(1, 0, 1)};
    trace.frame(three, [&] { trace.add(TraceCulled{0, trace.node(1, 1, 1), TraceCulling::ByOcclusion}); });
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
    trace.frame(three);
    ASSERT_EQ(trace.kinds(), std::vector<Kind>{Kind::Hole});
    EXPECT_EQ(trace.finder.faults()[0].node, quadtreeNode(1, 1, 1).id);
    EXPECT_EQ(trace.finder.faults()[0].other, quadtreeNode(0, 0, 0).id);
    EXPECT_EQ(trace.finder.faults()[0].firstFrame, 2u);
}

TEST(TraceFaults, aHoleBehindTheCameraIsNone) {
    MadeTrace trace;
    for (std::uint32_t y = 0; y < 2; ++y) {
        TraceNode behind = quadtreeNode(1, 1, y);
        behind.bounds.centre.z = 10;
        trace.add(TraceNodeTold{trace.node(1, 1, y), behind});
    }
    trace.frame({trace.node(1, 0, 0), trace.node(1, 0, 1)});
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
}

TEST(TraceFaults, aGrandchildDrawnWithItsAncestorIsFound) {
    MadeTrace trace;
    auto drawn = wholeLevel(trace, 1);
    drawn.push_back(trace.node(3, 1, 1));
    trace.frame(drawn);
    ASSERT_EQ(trace.kinds(), std::vector<Kind>{Kind::DrawnTwice});
    EXPECT_EQ(trace.finder.faults()[0].sentence,
              "3/1/1 is drawn although its ancestor 1/0/0 is drawn too, in frame 1");
}

TEST(TraceFaults, oneSplitAndMergeIsNoThrash) {
    MadeTrace trace;
    for (const std::uint32_t level : {1u, 2u, 1u}) trace.frame(wholeLevel(trace, level));
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
    for (const std::uint32_t level : {2u, 1u}) trace.frame(wholeLevel(trace, level));
    ASSERT_EQ(trace.kinds(), std::vector<Kind>(4, Kind::Thrash));
    // The first split was right; frame 3 takes it back.
    EXPECT_EQ(trace.finder.faults()[0].firstFrame, 3u);
    EXPECT_EQ(trace.finder.faults()[0].lastFrame, 5u);
    EXPECT_EQ(trace.finder.faults()[0].value, 3);
}

TEST(TraceFaults, slowChangesAreNoThrash) {
    MadeTrace trace;
    for (int change = 0; change < 8; ++change)
        for (int frame = 0; frame < 110; ++frame) trace.frame(wholeLevel(trace, change % 2 == 0 ? 1u : 2u));
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
}

// eps = 4 size * 500 / D: about 1,600 px for level 0 at the plane's distance, half for each further level.
TEST(TraceFaults, errorsAreComparedWithTauOfTheView) {
    MadeTrace trace;
    trace.set("tau", 1e6);
    trace.set("tau/0", 600);
    for (int frame = 0; frame < 60; ++frame) trace.frame(wholeLevel(trace, 1));
    ASSERT_EQ(trace.kinds(), std::vector<Kind>{Kind::TooCoarse});
    EXPECT_EQ(trace.finder.faults()[0].limit, 600);
    EXPECT_EQ(trace.finder.faults()[0].count, 4u);
}

TEST(TraceFaults, anEngineThatDescribesNothingIsJudgedByWorldUnits) {
    MadeTrace trace(std::nullopt);
    trace.set("tau", 600);
    for (int frame = 0; frame < 60; ++frame) trace.frame(wholeLevel(trace, 1));
    ASSERT_EQ(trace.kinds(), std::vector<Kind>{Kind::TooCoarse});
    EXPECT_EQ(trace.finder.faults()[0].count, 4u);
}

// Frames are 0.01 s apart. A switch may wait for two fades, and counts as ignored 0.5 s later.
TEST(TraceFaults, aSwitchMayWaitForFadesButAnIgnoredTauIsFoundDespiteThem) {
    MadeTrace trace;
    trace.set("tau", 600);
    trace.set("fade_s", 0.25);
    for (int frame = 0; frame < 95; ++frame) trace.frame(wholeLevel(trace, 1));
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
    for (int frame = 0; frame < 15; ++frame) trace.frame(wholeLevel(trace, 1));
    ASSERT_EQ(trace.kinds(), std::vector<Kind>{Kind::TooCoarse});
    EXPECT_NEAR(static_cast<double>(trace.finder.faults()[0].firstFrame), 101, 1);
    EXPECT_NE(trace.finder.faults()[0].sentence.find("exceed it for more than 1 s"), std::string::npos);
}

TEST(TraceFaults, mergesOfSeveralLevelsMayWaitForFadesButIgnoredOnesAreFound) {
    MadeTrace trace;
    trace.set("tau", 1e6);
    trace.set("fade_s", 0.25);
    // A level each 0.4 s, in two fades: at no time a node waits for longer.
    for (const std::uint32_t level : {3u, 2u, 1u, 0u})
        for (int frame = 0; frame < 40; ++frame) trace.frame(wholeLevel(trace, level));
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
    for (int frame = 0; frame < 110; ++frame) trace.frame(wholeLevel(trace, 2));
    ASSERT_EQ(trace.kinds(), std::vector<Kind>{Kind::TooFine});
    EXPECT_EQ(trace.finder.faults()[0].count, 16u);
}

TEST(TraceFaults, maxLevelExcusesCoarseNodes) {
    MadeTrace trace;
    trace.set("tau", 1);
    trace.set("max_level", 1);
    for (int frame = 0; frame < 60; ++frame) trace.frame(wholeLevel(trace, 1));
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
}

TEST(TraceFaults, aSelectionFinerThanTauIsFound) {
    MadeTrace trace;
    trace.set("tau", 1e6);
    for (int frame = 0; frame < 60; ++frame) trace.frame(wholeLevel(trace, 2));
    ASSERT_EQ(trace.kinds(), std::vector<Kind>{Kind::TooFine});
    EXPECT_EQ(trace.finder.faults()[0].count, 16u);
}

TEST(TraceFaults, hysteresisExcusesFineNodes) {
    MadeTrace trace;
    const auto errors = [&](std::uint32_t level) {
        TraceView view;
        view.projection[0][0] = 1;
        view.width = 1000;
        return traceErrorPx(*trace.state.description(), quadtreeNode(level, 0, 0), view);
    };
    trace.set("tau", errors(1) * 1.05);
    trace.set("hysteresis", 0.1);
    for (int frame = 0; frame < 60; ++frame) trace.frame(wholeLevel(trace, 2));
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
}

TEST(TraceFaults, framesThatLostEventsAreNotJudged) {
    MadeTrace trace;
    trace.frame({trace.node(1, 0, 0)}, [&] { trace.add(TraceDropped{3}); });
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
    trace.frame({trace.node(1, 0, 0)});
    EXPECT_EQ(trace.kinds(), std::vector<Kind>(3, Kind::Hole));
}

TEST(TraceFaults, aRequestThatNeverArrivesIsLateAtTheEnd) {
    MadeTrace trace;
    const TraceNodeIndex node = trace.node(1, 0, 0);
    trace.frame(wholeLevel(trace, 1), [&] { trace.add(TracePaged{.node = node, .ns = 1}); });
    for (int frame = 0; frame < 60; ++frame) trace.frame(wholeLevel(trace, 1));
    EXPECT_EQ(trace.kinds(), std::vector<Kind>{});
    trace.finder.finish(trace.state);
    ASSERT_EQ(trace.kinds(), std::vector<Kind>{Kind::LatePage});
    EXPECT_NEAR(trace.finder.faults()[0].value, 0.6, 1e-9);
    EXPECT_EQ(trace.finder.faults()[0].firstFrame, 1u);
}

TEST(TraceFaults, theListIsLimited) {
    MadeTrace trace;
    trace.finder = TraceFaultFinder({.maxFaults = 2});
    trace.frame({trace.node(1, 0, 0)});
    EXPECT_EQ(trace.finder.faults().size(), 2u);
    EXPECT_EQ(trace.finder.unlisted(), 1u);
}

}  // namespace
}  // namespace planet
