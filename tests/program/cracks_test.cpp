// worldy cracks, run as a user runs it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

// Hills so steep and chunks so coarse that there are cracks. Without morph, which closes those between levels
// one apart.
const std::string steepView =
    "--size 640x400 --tau 60 --set surface.exaggeration=20 --set lod.morph=false --camera 30,30,90000,0,-40 ";

TEST(CracksCommand, SkirtsHoldWhatWithoutThemLeaks) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran open =
        runWorldy(folder, "cracks planet.chk " + steepView + "--seams none -o open.json --mark open.png");
    EXPECT_EQ(open.exitCode, 1) << open.errors;
    EXPECT_THAT(open.output, HasSubstr("uncovered px"));
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "open.png"));
    const auto report = nlohmann::json::parse(contentOf(folder.path() / "open.json"));
    EXPECT_GT(report["crack_px"].get<int>(), 0);
    EXPECT_EQ(report["crack_px"], report["leaking_px"]);
    EXPECT_EQ(report["seams"], "none");
    ASSERT_EQ(report["view"].size(), 1u);
    ASSERT_FALSE(report["view"][0]["spots"].empty());
    EXPECT_TRUE(report["view"][0]["spots"][0].contains("finer"));
    EXPECT_GT(report["view"][0]["gaps"][0]["gap_m"].get<double>(), 0);

    const Ran hidden = runWorldy(folder, "cracks planet.chk " + steepView + "--find-depth -o hidden.json");
    EXPECT_EQ(hidden.exitCode, 0) << hidden.errors;
    EXPECT_THAT(hidden.output, HasSubstr("smallest depth: "));
    const auto found = nlohmann::json::parse(contentOf(folder.path() / "hidden.json"));
    EXPECT_EQ(found["leaking_px"], 0);
    EXPECT_EQ(found["crack_px"], report["crack_px"]) << "whatever the skirts are";
    EXPECT_GT(found["smallest_depth_m"].get<double>(), 0);
    EXPECT_LE(found["smallest_factor"].get<double>(), 1);

    const Ran stitched =
        runWorldy(folder, "cracks planet.chk " + steepView + "--seams stitched -o stitched.json");
    EXPECT_EQ(stitched.exitCode, 0) << stitched.errors;
    EXPECT_EQ(nlohmann::json::parse(contentOf(folder.path() / "stitched.json"))["crack_px"], 0);
}

TEST(CracksCommand, TheReportHoldsAllGapsAndTheTableTheWorst) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran ran =
        runWorldy(folder, "cracks planet.chk " + steepView + "--seams none -o all.json --worst 2");
    const auto measured = nlohmann::json::parse(contentOf(folder.path() / "all.json"))["view"][0];
    EXPECT_GT(measured["gaps"].size(), 2u);
    EXPECT_GT(measured["spots"].size(), 2u);
    int pixels = 0;
    for (const auto& spot : measured["spots"]) pixels += spot["pixels"].get<int>();
    EXPECT_EQ(measured["crack_px"], pixels);
    const std::string list = ran.output.substr(ran.output.find("largest crack clusters"));
    EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), 9) << list;
}

// Neither hysteresis nor what is resident carries over.
TEST(CracksCommand, AViewOfAFlightIsTheSameAsAlone) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::ofstream(folder.path() / "up.toml")
        << "name = \"Up\"\n[[key]]\ntime_s = 0\nlatitude_deg = 20\nlongitude_deg = 120\naltitude_m = 4000\n"
           "heading_deg = 0\npitch_deg = -90\n[[key]]\ntime_s = 1\nlatitude_deg = 20\nlongitude_deg = 120\n"
           "altitude_m = 60000\nheading_deg = 0\npitch_deg = -90\n";
    const std::string cracks =
        "cracks planet.chk --size 320x200 --tau 2 --set lod.hysteresis=0.5 -o report.json ";
    const auto viewsOf = [&](const std::string& options) {
        EXPECT_EQ(runWorldy(folder, cracks + options).exitCode, 0);
        return nlohmann::json::parse(contentOf(folder.path() / "report.json"))["view"];
    };
    nlohmann::json flown = viewsOf("--flight up.toml").at(1),
                   alone = viewsOf("--camera 20,120,60000,0,-90").at(0);
    for (nlohmann::json* one : {&flown, &alone})
        for (const char* key : {"time_s", "camera"}) one->erase(key);
    EXPECT_EQ(flown, alone);
}

TEST(CracksCommand, PrintsTheReportAndNothingElseAsJson) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran ran =
        runWorldy(folder, "cracks planet.chk " + steepView + "--find-depth --json -o report.json");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(ran.output, contentOf(folder.path() / "report.json"));
    const auto report = nlohmann::json::parse(ran.output);
    EXPECT_EQ(report["leaking_px_at_smallest_depth"], 0);
    EXPECT_EQ(report["leaking_px_at_smallest_factor"], 0);
}

TEST(CracksCommand, BadInputEndsWithTwo) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    for (const char* arguments :
         {"cracks none.chk", "cracks planet.chk --seams sewn", "cracks planet.chk --step-s 0",
          "cracks planet.chk --flight none.toml", "cracks planet.chk --size 3x3",
          "cracks planet.chk --seams stitched --find-depth",
          "cracks planet.chk --camera 1,2,3 --flight none.toml"}) {
        const Ran ran = runWorldy(folder, arguments);
        EXPECT_EQ(ran.exitCode, 2) << arguments;
        EXPECT_EQ(ran.output, "") << arguments;
        EXPECT_THAT(ran.errors, HasSubstr("worldy: ")) << arguments;
    }
}

TEST(CracksCommand, AFileWhoseNameIsNotUtf8IsReported) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::filesystem::rename(folder.path() / "planet.chk", folder.path() / "pl\xE9net.chk");
    const Ran ran =
        runWorldy(folder, "cracks pl\xE9net.chk " + steepView + "--seams stitched -o report.json");
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(nlohmann::json::parse(contentOf(folder.path() / "report.json"))["file"],
              "pl\xEF\xBF\xBDnet.chk");
}

TEST(CracksCommand, TooManyViewsEndWithTwo) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    writeLongFlight(folder);
    for (const char* step : {"1", "0.001"}) {
        const Ran ran =
            runWorldy(folder, std::string("cracks planet.chk --flight long.toml --step-s ") + step);
        EXPECT_EQ(ran.exitCode, 2) << step;
        EXPECT_THAT(ran.errors, HasSubstr("more than 100000 views; expected a longer step")) << step;
    }
}

}  // namespace
}  // namespace worldy
