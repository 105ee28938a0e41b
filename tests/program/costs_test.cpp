#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(Costs, TimeEachPartOfThePictureThatThereIs) {
    const TemporaryFolder folder;
    bakePlanet(folder);
    const Ran ran =
        runWorldy(folder, "costs planet.chk --camera 10,20,9000,0,-40 --size 64x48 --rounds 1 -o costs.json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("physical atmosphere"));
    const json report = json::parse(contentOf(folder.path() / "costs.json"));
    EXPECT_EQ(report["width_px"], 64);
    EXPECT_EQ(report["rounds"], 1);
    EXPECT_NEAR(report["camera"]["altitude_m"], 9000, 1e-3);
    std::set<std::string> parts;
    for (const json& part : report["parts"]) {
        parts.insert(part["part"]);
        EXPECT_GT(part["without_ms"], 0);
        EXPECT_GT(part["with_ms"], 0);
    }
    // The planet has no colours, and faces too small for tiles of normals.
    EXPECT_EQ(parts, (std::set<std::string>{"analytic atmosphere", "physical atmosphere", "sea surface",
                                            "shadows", "detail", "layers", "all features"}));
}

TEST(Costs, OfNoFileOrNoRoundsAreRefused) {
    const TemporaryFolder folder;
    const Ran gone = runWorldy(folder, "costs gone.chk");
    EXPECT_EQ(gone.exitCode, 2);
    EXPECT_THAT(gone.errors, HasSubstr("gone.chk"));
    const Ran none = runWorldy(folder, "costs gone.chk --rounds 0");
    EXPECT_EQ(none.exitCode, 2);
    EXPECT_THAT(none.errors, HasSubstr("--rounds"));
}

}  // namespace
}  // namespace worldy
