// worldy atlas on a small planet: surveys, resumption and the nightly check.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class AtlasCommand : public testing::Test {
protected:
    void SetUp() override { bakePlanet(folder); }
    Ran atlas(const std::string& arguments) const {
        return runWorldy(folder, "atlas planet.chk " + arguments);
    }
    std::string file(const std::string& name) const { return contentOf(folder.path() / name); }

    const std::string places = "--size 640x400 --altitudes 2000,10000 ";
    const std::string small = places + "--headings 2 --viewpoints 150 --set lod.tau_px=0.5 ";
    const TemporaryFolder folder;
};

TEST_F(AtlasCommand, WritesAnAtlasATableAndAReport) {
    const Ran ran = atlas(small + "-o a.atlas --csv a.csv --json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const nlohmann::json report = nlohmann::json::parse(ran.output);
    EXPECT_GT(report["viewpoints_per_s"], 0);
    EXPECT_GT(report["ms_per_viewpoint"]["settle"], 0);
    const std::size_t count = report["viewpoints"].size();
    EXPECT_LE(count, 150u);
    EXPECT_GE(count, 6u * 2 * 2);
    for (const auto& viewpoint : report["viewpoints"]) {
        EXPECT_GT(viewpoint["triangles"], 0);
        EXPECT_LE(viewpoint["eps_px"], 0.5);
        EXPECT_TRUE(viewpoint["measured_px"].is_null());
        EXPECT_GE(viewpoint["camera_altitude_m"].get<double>() + 1e-6,
                  viewpoint["above_ground_m"].get<double>());
    }
    const std::string csv = file("a.csv");
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), count + 1);
    EXPECT_EQ(file("a.atlas").substr(0, 8), "WORLDYAT");
}

TEST_F(AtlasCommand, PrintsTheWorstPlacesAndTheCosts) {
    const Ran ran = atlas(small + "-o a.atlas --worst 2");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("per second on"));
    EXPECT_THAT(ran.output, HasSubstr("worst triangles\n"));
    EXPECT_THAT(ran.output, Not(HasSubstr("measured_px")));
}

TEST_F(AtlasCommand, PrintsHowManyViewpointsHaveNoBoundOfTheError) {
    const Ran coarse = atlas(small + "-o a.atlas --set lod.max_level=0 --csv a.csv");
    ASSERT_EQ(coarse.exitCode, 0) << coarse.errors;
    EXPECT_THAT(coarse.output, HasSubstr("eps_px has no bound at "));
    EXPECT_THAT(file("a.csv"), HasSubstr(",inf,"));
    const Ran fine = atlas(small + "-o b.atlas");
    EXPECT_THAT(fine.output, Not(HasSubstr("no bound")));
}

TEST_F(AtlasCommand, AnUnchangedPlanetPassesItsNightlyCheck) {
    ASSERT_EQ(atlas(small + "-o a.atlas").exitCode, 0);
    // The settings are those of the atlas.
    const Ran same =
        atlas("--diff a.atlas --limit eps_px=+0 --limit triangles=-0 --limit sharp_s=+0 --limit chunks=+0");
    EXPECT_EQ(same.exitCode, 0) << same.output << same.errors;
    EXPECT_THAT(same.output, HasSubstr("limit chunks=+0: met"));
}

TEST_F(AtlasCommand, WhatGotWorseIsPlacedAndExitsWithOne) {
    ASSERT_EQ(atlas(small + "-o a.atlas").exitCode, 0);
    std::ofstream(folder.path() / "planet.regions.toml")
        << "[[region]]\nname = \"capped\"\ncircles = [[0, 0, 120000]]\nmost_level = 1\n";
    const Ran ran = atlas("--diff a.atlas --limit eps_px=+0.2 --json");
    EXPECT_EQ(ran.exitCode, 1) << ran.errors;
    const nlohmann::json diff = nlohmann::json::parse(ran.output)["diff"];
    EXPECT_FALSE(diff["within_limits"]);
    EXPECT_EQ(diff["changed_chunks"], 0);
    const nlohmann::json& worst = diff["limits"][0]["worst"][0];
    // The eye is inside the bounds of chunks that the region keeps coarse.
    EXPECT_TRUE(worst["now"].is_null());
    EXPECT_LE(worst["before"], 0.5);
    EXPECT_LT(std::abs(worst["latitude_deg"].get<double>()), 60);
    EXPECT_LT(std::abs(worst["longitude_deg"].get<double>()), 60);
    EXPECT_EQ(atlas("--diff a.atlas --limit triangles=+1e15").exitCode, 0);
}

