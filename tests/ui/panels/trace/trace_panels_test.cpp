// The trace panels show what the trace says, and their controls ask for it.
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <optional>
#include <thread>

#include "app/trace/trace_compare_job.h"
#include "app/trace/trace_document.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/small_trace.h"
#include "tests/support/temporary_folder.h"
#include "ui/kit/exports.h"
#include "ui/shell/panels.h"

namespace worldy::ui {
namespace {

using test::smallTraceId;

class TracePanels : public testing::Test {
protected:
    TracePanels() : file_(folder_.path() / "small.lodtrace"), window_({1200, 700}) {
        test::writeSmallTrace(file_);
        document_ = std::make_unique<TraceDocument>(file_, false);
        show(16);
    }
    void show(std::uint64_t number) {
        document_->show(number);
        for (int i = 0; i < 6000; ++i) {
            if (!document_->isBusy() && document_->history() && document_->history()->isComplete) break;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        frame_ = document_->frame();
        history_ = document_->history();
        ASSERT_TRUE(frame_ && history_);
    }
    EditorView view() {
        EditorView view{.frames = {.stats = stats_, .history = frames_},
                        .log = log_,
                        .instruments = {.changes = changes_}};
        view.trace = trace_;
        if (isOpen_) {
            view.trace.file = file_;
            view.trace.frame = frame_.get();
            view.trace.history = history_.get();
        }
        return view;
    }
    Commands draw(PanelId panel) {
        Commands commands;
        for (int i = 0; i < 3; ++i)
            window_.frame([&] { drawPanel(panel, view(), states_, settings_, commands); });
        return commands;
    }
    Commands click(PanelId panel, const char* item, float share = 0.5f) {
        draw(panel);
        Commands commands;
        window_.click(item, share, [&] {
            window_.frame([&] { drawPanel(panel, view(), states_, settings_, commands); });
        });
        return commands;
    }
    template <class Kind>
    static std::optional<Kind> find(const Commands& commands) {
        for (const Command& command : commands)
            if (const Kind* const found = command.as<Kind>()) return *found;
        return std::nullopt;
    }

    const tests::TemporaryFolder folder_;
    const std::filesystem::path file_;
    PanelWindow window_;
    std::unique_ptr<TraceDocument> document_;
    std::shared_ptr<const TracedFrame> frame_;
    std::shared_ptr<const TraceHistory> history_;
    TraceView trace_{.newest = false};
    bool isOpen_ = true;
    PanelStates states_;
    ViewSettings settings_;
    FrameStats stats_;
    std::deque<FrameSample> frames_;
    std::deque<LogLine> log_;
    planet::LodChanges changes_;
};

constexpr std::array tracePanels = {PanelId::Trace,       PanelId::TraceNodes,    PanelId::TraceNode,
                                    PanelId::TracePaging, PanelId::TraceFindings, PanelId::TraceWhatIf};

TEST_F(TracePanels, drawWithoutATraceAndInAnySize) {
    for (const ImVec2 size : {ImVec2(1200, 700), ImVec2(330, 400), ImVec2(60, 40)}) {
        PanelWindow::resize(size);
        for (const bool isOpen : {true, false}) {
            isOpen_ = isOpen;
            for (const PanelId panel : tracePanels)
                EXPECT_TRUE(draw(panel).empty()) << static_cast<int>(panel);
        }
    }
}

// The engine's clock may be no number, and a level may be any.
TEST_F(TracePanels, numbersThatAreNoneDrawToo) {
    constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
    TraceHistory history = *history_;
    TracedFrame frame = *frame_;
    for (const double timeS : {notANumber, std::numeric_limits<double>::infinity(), -1e308, 1e308}) {
        history.samples[10].timeS = frame.frame.timeS = timeS;
        history_ = std::make_shared<TraceHistory>(history);
        frame.views.at(0).nodes.at(0).node.level = 0xFFFFFFFF;
        frame_ = std::make_shared<TracedFrame>(frame);
        states_.traceNodes.colouring = TraceColouring::Level;
        for (const PanelId panel : tracePanels) draw(panel);
    }
    const Legend legend = traceLegend(TraceColouring::Level, frame.views.at(0));
    ASSERT_EQ(legend.entries.size(), 2u);  // and the mark of the node that waits
    EXPECT_EQ(legend.entries[0].label, "4294967295");
}

TEST_F(TracePanels, theTimelineHasTheTrianglesThatTheEngineTold) {
    ExportState exports;
    const auto samples = [&] {
        Commands commands;
        const auto drawn = [&] {
            beginExports(exports, commands);
            window_.frame([&] { drawPanel(PanelId::Trace, view(), states_, settings_, commands); });
            endExports();
        };
        for (int i = 0; i < 3; ++i) drawn();
        window_.click("timeline menu", 0.5f, drawn);
        window_.click("Copy samples", 0.5f, drawn);
        return find<CopyText>(commands).value_or(CopyText{}).text;
    };
    const std::string told = samples();
    EXPECT_NE(told.find("drawn (triangles)"), std::string::npos) << told.substr(0, 200);
    EXPECT_NE(told.find("\t896"), std::string::npos);  // seven nodes of 128
    TraceHistory untold = *history_;
    for (TracedViewSample& sample : untold.views.at(0)) sample.triangles = 0;
    history_ = std::make_shared<TraceHistory>(untold);
    EXPECT_EQ(samples().find("triangles"), std::string::npos);
}

TEST_F(TracePanels, attachAsksForThePort) {
    const Commands commands = click(PanelId::Trace, "Attach");
    ASSERT_TRUE(find<AttachTrace>(commands));
    EXPECT_EQ(find<AttachTrace>(commands)->port, 9910);
    trace_.link = {.isOn = true, .message = "waits"};
    EXPECT_TRUE(find<DetachTrace>(click(PanelId::Trace, "Detach")));
}

TEST_F(TracePanels, transportMovesThroughTheFrames) {
    EXPECT_EQ(find<StepTrace>(click(PanelId::Trace, "Next")).value_or(StepTrace{0}).frames, 1);
    EXPECT_EQ(find<StepTrace>(click(PanelId::Trace, "Back")).value_or(StepTrace{0}).frames, -1);
    EXPECT_EQ(find<ShowTraceFrame>(click(PanelId::Trace, "Last")).value_or(ShowTraceFrame{}).frame,
              test::smallTraceFrames);
    EXPECT_TRUE(find<PlayTrace>(click(PanelId::Trace, "Play")).value_or(PlayTrace{}).playing);
    // The middle of the timeline is half of the time: 6 s of a clock of 10 Hz, from 0.1 s on.
    const auto shown = find<ShowTraceFrame>(click(PanelId::Trace, "Timeline"));
    ASSERT_TRUE(shown);
    EXPECT_NEAR(static_cast<double>(shown->frame), 30, 1);
}

TEST_F(TracePanels, clickInTheNetSelectsTheNodeThere) {
    show(30);
    const Commands commands = click(PanelId::TraceNodes, "Nodes");
    // The middle belongs to one of the four children.
    ASSERT_TRUE(find<SelectTraceNode>(commands));
    ASSERT_TRUE(find<SelectTraceNode>(commands).value_or(SelectTraceNode{}).id);
    EXPECT_NE(*find<SelectTraceNode>(commands).value_or(SelectTraceNode{}).id, smallTraceId(0, 0, 0));
}

TEST_F(TracePanels, everyLayoutAndColouringDraws) {
    for (int layout = 0; layout < 4; ++layout) {
        for (int colouring = 0; colouring < 4; ++colouring) {
            draw(PanelId::TraceNodes);  // chooses the layout of the file
            states_.traceNodes.layout = static_cast<TraceLayout>(layout);
            states_.traceNodes.colouring = static_cast<TraceColouring>(colouring);
            trace_.selected = smallTraceId(0, 0, 0);
            draw(PanelId::TraceNodes);
            EXPECT_EQ(states_.traceNodes.plan.problem, "");
        }
    }
}

TEST_F(TracePanels, clickOnASwitchShowsItsFrameAndItsNode) {
    draw(PanelId::TraceFindings);
    click(PanelId::TraceFindings, "Switches");
    const Commands commands = click(PanelId::TraceFindings, "Switch 1");
    ASSERT_TRUE(find<ShowTraceFrame>(commands));
    EXPECT_EQ(find<ShowTraceFrame>(commands).value_or(ShowTraceFrame{}).frame, 41u);
    EXPECT_EQ(find<SelectTraceNode>(commands).value_or(SelectTraceNode{}).id, smallTraceId(1, 0, 0));
}

TEST_F(TracePanels, theWorstNodeIsAClickAway) {
    trace_.selected = smallTraceId(1, 0, 0);
    EXPECT_EQ(find<SelectTraceNode>(click(PanelId::TraceNode, "Worst node")).value_or(SelectTraceNode{}).id,
              smallTraceId(0, 0, 0));
    EXPECT_EQ(find<SelectTraceNode>(click(PanelId::TraceNode, "Parent")).value_or(SelectTraceNode{}).id,
              smallTraceId(0, 0, 0));
}

TEST_F(TracePanels, compareWithAsksForTheSecondTrace) {
    EXPECT_EQ(find<AskForFile>(click(PanelId::Trace, "Compare with...")).value_or(AskForFile{}).purpose,
              FilePurpose::TraceB);
    trace_.compared.running = true;
    EXPECT_FALSE(find<AskForFile>(click(PanelId::Trace, "Compare with...")));
}

TEST_F(TracePanels, aRunningComparisonIsShownAndCancelled) {
    trace_.compared.running = true;
    trace_.compared.runs = 1;
    EXPECT_TRUE(find<CancelTraceCompare>(click(PanelId::TraceFindings, "Cancel")));
}

TEST_F(TracePanels, aDifferingFrameAndItsNodesAreAClickAway) {
    const std::filesystem::path other = folder_ / "other.lodtrace";
    test::writeSmallTrace(other, test::smallTraceFrames, {.rootFrame = 50, .rootFrames = 5});
    const TraceCompared compared = compareTraceFiles({.fileA = file_, .fileB = other}, {}).value();
    trace_.compared.result = &compared;
    trace_.compared.fileB = other;
    click(PanelId::TraceFindings, "Compared");
    EXPECT_FALSE(window_.isShown("Differing frame 5"));
    // The middle of the row is the border between two columns, which can be dragged.
    const Commands commands = click(PanelId::TraceFindings, "Differing frame 2", 0.1f);
    EXPECT_EQ(find<ShowTraceFrame>(commands).value_or(ShowTraceFrame{}).frame, 52u);
    ASSERT_TRUE(find<SelectTraceView>(commands));

    const std::string root = tracedName(compared.found.descriptionB, smallTraceId(0, 0, 0));
    draw(PanelId::TraceFindings);
    EXPECT_FALSE(window_.isShown(root));
    show(52);
    EXPECT_EQ(
        find<SelectTraceNode>(click(PanelId::TraceFindings, root.c_str())).value_or(SelectTraceNode{}).id,
        smallTraceId(0, 0, 0));

    const auto again = find<StartTraceCompare>(click(PanelId::TraceFindings, "Compare again"));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->fileB, other);
    std::strcpy(states_.traceFindings.compared.filter.text.data(), "53");
    draw(PanelId::TraceFindings);
    EXPECT_TRUE(window_.isShown("Differing frame 0"));
    EXPECT_FALSE(window_.isShown("Differing frame 1"));
    // The timeline has a mark of four vertices for each of the five frames.
    const auto vertices = [&] {
        draw(PanelId::Trace);
        return ImGui::GetDrawData()->TotalVtxCount;
    };
    const int marked = vertices();
    trace_.compared.result = nullptr;
    EXPECT_EQ(marked - vertices(), 5 * 4);
    // The result of another trace is not shown.
    TraceCompared foreign = compared;
    foreign.request.fileA = other;
    trace_.compared.result = &foreign;
    draw(PanelId::TraceFindings);
    EXPECT_FALSE(window_.isShown("Differing frame 0"));
}

}  // namespace
}  // namespace worldy::ui
