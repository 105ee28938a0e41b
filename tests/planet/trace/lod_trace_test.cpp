// What an engine tells comes back the same, and the trace never costs the engine anything but what lod_trace.h states.
#include "planet/trace/lod_trace.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <thread>

#include "tests/support/trace_events.h"

namespace planet {
namespace {

using test::eventsOf;
using test::OpenTrace;
using test::readTrace;
using test::ReadTrace;
using tests::contentOf;
using tests::TemporaryFolder;

ReadTrace readFile(const std::filesystem::path& file) {
    const std::string content = contentOf(file);
    return readTrace(test::bytesOf(content));
}

// Writes a trace by calls and reads it back.
ReadTrace roundTrip(const std::function<void(lod_trace*)>& calls) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "made.lodtrace";
    OpenTrace trace(file.string());
    calls(trace);
    trace.close();
    ReadTrace read = readFile(file);
    EXPECT_EQ(read.problem, "");
    return read;
}

std::string nameOf(const ReadTrace& read, TraceNameIndex index) {
    for (const TraceNamed& named : eventsOf<TraceNamed>(read.events))
        if (named.index == index) return named.name;
    return "?";
}

TEST(LodTrace, descriptionComesBack) {
    const ReadTrace read = roundTrip([](lod_trace* trace) {
        lod_trace_description description{};
        description.name = "engine \xCF\x84";
        description.shape = LOD_TRACE_SPHERE;
        description.radius = 6371.0;
        description.metres_per_unit = 1000;
        description.ids = LOD_TRACE_IDS_QUADTREE;
        description.error = LOD_TRACE_ERROR_PIXELS;
        description.requests = LOD_TRACE_REQUESTS_CHILDREN;
        description.kinds[0] = "heights";
        description.kinds[2] = "normals";
        EXPECT_EQ(lod_trace_describe(trace, &description), 1);
    });
    TraceDescription expected;
    expected.name = "engine \xCF\x84";
    expected.shape = TraceShape::Sphere;
    expected.radius = 6371.0;
    expected.metresPerUnit = 1000;
    expected.ids = TraceIds::Quadtree;
    expected.error = TraceErrorUnit::Pixels;
    expected.requests = TraceRequests::Children;
    expected.kinds = {"heights", "", "normals", ""};
    EXPECT_EQ(eventsOf<TraceDescription>(read.events), std::vector{expected});
}

TEST(LodTrace, nodesComeBackWithAllBits) {
    lod_trace_node_info box{};
    box.id = 0xFEDCBA9876543210u;
    box.parent = 7;
    box.has_parent = 1;
    box.level = 20;
    box.bounds = LOD_TRACE_BOUNDS_BOX;
    for (int i = 0; i < 3; ++i) box.centre[i] = 1.0 / (3 + i);
    for (int i = 0; i < 9; ++i) box.axes[i] = std::sqrt(0.1 + i);
    for (int i = 0; i < 3; ++i) box.half_size[i] = 1e-300 * (i + 1);
    box.error = std::nextafter(2.0, 3.0);
    box.bytes = std::numeric_limits<std::uint64_t>::max();
    box.triangles = 2178;
    lod_trace_node_info bare{};
    bare.id = 7;
    const ReadTrace read = roundTrip([&](lod_trace* trace) {
        const lod_trace_node_info sphere = test::sphereNode(9, 3);
        for (const lod_trace_node_info* node :
             std::initializer_list<const lod_trace_node_info*>{&bare, &box, &sphere})
            EXPECT_EQ(lod_trace_node(trace, node), 1);
    });
    const auto nodes = eventsOf<TraceNodeTold>(read.events);
    ASSERT_EQ(nodes.size(), 3u);
    EXPECT_EQ(nodes[0].node, (TraceNode{.id = 7, .isTold = true}));
    TraceNode expected{.id = box.id, .isTold = true, .hasParent = true, .parent = 7, .level = 20};
    expected.bounds.shape = TraceBoundsShape::Box;
    for (int i = 0; i < 3; ++i) {
        expected.bounds.centre[i] = box.centre[i];
        expected.bounds.halfSize[i] = box.half_size[i];
        for (int j = 0; j < 3; ++j)
            expected.bounds.axes[static_cast<std::size_t>(i)][j] = box.axes[3 * i + j];
    }
    expected.error = box.error;
    expected.bytes = box.bytes;
    expected.triangles = box.triangles;
    EXPECT_EQ(nodes[1], (TraceNodeTold{1, expected}));
    EXPECT_EQ(nodes[2].node.bounds.radius, 1.5);
    EXPECT_EQ(nodes[2].node.level, 3u);
}

TEST(LodTrace, framesViewsAndDrawnNodesComeBackWithAllBits) {
    lod_trace_view_info second = test::someView(3.25);
    second.projection[0] = 1.0 / 3;
    second.viewport[0] = -4;
    const ReadTrace read = roundTrip([&](lod_trace* trace) {
        for (std::uint64_t id = 1; id <= 3; ++id) {
            const auto node = test::sphereNode(id);
            lod_trace_node(trace, &node);
        }
        const lod_trace_view_info first = test::someView(0.1);
        lod_trace_frame_begin(trace, 1.0 / 60);
        lod_trace_view(trace, 0, &first);
        lod_trace_view(trace, 15, &second);
        lod_trace_drawn(trace, 0, 1, 0);
        lod_trace_drawn(trace, 15, 3, 1);
        lod_trace_drawn_px(trace, 15, 2, 0.3f, 1.7f);
        lod_trace_culled(trace, 0, 2, LOD_TRACE_CULLED_HORIZON);
        lod_trace_drawn(trace, 0, 77, 0.5f);  // never told
        lod_trace_frame_end(trace, 1.0 / 3, -1);
        lod_trace_frame_begin(trace, 2.0 / 60);
        lod_trace_view(trace, 15, &second);
        lod_trace_frame_end(trace, 4, 5);
    });
    const auto began = eventsOf<TraceFrameBegan>(read.events);
    ASSERT_EQ(began.size(), 2u);
    EXPECT_EQ(began[0].number, 1u);
    EXPECT_EQ(began[0].timeS, 1.0 / 60);
    EXPECT_EQ(began[1].number, 2u);
    EXPECT_GE(began[1].ns, began[0].ns);
    const auto ended = eventsOf<TraceFrameEnded>(read.events);
    ASSERT_EQ(ended.size(), 2u);
    EXPECT_EQ(ended[0].cpuMs, 1.0 / 3);
    EXPECT_EQ(ended[0].gpuMs, -1);
    const auto views = eventsOf<TraceViewTold>(read.events);
    ASSERT_EQ(views.size(), 3u);
    EXPECT_EQ(views[0].info.eye.x, 0.1);
    EXPECT_EQ(views[0].info.view, glm::dmat4(1));
    EXPECT_EQ(views[1].view, 15);
    EXPECT_EQ(views[1].info.projection[0][0], 1.0 / 3);
    EXPECT_EQ(views[1].info.x, -4);
    EXPECT_EQ(views[1].info.height, 720);
    EXPECT_EQ(views[2], views[1]);
    const std::vector<TraceDrawn> expected = {
        {0, 0, 0, false, 0}, {15, 2, 1, false, 0}, {15, 1, 0.3f, true, 1.7f}, {0, 3, 0.5f, false, 0}};
    EXPECT_EQ(eventsOf<TraceDrawn>(read.events), expected);
    EXPECT_EQ(eventsOf<TraceCulled>(read.events),
              (std::vector<TraceCulled>{{0, 1, TraceCulling::ByHorizon}}));
    const auto nodes = eventsOf<TraceNodeTold>(read.events);
    ASSERT_EQ(nodes.size(), 4u);
    EXPECT_EQ(nodes[3].node, (TraceNode{.id = 77}));
}

TEST(LodTrace, pagingComesBackWithTimesInOrder) {
    const ReadTrace read = roundTrip([](lod_trace* trace) {
        lod_trace_thread_begin(trace, "main");
        lod_trace_frame_begin(trace, 0);
        lod_trace_requested(trace, 5, 0, 2.5f);
        lod_trace_requested(trace, 6, 3, std::nanf(""));
        lod_trace_started(trace, 5, 0);
        lod_trace_arrived(trace, 5, 0);
        lod_trace_cancelled(trace, 6, 3);
        lod_trace_failed(trace, 6, 3, "disk \xE2\x82\xAC");
        lod_trace_evicted(trace, 5, 0);
    });
    const auto steps = eventsOf<TracePaged>(read.events);
    ASSERT_EQ(steps.size(), 7u);
    EXPECT_EQ(steps[0].step, TraceStep::Requested);
    EXPECT_TRUE(steps[0].hasPriority);
    EXPECT_EQ(steps[0].priority, 2.5f);
    EXPECT_EQ(steps[1].kind, 3);
    EXPECT_FALSE(steps[1].hasPriority);
    const std::vector<TraceStep> order = {TraceStep::Requested, TraceStep::Requested, TraceStep::Started,
                                          TraceStep::Arrived,   TraceStep::Cancelled, TraceStep::Failed,
                                          TraceStep::Evicted};
    for (std::size_t i = 0; i < order.size(); ++i) {
        EXPECT_EQ(steps[i].step, order[i]);
        EXPECT_GE(steps[i].ns, steps[i > 0 ? i - 1 : 0].ns);
    }
    EXPECT_LE(steps.back().ns, lod_trace_now_ns());
    EXPECT_GE(steps.front().ns + 60'000'000'000u, lod_trace_now_ns());
    EXPECT_EQ(nameOf(read, steps[5].reason), "disk \xE2\x82\xAC");
    const auto threads = eventsOf<TraceThreadNamed>(read.events);
    ASSERT_EQ(threads.size(), 1u);
    EXPECT_EQ(nameOf(read, threads[0].name), "main");
}

TEST(LodTrace, settingsCountersAndMessagesComeBack) {
    const std::vector<double> values = {0,
                                        1,
                                        -1,
                                        1e15,
                                        -0.0,
                                        0.1,
                                        1e300,
                                        std::numeric_limits<double>::infinity(),
                                        9007199254740993.0,
                                        -9007199254740992.0};
    const ReadTrace read = roundTrip([&](lod_trace* trace) {
        lod_trace_setting(trace, LOD_TRACE_TAU, 1.5);
        lod_trace_setting_text(trace, "mode", "fast");
        lod_trace_frame_begin(trace, 0);
        for (const double value : values) lod_trace_counter(trace, "drawn", value);
        lod_trace_message(trace, LOD_TRACE_WARNING, "slow");
        lod_trace_setting(trace, "mode", 3);
    });
    const auto counted = eventsOf<TraceCounted>(read.events);
    ASSERT_EQ(counted.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        EXPECT_EQ(counted[i].value, values[i]);
        EXPECT_EQ(std::signbit(counted[i].value), std::signbit(values[i]));
        EXPECT_EQ(nameOf(read, counted[i].name), "drawn");
    }
    const auto set = eventsOf<TraceSet>(read.events);
    ASSERT_EQ(set.size(), 3u);
    EXPECT_EQ(nameOf(read, set[0].name), "tau");
    EXPECT_EQ(set[0].value, TraceSettingValue(1.5));
    EXPECT_EQ(set[1].value, TraceSettingValue(std::string("fast")));
    EXPECT_EQ(set[2].value, TraceSettingValue(3.0));
    const auto messages = eventsOf<TraceMessage>(read.events);
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_EQ(messages[0].severity, TraceSeverity::Warning);
    EXPECT_EQ(messages[0].text, "slow");
}

TEST(LodTrace, longTextsAreCutBetweenCharacters) {
    const std::string euros = [] {
        std::string text = "x";
        for (int i = 0; i < 2000; ++i) text += "\xE2\x82\xAC";
        return text;
    }();
    const ReadTrace read = roundTrip([&](lod_trace* trace) {
        lod_trace_frame_begin(trace, 0);
        lod_trace_message(trace, LOD_TRACE_INFO, euros.c_str());
        lod_trace_counter(trace, euros.c_str(), 1);
    });
    EXPECT_EQ(eventsOf<TraceMessage>(read.events).at(0).text, euros.substr(0, 4093));
    EXPECT_EQ(nameOf(read, eventsOf<TraceCounted>(read.events).at(0).name), euros.substr(0, 253));
}

// A frame sees the values that a node had in it.
TEST(LodTrace, changedNodeAppliesFromItsPlaceInTheStream) {
    const ReadTrace read = roundTrip([](lod_trace* trace) {
        auto node = test::sphereNode(1);
        for (int frame = 0; frame < 3; ++frame) {
            node.error = frame;
            lod_trace_node(trace, &node);
            lod_trace_node(trace, &node);  // the same again tells nothing
            if (frame == 0)
                lod_trace_flush(trace, 10'000);  // the node is in an earlier block than what draws it
            lod_trace_frame_begin(trace, frame);
            lod_trace_drawn(trace, 0, 1, 0);
            lod_trace_frame_end(trace, 1, 1);
        }
    });
    TraceState state;
    std::vector<double> errors;
    for (const TraceEvent& event : read.events)
        if (state.add(event)) errors.push_back(state.nodes().at(0).node.error);
    EXPECT_EQ(errors, (std::vector<double>{0, 1, 2}));
    EXPECT_EQ(eventsOf<TraceNodeTold>(read.events).size(), 3u);
}

TEST(LodTrace, nullTraceIsHarmless) {
    const auto node = test::sphereNode(1);
    const auto view = test::someView(0);
    EXPECT_EQ(lod_trace_node(nullptr, &node), 1);
    EXPECT_EQ(lod_trace_describe(nullptr, nullptr), 1);
    EXPECT_EQ(lod_trace_setting(nullptr, "tau", 1), 1);
    lod_trace_frame_begin(nullptr, 0);
    lod_trace_view(nullptr, 0, &view);
    lod_trace_drawn(nullptr, 0, 1, 0);
    lod_trace_requested(nullptr, 1, 0, 0);
    lod_trace_message(nullptr, 0, "text");
    lod_trace_frame_end(nullptr, 0, 0);
    lod_trace_thread_end(nullptr);
    EXPECT_EQ(lod_trace_flush(nullptr, 0), 1);
    EXPECT_EQ(lod_trace_listening(nullptr), 0);
    EXPECT_EQ(lod_trace_error(nullptr), nullptr);
    lod_trace_close(nullptr);
}

TEST(LodTrace, numbersOutOfRangeAreLeftOut) {
    const ReadTrace read = roundTrip([](lod_trace* trace) {
        const auto view = test::someView(0);
        lod_trace_frame_begin(trace, 0);
        for (const int wrong : {-1, 16, 1 << 20}) {
            lod_trace_view(trace, wrong, &view);
            lod_trace_drawn(trace, wrong, 1, 0);
            lod_trace_requested(trace, 1, wrong, 0);
        }
        lod_trace_counter(trace, nullptr, 1);
    });
    EXPECT_TRUE(eventsOf<TraceViewTold>(read.events).empty());
    EXPECT_TRUE(eventsOf<TraceDrawn>(read.events).empty());
    EXPECT_TRUE(eventsOf<TracePaged>(read.events).empty());
}

// A reader refuses a trace with an unknown value, so one wrong number of an engine would cost all of it.
TEST(LodTrace, enumerationsThatAreUnknownAreReplaced) {
    for (const int wrong : {-1, 3, 4, 7, 256 + 9, 1 << 20}) {
        const ReadTrace read = roundTrip([&](lod_trace* trace) {
            lod_trace_description description{};
            description.shape = description.ids = description.error = description.requests = wrong;
            lod_trace_describe(trace, &description);
            lod_trace_node_info node = test::sphereNode(1);
            node.bounds = wrong;
            lod_trace_node(trace, &node);
            lod_trace_frame_begin(trace, 0);
            lod_trace_culled(trace, 0, 1, wrong == 3 ? 4 : wrong);
            lod_trace_message(trace, wrong, "of no known severity");
        });
        EXPECT_EQ(eventsOf<TraceDescription>(read.events), std::vector{TraceDescription{}}) << wrong;
        const auto nodes = eventsOf<TraceNodeTold>(read.events);
        ASSERT_EQ(nodes.size(), 1u);
        EXPECT_EQ(nodes[0].node.bounds, TraceBounds{});
        EXPECT_EQ(nodes[0].node.error, 0.25);
        const auto culled = eventsOf<TraceCulled>(read.events);
        ASSERT_EQ(culled.size(), 1u);
        EXPECT_EQ(culled[0].reason, TraceCulling::Other);
        const auto messages = eventsOf<TraceMessage>(read.events);
        ASSERT_EQ(messages.size(), 1u);
        EXPECT_EQ(messages[0].severity, TraceSeverity::Failure);
    }
}

// ---- errors ----

std::string openError(const std::string& where) {
    char error[512] = "";
    lod_trace* trace = lod_trace_open(where.c_str(), nullptr, error, sizeof error);
    EXPECT_EQ(trace, nullptr) << where;
    lod_trace_close(trace);
    return error;
}

TEST(LodTraceOpen, errorsSayWhatIsWrongAndWhatIsRight) {
    EXPECT_EQ(openError(""), ": is no path; expected 1 to 511 bytes");
    EXPECT_EQ(openError("tcp:10.0.0.1:80"),
              "tcp:10.0.0.1:80: is another address; expected tcp:127.0.0.1:PORT");
    EXPECT_EQ(openError("tcp:127.0.0.1:99999"),
              "tcp:127.0.0.1:99999: is no port; expected tcp:127.0.0.1:PORT with a port in [0, 65535]");
    EXPECT_EQ(openError("tcp:127.0.0.1:8o"),
              "tcp:127.0.0.1:8o: is no port; expected tcp:127.0.0.1:PORT with a port in [0, 65535]");
    EXPECT_EQ(openError("/nowhere/at/all"), "/nowhere/at/all: cannot be written: No such file or directory");
}

TEST(LodTraceOpen, anotherFileIsNotOverwritten) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "notes.txt";
    std::ofstream(file) << "notes";
    EXPECT_EQ(openError(file.string()), file.string() + ": is another file; expected a trace or a new name");
    EXPECT_EQ(contentOf(file), "notes");
}

TEST(LodTraceOpen, anOlderTraceIsReplaced) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "made.lodtrace";
    for (int i = 0; i < 2; ++i) {
        OpenTrace trace(file.string());
        lod_trace_frame_begin(trace, i);
        trace.close();
        EXPECT_EQ(eventsOf<TraceFrameBegan>(readFile(file).events).at(0).timeS, i);
    }
}

TEST(LodTraceOpen, aTakenPortIsAnError) {
    const OpenTrace trace("tcp:127.0.0.1:0");
    const std::string where = "tcp:127.0.0.1:" + std::to_string(lod_trace_port(trace));
    EXPECT_EQ(openError(where), where + ": cannot listen: Address already in use; expected a free port");
}

// A file that cannot grow stands for a full disk.
TEST(LodTrace, fullDiskEndsTheTraceAndIsReported) {
    if (access("/dev/full", W_OK) != 0) GTEST_SKIP() << "this system has no /dev/full";
    OpenTrace trace("/dev/full");
    for (int frame = 0; frame < 10; ++frame) {
        lod_trace_frame_begin(trace, frame);
        lod_trace_frame_end(trace, 1, 1);
        lod_trace_flush(trace, 5000);
    }
    ASSERT_NE(lod_trace_error(trace), nullptr);
    EXPECT_STREQ(lod_trace_error(trace), "/dev/full: writing failed: No space left on device");
    EXPECT_EQ(lod_trace_listening(trace), 0);
}

// ---- the drop policy ----

// Sleeps long enough for the ring to fill: the writer looks five times a second.
constexpr lod_trace_options smallRing{.ring_bytes = 16384, .max_threads = 2, .wake_ms = 200};

TEST(LodTraceDrops, fullRingDropsDrawnNodesAndCountsThem) {
    constexpr int drawn = 3000;
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "made.lodtrace";
    OpenTrace trace(file.string(), smallRing);
    lod_trace_flush(trace, 5000);  // the writer now sleeps
    lod_trace_frame_begin(trace, 0);
    for (int i = 0; i < drawn; ++i) lod_trace_drawn(trace, 0, 1, 0);
    lod_trace_frame_end(trace, 1, 1);
    const std::uint64_t dropped = lod_trace_get_stats(trace).dropped;
    EXPECT_GT(dropped, 0u);
    lod_trace_flush(trace, 5000);
    lod_trace_frame_begin(trace, 1);
    lod_trace_frame_end(trace, 1, 1);
    trace.close();
    const ReadTrace read = readFile(file);
    EXPECT_EQ(eventsOf<TraceDrawn>(read.events).size() + dropped, drawn);
    std::uint64_t counted = 0;
    for (const TraceDropped& lost : eventsOf<TraceDropped>(read.events)) counted += lost.count;
    EXPECT_EQ(counted, dropped);
    TraceState state;
    std::vector<bool> complete;
    for (const TraceEvent& event : read.events)
        if (state.add(event)) complete.push_back(state.frame().isComplete());
    EXPECT_EQ(complete, (std::vector<bool>{false, true}));
    EXPECT_EQ(state.droppedTotal(), dropped);
}

TEST(LodTraceDrops, nodesAndSettingsAreNeverLost) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "made.lodtrace";
    OpenTrace trace(file.string(), {.ring_bytes = 16384, .max_threads = 1, .wake_ms = 1});
    std::uint64_t refused = 0;
    for (std::uint64_t id = 0; id < 2000; ++id) {
        // A flood of drawn nodes fills the part of the ring that is not kept for nodes.
        for (int i = 0; i < 50; ++i) lod_trace_drawn(trace, 0, id, 0);
        const auto node = test::sphereNode(id);
        while (lod_trace_node(trace, &node) == 0) {
            ++refused;
            std::this_thread::yield();
        }
        while (lod_trace_setting(trace, "last", static_cast<double>(id)) == 0) ++refused;
    }
    EXPECT_EQ(lod_trace_get_stats(trace).refused, refused);
    EXPECT_GT(lod_trace_get_stats(trace).dropped, 0u);
    trace.close();
    TraceState state;
    for (const TraceEvent& event : readFile(file).events) state.add(event);
    ASSERT_EQ(state.nodes().size(), 2000u);
    for (const TraceNodeState& node : state.nodes()) {
        EXPECT_TRUE(node.node.isTold);
        EXPECT_EQ(node.node.error, 0.25 * static_cast<double>(node.node.id));
    }
    EXPECT_EQ(state.setting("last", 0), 1999.0);
}

