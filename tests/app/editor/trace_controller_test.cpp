// A trace in the window is opened, attached to, played and closed.
#include "app/editor/trace_controller.h"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <fstream>
#include <thread>

#include "planet/trace/lod_trace.h"
#include "tests/support/small_trace.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;

class TraceControllers : public testing::Test {
protected:
    // Advances frames of the window until a condition holds; gives up after a minute.
    template <class Condition>
    bool advanceUntil(const Condition& condition) {
        for (int i = 0; i < 6000; ++i) {
            advanceTrace(controller_, 0, log_);
            if (condition()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }
    void send(const ui::TraceCommand& command) {
        execute(controller_, command, workspace_, 1e6, notices_, next_);
    }
    void open() {
        test::writeSmallTrace(file_);
        send(ui::OpenTrace{file_});
        ASSERT_TRUE(advanceUntil(
            [&] { return controller_.history && controller_.history->isComplete && controller_.frame; }));
    }
    bool shows(std::uint64_t frame) {
        return advanceUntil([&] { return controller_.frame && controller_.frame->frame.number == frame; });
    }

    const tests::TemporaryFolder folder_;
    const fs::path file_ = folder_.path() / "small.lodtrace";
    const Log log_;
    Notices notices_{log_};
    Workspace workspace_;
    ui::Commands next_;
    TraceController controller_;
};

TEST_F(TraceControllers, openingShowsTheFirstFrameAndThePanels) {
    open();
    EXPECT_TRUE(shows(1));
    EXPECT_TRUE(isShown(workspace_, PanelId::Trace));
    EXPECT_TRUE(isShown(workspace_, PanelId::TraceNodes));
    const ui::TraceView view = traceViewOf(controller_);
    EXPECT_EQ(view.file, file_);
    EXPECT_FALSE(view.isReading);
    EXPECT_FALSE(view.hasPlace);  // a flat world
    send(ui::CloseTrace{});
    EXPECT_TRUE(traceViewOf(controller_).file.empty());
}

TEST_F(TraceControllers, otherFilesAreRefusedAndTheOpenTraceStays) {
    open();
    const fs::path notes = folder_.path() / "notes.txt";
    std::ofstream(notes) << "no trace at all";
    send(ui::OpenTrace{notes});
    EXPECT_NE(notices_.message.text.find(notes.string()), std::string::npos) << notices_.message.text;
    EXPECT_EQ(traceViewOf(controller_).file, file_);
}

TEST_F(TraceControllers, stepsStayInTheTrace) {
    open();
    send(ui::ShowTraceFrame{30});
    EXPECT_TRUE(shows(30));
    send(ui::StepTrace{1});
    EXPECT_TRUE(shows(31));
    send(ui::StepTrace{-2});
    EXPECT_TRUE(shows(29));
    send(ui::StepTrace{-1000});
    EXPECT_TRUE(shows(1));
    send(ui::StepTrace{1000});
    EXPECT_TRUE(shows(test::smallTraceFrames));
}

TEST_F(TraceControllers, playingFollowsTheEnginesClock) {
    open();
    ASSERT_TRUE(shows(1));
    send(ui::PlayTrace{true, 2});
    advanceTrace(controller_, 1.01, log_);  // two seconds of a clock of 10 Hz
    EXPECT_TRUE(shows(21));
    advanceTrace(controller_, 60, log_);
    EXPECT_TRUE(shows(test::smallTraceFrames));
    EXPECT_FALSE(traceViewOf(controller_).playing);
    // Playing at the end begins anew.
    send(ui::PlayTrace{true, 1});
    EXPECT_TRUE(traceViewOf(controller_).playing);
    EXPECT_TRUE(shows(1));
}

TEST_F(TraceControllers, attachedEngineIsShownUntilItEnds) {
    std::array<char, 512> error{};
    lod_trace* engine = lod_trace_open("tcp:127.0.0.1:0", nullptr, error.data(), error.size());
    ASSERT_TRUE(engine) << error.data();
    ASSERT_TRUE(attachTrace(controller_, lod_trace_port(engine), folder_.path()));
    EXPECT_TRUE(traceViewOf(controller_).link.isOn);
    std::uint64_t told = 0;
    ASSERT_TRUE(advanceUntil([&] {
        lod_trace_frame_begin(engine, static_cast<double>(++told));
        lod_trace_drawn(engine, 0, 7, 0);
        lod_trace_frame_end(engine, 1, 1);
        return controller_.frame && controller_.frame->frame.number > 3;
    }));
    EXPECT_TRUE(traceViewOf(controller_).newest);
    EXPECT_TRUE(traceViewOf(controller_).link.isReceiving);
    // A frame that the user chooses stays.
    send(ui::ShowTraceFrame{controller_.frame->frame.number});
    EXPECT_FALSE(traceViewOf(controller_).newest);
    lod_trace_close(engine);
    EXPECT_TRUE(advanceUntil([&] { return !controller_.isLive; }));
    EXPECT_TRUE(advanceUntil([&] { return controller_.history && controller_.history->isComplete; }));
    EXPECT_TRUE(traceViewOf(controller_).link.isOn);  // waits for its next start
    const fs::path file = traceViewOf(controller_).file;
    send(ui::DetachTrace{});
    EXPECT_FALSE(traceViewOf(controller_).link.isOn);
    EXPECT_EQ(traceViewOf(controller_).file, file);
    EXPECT_TRUE(isTraceFile(file));
}

TEST_F(TraceControllers, impossiblePortsAreRefused) {
    EXPECT_FALSE(attachTrace(controller_, 0, folder_.path()));
    EXPECT_FALSE(attachTrace(controller_, 70'000, folder_.path()));
    EXPECT_FALSE(traceViewOf(controller_).link.isOn);
}

TEST_F(TraceControllers, whatIfRunsOverTheOpenTrace) {
    TraceWhatIfRequest request;
    request.settings.emplace_back().tauPx = 4;
    send(ui::StartTraceWhatIf{request});
    EXPECT_FALSE(traceViewOf(controller_).whatIf.running);
    open();
    send(ui::StartTraceWhatIf{request});
    EXPECT_TRUE(advanceUntil([&] { return traceViewOf(controller_).whatIf.result != nullptr; }));
}

TEST_F(TraceControllers, aSecondTraceIsComparedWithTheOpenOne) {
    const fs::path other = folder_.path() / "other.lodtrace";
    test::writeSmallTrace(other, 40);
    send(ui::StartTraceCompare{other});
    EXPECT_FALSE(traceViewOf(controller_).compared.running);
    open();
    workspace_ = {};
    send(ui::StartTraceCompare{other, planet::TraceMatch::Number});
    EXPECT_TRUE(isShown(workspace_, PanelId::TraceFindings));
    ASSERT_TRUE(advanceUntil([&] { return traceViewOf(controller_).compared.result != nullptr; }));
    const ui::TraceComparedView view = traceViewOf(controller_).compared;
    EXPECT_FALSE(view.running);
    EXPECT_EQ(view.problem, "");
    EXPECT_EQ(view.result->found.frames, 40u);
    EXPECT_EQ(view.match, planet::TraceMatch::Number);

    send(ui::StartTraceCompare{folder_.path() / "missing.lodtrace"});
    ASSERT_TRUE(advanceUntil([&] { return !traceViewOf(controller_).compared.running; }));
    EXPECT_NE(traceViewOf(controller_).compared.problem.find("missing.lodtrace"), std::string::npos);
    EXPECT_NE(traceViewOf(controller_).compared.result, nullptr);
    EXPECT_EQ(traceViewOf(controller_).compared.match, planet::TraceMatch::Number);
}

}  // namespace
}  // namespace worldy
