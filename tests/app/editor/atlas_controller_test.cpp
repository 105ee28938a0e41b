#include "app/editor/atlas_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "app/settings/settings_text.h"

namespace worldy {
namespace {

using planet::AtlasMeasure;
using testing::HasSubstr;

// Returns two headings on each face.
planet::Atlas twelveViewpoints() {
    planet::Atlas atlas;
    atlas.survey.radiusM = 1e6;
    atlas.survey.settings = viewSettingsText(ViewSettings{});
    atlas.survey.grid.altitudesM = {1000};
    atlas.survey.grid.headings = 2;
    atlas.isFinished = true;
    for (std::uint8_t i = 0; i < 12; ++i) {
        planet::AtlasViewpoint viewpoint;
        viewpoint.place = {{planet::allFaces[i / 2u], 0, 0, 0}, 0, static_cast<std::uint8_t>(i % 2)};
        viewpoint.eyeM = 1000;
        viewpoint.figures.fill(std::numeric_limits<double>::quiet_NaN());
        viewpoint.figures[static_cast<std::size_t>(AtlasMeasure::EpsPx)] = i;
        atlas.viewpoints.push_back(viewpoint);
    }
    return atlas;
}

std::string problemOf(const planet::Atlas& earlier, const planet::Atlas& now) {
    const auto comparison = comparisonOf(earlier, "old/a.atlas", now, "new/b.atlas");
    return comparison ? std::string() : comparison.error().message;
}

TEST(AtlasComparisons, ASurveyHasNoChangeFromItself) {
    const planet::Atlas atlas = twelveViewpoints();
    const auto comparison = comparisonOf(atlas, "a.atlas", atlas, "a.atlas");
    ASSERT_TRUE(comparison);
    ASSERT_EQ(comparison->diff.measures.size(), 1u);
    EXPECT_TRUE(comparison->diff.measures[0].moves.empty());
    EXPECT_TRUE(comparison->settings.empty());
    for (const planet::AtlasCell& cell : comparison->cells)
        EXPECT_EQ(planet::figureOf(cell.values, AtlasMeasure::EpsPx), 0);
}

TEST(AtlasComparisons, APlantedChangeIsAtItsViewpointAndInItsCellWithTheSettingsThatDiffer) {
    const planet::Atlas earlier = twelveViewpoints();
    planet::Atlas now = earlier;
    now.viewpoints[7].figures[static_cast<std::size_t>(AtlasMeasure::EpsPx)] += 0.5;
    ViewSettings settings;
    settings.lod.tauPx = 3;
    now.survey.settings = viewSettingsText(settings);
    const auto comparison = comparisonOf(earlier, "old/a.atlas", now, "b.atlas");
    ASSERT_TRUE(comparison);
    EXPECT_EQ(comparison->earlier, "a.atlas");
    ASSERT_EQ(comparison->diff.measures[0].moves.size(), 1u);
    EXPECT_EQ(comparison->diff.measures[0].moves[0].viewpoint, 7u);
    EXPECT_EQ(planet::figureOf(comparison->changes[7].figures, AtlasMeasure::EpsPx), 0.5);
    for (const planet::AtlasCell& cell : comparison->cells) {
        const bool isChanged = cell.cell == now.viewpoints[7].place.cell;
        EXPECT_EQ(planet::figureOf(cell.values, AtlasMeasure::EpsPx), isChanged ? 0.5 : 0);
    }
    ASSERT_EQ(comparison->settings.size(), 1u);
    EXPECT_EQ(comparison->settings[0].setting, "lod.tau_px");
    EXPECT_EQ(comparison->settings[0].there, "3");
}

TEST(AtlasComparisons, SurveysThatDoNotBelongTogetherAreRefusedWithWhatIsWrong) {
    const planet::Atlas now = twelveViewpoints();
    planet::Atlas other = now;
    other.isFinished = false;
    EXPECT_EQ(problemOf(other, now), "old/a.atlas: is not finished; expected a finished survey");
    EXPECT_EQ(problemOf(now, other), "new/b.atlas: is not finished; expected a finished survey");
    other = now;
    other.survey.radiusM = 2e6;
    EXPECT_EQ(problemOf(other, now),
              "old/a.atlas: is of a planet with a radius of 2e+06 m; expected 1e+06 m, that of b.atlas");
    other = now;
    other.viewpoints[3].eyeM = 1001;
    EXPECT_THAT(
        problemOf(other, now),
        HasSubstr("old/a.atlas: viewpoint 3 is not the same in both surveys; expected a survey of the "
                  "same viewpoints as b.atlas"));
    other.viewpoints.pop_back();
    EXPECT_THAT(problemOf(other, now), HasSubstr("11 viewpoints cannot be compared with 12"));
}

}  // namespace
}  // namespace worldy
