// The timeline in the window: it records the frames of a flight, lists the chunks of one, and saves a Chrome trace.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"

namespace worldy {
namespace {

std::filesystem::path savedTrace(const TemporaryFolder& folder) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
        if (entry.path().extension() == ".json") return entry.path();
    return {};
}

using TimelineWindowTest = PlanetWindowFixture;

TEST_F(TimelineWindowTest, framesOfAFlightAreRecordedWithTheirChunksAndSaved) {
    setenv("XDG_PICTURES_DIR", folder.path().c_str(), 1);
    const Ran ran = runInWindow(folder, "planet.chk", R"sh(
key ctrl+shift+t; expect shown timeline/Lanes
point viewport/picture; xdotool click --repeat 12 --delay 60 4; frames 4; settle
click timeline/Fit
click "timeline/Save Chrome trace"; expect says Saved:
)sh",
                                usualScreen);
    unsetenv("XDG_PICTURES_DIR");
    expectQuiet(ran);
    const std::filesystem::path file = savedTrace(folder);
    ASSERT_FALSE(file.empty()) << ran.errors;
    const auto report = nlohmann::json::parse(contentOf(file));
    std::map<std::string, int> counts;
    bool loadHasChunk = false;
    for (const auto& event : report.at("traceEvents")) {
        ++counts[event.at("name")];
        loadHasChunk |= event.at("name") == "decode" && event.at("args").contains("chunk");
    }
    for (const char* name : {"frame", "upload", "select", "paging", "draw", "panels", "present", "load",
                             "read", "decode", "came"})
        EXPECT_GT(counts[name], 0) << name;
    EXPECT_TRUE(loadHasChunk);
    EXPECT_GT(counts["split"] + counts["merged"], 0);
    if (report.at("otherData").contains("gpu_clock_error_us")) {
        EXPECT_GT(counts["chunks"], 0);
    }
    EXPECT_EQ(report.at("otherData").at("spans_dropped"), 0);
}

}  // namespace
}  // namespace worldy
