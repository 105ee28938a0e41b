#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <string>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr int faceSide = 257;

// A folder with one of everything that commands read.
class Overwrite : public testing::Test {
protected:
    Overwrite() {
        bakePlanet(folder_);
        copy("planet.chk", "s.chk");
        copy("hills.pgm", "n.tif");
        copy("hills.pgm", "x.tif");
        std::ofstream flight(path("d.toml"));
        for (const int timeS : {0, 1}) {
            flight
                << "[[key]]\ntime_s = " << timeS
                << "\nlatitude_deg = 5\nlongitude_deg = 5\naltitude_m = 90000\nheading_deg = 0\npitch_deg = "
                   "-60\n";
        }
        std::ofstream(path("own.toml")) << "[lod]\ntau_px = 3\n";
        for (const char* face : {"x_pos", "x_neg", "y_pos", "y_neg", "z_pos", "z_neg"}) {
            std::ofstream(path("faces257_" + std::string(face) + ".raw"))
                << std::string(faceSide * faceSide, 'h');
        }
        EXPECT_EQ(runWorldy(folder_, "shot s.chk -o c.jpg --size 64x64").exitCode, 0);
        fs::create_symlink("n.tif", path("link.tif"));
        fs::create_hard_link(path("s.chk"), path("hard.chk"));
    }

    fs::path path(const std::string& name) const { return folder_.path() / name; }
    void copy(const char* from, const char* to) const { fs::copy_file(path(from), path(to)); }
    Ran run(const std::string& command) const { return runWorldy(folder_, command); }

    // Every file's content by its name, all but what runs themselves leave.
    std::map<std::string, std::string> contents() const {
        std::map<std::string, std::string> contents;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder_.path())) {
            const std::string name = entry.path().filename().string();
            if (entry.is_regular_file() && !name.starts_with(".std"))
                contents[name] = contentOf(entry.path());
        }
        return contents;
    }

    void expectRefused(const std::string& command, const std::string& message) const {
        const auto before = contents();
        const Ran ran = run(command);
        EXPECT_EQ(ran.exitCode, 2) << command;
        EXPECT_THAT(ran.errors, HasSubstr(message)) << command;
        EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
        EXPECT_EQ(ran.output, "") << command;
        EXPECT_EQ(contents(), before) << command;
    }

    TemporaryFolder folder_;
};

TEST_F(Overwrite, OutputsThatAreInputsAreRefused) {
    for (const char* command : {"bake n.tif -o n.tif",
                                "bake faces257 -o faces257_x_pos.raw",
                                "bake faces257_y_neg.raw -o faces257_x_pos.raw",
                                "bake x.tif --colour c.jpg -o c.jpg",
                                "bake n.tif -o link.tif",
                                "bake link.tif -o n.tif",
                                "bake detail:seed=2,of=n.tif -o n.tif",
                                "bake n.tif --detail -o ./n.tif",
                                "audit s.chk --camera 1,2,1e6 -o s.chk",
                                "audit s.chk -o hard.chk",
                                "audit s.chk --flight d.toml -o d.toml",
                                "cracks s.chk -o s.chk",
                                "cracks s.chk --mark s.chk",
                                "cracks s.chk --flight d.toml -o d.toml",
                                "pops s.chk --flight d.toml -o d.toml",
                                "pops s.chk --flight d.toml -o s.chk",
                                "fly s.chk --flight d.toml -o s.chk",
                                "fly s.chk --flight d.toml -o d.toml",
                                "sweep s.chk --flight d.toml -o s.chk",
                                "sweep s.chk --flight d.toml -o d.toml",
                                "sweep s.chk --flight d.toml --plot s.chk",
                                "sweep n.tif --flight d.toml -o n.tif",
                                "shot s.chk -o s.chk",
                                "shot s.chk --colour-image c.jpg -o c.jpg",
                                "shot s.chk --settings own.toml -o own.toml",
                                "costs s.chk -o s.chk",
                                "costs s.chk --colour-image c.jpg -o c.jpg",
                                "bench n.tif -o n.tif",
                                "compare s.chk --flight d.toml -o d.toml",
                                "compare s.chk --with hard.chk --flight d.toml -o hard.chk",
                                "compare s.chk --flight d.toml --settings-b own.toml -o own.toml"}) {
        expectRefused(command, "is an input of this command");
        expectRefused(std::string(command) + " --overwrite", "is an input of this command");
    }
}

TEST_F(Overwrite, ColourImageBesideTheFileIsAnInput) {
    fs::rename(path("c.jpg"), path("colour.jpg"));
    expectRefused("shot s.chk -o colour.jpg", "colour.jpg: is an input of this command");
    expectRefused("bake x.tif -o colour.jpg --overwrite", "colour.jpg: is an input of this command");
}

