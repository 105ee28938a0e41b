// Takes tables, plots, notes and the session report out of the window, by mouse and keyboard.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "app/base/picture_file.h"
#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using testing::Not;

class TakeAwayWindowTest : public PlanetWindowFixture {
protected:
    void SetUp() override {
        PlanetWindowFixture::SetUp();
        if (IsSkipped()) return;
        std::filesystem::create_directories(saved());
        setenv("XDG_PICTURES_DIR", saved().c_str(), 1);
    }
    void TearDown() override { unsetenv("XDG_PICTURES_DIR"); }

    void drive(const std::string& steps) {
        const Ran ran = runInWindow(folder, "planet.chk", steps, usualScreen);
        expectQuiet(ran);
    }
    std::filesystem::path saved() const { return folder.path() / "saved"; }
    // Returns the file or folder whose name ends so; empty if there is none.
    std::filesystem::path found(const std::string& ending) const {
        for (const auto& entry : std::filesystem::directory_iterator(saved()))
            if (entry.path().filename().string().ends_with(ending)) return entry.path();
        return {};
    }
};

TEST_F(TakeAwayWindowTest, ATableAndAPlotAreSavedBesideTheScreenshots) {
    drive(R"sh(
slide "lod/Tolerance τ" 0.2; settle
tab Seams; expect shown "seams/LOD seams menu"
click "seams/LOD seams menu" && click "seams/Save all as CSV"; expect says 'LOD seams.csv'
click "seams/LOD seams menu" && click "seams/Save all as TSV"; expect says 'LOD seams.tsv'
click "seams/level differences menu" && click "seams/Save picture as PNG"; expect says 'level differences.png'
)sh");
    const std::string csv = contentOf(found("LOD seams.csv"));
    EXPECT_TRUE(csv.starts_with("schema_version,level_difference,edge,finer,coarser\r\n2,"))
        << csv.substr(0, 200);
    EXPECT_GT(std::count(csv.begin(), csv.end(), '\n'), 10);
    const std::string tsv = contentOf(found("LOD seams.tsv"));
    EXPECT_EQ(std::count(tsv.begin(), tsv.end(), '\n'), std::count(csv.begin(), csv.end(), '\n'));
    const auto picture = readPicture(found("level differences.png"));
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_GT(picture->width, 100);
    EXPECT_LT(picture->width, 600);
}

TEST_F(TakeAwayWindowTest, ANoteLiesOnTheGlobeAndOpensAgain) {
    drive(R"sh(
key ctrl+m; expect shown notes/Text
click notes/Text; xdotool type --delay 20 "A ridge"; frames
click "notes/Add note"; expect shown "notes/Note 1"; expect shown "viewport/note 1"
expect says 'planet.notes.toml'
click "notes/Edit"; click "notes/Edited text"; key ctrl+a; xdotool type --delay 20 "Changed words"; frames
click notes/Save; frames
)sh");
    EXPECT_THAT(contentOf(folder.path() / "planet.notes.toml"), HasSubstr("text = 'Changed words'"));
    drive(R"sh(
key ctrl+m; expect hidden notes/Text
click "viewport/note 1"; expect shown "notes/Note 1"
click "notes/Delete..."; click notes/Delete; expect hidden "viewport/note 1"
)sh");
    EXPECT_THAT(contentOf(folder.path() / "planet.notes.toml"), Not(HasSubstr("Changed words")));
}

TEST_F(TakeAwayWindowTest, ABrokenFileOfNotesIsNamedAndKept) {
    std::ofstream(folder.path() / "planet.notes.toml") << "format = 1\n[[note]]\nid = oops\n";
    drive(R"sh(
expect says 'planet.notes.toml: line 3'
key Escape; key ctrl+m
click notes/Text; xdotool type --delay 20 "kept"; frames
click "notes/Add note"; expect shown "notes/Note 1"
)sh");
    EXPECT_EQ(contentOf(folder.path() / "planet.notes.toml"), "format = 1\n[[note]]\nid = oops\n");
    EXPECT_THAT(contentOf(folder.path() / "planet.notes.session.toml"), HasSubstr("text = 'kept'"));
}

TEST_F(TakeAwayWindowTest, ASessionReportIsOneCommand) {
    drive(R"sh(
slide "lod/Tolerance τ" 0.2; settle
key ctrl+shift+2; click cracks/Measure; settle
click menu/File && click "menu item/Save session report..."; expect says 'report.md'
)sh");
    const std::filesystem::path report = found("report");
    ASSERT_FALSE(report.empty());
    const std::string text = contentOf(report / "report.md");
    EXPECT_THAT(text, HasSubstr("# Worldy: session report on planet.chk"));
    EXPECT_THAT(text, HasSubstr("lod.tau\\_px"));
    EXPECT_THAT(text, HasSubstr("| Crack pixels |"));
    EXPECT_THAT(text, HasSubstr("worldy shot"));
    const auto window = readPicture(report / "window.png"), planet = readPicture(report / "planet.png");
    ASSERT_TRUE(window && planet);
    EXPECT_EQ(window->width, 1280);
    EXPECT_LT(planet->width, window->width);
}

}  // namespace
}  // namespace worldy
