#include "app/settings/settings_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "app/settings/settings_schema.h"
#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::TemporaryFolder;
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

planet::Result<Settings> settingsFromText(const std::string& text) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "settings.toml";
    std::ofstream(file) << text;
    return loadSettings(file);
}

std::string settingsErrorOf(const std::string& text) {
    const planet::Result<Settings> loaded = settingsFromText(text);
    return loaded ? "no error" : loaded.error().message;
}

std::string setErrorOf(const std::string& assignment) {
    Settings settings;
    const planet::Result<void> set = setSetting(settings, assignment);
    EXPECT_EQ(settings, Settings{}) << assignment;
    return set ? "no error" : set.error().message;
}

// Gives a field another value than it has.
void change(const Field& field) {
    struct Change {
        void operator()(const Number& n) const {
            *n.value = *n.value == n.range.max ? n.range.min : (*n.value + n.range.max) / 2;
        }
        void operator()(const Integer& n) const {
            *n.value = static_cast<int>(*n.value == n.range.max ? n.range.min : n.range.max);
        }
        void operator()(const Seed& s) const { *s.value = 4294967295u; }
        void operator()(const Flag& f) const { *f.value = !*f.value; }
        void operator()(const Text& t) const { *t.value = "/a \"quoted\" \\ 'folder'/Erde ä = [1]\n.chk"; }
        void operator()(const Ramp& r) const {
            *r.value = {{-11000.5, {0, 0, 1}}, {0, {0, 0.2f, 1}}, {8848, {1, 1, 1}}};
        }
        void operator()(const LayerStack& l) const {
            l.value->resize(2);
            l.value->back().name = "a \"quoted\" name";
            l.value->back().heightM = {-17.5, 0.1, 3};
        }
        void operator()(const TabOrder& o) const { std::swap(o.value->front(), o.value->back()); }
        void operator()(const FloatingPanels& f) const {
            (*f.value)[1].floats = true;
            (*f.value)[1].floating = {0.25, 1, 160.5, 2000};
        }
        void operator()(const Choice& c) const {
            *c.value = static_cast<std::uint8_t>((*c.value + 1) % c.names.size());
        }
    };
    std::visit(Change{}, field.value);
}

// Settings of which no field has its default.
Settings allOther() {
    Settings settings;
    for (const Field& field : fieldsOf(settings)) change(field);
    return settings;
}

TEST(Settings, AnEmptyFileGivesTheDefaults) {
    const planet::Result<Settings> loaded = settingsFromText("");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(*loaded, Settings{});
}

TEST(Settings, WhatIsSavedIsLoadedAgainWhateverItIs) {
    const Settings settings = allOther();
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "new" / "settings.toml";
    ASSERT_TRUE(saveSettings(settings, file));
    const planet::Result<Settings> loaded = loadSettings(file);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(settingsText(*loaded), settingsText(settings));
    EXPECT_EQ(*loaded, settings);
    EXPECT_EQ(loaded->view.surface.ramp, settings.view.surface.ramp);
    EXPECT_EQ(loaded->dataSet, settings.dataSet);
}

TEST(Settings, EveryFieldOfTheViewAndTheWorkspaceStandsInTheTable) {
    const Settings settings = allOther();
    const ViewSettings none;
    EXPECT_NE(settings.view.lod, none.lod);
    // Each field by itself, so that none shares another's place.
    std::set<std::string> names;
    Settings counted;
    for (const Field& field : fieldsOf(counted))
        EXPECT_TRUE(names.insert(field.name()).second) << field.name();
    EXPECT_EQ(names.size(), 2u + 13 + 5 + 12 + 5 + 13 + 15 + 14 + 8 + 5 + 5 + 11 + 7 + 16 + 2 * panelCount +
                                dockCount + 3 + 4 + 3 + 8);
    for (std::size_t i = 0; i < names.size(); ++i) {
        Settings one;
        const std::vector<Field> fields = fieldsOf(one);
        change(fields[i]);
        EXPECT_NE(one, Settings{}) << fields[i].name();
    }
}

TEST(Settings, SavingLeavesNoTemporaryFile) {
    const TemporaryFolder folder;
    ASSERT_TRUE(saveSettings({}, folder.path() / "settings.toml"));
    const auto entries = std::filesystem::directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST(Settings, APathThatIsNoUtf8IsLeftOutRatherThanBreakingTheFile) {
    Settings settings;
    settings.dataSet = "/caf\xe9.chk";
    settings.view.lod.tauPx = 5;
    const planet::Result<Settings> loaded = settingsFromText(settingsText(settings));
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->dataSet, "");
    EXPECT_EQ(loaded->view.lod.tauPx, 5);
}