TEST_F(Overwrite, ColourImageOfTheSourceOfAChunkFileIsAnInput) {
    fs::create_directory(path("src"));
    copy("hills.pgm", "src/n.pgm");
    copy("c.jpg", "src/colour.jpg");
    ASSERT_EQ(run("bake src/n.pgm --detail -o d.chk --face-size 129").exitCode, 0);
    expectRefused("shot d.chk -o src/colour.jpg --size 200x100", "which is an input of this command");
    EXPECT_EQ(contentOf(path("src/colour.jpg")), contentOf(path("c.jpg")));
}

TEST_F(Overwrite, FilesOfAnotherKindAreReplacedOnlyWithOverwrite) {
    copy("planet.chk", "other.chk");
    for (const char* command :
         {"bake x.tif -o n.tif", "bake x.tif -o d.toml", "bake x.tif -o c.jpg", "audit s.chk -o other.chk",
          "cracks s.chk -o n.tif", "cracks s.chk --mark n.tif", "pops s.chk --flight d.toml -o other.chk",
          "sweep s.chk --flight d.toml -o other.chk", "sweep s.chk --flight d.toml --plot n.tif",
          "shot s.chk -o n.tif", "costs s.chk -o other.chk", "bench n.tif -o other.chk",
          "compare s.chk --flight d.toml -o other.chk"})
        expectRefused(command, "or --overwrite to replace it");
    for (const char* command : {"shot s.chk -o other.chk", "sweep s.chk --flight d.toml --plot other.chk"})
        expectRefused(command, "the extension names no picture format");
    const Ran asked = run("audit s.chk --camera 1,2,1e6 --size 64x64 -o other.chk --overwrite");
    EXPECT_EQ(asked.exitCode, 0) << asked.errors;
    EXPECT_EQ(contentOf(path("other.chk")).front(), '{');
    const Ran baked = run("bake hills.pgm -o n.tif --overwrite");
    EXPECT_EQ(baked.exitCode, 0) << baked.errors;
    EXPECT_TRUE(contentOf(path("n.tif")).starts_with("WORLDYCH"));
}

TEST_F(Overwrite, OutputsOfTheSameKindAreReplacedAsBefore) {
    for (int i = 0; i < 2; ++i) {
        EXPECT_EQ(run("bake hills.pgm -o o.chk --chunk-size 17").exitCode, 0);
        EXPECT_EQ(run("audit s.chk --camera 1,2,1e6 --size 64x64 -o o.json").exitCode, 0);
        EXPECT_EQ(run("shot s.chk --size 64x64 -o o.png").exitCode, 0);
        EXPECT_EQ(run("make-layers -o layers --texels 16").exitCode, 0);
        EXPECT_EQ(run("bake hills.pgm -o o.chk --chunk-size 17 --debug-levels levels").exitCode, 0);
    }
}

TEST_F(Overwrite, FoldersOfOutputsKeepFilesOfOtherKinds) {
    fs::create_directory(path("made"));
    copy("d.toml", "made/earth.toml");
    expectRefused("make-layers -o made --texels 16", "earth.toml: exists and is not a layer set");
    fs::create_directory(path("pictures"));
    copy("s.chk", "pictures/difference.png");
    expectRefused("compare s.chk --flight d.toml --pictures pictures", "difference.png: exists and is not");
    fs::create_directory(path("levels"));
    copy("s.chk", "levels/x_pos_level00.png");
    expectRefused("bake x.tif -o o.chk --debug-levels levels", "x_pos_level00.png: exists and is not");
}

TEST_F(Overwrite, ReplayKeepsTheFileThatWasFlownOver) {
    const Ran ran = run("replay d.toml -o d.toml");
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("d.toml: is an input of this command"));
}

TEST_F(Overwrite, WindowKeepsItsInputsToo) {
    expectRefused("s.chk --item-map s.chk", "s.chk: is an input of this command");
    expectRefused("s.chk --item-map n.tif", "n.tif: exists and is not an item map");
}

TEST_F(Overwrite, ScreenshotThatBringsSettingsToTheWindowStaysAPicture) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs Xvfb, xdotool and ImageMagick";
    ASSERT_EQ(run("shot s.chk -o look.png --size 64x64").exitCode, 0);
    const std::string before = contentOf(path("look.png"));
    const Ran ran = runInWindow(folder_, "s.chk --settings look.png", "key F1");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, "");
    EXPECT_EQ(contentOf(path("look.png")), before);
}

}  // namespace
}  // namespace worldy
