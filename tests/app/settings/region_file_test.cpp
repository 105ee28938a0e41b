#include "app/settings/region_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "tests/support/random_regions.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using planet::Region;
using tests::TemporaryFolder;

std::string refusalOf(const std::string& text) {
    const auto regions = regionsFromText(text, "valley.regions.toml");
    return regions ? "" : regions.error().message;
}

TEST(RegionFile, EveryKeyIsRead) {
    const auto regions = regionsFromText(R"([[region]]
name = "Valley"
on = false
circles = [[46.5, 7.9, 30000], [46, 7, 1e3]]
polygons = [[[46, 7], [46, 8], [47, 8]]]
heights_m = [1000, 4000]
heights_border_m = 200
border_m = 20000
tau_factor = 0.5
least_level = 6
most_level = 12
metric = "tight"

[[region]]
name = "Sea"
heights_m = [-11000, 0]
tau_factor = 4
)",
                                         "a.regions.toml");
    ASSERT_TRUE(regions) << regions.error().message;
    ASSERT_EQ(regions->size(), 2u);
    Region valley;
    valley.name = "Valley";
    valley.on = false;
    valley.circles = {{{46.5, 7.9}, 30'000}, {{46, 7}, 1'000}};
    valley.polygons = {{{46, 7}, {46, 8}, {47, 8}}};
    valley.heights = planet::HeightBand{1000, 4000, 200};
    valley.borderM = 20'000;
    valley.tauFactor = 0.5;
    valley.leastLevel = 6;
    valley.mostLevel = 12;
    valley.metric = planet::ErrorMetric::Tight;
    EXPECT_EQ(regions->at(0), valley);
    EXPECT_EQ(regions->at(1).heights, (planet::HeightBand{-11'000, 0, 0}));
    EXPECT_EQ(regions->at(1).tauFactor, 4);
    EXPECT_TRUE(regions->at(1).on);
}

TEST(RegionFile, WhatIsWrittenIsReadBackBitForBit) {
    std::mt19937 random(91);
    for (int i = 0; i < 50; ++i) {
        const std::vector<Region> regions = planet::randomRegions(random, 6.4e6, 8);
        const auto read = regionsFromText(regionsText(regions), "a.regions.toml");
        ASSERT_TRUE(read) << read.error().message;
        ASSERT_EQ(*read, regions);
    }
    EXPECT_EQ(regionsText({}), "");
    Region quoted;
    quoted.name = "a \"b\" \\ c";
    EXPECT_EQ(regionsFromText(regionsText({quoted}), "a").value().at(0).name, quoted.name);
}

TEST(RegionFile, ErrorsNameTheLineTheEntryAndWhatIsRight) {
    const std::string start = "[[region]]\nname = \"Valley\"\n";
    EXPECT_EQ(refusalOf(start + "tau_factor = 0\n"),
              "valley.regions.toml: line 3: region 1: tau_factor is 0; expected a number in [0.015625, 64]");
    EXPECT_EQ(refusalOf(start + "circles = [[46, 7, 1000],\n[99, 7, 1000]]\n"),
              "valley.regions.toml: line 4: region 1: circles: circle 2 is 99; expected a number in [-90, "
              "90] degrees");
    EXPECT_EQ(refusalOf(start + "circles = [[46, 7, 0]]\n"),
              "valley.regions.toml: line 1: region 1 \"Valley\": circle 1: radius_m: 0 is out of range; "
              "expected above "
              "0 and at most 10000000000");
    EXPECT_EQ(refusalOf(start + "circles = [[46, 7]]\n"),
              "valley.regions.toml: line 3: region 1: circles: circle 1 is [ 46, 7 ]; expected [latitude, "
              "longitude, "
              "radius in metres]");
    EXPECT_EQ(
        refusalOf(start + "least_level = 5\nmost_level = 2\n"),
        "valley.regions.toml: line 1: region 1 \"Valley\": least_level: 5 is larger than most_level, 2; "
        "expected at most "
        "2, or a larger most_level");
    EXPECT_EQ(refusalOf(start + "least_level = 25\n"),
              "valley.regions.toml: line 3: region 1: least_level is 25; expected an integer in [0, 24]");
    EXPECT_EQ(
        refusalOf(start + "colour = 1\n"),
        "valley.regions.toml: line 3: region 1: colour is an unknown key; expected one of name, on, circles, "
        "polygons, heights_m, heights_border_m, border_m, tau_factor, least_level, most_level, metric");
    EXPECT_EQ(refusalOf(start + "metric = \"loose\"\n"),
              "valley.regions.toml: line 3: region 1: metric is 'loose'; expected \"additive\" or \"tight\"");
    EXPECT_EQ(refusalOf(start + "polygons = [[[0, 0], [10, 10], [10, 0], [0, 10]]]\n"),
              "valley.regions.toml: line 1: region 1 \"Valley\": polygon 1: the edges from corner 1 and from "
              "corner 3 "
              "meet; expected edges that meet only at a shared corner");
    EXPECT_EQ(refusalOf(start + start),
              "valley.regions.toml: line 3: region 2 \"Valley\": name: an earlier region has it; expected a "
              "unique name");
    EXPECT_NE(refusalOf("[[region]]\ntau_factor = 2\n").find("name: 0 bytes; expected 1 to 64 bytes"),
              std::string::npos);
    EXPECT_NE(refusalOf(start + "heights_border_m = 5\n").find("heights_border_m is given without heights_m"),
              std::string::npos);
    EXPECT_NE(refusalOf(start + "border_m = inf\n").find("line 3: region 1: border_m is inf"),
              std::string::npos);
    EXPECT_NE(refusalOf(start + "border_m = nan\n").find("line 3: region 1: border_m is nan"),
              std::string::npos);
    EXPECT_NE(refusalOf("[region]\nname = \"a\"\n").find("expected tables [[region]]"), std::string::npos);
    EXPECT_NE(refusalOf("regions = 1\n").find("regions is an unknown key"), std::string::npos);
    EXPECT_NE(refusalOf("[[region]\n").find("valley.regions.toml: line 1"), std::string::npos);
}

TEST(RegionFile, FilesThatAreTooLargeAreRefused) {
    std::string circles = "[[region]]\nname = \"a\"\ncircles = [";
    for (std::size_t i = 0; i <= planet::mostCircles; ++i) circles += "[0,0,1],";
    EXPECT_NE(refusalOf(circles + "]\n").find("region 1: circles: 4097 of them; expected at most 4096"),
              std::string::npos);
    std::string many;
    for (int region = 0; region < 5; ++region) {
        many += "[[region]]\nname = \"" + std::to_string(region) + "\"\ncircles = [";
        for (std::size_t i = 0; i < planet::mostCircles; ++i) many += "[0,0,1],";
        many += "]\n";
    }
    EXPECT_NE(refusalOf(many).find("circles of all regions: 20480 of them; expected at most 16384"),
              std::string::npos);
    std::string regions;
    for (std::size_t i = 0; i <= planet::mostRegions; ++i)
        regions += "[[region]]\nname = \"" + std::to_string(i) + "\"\n";
    EXPECT_NE(refusalOf(regions).find("region: 256 of them; expected at most 255"), std::string::npos);
}

TEST(RegionFile, TheFileBesideAPlanetIsRead) {
    const TemporaryFolder folder;
    const std::filesystem::path planet = folder.path() / "earth.chk";
    EXPECT_EQ(regionsFileOf(planet), folder.path() / "earth.regions.toml");
    EXPECT_TRUE(isRegionsFile("earth.regions.toml"));
    EXPECT_FALSE(isRegionsFile("earth.toml"));
    EXPECT_FALSE(isRegionsFile(".regions.toml"));
    EXPECT_EQ(regionsFor({}, planet).value(), RegionSettings{});
    Region region;
    region.name = "a";
    ASSERT_TRUE(saveRegions({region}, regionsFileOf(planet)));
    const RegionSettings beside = regionsFor({}, planet).value();
    EXPECT_EQ(beside.all(), std::vector{region});
    EXPECT_EQ(beside.file, regionsFileOf(planet).string());
    // One that is named must exist.
    EXPECT_FALSE(regionsFor(folder.path() / "other.regions.toml", planet));
    std::ofstream(regionsFileOf(planet)) << "oops";
    EXPECT_FALSE(regionsFor({}, planet));
}

}  // namespace
}  // namespace worldy
