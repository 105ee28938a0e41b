// worldy suggest on a small planet: what it writes, what it refuses, and what an interruption leaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class SuggestCommand : public testing::Test {
protected:
    void SetUp() override {
        bakePlanet(folder);
        std::ofstream(folder.path() / "down.toml") << "[[key]]\ntime_s = 0\nlatitude_deg = 10\nlongitude_deg "
                                                      "= 0\naltitude_m = 60e3\nheading_deg = 60\n"
                                                      "pitch_deg = -50\n"
                                                      "[[key]]\ntime_s = 3\nlatitude_deg = 20\nlongitude_deg "
                                                      "= 30\naltitude_m = 15e3\nheading_deg = 60\n"
                                                      "pitch_deg = -30\n";
    }
    Ran suggest(const std::string& arguments) const {
        return runWorldy(folder, "suggest planet.chk --size 640x400 " + arguments);
    }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder.path() / name); }
    std::string file(const std::string& name) const { return contentOf(folder.path() / name); }

    const TemporaryFolder folder;
};

TEST_F(SuggestCommand, WritesAPresetAndAReportThatAnotherCommandConfirms) {
    const Ran ran =
        suggest("--budget '15 k triangles, 64 MiB' --flight down.toml --set lod.tau_px=0.3 -o out --json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const nlohmann::json report = nlohmann::json::parse(ran.output);
    EXPECT_TRUE(report["met"]);
    EXPECT_FALSE(report["unchanged"]);
    EXPECT_GT(report["before"]["triangles"], 15'000);
    EXPECT_LE(report["suggested"]["triangles"], 15'000);
    EXPECT_GT(report["trials"].size(), 5u);
    for (const char* name : {"out/suggested.toml", "out/suggested.md", "out/suggested.png"})
        EXPECT_TRUE(exists(name));
    EXPECT_THAT(file("out/suggested.md"), HasSubstr("| Triangles | 15 k triangles |"));
    EXPECT_EQ(file("out/suggested.png").substr(1, 3), "PNG");
    // The command in the report draws the worst place with as many triangles as the report says.
    for (const auto& place : report["places"]) {
        if (place["limit"] != "triangles") continue;
        const std::string command = place["command"];
        ASSERT_TRUE(command.starts_with("worldy "));
        const Ran shot = runWorldy(folder, command.substr(7) + " --json");
        ASSERT_EQ(shot.exitCode, 0) << shot.errors;
        const nlohmann::json drawn = nlohmann::json::parse(shot.output);
        EXPECT_NEAR(drawn["triangles"].get<double>() / place["value"].get<double>(), 1, 0.1);
    }
    // A second run may replace its own files, and names those that it does not replace.
    std::ofstream(folder.path() / "out/suggested.regions.toml")
        << "[[region]]\nname = \"peaks\"\ntau_factor = 2\nheights_m = [3000, 9000]\n";
    const Ran again = suggest("--budget '15 k triangles' --flight down.toml --vary tau --no-pictures -o out");
    EXPECT_EQ(again.exitCode, 0) << again.errors;
    EXPECT_THAT(again.errors, HasSubstr("suggested.regions.toml: is not of this suggestion"));
}

TEST_F(SuggestCommand, ABudgetThatCannotBeMetExitsWithOne) {
    const Ran ran =
        suggest("--budget '500 triangles, 0.1 px' --flight down.toml --no-pictures -o out --name no");
    EXPECT_EQ(ran.exitCode, 1) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("is not met"));
    EXPECT_THAT(file("out/no.md"), HasSubstr("binds"));
    EXPECT_TRUE(exists("out/no.toml"));
}

TEST_F(SuggestCommand, FramesAreDrawnWithBothSettingsAndNothingWorseIsSuggested) {
    const Ran ran = suggest("--budget '0.001 ms' --flight down.toml --vary tau --no-pictures -o out --json");
    ASSERT_EQ(ran.exitCode, 1) << ran.errors;
    const nlohmann::json report = nlohmann::json::parse(ran.output);
    EXPECT_GT(report["drawn_frames"]["before"], 0);
    EXPECT_GT(report["drawn_frames"]["suggested"], 0);
    EXPECT_LE(report["suggested"]["frame_ms"], report["before"]["frame_ms"]);
    EXPECT_EQ(report["picture"]["width_px"], 640);
}

TEST_F(SuggestCommand, AnInterruptionLeavesNoFile) {
    // Jobs in the background of a shell ignore the signal until the program handles it.
    const Ran ran =
        runShell(folder, "'" WORLDY_BINARY
                         "' suggest planet.chk --budget '15 k triangles' --altitudes 500,2000,9000 "
                         "--viewpoints 90000 -o out 2>log & for i in $(seq 600); do grep -q surveying log && "
                         "break; sleep 0.1; "
                         "done; kill -INT $!; wait $!");
    EXPECT_EQ(ran.exitCode, 130) << ran.output << file("log");
    EXPECT_FALSE(exists("out"));
}

TEST_F(SuggestCommand, BadInputIsNamed) {
    const auto problem = [&](const std::string& arguments) {
        const Ran ran = suggest(arguments);
        EXPECT_EQ(ran.exitCode, 2) << arguments;
        return ran.errors;
    };
    EXPECT_THAT(problem("-o out"), HasSubstr("--budget is required"));
    EXPECT_THAT(problem("--budget '16 msec, 3 px' -o out"),
                HasSubstr("--budget: \"16 msec\": the unit msec is unknown"));
    EXPECT_THAT(problem("--budget '3 px' -o out --vary colour"), HasSubstr("--vary: colour is unknown"));
    EXPECT_THAT(problem("--budget '3 px' -o out --frame-cost fast"), HasSubstr("--frame-cost: \"fast\""));
    EXPECT_THAT(problem("--budget '3 px' -o out --name a/b"), HasSubstr("--name"));
    EXPECT_THAT(problem("--budget '3 px' -o out --flight none.toml"), HasSubstr("none.toml"));
    EXPECT_THAT(problem("--budget '3 px' -o out --recording down.toml"), HasSubstr("down.toml"));
    EXPECT_THAT(problem("--budget '3 px' -o out --viewpoints 20"), HasSubstr("--viewpoints"));
    std::ofstream(folder.path() / "taken.md") << "# My notes\n";
    EXPECT_THAT(problem("--budget '3 px' -o . --name taken"), HasSubstr("taken.md: exists and is not"));
    EXPECT_EQ(file("taken.md"), "# My notes\n");
    EXPECT_FALSE(exists("out"));
}

TEST_F(SuggestCommand, AnotherChunkSizeIsBakedOnlyIfItIsAskedFor) {
    const std::string common =
        "--budget '15 k triangles, 40 px' --flight down.toml --vary tau --no-pictures --json "
        "--set lod.tau_px=0.3 -o out ";
    const Ran ran = suggest(common + "--chunk 17,33 --source hills.pgm --metres-per-unit 20");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const nlohmann::json report = nlohmann::json::parse(ran.output);
    const auto has = [&](const nlohmann::json& size) {
        return std::ranges::any_of(report["trials"],
                                   [&](const auto& trial) { return trial["chunk_size"] == size; });
    };
    EXPECT_TRUE(has(nullptr));
    EXPECT_TRUE(has(33));
    EXPECT_FALSE(has(17));  // the file's own
    if (!report["suggested"]["chunk_size"].is_null()) {
        EXPECT_THAT(file("out/suggested.md"), HasSubstr("baked with --chunk-size 33"));
    }

    const Ran other = suggest(common + "--chunk 33 --source hills.pgm --metres-per-unit 21");
    EXPECT_EQ(other.exitCode, 2);
    EXPECT_THAT(other.errors, HasSubstr("is not a bake of the same planet"));
    const Ran none = suggest(common + "--chunk 33");
    EXPECT_EQ(none.exitCode, 2);
    EXPECT_THAT(none.errors, HasSubstr("expected --source"));
}

TEST_F(SuggestCommand, ATraceGetsATauWhereItsDataAllow) {
    ASSERT_EQ(
        runWorldy(folder, "fly planet.chk --flight down.toml --frames 30 --size 320x200 --trace a.lodtrace")
            .exitCode,
        0);
    const auto onTrace = [&](const std::string& arguments) {
        return runWorldy(folder, "suggest a.lodtrace " + arguments);
    };
    const Ran ran = onTrace("--budget '10 k triangles' -o out --json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const nlohmann::json report = nlohmann::json::parse(ran.output);
    EXPECT_TRUE(report["met"]);
    EXPECT_GT(report["tau_px"], 0);
    EXPECT_LE(report["suggested"]["triangles"], 10'000);
    EXPECT_THAT(file("out/suggested.md"), HasSubstr("# Suggested settings for a.lodtrace"));
    EXPECT_FALSE(exists("out/suggested.toml"));
    const Ran times = onTrace("--budget '16 ms' -o out");
    EXPECT_EQ(times.exitCode, 2);
    EXPECT_THAT(times.errors, HasSubstr("a budget in ms needs the time of frames with another τ"));
    EXPECT_EQ(onTrace("--budget '10 k triangles' --flight down.toml -o out").exitCode, 2);
}

}  // namespace
}  // namespace worldy