TEST(Settings, IntegersServeAsNumbers) {
    const planet::Result<Settings> loaded = settingsFromText("[lod]\ntau_px = 4\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->view.lod.tauPx, 4);
}

// Recordings and files hold such flags, from when the feature could not be automatic.
TEST(Settings, trueAndFalseServeAsOnAndOff) {
    using planet::gl::FeatureUse;
    for (const auto& [text, use] : {std::pair("true", FeatureUse::On), std::pair("false", FeatureUse::Off)}) {
        const planet::Result<Settings> loaded =
            settingsFromText(std::string("[surface]\ndetail = ") + text + "\n");
        ASSERT_TRUE(loaded) << loaded.error().message;
        EXPECT_EQ(loaded->view.surface.detail, use);
        Settings set;
        ASSERT_TRUE(setSetting(set, std::string("surface.detail=") + text));
        EXPECT_EQ(set.view.surface.detail, use);
    }
    EXPECT_THAT(settingsErrorOf("[surface]\ncolour_mode = true\n"),
                HasSubstr("surface.colour_mode is true; expected one of"));
}

TEST(Settings, WhatAFileDoesNotHoldStaysAsItWas) {
    const Settings base = allOther();
    const planet::Result<Settings> loaded = settingsFromText("[lod]\ntau_px = 4\n", "text", base);
    ASSERT_TRUE(loaded) << loaded.error().message;
    Settings wanted = base;
    wanted.view.lod.tauPx = 4;
    EXPECT_EQ(*loaded, wanted);
}

TEST(Settings, ErrorsNameFileLineKeyAndWhatWouldBeRight) {
    const std::string range = settingsErrorOf("[lod]\n\ntau_px = -1\n");
    EXPECT_THAT(range, HasSubstr("settings.toml: line 3: lod.tau_px is -1"));
    EXPECT_THAT(range, HasSubstr("; expected a number in [0.1, 64] px"));
}

TEST(Settings, EveryKindOfWrongValueIsRefused) {
    EXPECT_THAT(settingsErrorOf("[lod]\ntau_px = \"two\"\n"),
                HasSubstr("lod.tau_px is 'two'; expected a number"));
    EXPECT_THAT(settingsErrorOf("[lod]\ntau_px = nan\n"), HasSubstr("lod.tau_px is nan; expected a number"));
    EXPECT_THAT(settingsErrorOf("[lod]\ntau_px = [2]\n"), HasSubstr("; expected a number"));
    EXPECT_THAT(settingsErrorOf("[paging]\nbudget_mb = 2.5\n"),
                HasSubstr("paging.budget_mb is 2.5; expected an integer"));
    EXPECT_THAT(settingsErrorOf("[paging]\nbudget_mb = 1\n"), HasSubstr("[16, 65536]"));
    EXPECT_THAT(settingsErrorOf("[paging]\nloader_threads = 9999999999999\n"),
                HasSubstr("paging.loader_threads"));
    EXPECT_THAT(settingsErrorOf("[bad_disk]\nseed = -1\n"),
                HasSubstr("bad_disk.seed is -1; expected an integer in [0, "));
    EXPECT_THAT(settingsErrorOf("[lod]\nmorph = 1\n"), HasSubstr("lod.morph is 1; expected true or false"));
    EXPECT_THAT(settingsErrorOf("[data]\nset = 7\n"), HasSubstr("data.set is 7; expected a text in quotes"));
    EXPECT_THAT(settingsErrorOf("[overlay]\ncolour_by = \"mood\"\n"),
                HasSubstr("\"none\", \"level\", \"error\""));
    EXPECT_THAT(settingsErrorOf("[surface]\ncolour = 3\n"), HasSubstr("\"image\", \"ramp\""));
    EXPECT_THAT(settingsErrorOf("[panels]\nlod = \"top\"\n"), HasSubstr("\"left\", \"right\", \"bottom\""));
}

TEST(Settings, AWrongRampIsRefusedWithTheStopThatIsWrong) {
    const auto ramp = [](const std::string& stops) {
        return settingsErrorOf("[surface]\nramp = " + stops + "\n");
    };
    const std::string good = "{ height_m = 0, colour = \"#102030\" }";
    EXPECT_EQ(ramp("[" + good + ", { height_m = 0.5, colour = \"#FFaa00\" }]"), "no error");
    EXPECT_THAT(ramp("3"), HasSubstr("surface.ramp is 3; expected an array of stops"));
    EXPECT_THAT(ramp("[1]"), HasSubstr("surface.ramp: stop 1 is not a stop"));
    EXPECT_THAT(ramp("[" + good + ", { height_m = 1 }]"), HasSubstr("stop 2 is not a stop"));
    EXPECT_THAT(ramp("[{ height_m = 1, colour = \"#102030\", more = 1 }]"),
                HasSubstr("stop 1 is not a stop"));
    EXPECT_THAT(ramp("[" + good + "," + good + "]"),
                HasSubstr("stop 2: height_m is 0; expected more than 0, the height of the previous stop"));
    EXPECT_THAT(ramp("[{ height_m = nan, colour = \"#102030\" }]"), HasSubstr("stop 1: height_m is nan"));
    for (const char* colour : {"", "102030", "#10203", "#1020300", "#10203g", "#-10203", "#+10203", "red"}) {
        EXPECT_THAT(ramp(std::string("[{ height_m = 1, colour = \"") + colour + "\" }]"),
                    HasSubstr("\"#rrggbb\""))
            << colour;
    }
    std::string many;
    for (int i = 0; i < 33; ++i) many += "{ height_m = " + std::to_string(i) + ", colour = \"#000000\" },";
    EXPECT_THAT(ramp("[" + many + "]"), HasSubstr("has 33 stops; expected at most 32"));
}

TEST(Settings, UnknownKeysAreRefusedWithTheNearestKnownOne) {
    EXPECT_THAT(settingsErrorOf("[lod]\ntua_px = 2\n"),
                HasSubstr("line 2: lod.tua_px is not a setting; did you mean lod.tau_px?"));
    EXPECT_THAT(settingsErrorOf("[lot]\ntau_px = 2\n"), HasSubstr("lot is not a setting"));
    EXPECT_THAT(settingsErrorOf("tau_px = 2\n"), HasSubstr("tau_px is not a setting"));
    EXPECT_THAT(settingsErrorOf("lod = 2\n"), HasSubstr("lod is not a setting"));
}

TEST(Settings, BrokenTomlNamesItsLine) {
    EXPECT_THAT(settingsErrorOf("[lod]\ntau_px = \n"), HasSubstr("settings.toml: line 2: not TOML"));
}

TEST(Settings, AMissingFileIsAnError) {
    const planet::Result<Settings> loaded = loadSettings("/nonexistent/settings.toml");
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message, HasSubstr("/nonexistent/settings.toml: no such file"));
}

