#include "ui/panels/frame/timeline_panel.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/editor_fixture.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/planet_fixture.h"
#include "ui/kit/plot_keys.h"
#include "ui/panels/frame/timeline_export.h"

namespace worldy::ui {
namespace {

constexpr std::int64_t frameNs = 16'700'000;  // of the fixture

class TimelinePanel : public testing::Test {
protected:
    TimelinePanel() {
        editor_.fly({}, 30);
        ImGuiIO& io = ImGui::GetIO();
        for (const ImGuiKey key :
             {ImGuiKey_LeftArrow, ImGuiKey_RightArrow, ImGuiKey_UpArrow, ImGuiKey_DownArrow, ImGuiKey_Home,
              ImGuiKey_End, ImGuiKey_PageUp, ImGuiKey_PageDown, ImGuiKey_Enter, ImGuiKey_Space})
            io.KeyMap[key] = 10 + key;
        frame();
        frame();
    }

    Commands frame() {
        Commands commands;
        EditorView view = editor_.view();
        view.frames.recordsTimeline = records_;
        window_.frame([&] { timelinePanel(view, state_, commands); });
        return commands;
    }
    // Clicks an item and returns the commands.
    Commands clicked(std::string_view label, float share = 0.5f) {
        Commands all;
        window_.click(label, share, [&] { addAsked(frame(), all); });
        return all;
    }
    // Moves the pointer over the lanes, from their left (0) to their right (1), in the row of the frames.
    void pointAtFrames(float share) {
        const ItemPlace* const lanes = window_.find("Lanes");
        ASSERT_TRUE(lanes);
        const float x = lanes->rect.x + labels_ + share * (lanes->rect.width - labels_ - 2);
        PanelWindow::movePointer({x, lanes->rect.y + 5});
    }
    void drag(float from, float to, bool shift) {
        ImGui::GetIO().KeyShift = shift;
        pointAtFrames(from);
        frame();
        PanelWindow::press(true);
        frame();
        pointAtFrames(to);
        frame();
        PanelWindow::press(false);
        frame();
        ImGui::GetIO().KeyShift = false;
    }
    void key(ImGuiKey key) {
        ImGui::GetIO().KeysDown[10 + key] = true;
        frame();
        ImGui::GetIO().KeysDown[10 + key] = false;
        frame();
    }
    TimelineLanesState& lanes() { return state_.lanes; }
    const FrameTimeline& timeline() const { return editor_.timeline(); }

