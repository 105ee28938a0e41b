// Traces in the window: a file is opened and examined, and a running engine is attached.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <thread>

#include "planet/trace/lod_trace.h"
#include "planet/trace/trace_index.h"
#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"
#include "tests/support/small_trace.h"

namespace worldy {
namespace {

class TraceWindow : public PlanetWindowFixture {
protected:
    void SetUp() override {
        PlanetWindowFixture::SetUp();
        if (IsSkipped()) return;
        writeWindowSettings(folder, "data.set = \"planet.chk\"\n");
    }
};

TEST_F(TraceWindow, AFileIsExaminedAndClosed) {
    test::writeSmallTrace(folder.path() / "flight.lodtrace");
    const Ran ran = runInWindow(folder, "flight.lodtrace", R"sh(
until_true shown trace/Timeline || echo 'there is no timeline'
click trace/Last
tab 'Trace findings'
click trace_findings/Switches
click 'trace_findings/Switch 1'
until_true shown trace_node/Parent || echo 'the node is not shown'
click trace_node/Parent
tab 'Trace paging'
until_true shown trace_paging/Queue || echo 'there is no queue'
tab Trace
click trace/Close
until_true hidden trace/Timeline || echo 'the trace stays open'
)sh",
                                usualScreen);
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
    EXPECT_NE(ran.errors.find("flight.lodtrace opened"), std::string::npos) << ran.errors;
}

TEST_F(TraceWindow, ASecondTraceIsComparedFrameByFrame) {
    test::writeSmallTrace(folder.path() / "flight.lodtrace");
    test::writeSmallTrace(folder.path() / "later.lodtrace", test::smallTraceFrames,
                          {.rootFrame = 50, .rootFrames = 5});
    const Ran ran = runInWindow(folder, "flight.lodtrace", R"sh(
until_true shown trace/Timeline || echo 'there is no timeline'
click 'trace/Compare with...'
enter open/Path later.lodtrace
until_true shown 'trace_findings/Differing frame 4' || echo 'the differing frames are not shown'
click 'trace_findings/Differing frame 2'
until_true shown trace_findings/1/1/0 || echo 'the nodes that differ are not shown'
click trace_findings/1/1/0
until_true shown trace_node/Parent || echo 'the node is not selected'
click 'trace_findings/Compare with...'
enter open/Path planet.chk
until_true says 'planet.chk: .* no trace' || echo 'another file is not refused'
)sh",
                                usualScreen);
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
    EXPECT_NE(ran.errors.find("Compared 60 frames, 5 differ"), std::string::npos) << ran.errors;
}

TEST_F(TraceWindow, ADroppedFileIsOpened) {
    test::writeSmallTrace(folder.path() / "flight.lodtrace");
    const Ran ran = runInWindow(folder, "", R"sh(
')sh" DROP_FILE_BINARY R"sh(' Worldy "$PWD/flight.lodtrace" || echo 'the window does not take the trace'
until_true shown trace/Timeline || echo 'the trace is not shown'
)sh",
                                usualScreen);
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
    EXPECT_NE(ran.errors.find("flight.lodtrace opened"), std::string::npos) << ran.errors;
}

TEST_F(TraceWindow, ARunningEngineIsAttachedAndItsTraceIsKept) {
    std::array<char, 512> error{};
    lod_trace* const engine = lod_trace_open("tcp:127.0.0.1:0", nullptr, error.data(), error.size());
    ASSERT_TRUE(engine) << error.data();
    std::jthread frames([&](const std::stop_token& stop) {
        for (int frame = 0; !stop.stop_requested(); ++frame) {
            lod_trace_frame_begin(engine, frame / 60.0);
            lod_trace_drawn(engine, 0, 7, 0);
            lod_trace_frame_end(engine, 1, -1);
            std::this_thread::sleep_for(std::chrono::milliseconds(16));
        }
    });
    const int port = lod_trace_port(engine);
    const Ran ran = runInWindow(folder, "",
                                fmt::format(R"sh(
click menu/File
click 'menu item/Attach to an engine...'
enter trace/Port {}
click trace/Attach
until_true shown trace/Newest || echo 'no frame arrives'
click trace/Detach
until_true hidden trace/Newest || echo 'the engine stays attached'
until_true shown trace/Timeline || echo 'what has arrived is not shown'
)sh",
                                            port),
                                usualScreen);
    frames.request_stop();
    frames.join();
    lod_trace_close(engine);
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
    const auto kept = planet::TraceFile::open(folder.path() / "config" / "worldy" / "traces" /
                                              fmt::format("port {}.lodtrace", port));
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_FALSE(kept->problem());
    ASSERT_TRUE(kept->frames());
    EXPECT_GT(kept->frames()->last, kept->frames()->first);
}

}  // namespace
}  // namespace worldy
