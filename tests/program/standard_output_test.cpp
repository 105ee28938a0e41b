#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

// Each prints something, little or much.
class StandardOutput : public testing::TestWithParam<const char*> {};

TEST_P(StandardOutput, FullDeviceEndsWithTwoAndSaysWhy) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::ofstream(folder.path() / "still.toml")
        << "[[key]]\ntime_s = 0\nlatitude_deg = 5\nlongitude_deg = 5\naltitude_m = 90000\nheading_deg = "
           "0\npitch_deg = -60\n"
           "[[key]]\ntime_s = 1\nlatitude_deg = 6\nlongitude_deg = 5\naltitude_m = 90000\nheading_deg = "
           "0\npitch_deg = -60\n";
    const Ran ran = runWorldy(folder, std::string(GetParam()) + " >/dev/full");
    EXPECT_EQ(ran.exitCode, 2) << ran.errors;
    EXPECT_THAT(ran.errors, HasSubstr("worldy: standard output: cannot be written: No space left on device"));
}

INSTANTIATE_TEST_SUITE_P(
    EachCommand, StandardOutput,
    testing::Values("--help", "--version", "bake --help", "bake --list-presets",
                    "bake hills.pgm -o o.chk --chunk-size 17", "bake hills.pgm -o o.chk --json",
                    "info planet.chk", "info planet.chk --json", "verify planet.chk",
                    "verify planet.chk --json", "probe planet.chk 1 2", "probe planet.chk 1 2 --json",
                    "audit planet.chk --size 160x120", "pops planet.chk --flight still.toml --step-s 0.5",
                    "cracks planet.chk --size 160x120", "costs planet.chk --size 160x120 --rounds 1",
                    "shot planet.chk -o o.png --size 160x120 --json",
                    "sweep planet.chk --flight still.toml --tau 8 --metric tight --frames 2 --size 160x120",
                    "compare planet.chk --flight still.toml --frames 2 --size 160x120",
                    "make-layers -o made --texels 16"));

TEST(LostOutput, FailedCheckIsNotToldWhereItsReportIsLost) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::fstream(folder.path() / "planet.chk", std::ios::in | std::ios::out | std::ios::binary)
        .seekp(700)
        .write("ZZZZ", 4);
    EXPECT_EQ(runWorldy(folder, "verify planet.chk").exitCode, 1);
    EXPECT_EQ(runWorldy(folder, "verify planet.chk >/dev/full").exitCode, 2);
}

TEST(LostOutput, ClosedStreamIsAnErrorAndNoFileTakesItsPlace) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran ran = runWorldy(folder,
                              "bake hills.pgm -o closed.chk --chunk-size 17 --radius 100000 "
                              "--metres-per-unit 20 >&-");
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("worldy: standard output: cannot be written: "));
    EXPECT_EQ(contentOf(folder.path() / "closed.chk"), contentOf(folder.path() / "planet.chk"));
}

TEST(LostOutput, LostMessagesEndNoCommand) {
    const TemporaryFolder folder;
    writeHills(folder);
    for (const char* where : {"2>/dev/full", "2>&-", "</dev/null >/dev/null 2>/dev/full"}) {
        const Ran ran = runWorldy(folder, std::string("bake hills.pgm -o o.chk ") + where);
        EXPECT_EQ(ran.exitCode, 0) << where;
        EXPECT_EQ(runWorldy(folder, "verify o.chk").exitCode, 0);
        std::filesystem::remove(folder.path() / "o.chk");
    }
}

TEST(SymbolicLink, BakeWritesTheFileThatItLeadsTo) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::filesystem::create_directory(folder.path() / "data");
    std::filesystem::create_symlink("data/far.chk", folder.path() / "link.chk");
    const Ran baked = runWorldy(folder,
                                "bake hills.pgm -o link.chk --chunk-size 17 --radius 100000 "
                                "--metres-per-unit 20");
    EXPECT_EQ(baked.exitCode, 0) << baked.errors;
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.chk"));
    EXPECT_EQ(contentOf(folder.path() / "data/far.chk"), contentOf(folder.path() / "planet.chk"));
    EXPECT_EQ(tests::fileCountIn(folder.path() / "data"), 1u);
}

}  // namespace
}  // namespace worldy
