// worldy pops on a small planet.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class PopsCommand : public testing::Test {
protected:
    void SetUp() override {
        bakePlanet(folder);
        std::ofstream(folder.path() / "down.toml") << "name = \"Down\"\n"
                                                      "[[key]]\ntime_s = 0\nlatitude_deg = 10\n"
                                                      "longitude_deg = 20\naltitude_m = 400000\n"
                                                      "heading_deg = 0\npitch_deg = -80\n"
                                                      "[[key]]\ntime_s = 4\nlatitude_deg = 12\n"
                                                      "longitude_deg = 21\naltitude_m = 20000\n"
                                                      "heading_deg = 0\npitch_deg = -60\n";
    }
    nlohmann::json report(const std::string& options) {
        const Ran ran = runWorldy(folder, "pops planet.chk --flight down.toml -o out.json " + options);
        EXPECT_EQ(ran.exitCode, 0) << ran.errors;
        EXPECT_THAT(ran.output, HasSubstr("level changes"));
        return nlohmann::json::parse(contentOf(folder.path() / "out.json"));
    }

    const TemporaryFolder folder;
};

TEST_F(PopsCommand, MorphingTakesThePopsAway) {
    const nlohmann::json hard = report("--tau 1 --step-s 0.01 --set lod.morph=false");
    const nlohmann::json smooth = report("--tau 1 --step-s 0.01 --set lod.morph=true");
    EXPECT_EQ(hard["frames"], 401);
    EXPECT_GT(hard["switches"], 10);
    EXPECT_EQ(hard["late"], 0);
    EXPECT_EQ(hard["causes"]["camera moved"], hard["switches"]);
    EXPECT_GT(hard["largest_px_by_percentile"]["p99"], 0.2);
    EXPECT_LT(smooth["largest_px_by_percentile"]["p50"],
              0.1 * hard["largest_px_by_percentile"]["p50"].get<double>());
    EXPECT_EQ(hard["events"][0]["largest_px"], hard["largest_px_by_percentile"]["maximum"]);
}

TEST_F(PopsCommand, TheReportHoldsAllSwitchesAndTheTableTheWorst) {
    const nlohmann::json all = report("--tau 0.25 --step-s 0.01 --set lod.morph=false --worst 3");
    EXPECT_GT(all["switches"], 20);
    EXPECT_EQ(all["events"].size(), all["switches"]);
    for (std::size_t i = 1; i < all["events"].size(); ++i)
        EXPECT_GE(all["events"][i - 1]["largest_px"], all["events"][i]["largest_px"]);
    const std::string table = contentOf(folder.path() / ".stdout");
    EXPECT_THAT(table, HasSubstr(all["events"][2]["chunk"]));
    const std::string head = "largest px";
    EXPECT_EQ(std::count(table.begin() + static_cast<std::ptrdiff_t>(table.find(head)), table.end(), '\n'),
              4);
}

// Loads and fades of the first view are no part of the measurement.
TEST_F(PopsCommand, AStillCameraSwitchesNothing) {
    std::ofstream still(folder.path() / "still.toml");
    still << "name = \"Still\"\n";
    for (const int timeS : {0, 2}) {
        still << "[[key]]\ntime_s = " << timeS
              << "\nlatitude_deg = 10\nlongitude_deg = 20\naltitude_m = 30000\nheading_deg = 0\n"
                 "pitch_deg = -50\n";
    }
    still.close();
    for (const char* options : {"", "--set lod.fade_s=0", "--tau 0.5 --set lod.morph=false"}) {
        const Ran ran = runWorldy(
            folder,
            fmt::format("pops planet.chk --flight still.toml -o still.json --step-s 0.1 {}", options));
        EXPECT_EQ(ran.exitCode, 0) << ran.errors;
        const nlohmann::json found = nlohmann::json::parse(contentOf(folder.path() / "still.json"));
        EXPECT_EQ(found["switches"], 0) << options;
        EXPECT_EQ(found["late"], 0) << options;
    }
}