    const float labels_ = 80;  // more than the width of the lanes' names
    PanelWindow window_{{1600, 400}};
    test::EditorFixture editor_{planet::openFake()};
    TimelinePanelState state_;
    bool records_ = true;
};

TEST_F(TimelinePanel, followsTheNewestFrameUntilItIsHeld) {
    EXPECT_EQ(lanes().shown.toNs, timeline().extent().toNs);
    editor_.fly({}, 5);
    frame();
    EXPECT_EQ(lanes().shown.toNs, timeline().extent().toNs);
    clicked("Hold", 0.1f);
    ASSERT_TRUE(lanes().held);
    const TimeRange held = lanes().shown;
    editor_.fly({}, 5);
    frame();
    EXPECT_EQ(lanes().shown, held);
}

TEST_F(TimelinePanel, theWheelZoomsAboutThePointerAndHolds) {
    clicked("Fit");
    const TimeRange all = lanes().shown;
    EXPECT_EQ(all, timeline().extent());
    pointAtFrames(1);
    frame();
    ImGui::GetIO().MouseWheel = 1;
    frame();
    ImGui::GetIO().MouseWheel = 0;
    EXPECT_TRUE(lanes().held);
    EXPECT_NEAR(static_cast<double>(lanes().shown.lengthNs()), 0.8 * static_cast<double>(all.lengthNs()),
                1e5);
    // The right end is under the pointer, so it stays.
    EXPECT_NEAR(static_cast<double>(lanes().shown.toNs), static_cast<double>(all.toNs),
                0.02 * static_cast<double>(all.lengthNs()));
}

TEST_F(TimelinePanel, shiftAndDragMarksARangeWhosePercentilesAreTold) {
    clicked("Fit");
    drag(0.25f, 0.75f, true);
    ASSERT_TRUE(lanes().marked);
    EXPECT_NEAR(static_cast<double>(lanes().marked->lengthNs()),
                0.5 * static_cast<double>(timeline().extent().lengthNs()), 20e6);
    EXPECT_EQ(toldRange(lanes()), *lanes().marked);
    clicked("Clear range");
    EXPECT_FALSE(lanes().marked);
    EXPECT_EQ(toldRange(lanes()), lanes().shown);
}

TEST_F(TimelinePanel, aDragMovesTheView) {
    clicked("Fit");
    lanes().shown = {timeline().extent().fromNs, timeline().extent().fromNs + 5 * frameNs};
    drag(0.8f, 0.4f, false);
    EXPECT_FALSE(lanes().marked);
    EXPECT_FALSE(lanes().frame);
    EXPECT_EQ(lanes().shown.lengthNs(), 5 * frameNs);
    EXPECT_NEAR(static_cast<double>(lanes().shown.fromNs - timeline().extent().fromNs), 2e-9 * frameNs * 1e9,
                0.3 * frameNs);
}

TEST_F(TimelinePanel, aClickOnAFrameListsItsChunksAndAClickOnOneSelectsIt) {
    clicked("Fit");
    pointAtFrames(0.5f);
    for (const bool down : {false, true, false}) {
        PanelWindow::press(down);
        frame();
    }
    ASSERT_TRUE(lanes().frame);
    EXPECT_NEAR(static_cast<double>(*lanes().frame), 15, 2);
    frame();
    ASSERT_TRUE(window_.isShown("Change 0"));
    const Commands commands = clicked("Change 0");
    ASSERT_EQ(commands.size(), 1u);
    ASSERT_TRUE(commands[0].as<SelectChunk>());
    const auto [first, last] = timeline().changesIn(*lanes().frame, *lanes().frame);
    ASSERT_LT(first, last);
    EXPECT_EQ(commands[0].as<SelectChunk>()->id, timeline().changes()[first].block.parent);
}

TEST_F(TimelinePanel, aDoubleClickZoomsToTheFrame) {
    clicked("Fit");
    pointAtFrames(0.5f);
    for (const bool down : {false, true, false, true, false}) {
        PanelWindow::press(down);
        frame();
    }
    EXPECT_NEAR(static_cast<double>(lanes().shown.lengthNs()), 1.1 * frameNs, 0.02 * frameNs);
}

TEST_F(TimelinePanel, keysMoveZoomAndFitWhileTheLanesHaveTheFocus) {
    EXPECT_FALSE(plotTakesKeys());
    clicked("Fit");
    pointAtFrames(0.5f);
    for (const bool down : {false, true, false}) {
        PanelWindow::press(down);
        frame();
    }
    EXPECT_TRUE(plotTakesKeys());
    const TimeRange all = timeline().extent();
    key(ImGuiKey_UpArrow);
    EXPECT_NEAR(static_cast<double>(lanes().shown.lengthNs()), 0.7 * static_cast<double>(all.lengthNs()), 10);
    key(ImGuiKey_Home);
    EXPECT_EQ(lanes().shown.fromNs, all.fromNs);
    const std::int64_t lengthNs = lanes().shown.lengthNs();
    key(ImGuiKey_RightArrow);
    EXPECT_NEAR(static_cast<double>(lanes().shown.fromNs - all.fromNs), 0.1 * static_cast<double>(lengthNs),
                10);
    EXPECT_EQ(lanes().shown.lengthNs(), lengthNs);
    ImGui::GetIO().AddInputCharacter('f');
    frame();
    EXPECT_EQ(lanes().shown, all);
    ImGui::GetIO().AddInputCharacter('+');
    frame();
    EXPECT_LT(lanes().shown.lengthNs(), all.lengthNs());
    ImGui::GetIO().AddInputCharacter('-');
    frame();
    EXPECT_EQ(lanes().shown.lengthNs(), all.lengthNs());
    key(ImGuiKey_End);
    EXPECT_FALSE(lanes().held);
}

TEST_F(TimelinePanel, framesAreSelectedMarkedAndZoomedToByKeys) {
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    clicked("Fit");
    pointAtFrames(0.5f);
    for (const bool down : {false, true, false}) {
        PanelWindow::press(down);
        frame();
    }
    ASSERT_TRUE(lanes().frame);
    const std::uint64_t first = *lanes().frame;
    ImGui::GetIO().KeyShift = true;
    key(ImGuiKey_RightArrow);
    EXPECT_EQ(*lanes().frame, first + 1);
    EXPECT_FALSE(lanes().marked);
    key(ImGuiKey_PageDown);
    key(ImGuiKey_PageDown);
    ImGui::GetIO().KeyShift = false;
    EXPECT_EQ(*lanes().frame, first + 3);
    ASSERT_TRUE(lanes().marked);
    EXPECT_NEAR(static_cast<double>(lanes().marked->lengthNs()), 3 * frameNs, 0.01 * frameNs);
    key(ImGuiKey_Enter);
    EXPECT_NEAR(static_cast<double>(lanes().shown.lengthNs()), 1.1 * frameNs, 0.02 * frameNs);
}

TEST_F(TimelinePanel, savesTheMarkedRangeAsAChromeTrace) {
    clicked("Fit");
    lanes().marked = TimeRange{timeline().frames()[3].beginNs, timeline().frames()[5].beginNs};
    const Commands commands = clicked("Save Chrome trace");
    ASSERT_EQ(commands.size(), 1u);
    const auto* const save = commands[0].as<SaveExport>();
    ASSERT_TRUE(save);
    EXPECT_EQ(save->extension, "json");
    const auto json = nlohmann::json::parse(save->text);
    int frames = 0;
    for (const auto& event : json.at("traceEvents")) frames += event.at("name") == "frame";
    EXPECT_EQ(frames, 2);
    EXPECT_EQ(json.at("otherData").at("data_set"), "earth.chk");
    EXPECT_EQ(json.at("otherData").at("gpu_clock_error_us"), 0.4);
}

TEST_F(TimelinePanel, recordIsACommand) {
    const Commands commands = clicked("Record", 0.1f);
    ASSERT_EQ(commands.size(), 1u);
    ASSERT_TRUE(commands[0].as<RecordTimeline>());
    EXPECT_FALSE(commands[0].as<RecordTimeline>()->on);
}

TEST_F(TimelinePanel, theTableOfFramesHasThoseThatBeginInTheRange) {
    const auto& frames = timeline().frames();
    const ExportTable table = timelineFramesTable(timeline(), {frames[3].beginNs + 1, frames[6].beginNs});
    ASSERT_EQ(table.rows, 2u);
    EXPECT_EQ(tsvOf(table, std::vector<std::size_t>{0}, false),
              "frame\tbegin_s\tframe_ms\tcame_blocks\tsplits\tmerges\tpops\tevicted_blocks\tfailed_blocks\t"
              "largest_pop_px\n5\t0.0668\t16.7\t1\t1\t0\t1\t0\t0\t1.25\n");
}

TEST_F(TimelinePanel, withoutARecordItSaysWhatToDo) {
    const FrameTimeline empty;
    Commands commands;
    EditorView view = editor_.view();
    view.frames.timeline = &empty;
    for (int i = 0; i < 2; ++i) window_.frame([&] { timelinePanel(view, state_, commands); });
    EXPECT_FALSE(window_.isShown("Lanes"));
    view.planet = nullptr;
    window_.frame([&] { timelinePanel(view, state_, commands); });
    EXPECT_FALSE(window_.isShown("Record"));
}

}  // namespace
}  // namespace worldy::ui