TEST(Settings, AFileFarTooLargeIsNotRead) {
    const TemporaryFolder folder;
    std::ofstream(folder / "large.toml").close();
    std::filesystem::resize_file(folder / "large.toml", 17u << 20);
    const planet::Result<Settings> loaded = loadSettings(folder / "large.toml");
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message, HasSubstr("17825792 bytes large"));
}

TEST(SetSetting, TakesWordsTextsNumbersAndRampsAsTheyAreWritten) {
    Settings settings;
    for (const char* assignment :
         {"lod.tau_px = 3", "lod.morph=false", "paging.budget_mb=99", "bad_disk.seed=4294967295",
          "overlay.colour_by= level ", "surface.colour=\"ramp\"", "data.set=/a b'c=d.chk",
          "view.flight=\"x\\ty\"", "camera.longitude_deg=-70.5", "panels.log_shown=false",
          "surface.ramp=[{ height_m = 1, colour = \"#ff0000\" }]"}) {
        const planet::Result<void> set = setSetting(settings, assignment);
        EXPECT_TRUE(set) << set.error().message;
    }
    EXPECT_EQ(settings.view.lod.tauPx, 3);
    EXPECT_FALSE(settings.view.lod.morph);
    EXPECT_EQ(settings.view.paging.badDisk.seed, 4294967295u);
    EXPECT_EQ(settings.view.overlay.colourBy, ColourBy::Level);
    EXPECT_EQ(settings.view.surface.surface, planet::gl::SurfaceColour::HeightRamp);
    EXPECT_EQ(settings.dataSet, "/a b'c=d.chk");
    EXPECT_EQ(settings.view.camera.flight, "x\ty");
    EXPECT_EQ(settings.camera.longitudeDeg, -70.5);
    EXPECT_FALSE(settings.workspace.panels[static_cast<std::size_t>(PanelId::Log)].shown);
    EXPECT_EQ(settings.view.surface.ramp.size(), 1u);
}