TEST_F(AtlasCommand, AnotherBakeIsFoundByItsChunks) {
    ASSERT_EQ(atlas(small + "-o a.atlas").exitCode, 0);
    const Ran baked = runWorldy(
        folder, "bake hills.pgm -o planet.chk --chunk-size 17 --radius 100000 --metres-per-unit 21");
    ASSERT_EQ(baked.exitCode, 0) << baked.errors;
    const Ran ran = atlas("--diff a.atlas --limit chunks=+10");
    EXPECT_EQ(ran.exitCode, 1) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("limit chunks=+10: exceeded"));
}

TEST_F(AtlasCommand, ResumesOnlyTheSameSurvey) {
    ASSERT_EQ(atlas(small + "-o whole.atlas").exitCode, 0);
    // A finished file without its end is one whose program was killed.
    const std::string whole = file("whole.atlas");
    std::ofstream(folder.path() / "part.atlas.part", std::ios::binary)
        << whole.substr(0, whole.size() * 2 / 3);
    const Ran other = atlas(small + "-o part.atlas --resume --set lod.hysteresis=0.3");
    EXPECT_EQ(other.exitCode, 2);
    EXPECT_THAT(other.errors, HasSubstr("lod.hysteresis"));
    const Ran grid =
        atlas(places + "--headings 3 --viewpoints 150 --set lod.tau_px=0.5 -o part.atlas --resume");
    EXPECT_EQ(grid.exitCode, 2);
    EXPECT_THAT(grid.errors, HasSubstr("has other viewpoints"));
    const Ran resumed = atlas(small + "-o part.atlas --resume");
    EXPECT_EQ(resumed.exitCode, 0) << resumed.errors;
    EXPECT_EQ(file("part.atlas"), whole);
    const Ran again = atlas(small + "-o part.atlas --resume");
    EXPECT_EQ(again.exitCode, 2);
    EXPECT_THAT(again.errors, HasSubstr("part.atlas: is finished"));
    std::ofstream(folder.path() / "empty.atlas");
    EXPECT_EQ(atlas(small + "-o empty.atlas --resume").exitCode, 0);
    EXPECT_EQ(file("empty.atlas"), whole);
}

TEST_F(AtlasCommand, BadInputIsNamed) {
    const auto problem = [&](const std::string& arguments) {
        const Ran ran = atlas(arguments);
        EXPECT_EQ(ran.exitCode, 2) << arguments;
        return ran.errors;
    };
    EXPECT_THAT(problem(places + "--viewpoints 20 -o a.atlas"), HasSubstr("expected at least 48"));
    EXPECT_THAT(problem(""), HasSubstr("--output is required without --diff"));
    EXPECT_THAT(problem("--limit eps_px=+1 -o a.atlas"), HasSubstr("--diff"));
    EXPECT_THAT(problem("--diff planet.chk"), HasSubstr("planet.chk: is not an atlas"));
    EXPECT_THAT(problem("--diff none.atlas"), HasSubstr("none.atlas"));
    EXPECT_THAT(problem("-o planet.chk"), HasSubstr("planet.chk"));
    ASSERT_EQ(atlas(small + "-o a.atlas").exitCode, 0);
    EXPECT_THAT(problem("--diff a.atlas --limit speed=+1"), HasSubstr("speed=+1: is not a limit"));
    EXPECT_THAT(problem("--diff a.atlas --limit error_px=+1"), HasSubstr("--true-error"));
    EXPECT_THAT(problem("--diff a.atlas -o a.atlas"), HasSubstr("a.atlas"));
    for (const char* const decided : {"--altitudes 100", "--headings 3", "--pitch -20", "--viewpoints 50",
                                      "--cells 1", "--size 64x64", "--fov 40"}) {
        const std::string option = decided;
        EXPECT_THAT(problem("--diff a.atlas " + option),
                    testing::AllOf(HasSubstr("--diff"), HasSubstr(option.substr(0, option.find(' ')))));
    }
}

}  // namespace
}  // namespace worldy
