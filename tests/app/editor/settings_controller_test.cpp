// Budgets govern the settings of the frames that step; what is saved and undone is the user's own.
#include "app/editor/settings_controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <iterator>
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

    // Adds a region as the panel does.
    void add(const std::string& name) {
        std::vector<planet::Region> all = controller_.settings.view.regions.all();
        all.emplace_back().name = name;
        controller_.settings.view.regions.list = std::make_shared<const std::vector<planet::Region>>(all);
    }
    void run(const ui::SettingsCommand& command) { execute(controller_, command, false, notices_); }
    bool mayQuit(ui::Quit::Unsaved unsaved = ui::Quit::Unsaved::Ask) {
        return worldy::mayQuit(controller_, {unsaved}, false, notices_);
    }
    std::string text(const std::string& file) const {
        std::ifstream stream(folder_ / file);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    std::vector<std::string> namesIn(const std::string& file) const {
        const std::vector<planet::Region> read = loadRegions(folder_ / file).value();
        std::vector<std::string> all;
        for (const planet::Region& region : read) all.push_back(region.name);
        return all;
    }
    ui::SettingsView view() { return settingsViewOf(controller_); }

    using Names = std::vector<std::string>;
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

TEST_F(RegionsOfPlanets, editsAreSavedBesideThePlanet) {
    open("moon.chk");
    add("Crater");
    EXPECT_TRUE(view().hasUnsavedRegions);
    run(ui::SaveRegions{});
    EXPECT_FALSE(view().hasUnsavedRegions);
    EXPECT_EQ(namesIn("moon.regions.toml"), Names{"Crater"});
    run(ui::LoadRegions{folder_ / "other.regions.toml"});
    EXPECT_EQ(names(), Names{"Other"});
    execute(controller_, ui::LoadRegions{folder_ / "earth.regions.toml"}, true, notices_);
    EXPECT_EQ(names(), Names{"Other"}) << "not during a replay";
    run(ui::Undo{});
    EXPECT_EQ(names(), Names{"Crater"});
    EXPECT_FALSE(view().hasUnsavedRegions) << "they are those of moon.regions.toml again";
}

TEST_F(RegionsOfPlanets, undoDoesNotBringRegionsToAnotherPlanet) {
    open("moon.chk");
    const ViewSettings before = controller_.settings.view;
    add("Crater");
    controller_.undo.add(before, controller_.settings.view, "Region \"Crater\" added");
    const ViewSettings added = controller_.settings.view;
    controller_.settings.view.lod.tauPx = 3;
    controller_.undo.add(added, controller_.settings.view, "");
    open("moon.chk");  // the next frame
    open("earth.chk");
    EXPECT_EQ(names(), Names{"Valley"});
    run(ui::Undo{});
    EXPECT_EQ(controller_.settings.view.lod.tauPx, before.lod.tauPx) << "other settings are undone";
    EXPECT_EQ(names(), Names{"Valley"});
    EXPECT_EQ(view().undoName, "");
    run(ui::Undo{});
    EXPECT_EQ(names(), Names{"Valley"});
    EXPECT_FALSE(view().hasUnsavedRegions);
    run(ui::Redo{});
    EXPECT_EQ(controller_.settings.view.lod.tauPx, 3);
    EXPECT_EQ(names(), Names{"Valley"});
}

TEST_F(RegionsOfPlanets, unsavedOnesComeBackWithTheirPlanet) {
    open("moon.chk");
    add("Crater");
    open("moon.chk");  // the next frame
    open("earth.chk");
    EXPECT_EQ(names(), Names{"Valley"});
    EXPECT_FALSE(view().hasUnsavedRegions);
    open("moon.chk");
    EXPECT_EQ(names(), Names{"Crater"});
    EXPECT_TRUE(view().hasUnsavedRegions);
    run(ui::SaveRegions{});
    EXPECT_EQ(namesIn("moon.regions.toml"), Names{"Crater"});
    open("moon.chk");
    open("earth.chk");
    EXPECT_TRUE(mayQuit()) << "all are saved";
}

TEST_F(RegionsOfPlanets, quittingAsksAboutUnsavedOnes) {
    EXPECT_TRUE(mayQuit()) << "no planet is open";
    open("earth.chk");
    EXPECT_TRUE(mayQuit());
    add("Crater");
    EXPECT_FALSE(mayQuit());
    EXPECT_EQ(view().quitQuestion, Names{(folder_ / "earth.regions.toml").string()});
    run(ui::KeepWindow{});
    EXPECT_TRUE(view().quitQuestion.empty());
    open("earth.chk");
    open("moon.chk");
    EXPECT_FALSE(mayQuit()) << "those of the planet before are lost too";
    EXPECT_TRUE(mayQuit(ui::Quit::Unsaved::Discard));
    add("Sea");
    EXPECT_TRUE(mayQuit(ui::Quit::Unsaved::Save));
    EXPECT_EQ(namesIn("earth.regions.toml"), (Names{"Valley", "Crater"}));
    EXPECT_EQ(namesIn("moon.regions.toml"), Names{"Sea"});
}

TEST_F(RegionsOfPlanets, quittingStaysIfAFileNeedsAnAnswer) {
    open("earth.chk");
    add("Crater");
    write("earth.regions.toml", "Of another program");
    EXPECT_FALSE(mayQuit(ui::Quit::Unsaved::Save));
    EXPECT_EQ(namesIn("earth.regions.toml"), Names{"Of another program"});
    EXPECT_NE(notices_.message.text.find("changed by another program"), std::string::npos);
}

TEST_F(RegionsOfPlanets, aFileThatCannotBeReadIsNeverOverwritten) {
    const std::string broken = "[[region]]\nname = \"Valley\nleast_level = 3\n";
    std::ofstream(folder_ / "earth.regions.toml") << broken;
    open("earth.chk");
    notices_.message = {};
    add("Crater");
    run(ui::SaveRegions{});
    EXPECT_EQ(text("earth.regions.toml"), broken);
    EXPECT_EQ(namesIn("earth.session.regions.toml"), Names{"Crater"});
    EXPECT_NE(notices_.message.text.find("earth.regions.toml: line"), std::string::npos);
    EXPECT_FALSE(view().hasUnsavedRegions);
    add("Sea");
    run(ui::SaveRegions{});
    EXPECT_EQ(namesIn("earth.session.regions.toml"), (Names{"Crater", "Sea"}));

    // The next session finds them.
    controller_.regions = {};
    controller_.settings.view.regions = {};
    open("earth.chk");
    EXPECT_EQ(names(), (Names{"Crater", "Sea"}));
    EXPECT_EQ(text("earth.regions.toml"), broken);
}

TEST_F(RegionsOfPlanets, aSecondFileOfSomebodyElseIsNotOverwritten) {
    std::ofstream(folder_ / "earth.regions.toml") << "broken";
    open("earth.chk");
    write("earth.session.regions.toml", "Of somebody else");
    add("Crater");
    run(ui::SaveRegions{});
    EXPECT_EQ(namesIn("earth.session.regions.toml"), Names{"Of somebody else"});
    EXPECT_EQ(namesIn("earth.session-2.regions.toml"), Names{"Crater"});
}

TEST_F(RegionsOfPlanets, changesByAnotherProgramAreNotOverwrittenUnasked) {
    open("earth.chk");
    const ViewSettings before = controller_.settings.view;
    add("Crater");
    write("earth.regions.toml", "Of another program");
    run(ui::SaveRegions{});
    EXPECT_EQ(namesIn("earth.regions.toml"), Names{"Of another program"});
    EXPECT_NE(view().regionsQuestion.find("was changed by another program"), std::string::npos);
    EXPECT_TRUE(view().hasUnsavedRegions);
    run(ui::KeepRegionsFile{});
    EXPECT_EQ(view().regionsQuestion, "");
    run(ui::SaveRegions{});
    run(ui::LoadRegions{view().regionsFile});
    EXPECT_EQ(view().regionsQuestion, "");
    EXPECT_EQ(names(), Names{"Of another program"});
    run(ui::Undo{});
    run(ui::SaveRegions{});
    EXPECT_EQ(namesIn("earth.regions.toml"), (Names{"Valley", "Crater"})) << "the other changes were read";
    write("earth.regions.toml", "Of another program");
    run(ui::SaveRegions{.replaces = true});
    EXPECT_EQ(namesIn("earth.regions.toml"), (Names{"Valley", "Crater"}));
}

TEST_F(RegionsOfPlanets, aFileThatAnotherProgramMadeIsNotOverwrittenUnasked) {
    open("moon.chk");
    add("Crater");
    write("moon.regions.toml", "Of another program");
    run(ui::SaveRegions{});
    EXPECT_EQ(namesIn("moon.regions.toml"), Names{"Of another program"});
    EXPECT_NE(view().regionsQuestion.find("was written by another program"), std::string::npos);
}

TEST_F(RegionsOfPlanets, commentsAreLostOnlyIfTheUserAgrees) {
    std::ofstream(folder_ / "earth.regions.toml") << "# mine\n[[region]]\nname = \"Valley # 1\"\n";
    open("earth.chk");
    add("Crater");
    run(ui::SaveRegions{});
    EXPECT_EQ(namesIn("earth.regions.toml"), Names{"Valley # 1"});
    EXPECT_NE(view().regionsQuestion.find("has comments"), std::string::npos);
    run(ui::SaveRegions{.replaces = true});
    EXPECT_EQ(namesIn("earth.regions.toml"), (Names{"Valley # 1", "Crater"}));
    add("Sea");
    run(ui::SaveRegions{});
    EXPECT_EQ(view().regionsQuestion, "") << "there are no comments any more";
    EXPECT_FALSE(view().hasUnsavedRegions);
}

TEST_F(RegionsOfPlanets, otherOnesDoNotReplaceUnsavedOnesSilently) {
    open("earth.chk");
    run(ui::LoadRegions{folder_ / "other.regions.toml"});
    add("Crater");
    std::deque<LogLine> lines;
    log_.moveNewLines(lines);
    lines.clear();
    run(ui::LoadRegions{folder_ / "earth.regions.toml"});
    log_.moveNewLines(lines);
    EXPECT_TRUE(std::ranges::any_of(lines, [](const LogLine& line) {
        return line.level == LogLevel::Warning && line.text.find("not saved") != std::string::npos;
    }));
    run(ui::Undo{});
    EXPECT_EQ(names(), (Names{"Other", "Crater"}));
}

TEST(RegionsFileComments, areFoundOutsideOfStrings) {
    EXPECT_FALSE(hasOwnComments(""));
    EXPECT_FALSE(hasOwnComments("# Regions of a planet, for Worldy.\n[[region]]\nname = \"a # b\"\n"));
    EXPECT_TRUE(hasOwnComments("# Regions of a planet, for Worldy.\n[[region]] # mine\n"));
    EXPECT_TRUE(hasOwnComments("a = \"\" # mine"));
    EXPECT_TRUE(hasOwnComments("a = \"\\\" # no\" # mine"));
    EXPECT_FALSE(hasOwnComments("a = \"\\\" # no\""));
    EXPECT_FALSE(hasOwnComments("a = '\\ # no'"));
    EXPECT_TRUE(hasOwnComments("a = '\\' # mine"));
    EXPECT_FALSE(hasOwnComments("a = \"\"\"x\n# no \" # no\"\"\"\""));
    EXPECT_TRUE(hasOwnComments("a = '''x\n# no '''' # mine"));
}

}  // namespace
}  // namespace worldy