TEST(SetSetting, RefusesWithTheNameAndWhatWouldBeRight) {
    EXPECT_EQ(setErrorOf("lod.tau_px=0"), "lod.tau_px=0: lod.tau_px is 0; expected a number in [0.1, 64] px");
    EXPECT_THAT(setErrorOf("lod.tua_px=3"),
                HasSubstr("lod.tua_px is not a setting; did you mean lod.tau_px?"));
    EXPECT_THAT(setErrorOf("lod.tau_px"), HasSubstr("has no value; expected lod.tau_px=2"));
    EXPECT_THAT(setErrorOf("overlay.colour_by=mood"), HasSubstr("overlay.colour_by is 'mood'"));
    for (const char* nameless : {"", "=", "=3", "tau=3"})
        EXPECT_THAT(setErrorOf(nameless), HasSubstr("is not a setting; expected a name of the settings file"))
            << nameless;
    EXPECT_THAT(setErrorOf("lod.morp=3"), HasSubstr("did you mean lod.morph?"));
    EXPECT_THAT(setErrorOf("key=3"), HasSubstr("the file seems to be a flight"));
    for (const char* wrong : {"lod.tau_px=", "lod.tau_px=two", "lod.tau_px=3 4", "lod.tau_px=3\nmore=4",
                              "lod.tau_px=[3]", "lod.morph=yes"}) {
        EXPECT_THAT(setErrorOf(wrong), HasSubstr("; expected ")) << wrong;
    }
}

TEST(Differences, NameEverySettingOfTheViewThatDiffersAndNoOther) {
    Settings here, there = allOther();
    const std::vector<SettingDifference> all = differences(here, there);
    EXPECT_EQ(all.size(), 121u);
    EXPECT_THAT(differences(there, there), IsEmpty());
    there = here;
    there.view.lod.tauPx = 3.5;
    there.view.overlay.colourBy = ColourBy::LoadOrder;
    there.camera.latitudeDeg = 80;
    there.workspace.preferences.scale = 2;
    const std::vector<SettingDifference> few = differences(here, there);
    ASSERT_EQ(few.size(), 2u);
    EXPECT_EQ(few[0].setting, "lod.tau_px");
    EXPECT_EQ(few[0].here, "2");
    EXPECT_EQ(few[0].there, "3.5");
    EXPECT_EQ(few[1].there, "load_order");
}

TEST(Differences, AsAssignmentsMakeTheSameViewOfTheDefaults) {
    const ViewSettings view = allOther().view;
    Settings built;
    for (const std::string& assignment : assignmentsFor(view)) {
        const planet::Result<void> set = setSetting(built, assignment);
        EXPECT_TRUE(set) << set.error().message;
    }
    EXPECT_EQ(built.view, view);
    EXPECT_THAT(assignmentsFor({}), IsEmpty());
}

TEST(ViewPart, ChangesWhatItHoldsAndNothingElse) {
    const TemporaryFolder folder;
    std::ofstream(folder / "part.toml")
        << "[lod]\nmorph = false\n[seams]\nskirt_factor = 1\n[data]\nset = \"x\"\n";
    const planet::Result<ViewPart> part = loadViewPart(folder / "part.toml");
    ASSERT_TRUE(part) << part.error().message;
    EXPECT_THAT(part->names, ElementsAre("lod.morph", "seams.skirt_factor"));
    ViewSettings now;
    now.lod.tauPx = 9;
    now.lod.skirtFactor = 5;
    ViewSettings wanted = now;
    wanted.lod.morph = false;
    wanted.lod.skirtFactor = 1;
    EXPECT_EQ(applied(*part, now), wanted);
    EXPECT_EQ(differences(now, *part).size(), 2u);
    EXPECT_THAT(differences(wanted, *part), IsEmpty());
}

TEST(ViewPart, TheWholeViewIsKeptAsText) {
    const ViewSettings view = allOther().view;
    const TemporaryFolder folder;
    std::ofstream(folder / "whole.toml") << viewSettingsText(view);
    const planet::Result<ViewSettings> loaded = loadViewSettings(folder / "whole.toml");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(*loaded, view);
    EXPECT_THAT(viewSettingsText(view), Not(HasSubstr("[window]")));
}

}  // namespace
}  // namespace worldy
