// What the writer in JavaScript tells is what lod_trace.h tells of the same calls. tests/trace/cesium/write_events.mjs has the
// calls in JavaScript. These tests need node, and are skipped without it.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>

#include "planet/trace/trace_index.h"
#include "tests/support/trace_events.h"

namespace planet {
namespace {

using test::eventsOf;
using test::ReadTrace;
using test::readTrace;

constexpr int framesWritten = 300;

void tellNodes(lod_trace* trace, std::uint64_t farId) {
    lod_trace_node_info near{};
    near.id = 1;
    near.bounds = LOD_TRACE_BOUNDS_SPHERE;
    near.centre[0] = 1;
    near.centre[1] = -2;
    near.centre[2] = 3.5;
    near.radius = 4.25;
    near.error = 0.5;
    near.bytes = std::uint64_t{1} << 40;
    near.triangles = 7;
    lod_trace_node(trace, &near);
    lod_trace_node_info far{};
    far.id = farId;
    far.has_parent = 1;
    far.parent = 1;
    far.level = 28;
    far.bounds = LOD_TRACE_BOUNDS_BOX;
    far.centre[0] = 1e7;
    far.centre[1] = 2;
    far.centre[2] = 3;
    far.axes[1] = 1;
    far.axes[3] = -1;
    far.axes[8] = 1;
    far.half_size[0] = 3;
    far.half_size[1] = 2;
    far.half_size[2] = 1;
    far.error = 1e-9;
    lod_trace_node(trace, &far);
}

void tellThird(lod_trace* trace, std::uint64_t parent, std::uint32_t level, double error) {
    lod_trace_node_info node{};
    node.id = 3;
    node.has_parent = 1;
    node.parent = parent;
    node.level = level;
    node.error = error;
    lod_trace_node(trace, &node);
}

void tellOfNoShape(lod_trace* trace) {
    lod_trace_node_info node{};
    node.id = 4;
    node.bounds = 3;
    lod_trace_node(trace, &node);
}

void tellPaging(lod_trace* trace, int frame, std::uint64_t farId) {
    if (frame == 3) {
        lod_trace_requested(trace, 1, 0, std::numeric_limits<float>::quiet_NaN());
        lod_trace_requested(trace, 3, 0, -2.5f);
        lod_trace_requested(trace, farId, 2, 1e9f);
        lod_trace_started(trace, 1, 0);
        lod_trace_arrived(trace, 1, 0);
        lod_trace_cancelled(trace, 3, 0);
        lod_trace_started(trace, farId, 2);
        lod_trace_failed(trace, farId, 2, "disk");
        lod_trace_requested(trace, 50, 3, std::numeric_limits<float>::quiet_NaN());
        lod_trace_started(trace, 50, 3);
        lod_trace_requested(trace, 51, 1, std::numeric_limits<float>::quiet_NaN());
    }
    if (frame == 299) {
        lod_trace_evicted(trace, 1, 0);
        lod_trace_arrived(trace, 51, 1);
    }
}

// Makes the calls of write_events.mjs, but for the lost events, which the C header counts itself.
std::string writtenInC(const std::filesystem::path& file) {
    test::OpenTrace trace(file.string());
    lod_trace_description engine{};
    engine.name = "engine \u03b1";
    engine.shape = LOD_TRACE_SPHERE;
    engine.radius = 6371000.5;
    engine.metres_per_unit = 0.25;
    engine.ids = LOD_TRACE_IDS_QUADTREE;
    engine.error = LOD_TRACE_ERROR_PIXELS;
    engine.requests = LOD_TRACE_REQUESTS_CHILDREN;
    engine.kinds[0] = "mesh";
    engine.kinds[2] = "colour";
    lod_trace_describe(trace, &engine);
    lod_trace_thread_begin(trace, "main");
    lod_trace_setting(trace, LOD_TRACE_TAU, 2);
    lod_trace_setting_text(trace, "mode", "fast");
    lod_trace_setting_text(trace, "mode", std::string(5000, 'x').c_str());
    const std::uint64_t farId = lod_trace_quadtree_id(5, 28, (1u << 28) - 1, (1u << 28) - 2);
    tellNodes(trace, farId);
    tellOfNoShape(trace);
    tellThird(trace, 0xFEDCBA9876543210u, 2, std::numeric_limits<double>::infinity());
    for (int frame = 1; frame <= framesWritten; ++frame) {
        if (frame == 2) tellThird(trace, 1, 1, 0.125);
        lod_trace_frame_begin(trace, frame / 64.0);
        lod_trace_view_info view{};
        view.eye[0] = frame;
        view.eye[1] = 0.1;
        view.eye[2] = -0.0;
        for (int i = 0; i < 16; ++i) {
            view.view[i] = i == 15 ? frame : i;
            view.projection[i] = i / 3.0;
        }
        view.viewport[0] = -1;
        view.viewport[1] = 2;
        view.viewport[2] = 1280;
        view.viewport[3] = 720;
        lod_trace_view(trace, 0, &view);
        if (frame % 2 == 0) lod_trace_view(trace, 15, &view);
        lod_trace_drawn(trace, 0, 1, 0);
        lod_trace_drawn(trace, 0, farId, 1);
        lod_trace_drawn_px(trace, 15, 3, 0.25f, 1.75f);
        lod_trace_drawn_px(trace, 0, 3, 0, std::numeric_limits<float>::infinity());
        lod_trace_culled(trace, 15, 1, LOD_TRACE_CULLED_OTHER);
        lod_trace_culled(trace, 15, 40, LOD_TRACE_CULLED_HORIZON);
        lod_trace_culled(trace, 0, 40, 7);
        tellPaging(trace, frame, farId);
        lod_trace_counter(trace, "whole", frame - 5);
        lod_trace_counter(trace, "large", -9007199254740991.0);
        lod_trace_counter(trace, "real", frame / 3.0);
        lod_trace_counter(trace, "zero", -0.0);
        lod_trace_message(trace, LOD_TRACE_WARNING, "message \u03b2");
        lod_trace_message(trace, 3, "of no known severity");
        lod_trace_frame_end(trace, 1.5, frame % 2 ? -1 : 2.25);
    }
    trace.close();
    return tests::contentOf(file);
}

bool hasNodeJs() {
    return std::system("node --version >/dev/null 2>&1") == 0;
}

// Both clocks differ, so times are compared apart.
template <class Event>
void clearTimes(Event& event) {
    if constexpr (requires { event.ns; }) event.ns = 0;
    if constexpr (requires { event.requestedNs; }) event.requestedNs = event.startedNs = 0;
}

template <class Event>
void expectSame(const ReadTrace& js, const ReadTrace& c, const char* what) {
    std::vector<Event> ours = eventsOf<Event>(js.events), theirs = eventsOf<Event>(c.events);
    for (auto* events : {&ours, &theirs})
        for (Event& event : *events) clearTimes(event);
    ASSERT_EQ(ours.size(), theirs.size()) << what;
    for (std::size_t i = 0; i < ours.size(); ++i) ASSERT_EQ(ours[i], theirs[i]) << what << " " << i;
}

class LodTraceJs : public testing::Test {
protected:
    void SetUp() override {
        if (!hasNodeJs()) GTEST_SKIP() << "node is not installed";
        const std::string command = "node " WORLDY_SOURCE_DIR "/tests/trace/cesium/write_events.mjs " +
                                    (folder_ / "js.lodtrace").string() + " >/dev/null";
        ASSERT_EQ(std::system(command.c_str()), 0);
        content_ = tests::contentOf(folder_ / "js.lodtrace");
        js_ = readTrace(test::bytesOf(content_));
        ASSERT_EQ(js_.problem, "");
    }

