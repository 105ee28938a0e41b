#include "app/editor/atlas_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

#include "app/base/places.h"
#include "app/settings/settings_text.h"
#include "planet/measure/atlas_file.h"
#include "tests/app/session_fixture.h"

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

TEST(AtlasComparisons, RegionsThatDifferAreToldAndOverlaysAreNot) {
    const planet::Atlas earlier = twelveViewpoints();
    planet::Atlas now = earlier;
    ViewSettings settings;
    settings.overlay.colourBy = ColourBy::Level;
    now.survey.settings = viewSettingsText(settings);
    EXPECT_TRUE(comparisonOf(earlier, "a.atlas", now, "b.atlas")->settings.empty());

    now.survey.regions = "[[region]]\nname = \"peaks\"\ntau_factor = 2\nheights_m = [3000, 9000]\n";
    auto comparison = comparisonOf(earlier, "a.atlas", now, "b.atlas");
    ASSERT_TRUE(comparison);
    ASSERT_EQ(comparison->settings.size(), 1u);
    EXPECT_EQ(comparison->settings[0].setting, "regions");
    EXPECT_EQ(comparison->settings[0].here, "none");
    EXPECT_EQ(comparison->settings[0].there, "peaks");

    planet::Atlas other = now;
    other.survey.regions = "[[region]]\nname = \"peaks\"\ntau_factor = 3\nheights_m = [3000, 9000]\n";
    comparison = comparisonOf(now, "a.atlas", other, "b.atlas");
    ASSERT_EQ(comparison->settings.size(), 1u);
    EXPECT_THAT(comparison->settings[0].here, HasSubstr("peaks ("));
    EXPECT_NE(comparison->settings[0].here, comparison->settings[0].there);
    EXPECT_TRUE(comparisonOf(now, "a.atlas", now, "b.atlas")->settings.empty());
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

planet::Atlas withTwoAltitudes() {
    planet::Atlas atlas = twelveViewpoints();
    atlas.survey.grid.altitudesM = {200, 5000};
    atlas.viewpoints[7].place.altitude = 1;
    return atlas;
}

class AtlasSurveysInTheWindow : public test::SessionTest {
protected:
    AtlasSurveysInTheWindow() {
        const char* pictures = std::getenv("XDG_PICTURES_DIR");
        if (pictures) oldPictures_ = pictures;
        setenv("XDG_PICTURES_DIR", folder_.path().c_str(), 1);
    }
    ~AtlasSurveysInTheWindow() override {
        if (oldPictures_.empty())
            unsetenv("XDG_PICTURES_DIR");
        else
            setenv("XDG_PICTURES_DIR", oldPictures_.c_str(), 1);
    }

    void SetUp() override {
        ASSERT_TRUE(advanceUntil(session_, [&] { return session_.open.has_value(); }));
    }
    void send(AtlasController& controller, const ui::AtlasCommand& command) {
        const CameraContext cameraContext{nullptr, settingsOfWindow_.settings, popSide_, stepOnce_, false,
                                          nullptr};
        execute(controller, command, {&*session_.open, settingsOfWindow_, camera_, cameraContext}, notices_);
    }
    // Advances frames until a survey has ended.
    void finish(AtlasController& controller) {
        for (int i = 0; controller.job && i < 60'000; ++i) {
            advanceAtlas(controller, log_);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        ASSERT_FALSE(controller.job);
    }
    // Surveys until some viewpoints are written, and returns the unfinished survey as a killed program leaves it.
    std::filesystem::path killedSurvey() {
        AtlasController controller;
        send(controller, ui::StartAtlas{.viewpoints = viewpoints});
        const auto isUnderWay = [&] {
            const auto progress = controller.job->progress();
            return progress && progress->done >= 2 * planet::atlasBatch;
        };
        for (int i = 0; !isUnderWay() && i < 10'000; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        const std::filesystem::path part = planet::unfinishedAtlas(controller.files.output);
        const std::filesystem::path killed = folder_ / "killed";
        std::filesystem::create_directory(killed);
        std::filesystem::copy(controller.files.output, killed);
        std::filesystem::copy(part, killed);
        send(controller, ui::CancelAtlas{});
        finish(controller);
        return killed / part.filename().string();
    }

    static constexpr std::uint64_t viewpoints = 600;
    Session session_ = sessionOf(bakeTo("planet.chk", {.faceSize = 65, .chunkSize = 17}));
    SettingsController settingsOfWindow_;
    CameraController camera_;
    PopSide popSide_{};
    bool stepOnce_ = false;
    Notices notices_{log_};

private:
    std::string oldPictures_;
};

TEST_F(AtlasSurveysInTheWindow, AKilledSurveyIsContinuedThoughItsEmptyReservationIsStillThere) {
    const std::filesystem::path part = killedSurvey();
    const std::filesystem::path finished = planet::finishedAtlas(part);
    ASSERT_TRUE(std::filesystem::exists(finished));
    ASSERT_EQ(std::filesystem::file_size(finished), 0u);
    AtlasController controller;
    send(controller, ui::OpenAtlas{part});
    ASSERT_TRUE(controller.atlas);
    const std::size_t before = controller.atlas->viewpoints.size();
    EXPECT_GT(before, 0u);
    EXPECT_LT(before, viewpoints);
    send(controller, ui::ResumeAtlas{});
    ASSERT_TRUE(controller.job) << notices_.message.text;
    finish(controller);
    EXPECT_EQ(controller.problem, "");
    EXPECT_TRUE(controller.atlas->isFinished);
    EXPECT_EQ(controller.file, finished);
    EXPECT_EQ(planet::loadAtlas(finished)->viewpoints.size(), controller.atlas->viewpoints.size());
    EXPECT_GT(controller.atlas->viewpoints.size(), before);
    EXPECT_FALSE(std::filesystem::exists(part));
}

TEST_F(AtlasSurveysInTheWindow, AFileThatHoldsSomethingIsNeverReplacedByAContinuedSurvey) {
    const std::filesystem::path part = killedSurvey();
    const std::filesystem::path finished = planet::finishedAtlas(part);
    std::ofstream(finished) << "mine";
    AtlasController controller;
    send(controller, ui::OpenAtlas{part});
    send(controller, ui::ResumeAtlas{});
    EXPECT_FALSE(controller.job);
    EXPECT_THAT(notices_.message.text, HasSubstr("exists; expected no file of this name"));
    EXPECT_EQ(tests::contentOf(finished), "mine");
}

TEST_F(AtlasSurveysInTheWindow, PlanetsAreNamedAsInTheTitleOfTheWindow) {
    session_.open->data.source = "/worlds/earth.toml";
    AtlasController controller;
    send(controller, ui::StartAtlas{.viewpoints = 72});
    EXPECT_EQ(atlasViewOf(controller, &*session_.open).surveyed, "earth.toml");
    finish(controller);
    EXPECT_EQ(atlasViewOf(controller, &*session_.open).otherBake, "");
    controller.atlas->survey.bake = "moon.chk";
    EXPECT_EQ(atlasViewOf(controller, &*session_.open).otherBake, "It is of moon.chk; earth.toml is open.");
}

TEST_F(AtlasSurveysInTheWindow, LookingFromAViewpointShowsItsAltitude) {
    AtlasController controller;
    controller.atlas = withTwoAltitudes();
    controller.cells = planet::cellsOf(controller.atlas->survey.grid, controller.atlas->viewpoints);
    send(controller, ui::LookFromAtlas{7});
    EXPECT_EQ(controller.altitude, 1);
    EXPECT_EQ(controller.drape.values.size(), 1u);
    send(controller, ui::LookFromAtlas{3});
    EXPECT_EQ(controller.altitude, 0);
}

TEST_F(AtlasSurveysInTheWindow, ARefusedComparisonKeepsTheOneOnScreenAndItsReasonEndsWithTheNextCommand) {
    AtlasController controller;
    send(controller, ui::StartAtlas{.viewpoints = 72});
    finish(controller);
    ASSERT_TRUE(controller.atlas && controller.atlas->isFinished);
    const std::filesystem::path first = controller.file;
    send(controller, ui::CompareAtlas{first});
    ASSERT_TRUE(controller.comparison);
    EXPECT_EQ(controller.comparisonProblem, "");
    send(controller, ui::StartAtlas{.viewpoints = 150});
    finish(controller);
    const std::filesystem::path second = controller.file;
    send(controller, ui::CompareAtlas{second});
    ASSERT_TRUE(controller.comparison);

    send(controller, ui::CompareAtlas{first});
    EXPECT_THAT(controller.comparisonProblem, HasSubstr("viewpoints cannot be compared"));
    ASSERT_TRUE(controller.comparison);
    EXPECT_EQ(controller.comparison->earlier, second.filename().string());
    EXPECT_TRUE(controller.isChange);
    send(controller, ui::CompareAtlas{folder_ / "planet.chk"});
    EXPECT_EQ(controller.comparisonProblem, "");
    EXPECT_EQ(notices_.message.title, "planet.chk cannot be compared");
    EXPECT_THAT(notices_.message.advice, HasSubstr(".atlas"));
    EXPECT_TRUE(controller.comparison);
}

}  // namespace
}  // namespace worldy
