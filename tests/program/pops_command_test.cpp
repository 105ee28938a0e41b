// worldy pops on a small planet.
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
        EXPECT_THAT(ran.output, HasSubstr("switches of level"));
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
    EXPECT_EQ(hard["cause"]["camera moved"], hard["switches"]);
    EXPECT_GT(hard["largest_px"]["p99"], 0.2);
    EXPECT_LT(smooth["largest_px"]["p50"], 0.1 * hard["largest_px"]["p50"].get<double>());
    EXPECT_EQ(hard["worst"][0]["largest_px"], hard["largest_px"]["maximum"]);
}

TEST_F(PopsCommand, TheReportHoldsAllSwitchesAndTheTableTheWorst) {
    const nlohmann::json all = report("--tau 0.25 --step-s 0.01 --set lod.morph=false --worst 3");
    EXPECT_GT(all["switches"], 20);
    EXPECT_EQ(all["worst"].size(), all["switches"]);
    for (std::size_t i = 1; i < all["worst"].size(); ++i)
        EXPECT_GE(all["worst"][i - 1]["largest_px"], all["worst"][i]["largest_px"]);
    const std::string table = contentOf(folder.path() / ".stdout");
    EXPECT_THAT(table, HasSubstr(all["worst"][2]["chunk"]));
    const std::string head = "largest px";
    EXPECT_EQ(std::count(table.begin() + static_cast<std::ptrdiff_t>(table.find(head)), table.end(), '\n'),
              4);
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
