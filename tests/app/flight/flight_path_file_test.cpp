#include "app/flight/flight_path_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;
using tests::TemporaryFolder;

std::string keyText(double time, double latitude, double longitude, double altitude = 1000) {
    return "[[key]]\ntime_s = " + std::to_string(time) + "\nlatitude_deg = " + std::to_string(latitude) +
           "\nlongitude_deg = " + std::to_string(longitude) + "\naltitude_m = " + std::to_string(altitude) +
           "\nheading_deg = 0\npitch_deg = -10\n";
}

planet::Result<FlightPath> pathFromText(const std::string& text) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "path.toml") << text;
    return loadFlightPath(folder.path() / "path.toml");
}

std::string pathErrorOf(const std::string& text) {
    const planet::Result<FlightPath> loaded = pathFromText(text);
    return loaded ? "no error" : loaded.error().message;
}

TEST(FlightPathFile, aFileThatIsNoTextIsNoFlight) {
    const TemporaryFolder folder;
    std::ofstream(folder / "s.chk", std::ios::binary) << std::string("WORLDYCH\0\xff\x01", 11);
    const planet::Result<FlightPath> path = loadFlightPath(folder / "s.chk");
    ASSERT_FALSE(path);
    EXPECT_THAT(path.error().message,
                testing::HasSubstr("s.chk: is not a flight; expected a flight (.toml or .flight)"));
}

TEST(FlightPathFile, AGoodFileIsRead) {
    const planet::Result<FlightPath> path =
        pathFromText("name = \"Two\"\n" + keyText(0, 1, 2) + keyText(5, 3, 4));
    ASSERT_TRUE(path) << path.error().message;
    EXPECT_EQ(path->name, "Two");
    ASSERT_EQ(path->keys.size(), 2u);
    EXPECT_EQ(path->keys[1].pose.longitudeDeg, 4);
}

TEST(FlightPathFile, ErrorsNameFileKeyAndWhatWouldBeRight) {
    const std::string good = keyText(0, 1, 2);
    EXPECT_THAT(pathErrorOf(good + keyText(5, 91, 0)),
                HasSubstr("path.toml: line 10: key 2: latitude_deg is 91"));
    EXPECT_THAT(pathErrorOf(good + keyText(5, 91, 0)), HasSubstr("expected a number in [-90, 90]°"));
    EXPECT_THAT(pathErrorOf(good + keyText(0, 0, 0)),
                HasSubstr("key 2: time_s is 0; expected a time after key 1's 0"));
    EXPECT_THAT(pathErrorOf(good + keyText(5, 0, 0, 0)), HasSubstr("key 2: altitude_m is 0"));
    EXPECT_THAT(pathErrorOf(good + "[[key]]\ntime_s = 5\n"), HasSubstr("key 2: latitude_deg is missing"));
    EXPECT_THAT(pathErrorOf(good + keyText(5, -1, -178)), HasSubstr("key 2: is 180° from key 1"));
    EXPECT_THAT(pathErrorOf(good + keyText(5, 0, 0) + "roll_deg = 3\n"),
                HasSubstr("key 2: roll_deg is unknown"));
    EXPECT_THAT(pathErrorOf(good + keyText(5, 0, 0) + "jump = 3\n"), HasSubstr("key 2: jump is"));
    EXPECT_THAT(pathErrorOf(good + "jump = true\n" + keyText(5, 0, 0)),
                HasSubstr("key 1: jump is true without a key before it; expected false"));
    EXPECT_THAT(pathErrorOf(good), HasSubstr("has 1 [[key]] tables; expected two or more"));
    EXPECT_THAT(pathErrorOf(""), HasSubstr("has 0 [[key]] tables"));
    EXPECT_THAT(pathErrorOf("key = 3\n"), HasSubstr("key is unknown"));
    EXPECT_THAT(pathErrorOf("speed = 3\n"), HasSubstr("speed is unknown"));
    EXPECT_THAT(pathErrorOf("key = [3]\n"), HasSubstr("key 1 is not a table"));
    EXPECT_THAT(pathErrorOf("[[key]\n"), HasSubstr("path.toml: line 1: not TOML"));
}

TEST(FlightPathFile, AKeyMayBeJumpedToEvenFromTheOppositePlace) {
    const planet::Result<FlightPath> path = pathFromText(
        keyText(0, 1, 2) + keyText(5, -1, -178) + "jump = true\n" + keyText(9, -1, -177) + "jump = false\n");
    ASSERT_TRUE(path) << path.error().message;
    EXPECT_TRUE(path->keys[1].jumpedTo);
    EXPECT_FALSE(path->keys[2].jumpedTo);
    EXPECT_NEAR(poseAt(*path, 4.999).longitudeDeg, 2, 1e-9);
    EXPECT_NEAR(poseAt(*path, 5).longitudeDeg, -178, 1e-9);
    EXPECT_TRUE(jumpsBetween(*path, 4.99, 5));
}

TEST(FlightPathFile, TheFlightsThatComeWithWorldyAreGood) {
    const std::filesystem::path folder = std::filesystem::path(WORLDY_SOURCE_DIR) / "data" / "flights";
    for (const char* name : {"orbit_to_ground.toml", "andes_low_fast.toml", "vancouver_coast.toml"}) {
        const planet::Result<FlightPath> path = loadFlightPath(folder / name);
        EXPECT_TRUE(path) << path.error().message;
    }
}

}  // namespace
}  // namespace worldy
