// The texts and reports of atlases whose figures are planted.
#include "app/measure/atlas_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>

#include "planet/measure/atlas.h"
#include "planet/measure/atlas_diff.h"

namespace worldy {
namespace {

using planet::AtlasMeasure;
using testing::HasSubstr;

constexpr double unboundedPx = std::numeric_limits<double>::infinity();

double& epsOf(planet::AtlasViewpoint& viewpoint) {
    return viewpoint.figures[static_cast<std::size_t>(AtlasMeasure::EpsPx)];
}

// Returns ten viewpoints of one face with ε of 0 to 9 px, of which the last is not bounded.
planet::Atlas tenViewpoints() {
    planet::Atlas atlas;
    atlas.survey.radiusM = 1e6;
    atlas.survey.grid.headings = 10;
    atlas.isFinished = true;
    for (std::uint8_t i = 0; i < 10; ++i) {
        planet::AtlasViewpoint viewpoint;
        viewpoint.place.heading = i;
        viewpoint.figures.fill(std::numeric_limits<double>::quiet_NaN());
        epsOf(viewpoint) = i < 9 ? i : unboundedPx;
        atlas.viewpoints.push_back(viewpoint);
    }
    return atlas;
}

TEST(AtlasTable, FiguresAndChangesHaveTheirUnits) {
    EXPECT_EQ(figureText(AtlasMeasure::EpsPx, 1.236), "1.24 px");
    EXPECT_EQ(figureText(AtlasMeasure::EpsPx, unboundedPx), "no bound");
    EXPECT_EQ(figureText(AtlasMeasure::EpsPx, NAN), "-");
    EXPECT_EQ(changeText(AtlasMeasure::EpsPx, 0.25), "+0.25 px");
    EXPECT_EQ(changeText(AtlasMeasure::Thrashes, -3), "-3");
    EXPECT_EQ(changeText(AtlasMeasure::EpsPx, 0), "0");
    EXPECT_EQ(changeText(AtlasMeasure::EpsPx, unboundedPx), "bound lost");
    EXPECT_EQ(changeText(AtlasMeasure::EpsPx, -unboundedPx), "bound gained");
}

TEST(AtlasTable, NoBoundIsTheLargestValueAndIsCounted) {
    const planet::Atlas atlas = tenViewpoints();
    const auto spreads = spreadsOf(atlas.viewpoints);
    ASSERT_EQ(spreads.size(), 1u);
    EXPECT_EQ(spreads[0].count, 10u);
    EXPECT_EQ(spreads[0].unbounded, 1u);
    EXPECT_EQ(spreads[0].p90, 8);
    EXPECT_EQ(spreads[0].most, unboundedPx);
    EXPECT_EQ(worstViewpoints(atlas.viewpoints, AtlasMeasure::EpsPx, 1).front(), 9u);
}

TEST(AtlasTable, ReportsNameWhatHasNoBound) {
    const planet::Atlas atlas = tenViewpoints();
    const nlohmann::ordered_json report = atlasJson(atlas, {}, 0);
    EXPECT_EQ(report["measures"][0]["unbounded"], 1);
    EXPECT_TRUE(report["measures"][0]["maximum"].is_null());
    EXPECT_EQ(report["viewpoints"][8]["eps_px"], 8);
    EXPECT_FALSE(report["viewpoints"][8].contains("unbounded"));
    EXPECT_TRUE(report["viewpoints"][9]["eps_px"].is_null());
    EXPECT_EQ(report["viewpoints"][9]["unbounded"], nlohmann::ordered_json({"eps_px"}));
    EXPECT_THAT(atlasCsv(atlas), HasSubstr(",inf,"));
}

TEST(AtlasTable, ALimitOnTheTimeOfViewsThatAreNotSharpIsRefusedAndNotMet) {
    planet::Atlas before = tenViewpoints();
    const auto sharpOf = [](planet::AtlasViewpoint& viewpoint) -> double& {
        return viewpoint.figures[static_cast<std::size_t>(AtlasMeasure::SharpS)];
    };
    for (planet::AtlasViewpoint& viewpoint : before.viewpoints) sharpOf(viewpoint) = 2;
    planet::Atlas now = before;
    const planet::AtlasLimit limit{.measure = AtlasMeasure::SharpS, .by = 1};
    EXPECT_TRUE(diffOf(before, now, {&limit, 1})->isWithinLimits());
    sharpOf(now.viewpoints[4]) = NAN;
    for (const auto& [earlier, later, which] :
         {std::tuple(&before, &now, "present"), std::tuple(&now, &before, "earlier")}) {
        const auto diff = diffOf(*earlier, *later, {&limit, 1});
        ASSERT_FALSE(diff);
        EXPECT_THAT(diff.error().message,
                    HasSubstr(std::string("1 of 10 viewpoints of the ") + which +
                              " survey are not sharp within 3600 s; expected a faster disk"));
    }
    EXPECT_TRUE(diffOf(before, now, {}));
    const std::string csv = atlasCsv(now);
    EXPECT_EQ(std::ranges::count(csv, '\n'), 11);
    EXPECT_TRUE(atlasJson(now, {}, 0)["viewpoints"][4]["sharp_s"].is_null());
    EXPECT_EQ(atlasJson(now, {}, 0)["viewpoints"][5]["sharp_s"], 2);
}

TEST(AtlasTable, ALostBoundExceedsALimitAndIsReported) {
    planet::Atlas before = tenViewpoints(), now = before;
    epsOf(now.viewpoints[4]) = unboundedPx;
    const planet::AtlasLimit limit = planet::atlasLimitFromText("eps_px=+1e9").value();
    const AtlasDiff diff = diffOf(before, now, {&limit, 1}).value();
    EXPECT_FALSE(diff.isWithinLimits());
    const nlohmann::ordered_json worst = diffJson(diff, now, 5)["limits"][0]["worst"];
    ASSERT_EQ(worst.size(), 1u);
    EXPECT_EQ(worst[0]["before"], 4);
    EXPECT_TRUE(worst[0]["now"].is_null());
    EXPECT_TRUE(diffOf(now, now, {&limit, 1})->isWithinLimits());
}

}  // namespace
}  // namespace worldy
