// Planets from nothing, by the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/program/run_program.h"
#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using ::testing::HasSubstr;

class TerrainTest : public testing::Test {
protected:
    nlohmann::json infoOf(const std::string& file) {
        const Ran ran = runWorldy(folder, "info " + file + " --json");
        EXPECT_EQ(ran.exitCode, 0) << ran.errors;
        return nlohmann::json::parse(ran.output);
    }
    const TemporaryFolder folder;
};

TEST_F(TerrainTest, EachKindIsBakedAndIsTheSameAgain) {
    for (const char* source :
         {"noise:fbm,seed=5", "noise:ridged,seed=5", "noise:faults,seed=5,count=50", "noise:midpoint,seed=5",
          "noise:craters,seed=5", "detail:seed=5,of=noise:midpoint"}) {
        const std::string bake = std::string("bake ") + source + " --face-size 65 --chunk-size 17 -o ";
        const Ran baked = runWorldy(folder, bake + "a.chk --threads 1");
        ASSERT_EQ(baked.exitCode, 0) << baked.errors;
        ASSERT_EQ(runWorldy(folder, bake + "b.chk --threads 4").exitCode, 0);
        EXPECT_EQ(contentOf(folder / "a.chk"), contentOf(folder / "b.chk")) << source;
        const Ran verified = runWorldy(folder, std::string("verify a.chk --source ") + source);
        EXPECT_EQ(verified.exitCode, 0) << verified.errors;
        EXPECT_THAT(verified.output, HasSubstr("compared with the source, 0 problems"));
        EXPECT_EQ(infoOf("a.chk")["source"].get<std::string>().substr(0, 6),
                  std::string(source).substr(0, 6));
    }
}

TEST_F(TerrainTest, ABakeCopiesFromAnEarlierOneAndSaysSo) {
    const std::string bake = "bake noise:fbm,seed=5 --face-size 257 --chunk-size 17 -o ";
    ASSERT_EQ(runWorldy(folder, bake + "a.chk").exitCode, 0);
    const std::string before = contentOf(folder / "a.chk");
    const Ran text = runWorldy(folder, bake + "a.chk --reuse a.chk");
    EXPECT_EQ(text.exitCode, 0) << text.errors;
    EXPECT_THAT(text.output, HasSubstr(" of 2046 chunks copied from a.chk"));
    EXPECT_EQ(contentOf(folder / "a.chk"), before);
    const Ran ran = runWorldy(folder, bake + "b.chk --reuse a.chk --json");
    const auto report = nlohmann::json::parse(ran.output);
    EXPECT_GT(report["copied_chunks"], 1900);
    EXPECT_EQ(report["sampled_cells"], 0);
    EXPECT_EQ(report["reuse"], "a.chk");
    const Ran other = runWorldy(folder, "bake noise:fbm,seed=5 --face-size 257 -o b.chk --reuse a.chk");
    EXPECT_EQ(other.exitCode, 0);
    EXPECT_THAT(other.errors, HasSubstr("a.chk: no chunk was copied from it, because its chunk size is 17"));
    const Ran missing = runWorldy(folder, bake + "b.chk --reuse none.chk");
    EXPECT_NE(missing.exitCode, 0);
    EXPECT_THAT(missing.errors, HasSubstr("none.chk"));
}

TEST_F(TerrainTest, AnotherSeedMakesAnotherFile) {
    for (const char* seed : {"1", "2"}) {
        ASSERT_EQ(runWorldy(folder, std::string("bake noise:fbm,seed=") + seed + " --face-size 65 -o " +
                                        seed + ".chk")
                      .exitCode,
                  0);
    }
    EXPECT_NE(contentOf(folder / "1.chk"), contentOf(folder / "2.chk"));
    EXPECT_EQ(runWorldy(folder, "verify 1.chk --source noise:fbm,seed=2").exitCode, 1);
}

