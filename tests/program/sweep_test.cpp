// worldy sweep as a program: what it writes, and how it ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

class SweepTest : public testing::Test {
protected:
    void SetUp() override {
        bakePlanet(folder);
        std::ofstream(folder.path() / "down.toml") << "name = \"Down\"\n"
                                                      "[[key]]\ntime_s = 0\nlatitude_deg = 10\n"
                                                      "longitude_deg = 20\naltitude_m = 80000\n"
                                                      "heading_deg = 0\npitch_deg = -90\n"
                                                      "[[key]]\ntime_s = 4\nlatitude_deg = 12\n"
                                                      "longitude_deg = 22\naltitude_m = 20000\n"
                                                      "heading_deg = 30\npitch_deg = -50\n";
    }
    const TemporaryFolder folder;
};

TEST_F(SweepTest, WritesTheSamePointsAsTableAndAsJson) {
    const Ran ran = runWorldy(folder,
                              "sweep planet.chk --flight down.toml --tau 1,4 --frames 2 --size 160x120 "
                              "-o s.csv --plot s.png");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_EQ(std::count(ran.output.begin(), ran.output.end(), '\n'), 5) << ran.output;
    const std::string csv = contentOf(folder.path() / "s.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5) << csv;
    const Ran told = runWorldy(
        folder, "sweep planet.chk --flight down.toml --tau 1,4 --step-s 4 --size 160x120 -o s.json --json");
    ASSERT_EQ(told.exitCode, 0) << told.errors;
    EXPECT_EQ(told.output, contentOf(folder.path() / "s.json"));
    const auto report = nlohmann::json::parse(told.output);
    EXPECT_EQ(report["frames"], 2);
    ASSERT_EQ(report["points"].size(), 4u);
    EXPECT_EQ(report["points"][0]["chunk_size"], 17);
    EXPECT_GT(report["points"][0]["mean_drawn_chunks"], 0);
    EXPECT_TRUE(report["points"][0]["most_resident_bytes"].is_number_integer());
    EXPECT_GE(report["points"][0]["mean_triangles"], report["points"][1]["mean_triangles"]);
    EXPECT_EQ(report["points"][0]["violations"], 0);
    EXPECT_GT(contentOf(folder.path() / "s.png").size(), 1000u);
}

TEST_F(SweepTest, BakesChunkSizesOnceIntoTheCache) {
    const std::string command =
        "sweep hills.pgm --flight down.toml --tau 4 --metric tight --chunk 17,33 --frames 1 --size 160x120";
    const Ran first = runWorldy(folder, command);
    ASSERT_EQ(first.exitCode, 0) << first.errors;
    EXPECT_THAT(first.errors, HasSubstr("100 %"));
    const Ran second = runWorldy(folder, command);
    ASSERT_EQ(second.exitCode, 0) << second.errors;
    EXPECT_EQ(second.errors, "");
}

TEST_F(SweepTest, SuggestsInOneLineAMetric) {
    const Ran ran = runWorldy(folder,
                              "sweep planet.chk --flight down.toml --frames 1 --size 160x120 --metric tight "
                              "--suggest error_px=1");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.output, testing::StartsWith("tight: tau "));
    EXPECT_THAT(ran.output, HasSubstr("within 1"));
    const Ran told = runWorldy(folder,
                               "sweep planet.chk --flight down.toml --frames 1 --size 160x120 --metric tight "
                               "--suggest error_px=1 --json");
    ASSERT_EQ(told.exitCode, 0) << told.errors;
    const auto suggestion = nlohmann::json::parse(told.output)["suggestions"].at(0);
    EXPECT_EQ(suggestion["met"], true);
    EXPECT_LE(suggestion["value"], 1);
}

TEST_F(SweepTest, WhatCannotBeFlownEndsWithTwoAndAReason) {
    for (const auto& [arguments, reason] :
         {std::pair("planet.chk --flight gone.toml", "gone.toml"),
          std::pair("gone.chk --flight down.toml", "gone.chk"),
          std::pair("planet.chk --flight down.toml --chunk 33", "chunk size is 17, not 33"),
          std::pair("planet.chk --flight down.toml -o table.txt", "expected .csv or .json"),
          std::pair("planet.chk --flight down.toml --tau 0", "--tau")}) {
        const Ran ran = runWorldy(folder, std::string("sweep --frames 1 --size 64x64 ") + arguments);
        EXPECT_EQ(ran.exitCode, 2) << arguments;
        EXPECT_THAT(ran.errors, HasSubstr(reason));
    }
}

}  // namespace
}  // namespace worldy