TEST(LodTraceDrops, threadsBeyondTheRingsAreCounted) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "made.lodtrace";
    OpenTrace trace(file.string(), {.ring_bytes = 0, .max_threads = 1, .wake_ms = 0});
    lod_trace_frame_begin(trace, 0);
    std::thread([&] { lod_trace_arrived(trace, 1, 0); }).join();
    lod_trace_frame_end(trace, 1, 1);
    EXPECT_EQ(lod_trace_get_stats(trace).dropped, 1u);
    EXPECT_EQ(lod_trace_get_stats(trace).unringed, 1u);
    lod_trace_thread_end(trace);
    std::thread([&] {
        lod_trace_frame_begin(trace, 1);
        lod_trace_frame_end(trace, 1, 1);
    }).join();
    trace.close();
    const ReadTrace read = readFile(file);
    EXPECT_EQ(eventsOf<TraceFrameBegan>(read.events).size(), 2u);
    EXPECT_EQ(eventsOf<TraceDropped>(read.events), (std::vector<TraceDropped>{{1}}));
}

// ---- threads ----

TEST(LodTraceThreads, eventsOfManyThreadsAllArrive) {
    constexpr int threads = 6, each = 2000;
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "made.lodtrace";
    OpenTrace trace(file.string(), {.ring_bytes = 0, .max_threads = 8, .wake_ms = 1});
    std::vector<std::thread> loaders;
    for (int i = 0; i < threads; ++i) {
        loaders.emplace_back([&trace, i] {
            lod_trace_thread_begin(trace, ("loader " + std::to_string(i)).c_str());
            for (int j = 0; j < each; ++j) {
                const auto id = static_cast<std::uint64_t>(i * each + j);
                const auto node = test::sphereNode(id);
                while (lod_trace_node(trace, &node) == 0) std::this_thread::yield();
                lod_trace_arrived(trace, id, 0);
                // The writer has one core of two, and under a sanitizer a part of it.
                if (j % 200 == 199) lod_trace_flush(trace, 10'000);
            }
            lod_trace_thread_end(trace);
        });
    }
    for (int frame = 0; frame < 100; ++frame) {
        lod_trace_frame_begin(trace, frame);
        for (std::uint64_t id = 0; id < 100; ++id) lod_trace_drawn(trace, 0, id, 0);
        lod_trace_frame_end(trace, 1, 1);
    }
    for (std::thread& loader : loaders) loader.join();
    EXPECT_EQ(lod_trace_get_stats(trace).dropped, 0u);
    trace.close();
    const ReadTrace read = readFile(file);
    EXPECT_EQ(read.problem, "");
    EXPECT_EQ(eventsOf<TraceDrawn>(read.events).size(), 100u * 100u);
    std::vector<std::uint64_t> last(maxTraceThreads, 0);
    std::size_t arrived = 0;
    for (const TracePaged& paged : eventsOf<TracePaged>(read.events)) {
        EXPECT_GE(paged.ns, last[paged.thread]);
        last[paged.thread] = paged.ns;
        ++arrived;
    }
    EXPECT_EQ(arrived, static_cast<std::size_t>(threads * each));
    EXPECT_EQ(eventsOf<TraceThreadNamed>(read.events).size(), static_cast<std::size_t>(threads));
}

TEST(LodTraceThreads, twoTracesInOneProcessStayApart) {
    const TemporaryFolder folder;
    OpenTrace first((folder / "1").string()), second((folder / "2").string());
    for (int i = 0; i < 10; ++i) {
        lod_trace_frame_begin(first, 1);
        lod_trace_frame_begin(second, 2);
    }
    first.close();
    second.close();
    for (const int which : {1, 2}) {
        const auto began = eventsOf<TraceFrameBegan>(readFile(folder / std::to_string(which)).events);
        ASSERT_EQ(began.size(), 10u);
        for (const TraceFrameBegan& frame : began) EXPECT_EQ(frame.timeS, which);
    }
}

TEST(LodTrace, killedProcessLeavesAValidFile) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "made.lodtrace";
    const pid_t child = fork();
    if (child == 0) {
        lod_trace* trace = lod_trace_open(file.c_str(), nullptr, nullptr, 0);
        for (int frame = 0; frame < 100; ++frame) {
            lod_trace_frame_begin(trace, frame);
            lod_trace_frame_end(trace, 1, 1);
        }
        lod_trace_flush(trace, 5000);
        raise(SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    const ReadTrace read = readFile(file);
    EXPECT_EQ(read.problem, "");
    EXPECT_EQ(eventsOf<TraceFrameEnded>(read.events).size(), 100u);
}

// ---- tools that attach ----

class Tool {
public:
    explicit Tool(int port) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
        const timeval patience{.tv_sec = 10, .tv_usec = 0};
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    }
    Tool(const Tool&) = delete;
    Tool& operator=(const Tool&) = delete;
    ~Tool() { close(socket_); }

    // Reads until a condition holds for the events so far, or until the stream ends.
    void readUntil(const std::function<bool(const std::vector<TraceEvent>&)>& isEnough) {
        std::vector<std::byte> bytes(65536);
        while (!isEnough(events)) {
            const ssize_t count = recv(socket_, bytes.data(), bytes.size(), 0);
            if (count <= 0) return;
            const auto fed = reader_.feed(std::span(bytes).first(static_cast<std::size_t>(count)));
            ASSERT_TRUE(fed) << fed.error().message;
        }
    }
    // Reads to the end of the stream.
    void readAll(const TraceDecoder::Sink& sink) {
        sink_ = sink;
        readUntil([](const auto&) { return false; });
    }
    // Returns whether the other side closes without a byte.
    bool isTurnedAway() {
        std::byte byte{};
        return recv(socket_, &byte, 1, 0) == 0;
    }

    std::vector<TraceEvent> events;

private:
    int socket_;
    TraceDecoder::Sink sink_ = [this](const TraceEvent& event) { events.push_back(event); };
    TraceReader reader_{"socket", [this](const TraceEvent& event) { sink_(event); }};
};

// Draws frames until told to stop.
class Engine {
public:
    explicit Engine(lod_trace* trace)
        : thread_([this, trace] {
              for (int frame = 0; !stops_; ++frame) {
                  lod_trace_frame_begin(trace, frame);
                  const auto view = test::someView(frame);
                  lod_trace_view(trace, 0, &view);
                  for (std::uint64_t id = 1; id <= 20; ++id) lod_trace_drawn(trace, 0, id, 0);
                  lod_trace_frame_end(trace, 1, 1);
                  std::this_thread::sleep_for(std::chrono::milliseconds(1));
              }
          }) {}
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;
    ~Engine() {
        stops_ = true;
        thread_.join();
    }

private:
    std::atomic<bool> stops_ = false;
    std::thread thread_;
};

bool hasFrames(const std::vector<TraceEvent>& events) {
    return eventsOf<TraceFrameEnded>(events).size() >= 5;
}

TEST(LodTraceSocket, eachToolThatAttachesGetsAllThatEventsBuildOn) {
    OpenTrace trace("tcp:127.0.0.1:0", {.ring_bytes = 0, .max_threads = 0, .wake_ms = 1});
    EXPECT_EQ(lod_trace_listening(trace), 0);
    lod_trace_description description{};
    description.name = "engine";
    lod_trace_describe(trace, &description);
    for (std::uint64_t id = 1; id <= 20; ++id) {
        const auto node = test::sphereNode(id);
        EXPECT_EQ(lod_trace_node(trace, &node), 1);
    }
    lod_trace_setting(trace, LOD_TRACE_TAU, 2);
    lod_trace_arrived(trace, 3, 0);
    lod_trace_requested(trace, 4, 1, 1);
    const Engine engine(trace);
    std::uint64_t lastFrame = 0;
    for (int attached = 0; attached < 3; ++attached) {
        Tool tool(lod_trace_port(trace));
        tool.readUntil(hasFrames);
        TraceState state;
        bool isFirst = true;
        for (const TraceEvent& event : tool.events) {
            if (!state.add(event)) continue;
            const TraceFrame& frame = state.frame();
            EXPECT_GT(frame.number, lastFrame);
            isFirst = false;
            EXPECT_TRUE(frame.isComplete());
            ASSERT_EQ(frame.views.size(), 1u);
            EXPECT_EQ(frame.views[0].drawn.size(), 20u);
            EXPECT_TRUE(frame.views[0].info);
            lastFrame = frame.number;
        }
        ASSERT_TRUE(state.description());
        EXPECT_EQ(state.description()->name, "engine");
        ASSERT_EQ(state.nodes().size(), 20u);
        EXPECT_EQ(state.nodes()[19].node.error, 5.0);
        EXPECT_EQ(state.setting("tau", 0), 2.0);
        EXPECT_EQ(state.nodes()[2].data[0].data, TraceData::Resident);
        EXPECT_EQ(state.nodes()[3].data[1].data, TraceData::Requested);
        EXPECT_GT(state.nodes()[3].data[1].requestedNs, 0u);
        EXPECT_FALSE(isFirst);
    }
    EXPECT_EQ(lod_trace_get_stats(trace).connections, 3u);
}

TEST(LodTraceSocket, aSecondToolIsTurnedAway) {
    OpenTrace trace("tcp:127.0.0.1:0");
    const Engine engine(trace);
    Tool first(lod_trace_port(trace));
    first.readUntil(hasFrames);
    Tool second(lod_trace_port(trace));
    EXPECT_TRUE(second.isTurnedAway());
    first.events.clear();
    first.readUntil(hasFrames);
    EXPECT_TRUE(hasFrames(first.events));
}

TEST(LodTraceSocket, aToolThatLeavesIsNoticed) {
    OpenTrace trace("tcp:127.0.0.1:0", {.ring_bytes = 0, .max_threads = 0, .wake_ms = 1});
    const Engine engine(trace);
    {
        Tool tool(lod_trace_port(trace));
        tool.readUntil(hasFrames);
        EXPECT_EQ(lod_trace_listening(trace), 1);
    }
    for (int i = 0; i < 5000 && lod_trace_listening(trace); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    EXPECT_EQ(lod_trace_listening(trace), 0);
}

// Frames are lost whole, nodes are not lost, and the engine is not kept waiting.
TEST(LodTraceSocket, aToolThatIsTooSlowLosesWholeFrames) {
    OpenTrace trace("tcp:127.0.0.1:0", {.ring_bytes = 64u << 20, .max_threads = 1, .wake_ms = 1});
    Tool tool(lod_trace_port(trace));
    while (!lod_trace_listening(trace)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto draw = [&](int frame) {
        lod_trace_frame_begin(trace, frame);
        for (std::uint64_t id = 0; id < 20'000; ++id) lod_trace_drawn_px(trace, 0, id, 0.5f, 1.25f);
        const auto node = test::sphereNode(1'000'000 + static_cast<std::uint64_t>(frame));
        EXPECT_EQ(lod_trace_node(trace, &node), 1);
        lod_trace_frame_end(trace, 1, 1);
        // The ring holds all frames that a slow writer has not taken yet, so that none is lost there.
        const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(20);
        lod_trace_flush(trace, 5);
        std::this_thread::sleep_until(end);
    };
    int frame = 0;
    while (lod_trace_get_stats(trace).dropped == 0 && frame < 500) draw(frame++);
    for (int more = 0; more < 10; ++more) draw(frame++);
    ASSERT_LT(frame, 500);
    TraceState state;
    std::size_t complete = 0;
    bool hasGap = false;
    std::thread reading([&] {
        tool.readAll([&](const TraceEvent& event) {
            if (!state.add(event)) return;
            if (state.frame().followsGap) hasGap = true;
            if (!state.frame().isComplete()) return;
            ++complete;
            EXPECT_EQ(state.frame().views.at(0).drawn.size(), 20'000u) << state.frame().number;
        });
    });
    // Once the tool has caught up, the next frame is one after those that are lost.
    EXPECT_EQ(lod_trace_flush(trace, 60'000), 1);
    for (int more = 0; more < 3; ++more) draw(frame++);
    EXPECT_EQ(lod_trace_flush(trace, 60'000), 1);
    trace.close();
    reading.join();
    EXPECT_TRUE(hasGap);
    EXPECT_GE(complete, 2u);
    EXPECT_GT(state.droppedTotal(), 0u);
    for (int told = 0; told < frame; ++told)
        EXPECT_NE(state.find(1'000'000 + static_cast<std::uint64_t>(told)), noTraceNode) << told;
}

// ---- the example of README.md ----

TEST(LodTraceExample, isTheProgramInTheReadme) {
    const std::filesystem::path source = WORLDY_SOURCE_DIR;
    const std::string readme = contentOf(source / "planet/trace/README.md");
    const std::string program = contentOf(source / "tests/trace/readme_example.c");
    EXPECT_NE(readme.find("```c\n" + program + "```\n"), std::string::npos);
    EXPECT_LE(std::count(program.begin(), program.end(), '\n'), 45);
}

TEST(LodTraceExample, tracesSixtyFrames) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "engine.lodtrace";
    ASSERT_EQ(std::system((std::string(README_EXAMPLE_BINARY) + " " + file.string()).c_str()), 0);
    const ReadTrace read = readFile(file);
    EXPECT_EQ(read.problem, "");
    EXPECT_EQ(eventsOf<TraceFrameEnded>(read.events).size(), 60u);
    EXPECT_EQ(eventsOf<TraceDrawn>(read.events).size(), 60u);
    EXPECT_EQ(eventsOf<TracePaged>(read.events).size(), 2u);
}

// ---- bytes ----

TEST(LodTrace, ordinaryEventsTakeAtMostEightBytes) {
    constexpr int frames = 10, drawn = 1000;
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "made.lodtrace";
    OpenTrace trace(file.string());
    for (std::uint64_t id = 0; id < 100'000; ++id) {
        const auto node = test::sphereNode(id);
        while (lod_trace_node(trace, &node) == 0) std::this_thread::yield();
    }
    lod_trace_flush(trace, 10'000);
    const std::uint64_t before = lod_trace_get_stats(trace).bytes;
    for (int frame = 0; frame < frames; ++frame) {
        lod_trace_frame_begin(trace, frame);
        // Jumps over half the table, with a morph: the longest that a drawn node can be with 100,000 nodes.
        for (std::uint64_t i = 0; i < drawn; ++i) lod_trace_drawn(trace, 0, i % 2 * 50'000 + i, 0.3f);
        lod_trace_frame_end(trace, 1, 1);
        lod_trace_flush(trace, 10'000);
    }
    const std::uint64_t bytes = lod_trace_get_stats(trace).bytes - before;
    EXPECT_EQ(lod_trace_get_stats(trace).dropped, 0u);
    EXPECT_LE(static_cast<double>(bytes), 8.0 * frames * drawn + 120.0 * frames);
}

}  // namespace
}  // namespace planet