// From one side of the planet to another within a frame: what switches then and is still loading or fading does
// not count.
TEST_F(PopsCommand, SwitchesAfterAJumpOfTheCameraDoNotCount) {
    std::ofstream jump(folder.path() / "jump.toml");
    const auto key = [&](double timeS, double latitudeDeg, double longitudeDeg) {
        jump << fmt::format(
            "[[key]]\ntime_s = {}\nlatitude_deg = {}\nlongitude_deg = {}\naltitude_m = 20000\nheading_deg = "
            "0\n"
            "pitch_deg = -50\n",
            timeS, latitudeDeg, longitudeDeg);
    };
    jump << "name = \"Jump\"\n";
    key(0, 10, 20);
    key(0.5, 10, 20);
    key(0.51, -17, 150);
    key(1, -17, 150);
    jump.close();
    const Ran ran = runWorldy(folder, "pops planet.chk --flight jump.toml --tau 0.5 -o jump.json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const nlohmann::json found = nlohmann::json::parse(contentOf(folder.path() / "jump.json"));
    EXPECT_GT(found["after_jump"], 0);
    EXPECT_EQ(found["counted"], 0);
}

// The sea level is set so high that all land is under it.
TEST_F(PopsCommand, TheBedOfADrawnSeaIsNotSeenToPop) {
    const std::string fine = "--tau 1 --step-s 0.02 --set lod.morph=false ";
    const nlohmann::json dry = report(fine + "--set light.sea=off");
    EXPECT_EQ(dry["under_sea"], 0);
    EXPECT_EQ(dry["sea_surface_drawn"], false);
    EXPECT_EQ(dry["counted"].get<int>() + dry["outside_picture"].get<int>(), dry["switches"]);
    const nlohmann::json flooded = report(fine + "--set light.sea=on --set surface.sea_level_m=9000");
    const nlohmann::json automatic =
        report(fine + "--set light.sea=automatic --set surface.sea_level_m=9000");
    EXPECT_EQ(automatic["sea_surface_drawn"], true) << "as on a GPU";
    EXPECT_EQ(flooded["switches"], dry["switches"]);
    EXPECT_EQ(flooded["counted"], 0);
    EXPECT_EQ(flooded["sea_surface_drawn"], true);
    EXPECT_GT(flooded["under_sea"], 10);
    EXPECT_EQ(flooded["under_sea"].get<int>() + flooded["outside_picture"].get<int>(), flooded["switches"]);
    EXPECT_EQ(flooded["largest_px_by_percentile"]["maximum"], 0);
    EXPECT_EQ(flooded["events"][0]["under_sea"], true);
    EXPECT_EQ(flooded["events"][0]["after_jump"], false);
}

TEST_F(PopsCommand, SaysWhatIsWrongWithItsInput) {
    const Ran noFile = runWorldy(folder, "pops none.chk --flight down.toml");
    EXPECT_EQ(noFile.exitCode, 2);
    EXPECT_THAT(noFile.errors, HasSubstr("none.chk"));
    const Ran noFlight = runWorldy(folder, "pops planet.chk --flight none.toml");
    EXPECT_EQ(noFlight.exitCode, 2);
    EXPECT_THAT(noFlight.errors, HasSubstr("none.toml"));
    const Ran noStep = runWorldy(folder, "pops planet.chk --flight down.toml --step-s 0");
    EXPECT_EQ(noStep.exitCode, 2);
    EXPECT_THAT(noStep.errors, HasSubstr("--step-s"));
}

TEST_F(PopsCommand, TooManyFramesEndWithTwo) {
    writeLongFlight(folder);
    const Ran ran = runWorldy(folder, "pops planet.chk --flight long.toml --step-s 1e-4");
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors, HasSubstr("more than 10000000 views; expected a longer step"));
}

}  // namespace
}  // namespace worldy