    tests::TemporaryFolder folder_;
    std::string content_;
    ReadTrace js_;
};

TEST_F(LodTraceJs, tellsWhatTheHeaderInCTells) {
    const std::string content = writtenInC(folder_ / "c.lodtrace");
    const ReadTrace c = readTrace(test::bytesOf(content));
    ASSERT_EQ(c.problem, "");
    expectSame<TraceDescription>(js_, c, "description");
    expectSame<TraceNamed>(js_, c, "name");
    expectSame<TraceNodeTold>(js_, c, "node");
    expectSame<TraceFrameBegan>(js_, c, "begin");
    expectSame<TraceFrameEnded>(js_, c, "end");
    expectSame<TraceViewTold>(js_, c, "view");
    expectSame<TraceDrawn>(js_, c, "drawn");
    expectSame<TraceCulled>(js_, c, "culled");
    expectSame<TracePaged>(js_, c, "paging");
    expectSame<TraceCounted>(js_, c, "counter");
    expectSame<TraceSet>(js_, c, "setting");
    expectSame<TraceMessage>(js_, c, "message");
    expectSame<TraceThreadNamed>(js_, c, "thread");
    expectSame<TraceRestored>(js_, c, "restored");
    EXPECT_EQ(eventsOf<TraceKey>(js_.events).size(), 2u);
    EXPECT_EQ(eventsOf<TraceKey>(c.events).size(), 2u);
}

TEST_F(LodTraceJs, stampsEventsWithTheClockThatItIsGiven) {
    // 1 ms at first, 1 us before each frame, 0.5 us in it, and 70 s and 7 ns in frame 3.
    const auto begins = eventsOf<TraceFrameBegan>(js_.events);
    ASSERT_EQ(begins.size(), static_cast<std::size_t>(framesWritten));
    EXPECT_EQ(begins[0].ns, 1'001'000u);
    EXPECT_EQ(begins[2].ns, 1'004'000u);
    EXPECT_EQ(begins[3].ns, 70'001'005'507u);
    const auto ends = eventsOf<TraceFrameEnded>(js_.events);
    EXPECT_EQ(ends.back().ns, 70'001'450'007u);
    const auto paged = eventsOf<TracePaged>(js_.events);
    EXPECT_EQ(paged[3].ns, 1'004'500u);
    EXPECT_EQ(paged[4].ns, 70'001'004'500u);
}

TEST_F(LodTraceJs, tellsLostEventsInTheirFrame) {
    EXPECT_EQ(eventsOf<TraceDropped>(js_.events), std::vector<TraceDropped>{{300}});
    TraceState state;
    for (const TraceEvent& event : js_.events)
        if (state.add(event)) {
            EXPECT_EQ(state.frame().isComplete(), state.frame().number != 4);
        }
}

TEST_F(LodTraceJs, isReadFromItsSecondKeyOn) {
    auto trace = TraceFile::open(folder_ / "js.lodtrace");
    ASSERT_TRUE(trace) << trace.error().message;
    TraceState state;
    std::uint64_t last = 0;
    const auto sink = [&](const TraceEvent& event) {
        if (state.add(event)) last = state.frame().number;
    };
    ASSERT_TRUE(trace->seek(framesWritten, sink));
    for (auto more = trace->next(sink); more && *more;) more = trace->next(sink);
    EXPECT_EQ(last, static_cast<std::uint64_t>(framesWritten));
    const TraceNodeIndex pending = state.find(50);
    ASSERT_NE(pending, noTraceNode);
    EXPECT_EQ(state.nodes()[pending].data[3].data, TraceData::Started);
    EXPECT_EQ(state.nodes()[pending].data[3].requestedNs, 70'001'004'500u);
    EXPECT_EQ(state.nodes()[pending].data[3].startedNs, 70'001'004'507u);
    EXPECT_EQ(state.nodes()[state.find(1)].data[0].data, TraceData::Absent);
    EXPECT_EQ(state.setting("tau", 0), 2.0);
}

TEST(CesiumAdapter, namesTheFieldThatAnotherCesiumLacks) {
    if (!hasNodeJs()) GTEST_SKIP() << "node is not installed";
    const std::string command =
        "cd " WORLDY_SOURCE_DIR
        "/tests/trace/cesium && node --input-type=module -e \"import { traceCesium } from "
        "'./cesium_adapter.js';"
        "const scene = { globe: { _surface: { _tilesToRender: [] }, maximumScreenSpaceError: 2 },"
        "    preRender: 0, postRender: 0, mode: 3, camera: 0 };"
        "try { traceCesium({ VERSION: '9.1' }, scene, {}); } catch (error) { console.log(error.message); }\"";
    const std::unique_ptr<FILE, int (*)(FILE*)> output(popen(command.c_str(), "r"), pclose);
    std::array<char, 256> line{};
    ASSERT_NE(std::fgets(line.data(), line.size(), output.get()), nullptr);
    EXPECT_STREQ(line.data(),
                 "scene.globe._surface._tileLoadQueueHigh is missing in CesiumJS 9.1; expected the fields of "
                 "CesiumJS 1.140\n");
}

}  // namespace
}  // namespace planet
