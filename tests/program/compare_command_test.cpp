// worldy compare on a small planet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/base/picture_file.h"
#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

TEST(CompareCommand, SetsBothSidesBesideEachOtherAndTakesPictures) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::ofstream(folder.path() / "down.toml")
        << "name = \"Down\"\n"
           "[[key]]\ntime_s = 0\nlatitude_deg = 10\nlongitude_deg = 20\naltitude_m = 200000\n"
           "heading_deg = 0\npitch_deg = -80\n"
           "[[key]]\ntime_s = 1\nlatitude_deg = 12\nlongitude_deg = 21\naltitude_m = 20000\n"
           "heading_deg = 0\npitch_deg = -60\n";
    std::ofstream(folder.path() / "coarse.toml") << "[lod]\ntau_px = 8\n";
    const Ran ran = runWorldy(folder,
                              "compare planet.chk --flight down.toml --set-a lod.tau_px=1 --settings-b "
                              "coarse.toml --set-b seams.mode=stitched --frames 2 --size 320x200 -o out.json "
                              "--pictures made/here");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    for (const char* text : {"lod.tau_px: A 1, B 8", "seams.mode: A skirts, B stitched", "Triangles", "x 0."})
        EXPECT_THAT(ran.output, HasSubstr(text));
    const nlohmann::json report = nlohmann::json::parse(contentOf(folder.path() / "out.json"));
    EXPECT_LT(report["b"]["mean_triangles"], report["a"]["mean_triangles"]);
    EXPECT_GT(report["b"]["worst_measured_px"], report["a"]["worst_measured_px"]);
    EXPECT_EQ(report["b"]["crack_px"], 0);
    for (const char* count :
         {"most_resident_bytes", "bytes_read", "violations", "crack_px", "leaking_px", "switches", "late"})
        EXPECT_TRUE(report["a"][count].is_number_integer()) << count;
    EXPECT_EQ(report["settings"].size(), 2u);
    EXPECT_GT(report["most_different"]["pixels"], 0);
    const auto beside = readPicture(folder.path() / "made" / "here" / "side_by_side.png");
    ASSERT_TRUE(beside);
    EXPECT_EQ(beside->width, 640);
    const auto difference = readPicture(folder.path() / "made" / "here" / "difference.png");
    ASSERT_TRUE(difference);
    EXPECT_EQ(difference->width, 320);
}

TEST(CompareCommand, SaysWhatIsWrongWithItsFiles) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::ofstream(folder.path() / "still.toml")
        << "name = \"Still\"\n[[key]]\ntime_s = 0\nlatitude_deg = 10\nlongitude_deg = 20\naltitude_m = 2e5\n"
           "heading_deg = 0\npitch_deg = -80\n[[key]]\ntime_s = 0.1\nlatitude_deg = 10\n"
           "longitude_deg = 20\naltitude_m = 2e5\nheading_deg = 0\npitch_deg = -80\n";
    const Ran none = runWorldy(folder, "compare planet.chk --flight still.toml --with none.chk");
    EXPECT_EQ(none.exitCode, 2);
    EXPECT_THAT(none.errors, HasSubstr("none.chk"));
    ASSERT_EQ(runWorldy(folder, "bake hills.pgm -o moon.chk --chunk-size 17 --radius 50000").exitCode, 0);
    const Ran moon = runWorldy(folder, "compare planet.chk --flight still.toml --with moon.chk");
    EXPECT_EQ(moon.exitCode, 2);
    EXPECT_THAT(moon.errors, HasSubstr("radius"));
    EXPECT_EQ(moon.output, "");
}

// A flight that stands still, and a shot and an audit of its view.
TEST(CompareCommand, SaysTheSameOfAViewAsAShotAndAnAudit) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    std::ofstream still(folder.path() / "still.toml");
    for (const int timeS : {0, 1})
        still << "[[key]]\ntime_s = " << timeS
              << "\nlatitude_deg = 10\nlongitude_deg = 20\naltitude_m = 30000\nheading_deg = 0\npitch_deg = "
                 "-40\n";
    still.close();
    const std::string view = " --camera 10,20,30000,0,-40 --size 160x120 --tau 2";
    const Ran shot = runWorldy(folder, "shot planet.chk -o shot.png --json" + view);
    ASSERT_EQ(shot.exitCode, 0) << shot.errors;
    ASSERT_EQ(runWorldy(folder, "audit planet.chk -o audit.json" + view).exitCode, 0);
    const Ran compared = runWorldy(folder,
                                   "compare planet.chk --flight still.toml --frames 1 --size 160x120 "
                                   "--set-a lod.tau_px=2 --set-b lod.tau_px=3 --set-b "
                                   "surface.sun_hour=19.630435466766357 -o compare.json");
    ASSERT_EQ(compared.exitCode, 0) << compared.errors;
    EXPECT_THAT(compared.output, HasSubstr(", B 19.63\n"));
    const nlohmann::json ofShot = nlohmann::json::parse(shot.output);
    const nlohmann::json ofAudit = nlohmann::json::parse(contentOf(folder.path() / "audit.json"));
    const nlohmann::json comparison = nlohmann::json::parse(contentOf(folder.path() / "compare.json"));
    EXPECT_EQ(comparison["settings"][1]["b"], "19.630435466766357");
    const nlohmann::json& ofCompare = comparison["a"];
    for (const char* key : {"worst_eps_px", "worst_drawn_bound_px"}) {
        const double px = ofShot[key];
        EXPECT_GT(px, 0.1) << key;
        EXPECT_NEAR(ofAudit[key], px, 1e-6 * px) << key;
        EXPECT_NEAR(ofCompare[key], px, 1e-6 * px) << key;
    }
    const double measuredPx = ofAudit["worst_measured_px"];
    EXPECT_NEAR(ofCompare["worst_measured_px"], measuredPx, 1e-6 * measuredPx);
    for (const std::string key : {"ground_triangles", "skirt_triangles", "triangles"}) {
        EXPECT_EQ(ofShot[key], ofAudit["view"][0][key]) << key;
        EXPECT_EQ(ofShot[key], ofCompare["mean_" + key]) << key;
    }
}

}  // namespace
}  // namespace worldy
