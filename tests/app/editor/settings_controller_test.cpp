// Budgets govern the settings of the frames that step; what is saved and undone is the user's own.
#include "app/editor/settings_controller.h"

#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "app/settings/region_file.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

TEST(SettingsController, aBudgetGovernsTheFramesThatStep) {
    const auto planet = planet::openFake();
    planet->step(planet::viewAt(10, 20), {}, planet::noUpload);
    FrameStats stats;
    stats.tauPx = 2;
    stats.selection = planet->selection().counters;
    FrameController frames;
    SettingsController controller;
    ViewSettings& view = controller.settings.view;
    view.budget.triangles = 1;
    const auto tauOfNextFrame = [&] {
        governFrame(controller, frames, *planet, 1.0 / 60);
        return view.lod.tauPx;
    };
    EXPECT_EQ(tauOfNextFrame(), 2) << "no frame was drawn yet";
    finishFrame(frames, stats);
    frames.paused = true;
    EXPECT_EQ(tauOfNextFrame(), 2);
    frames.stepOnce = true;
    EXPECT_EQ(tauOfNextFrame(), view.budget.mostTauPx);
    EXPECT_EQ(ungoverned(controller, view).lod.tauPx, 2);
}

// A folder of planets and their regions.
class RegionsOfPlanets : public testing::Test {
protected:
    RegionsOfPlanets() {
        write("earth.regions.toml", "Valley");
        write("other.regions.toml", "Other");
        write("bad.regions.toml", "");
    }
    void write(const std::string& file, const std::string& name) const {
        std::ofstream(folder_ / file) << "[[region]]\nname = \"" << name << "\"\n";
    }
    void open(const std::string& planet) {
        DataSet data;
        data.source = data.chunkFile = folder_ / planet;
        followRegions(controller_, data, notices_);
    }
    std::vector<std::string> names() const {
        std::vector<std::string> all;
        for (const planet::Region& region : controller_.settings.view.regions.all())
            all.push_back(region.name);
        return all;
    }

    const tests::TemporaryFolder folder_;
    const Log log_;
    Notices notices_{log_};
    SettingsController controller_;
};

TEST_F(RegionsOfPlanets, eachPlanetBringsItsOwn) {
    open("earth.chk");
    EXPECT_EQ(names(), std::vector<std::string>{"Valley"});
    EXPECT_FALSE(settingsViewOf(controller_).hasUnsavedRegions);
    open("moon.chk");
    EXPECT_TRUE(names().empty());
    EXPECT_EQ(settingsViewOf(controller_).regionsFile, folder_ / "moon.regions.toml");
    open("bad.chk");
    EXPECT_TRUE(names().empty());
    EXPECT_NE(notices_.message.title, "");
}

TEST_F(RegionsOfPlanets, thoseOfTheCommandLineStayForTheFirstPlanet) {
    controller_.settings.view.regions = regionsFor(folder_ / "other.regions.toml", {}).value();
    open("earth.chk");
    EXPECT_EQ(names(), std::vector<std::string>{"Other"});
    open("moon.chk");
    open("earth.chk");
    EXPECT_EQ(names(), std::vector<std::string>{"Valley"});
}

TEST_F(RegionsOfPlanets, editsAreSavedBesideThePlanetAndAnotherPlanetDoesNotLoseThem) {
    open("moon.chk");
    planet::Region region;
    region.name = "Crater";
    RegionSettings& regions = controller_.settings.view.regions;
    regions.list = std::make_shared<const std::vector<planet::Region>>(1, region);
    EXPECT_TRUE(settingsViewOf(controller_).hasUnsavedRegions);
    open("earth.chk");
    execute(controller_, ui::Undo{}, false, notices_);
    EXPECT_EQ(names(), std::vector<std::string>{"Crater"});
    execute(controller_, ui::Redo{}, false, notices_);
    EXPECT_EQ(names(), std::vector<std::string>{"Valley"});
    open("moon.chk");
    regions.list = std::make_shared<const std::vector<planet::Region>>(1, region);
    execute(controller_, ui::SaveRegions{}, false, notices_);
    EXPECT_FALSE(settingsViewOf(controller_).hasUnsavedRegions);
    EXPECT_EQ(loadRegions(folder_ / "moon.regions.toml").value(), regions.all());
    execute(controller_, ui::LoadRegions{folder_ / "other.regions.toml"}, false, notices_);
    EXPECT_EQ(names(), std::vector<std::string>{"Other"});
    execute(controller_, ui::LoadRegions{folder_ / "earth.regions.toml"}, true, notices_);
    EXPECT_EQ(names(), std::vector<std::string>{"Other"}) << "not during a replay";
}

}  // namespace
}  // namespace worldy