TEST_F(TerrainTest, APresetBringsItsRadiusUnlessOneIsGiven) {
    ASSERT_EQ(runWorldy(folder, "bake preset:moon --face-size 65 -o moon.chk").exitCode, 0);
    EXPECT_EQ(infoOf("moon.chk")["radius_m"], 1737400);
    ASSERT_EQ(runWorldy(folder, "bake preset:moon --face-size 65 --radius 6371000 -o large.chk").exitCode, 0);
    EXPECT_EQ(infoOf("large.chk")["radius_m"], 6371000);
    const Ran list = runWorldy(folder, "bake --list-presets");
    EXPECT_EQ(list.exitCode, 0);
    for (const char* name : {"earth-amplified", "moon", "ridged", "noise:midpoint", "roughness", "limit_m"})
        EXPECT_THAT(list.output, HasSubstr(name));
}

TEST_F(TerrainTest, DetailRoughensAFinerGridAndLeavesTheSourcesOwn) {
    writeHills(folder);
    const auto bytes = [&](const std::string& options) {
        EXPECT_EQ(
            runWorldy(folder, "bake hills.pgm --metres-per-unit 40 --quantum 1 -o h.chk " + options).exitCode,
            0);
        return infoOf("h.chk")["file_bytes"].get<double>();
    };
    const double plain = bytes("--face-size 513");
    EXPECT_GT(bytes("--face-size 513 --detail"), 1.1 * plain);
    EXPECT_THAT(infoOf("h.chk")["source"].get<std::string>(), HasSubstr("detail:seed=1,of=/"));
    EXPECT_GT(bytes("--face-size 513 --detail=strength=4,sea_m=-5000"), 1.3 * plain);
}

TEST_F(TerrainTest, ASweepBakesOtherChunkSizesOfWhatAChunkFileSaysItWasMadeFrom) {
    std::ofstream flight(folder / "down.toml");
    flight << "name = \"down\"\n";
    for (const int t : {0, 1}) {
        flight << "[[key]]\ntime_s = " << t
               << "\nlatitude_deg = 0\nlongitude_deg = 0\naltitude_m = " << (t == 0 ? 500000 : 200000)
               << "\nheading_deg = 0\npitch_deg = -90\n";
    }
    flight.close();
    ASSERT_EQ(
        runWorldy(folder, "bake noise:fbm,seed=3 --face-size 65 --chunk-size 17 --radius 500000 -o w.chk")
            .exitCode,
        0);
    const Ran ran =
        runWorldy(folder,
                  "sweep w.chk --flight down.toml --tau 4 --metric tight --chunk 17,33 --frames 1 "
                  "--size 160x120 --json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const auto report = nlohmann::json::parse(ran.output);
    ASSERT_EQ(report["points"].size(), 2u);
    EXPECT_EQ(report["points"][1]["chunk_size"], 33);
}

TEST_F(TerrainTest, BadInputIsToldWithWhatWouldBeRight) {
    const auto expectBad = [&](const std::string& arguments, const std::string& told) {
        const Ran ran = runWorldy(folder, arguments);
        EXPECT_EQ(ran.exitCode, 2) << arguments;
        EXPECT_THAT(ran.errors, HasSubstr(told));
        EXPECT_FALSE(std::filesystem::exists(folder / "o.chk"));
    };
    expectBad("bake noise:rigded -o o.chk", "did you mean noise:ridged");
    expectBad("bake noise:fbm,octaves=99 -o o.chk", "octaves is 99");
    expectBad("bake noise:fbm --offset 3 -o o.chk", "is procedural terrain");
    expectBad("bake preset:mon -o o.chk", "preset:moon");
    expectBad("bake nothing.tif --detail -o o.chk", "nothing.tif");
    expectBad("bake noise:fbm --detail=strength=99 -o o.chk", "strength is 99");
    expectBad("bake noise:fbm --face-size 65 --quantum 0.01 -o o.chk", "exceed 16 bits");
    expectBad("noise:fbm,gain=7", "gain is 7");
    expectBad("sweep noise:fbn --flight x.toml", "");
}

}  // namespace
}  // namespace worldy
