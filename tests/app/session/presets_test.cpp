#include "app/session/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/settings/settings_schema.h"
#include "app/settings/settings_text.h"
#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::TemporaryFolder;
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ViewSettings someView() {
    ViewSettings view;
    view.lod.tauPx = 5;
    view.surface.ramp = {{-1, {0, 0, 1}}, {1, {1, 1, 0}}};
    return view;
}

// Shipped: "default" with all settings, "no morph" with one. Own: none, the folder is not there yet.
struct Presets : testing::Test {
    TemporaryFolder folder;
    PresetFolders folders{folder / "shipped", folder / "config/presets"};

    Presets() {
        std::filesystem::create_directories(folders.shipped);
        std::ofstream(folders.shipped / "default.toml") << viewSettingsText({});
        std::ofstream(folders.shipped / "no morph.toml") << "[lod]\nmorph = false\n";
    }
    void writeOwn(const std::string& file, const std::string& text) const {
        std::filesystem::create_directories(folders.own);
        std::ofstream(folders.own / file) << text;
    }
    std::vector<std::string> names(PresetLibrary& library) const {
        std::vector<std::string> all;
        for (const ui::PresetView& view : library.views({})) all.push_back(view.name);
        return all;
    }
};

TEST_F(Presets, WhatIsSavedIsListedAndLoadedAgain) {
    PresetLibrary library(folders);
    EXPECT_THAT(names(library), ElementsAre("default", "no morph"));
    const planet::Result<void> saved = library.save("Mein Eis ä", someView());
    ASSERT_TRUE(saved) << saved.error().message;
    ASSERT_TRUE(library.save("a first one", {}));
    EXPECT_THAT(names(library), ElementsAre("default", "no morph", "a first one", "Mein Eis ä"));
    EXPECT_EQ(library.load("Mein Eis ä", {}), someView());
    PresetLibrary another(folders);
    EXPECT_EQ(another.load("Mein Eis ä", {}), someView());
}

TEST_F(Presets, APresetChangesOnlyWhatItHolds) {
    PresetLibrary library(folders);
    ViewSettings wanted = someView();
    wanted.lod.morph = false;
    EXPECT_EQ(library.load("no morph", someView()), wanted);
    EXPECT_EQ(library.load("default", someView()), ViewSettings{});
}

TEST_F(Presets, TheDefaultCanBeLoadedWhereItsFileIsNot) {
    PresetLibrary library({folder / "none", folder / "none either"});
    EXPECT_EQ(library.load("default", someView()), ViewSettings{});
    EXPECT_FALSE(library.load("no morph", someView()));
}

TEST_F(Presets, DifferencesAreThoseFromTheSettingsAsTheyAre) {
    PresetLibrary library(folders);
    const auto of = [&](const ViewSettings& now) { return library.views(now)[1].differences; };
    ASSERT_EQ(of(someView()).size(), 1u);
    EXPECT_EQ(of(someView())[0].setting, "lod.morph");
    EXPECT_EQ(of(someView())[0].here, "true");
    EXPECT_EQ(of(someView())[0].there, "false");
    EXPECT_EQ(library.views(someView())[0].differences.size(), 2u);
    EXPECT_THAT(of(*library.load("no morph", {})), IsEmpty());
    EXPECT_EQ(library.views({})[0].shipped, true);
}

TEST_F(Presets, BadFilesAreListedWithTheirProblemAndCannotBeLoaded) {
    writeOwn("broken.toml", "[lod]\ntau_px = 1000\n");
    writeOwn("notes.txt", "no preset");
    writeOwn(".hidden.toml", "");
    std::filesystem::create_directories(folders.own / "folder.toml");
    PresetLibrary library(folders);
    EXPECT_THAT(names(library), ElementsAre("default", "no morph", "broken", "folder"));
    EXPECT_THAT(library.views({})[2].problem, HasSubstr("broken.toml: line 2: lod.tau_px is 1000"));
    EXPECT_NE(library.views({})[3].problem, "");
    EXPECT_EQ(library.views({})[0].problem, "");
    EXPECT_THAT(library.load("broken", {}).error().message, HasSubstr("lod.tau_px is 1000"));
    EXPECT_THAT(library.load("none", {}).error().message,
                HasSubstr("unknown preset \"none\"; expected one in "));
    EXPECT_TRUE(library.remove("broken"));
    EXPECT_FALSE(std::filesystem::exists(folders.own / "broken.toml"));
}

