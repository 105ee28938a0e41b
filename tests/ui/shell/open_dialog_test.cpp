#include "ui/shell/open_dialog.h"

#include <gtest/gtest.h>
#include <imgui_internal.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "app/flight/flight_record.h"
#include "tests/support/panel_fixture.h"
#include "tests/support/temporary_folder.h"
#include "ui/model/recording_view.h"

namespace worldy::ui {
namespace {

TEST(OpenDialog, listsRecordedFlights) {
    const std::filesystem::path flight = std::string("canyon") + recordedFlightEnding;
    EXPECT_TRUE(worldy::isFlightRecord(flight));
    EXPECT_TRUE(mayBeOpened(flight, FilePurpose::Open));
}

TEST(OpenDialog, listsOnlyTracesForATrace) {
    EXPECT_TRUE(mayBeOpened("engine.LODTRACE", FilePurpose::TraceB));
    EXPECT_FALSE(mayBeOpened("planet.chk", FilePurpose::TraceB));
    EXPECT_TRUE(mayBeOpened("planet.chk", FilePurpose::Open));
}

// The dialog over a folder with a planet in a folder within it.
class OpenDialogWindow : public testing::Test {
protected:
    OpenDialogWindow() {
        std::filesystem::create_directory(folder_ / "sub");
        std::ofstream(folder_ / "sub" / "planet.chk");
        state_.folder = folder_ / "";
        ask();
    }
    void ask() {
        state_.opening = true;
        for (int i = 0; i < 3; ++i) frame();
    }
    void frame() {
        window_.frame([&] { openDialog(state_, commands_); });
    }
    void click(const char* item) {
        window_.click(item, 0.5f, [&] { frame(); });
        frame();
    }
    void setField(const std::filesystem::path& path) {
        std::snprintf(state_.path.data(), state_.path.size(), "%s", path.c_str());
    }
    std::filesystem::path field() const { return state_.path.data(); }
    // Ends the edit of the field, which would otherwise keep its own text.
    void leaveField() {
        ImGui::ClearActiveID();
        frame();
    }

    const tests::TemporaryFolder folder_;
    PanelWindow window_{{900, 700}};
    OpenDialogState state_;
    Commands commands_;
};

TEST_F(OpenDialogWindow, listsTheFolderOfTheFileThatWasOpenedLast) {
    leaveField();
    setField(folder_ / "sub" / "planet.chk");
    frame();
    click("open/Open");
    ASSERT_EQ(commands_.size(), 1u);
    ASSERT_TRUE(commands_[0].as<OpenFile>());
    EXPECT_EQ(commands_[0].as<OpenFile>()->file, folder_ / "sub" / "planet.chk");
    EXPECT_TRUE(commands_[0].as<OpenFile>()->asks) << "a raster may become a layer";
    ask();
    EXPECT_EQ(state_.folder, field().parent_path());
    EXPECT_EQ(field().filename(), "planet.chk");
    ASSERT_EQ(state_.entries.size(), 1u);
    EXPECT_EQ(state_.entries[0].path, field()) << "its row is marked";
}

TEST_F(OpenDialogWindow, theFieldFollowsToAnotherFolder) {
    leaveField();
    setField(folder_ / "sub" / "planet.chk");
    frame();
    click("open/Open");
    ask();
    leaveField();
    click("open/Up");
    EXPECT_EQ(field(), state_.folder);
    setField(folder_ / "sub");
    frame();
    click("open/Open");
    EXPECT_EQ(commands_.size(), 1u) << "a folder is entered";
    EXPECT_EQ(field(), state_.folder);
    EXPECT_EQ(state_.folder.filename(), "sub");
}

}  // namespace
}  // namespace worldy::ui