TEST_F(Presets, ShippedOnesCanNeitherBeDeletedNorWrittenOver) {
    PresetLibrary library(folders);
    EXPECT_THAT(library.remove("default").error().message, HasSubstr("cannot be deleted"));
    EXPECT_THAT(library.save("default", someView()).error().message,
                HasSubstr("built-in preset has that name"));
    EXPECT_THAT(library.save("Default", someView()).error().message,
                HasSubstr("built-in preset has that name"));
    EXPECT_TRUE(std::filesystem::exists(folders.shipped / "default.toml"));
    EXPECT_FALSE(std::filesystem::exists(folders.own / "default.toml"));
}

TEST_F(Presets, OwnOnesAreWrittenOverAndDeleted) {
    PresetLibrary library(folders);
    ASSERT_TRUE(library.save("mine", {}));
    ASSERT_TRUE(library.save("Mine", someView()));
    EXPECT_THAT(names(library), ElementsAre("default", "no morph", "mine"));
    EXPECT_EQ(library.load("mine", {}), someView());
    EXPECT_TRUE(library.remove("mine"));
    EXPECT_THAT(names(library), ElementsAre("default", "no morph"));
    EXPECT_FALSE(library.remove("mine"));
}

TEST_F(Presets, fileThatIsNoPresetIsNotWrittenOver) {
    writeOwn("flight.toml", "[[key]]\ntime_s = 0\n");
    PresetLibrary library(folders);
    EXPECT_THAT(library.save("flight", someView()).error().message,
                HasSubstr("flight.toml: exists and is not a preset; expected another name"));
    EXPECT_EQ(tests::contentOf(folders.own / "flight.toml"), "[[key]]\ntime_s = 0\n");
}

TEST_F(Presets, AFileThatHidesBehindAShippedNameIsToldAsAProblem) {
    writeOwn("Default.toml", "[lod]\ntau_px = 9\n");
    PresetLibrary library(folders);
    EXPECT_EQ(library.load("default", someView()), ViewSettings{});
    EXPECT_THAT(library.views({})[2].problem, HasSubstr("rename the file"));
}

TEST_F(Presets, NamesThatAreNoFileNamesAreRefusedAndWriteNothing) {
    PresetLibrary library(folders);
    for (const std::string& name :
         {std::string(), std::string("../evil"), std::string("a/b"), std::string("a\\b"),
          std::string(".hidden"), std::string(".."), std::string(" x"), std::string("x "), std::string("x."),
          std::string("a\nb"), std::string("nul\0", 4), std::string("a:b"), std::string("caf\xe9"),
          std::string(61, 'x')}) {
        EXPECT_FALSE(checkFileName(name)) << name;
        EXPECT_FALSE(library.save(name, {})) << name;
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "config"));
    EXPECT_FALSE(std::filesystem::exists(folder / "evil.toml"));
    EXPECT_THAT(library.save("a/b", {}).error().message,
                HasSubstr("name \"a/b\": contains one of / \\ : * ? \" < > |; expected none of them"));
    for (const char* name : {"a", "crack hunting 2", "tau 0.5 (fine)", "Erde ä"})
        EXPECT_TRUE(checkFileName(name)) << name;
}

TEST(ShippedPresets, AllCanBeReadAndChangeSomethingAndTheDefaultHoldsEverything) {
    const std::filesystem::path data = std::filesystem::path(WORLDY_SOURCE_DIR) / "data" / "presets";
    PresetLibrary library({data, "/nonexistent"});
    std::vector<std::string> names;
    for (const ui::PresetView& view : library.views({})) {
        names.push_back(view.name);
        EXPECT_EQ(view.problem, "");
        EXPECT_TRUE(checkFileName(view.name));
        EXPECT_EQ(view.differences.empty(), view.name == defaultPreset) << view.name;
    }
    EXPECT_THAT(names,
                ElementsAre("airless moon", "crack hunting", "default", "overview", "popping", "slow disk"));
    const planet::Result<ViewPart> all = loadViewPart(data / "default.toml");
    ASSERT_TRUE(all);
    EXPECT_EQ(all->values, ViewSettings{});
    Settings settings;
    for (const Field& field : fieldsOf(settings)) {
        const bool held = std::find(all->names.begin(), all->names.end(), field.name()) != all->names.end();
        EXPECT_EQ(held, isViewTable(field.table)) << field.name();
    }
}

}  // namespace
}  // namespace worldy
