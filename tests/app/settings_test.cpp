#include "app/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/temporary_folder.h"

namespace worldy {

using tests::TemporaryFolder;
namespace {

using testing::HasSubstr;

planet::Result<Settings> loadText(const std::string& text) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "settings.toml";
    std::ofstream(file) << text;
    return loadSettings(file);
}

std::string errorOf(const std::string& text) {
    const planet::Result<Settings> loaded = loadText(text);
    return loaded ? "no error" : loaded.error().message;
}

TEST(Settings, AnEmptyFileGivesTheDefaults) {
    const planet::Result<Settings> loaded = loadText("");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(settingsText(*loaded), settingsText(Settings{}));
}

TEST(Settings, WhatIsSavedIsLoadedAgain) {
    Settings settings;
    settings.dataSet = "/some \"quoted\" \\ folder/Erde ä.chk";
    settings.view.tauPx = 3.7;
    settings.view.skirts = false;
    settings.view.colourBy = planet::gl::ColourBy::Error;
    settings.view.surface = planet::gl::SurfaceColour::HeightRamp;
    settings.view.budgetMB = 99;
    settings.camera = {-12.5, 170, 1234.5, 90, -10};
    settings.windowWidthPx = 1024;
    settings.panels.lodWidth = 250;
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "new" / "settings.toml";
    ASSERT_TRUE(saveSettings(settings, file));
    const planet::Result<Settings> loaded = loadSettings(file);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(settingsText(*loaded), settingsText(settings));
    EXPECT_EQ(loaded->view.tauPx, 3.7);
    EXPECT_EQ(loaded->view.colourBy, planet::gl::ColourBy::Error);
    EXPECT_EQ(loaded->dataSet, settings.dataSet);
}

TEST(Settings, SavingLeavesNoTemporaryFile) {
    const TemporaryFolder folder;
    ASSERT_TRUE(saveSettings({}, folder.path() / "settings.toml"));
    const auto entries = std::filesystem::directory_iterator(folder.path());
    EXPECT_EQ(std::distance(begin(entries), end(entries)), 1);
}

TEST(Settings, IntegersServeAsNumbers) {
    const planet::Result<Settings> loaded = loadText("[lod]\ntau_px = 4\n");
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->view.tauPx, 4);
}

TEST(Settings, ErrorsNameFileLineKeyAndWhatWouldBeRight) {
    const std::string range = errorOf("[lod]\n\ntau_px = -1\n");
    EXPECT_THAT(range, HasSubstr("settings.toml: line 3: lod.tau_px is -1"));
    EXPECT_THAT(range, HasSubstr("; a number of pixels from 0.1 to 64 would be right"));
}

TEST(Settings, EveryKindOfWrongValueIsRefused) {
    EXPECT_THAT(errorOf("[lod]\ntau_px = \"two\"\n"), HasSubstr("lod.tau_px is 'two'; a number"));
    EXPECT_THAT(errorOf("[lod]\ntau_px = nan\n"), HasSubstr("lod.tau_px is nan; a number"));
    EXPECT_THAT(errorOf("[lod]\ntau_px = [2]\n"), HasSubstr("; a number"));
    EXPECT_THAT(errorOf("[paging]\nbudget_mb = 2.5\n"), HasSubstr("paging.budget_mb is 2.5; a whole number"));
    EXPECT_THAT(errorOf("[paging]\nbudget_mb = 1\n"), HasSubstr("from 16 to 65536"));
    EXPECT_THAT(errorOf("[paging]\nloader_threads = 9999999999999\n"), HasSubstr("paging.loader_threads"));
    EXPECT_THAT(errorOf("[view]\nskirts = 1\n"), HasSubstr("view.skirts is 1; true or false"));
    EXPECT_THAT(errorOf("[data]\nset = 7\n"), HasSubstr("data.set is 7; a text in quotes"));
    EXPECT_THAT(errorOf("[view]\ncolour_by = \"mood\"\n"), HasSubstr("\"none\", \"level\", \"error\""));
    EXPECT_THAT(errorOf("[view]\nsurface = 3\n"), HasSubstr("\"image\", \"ramp\""));
}

TEST(Settings, UnknownKeysAreRefusedWithTheNearestKnownOne) {
    EXPECT_THAT(errorOf("[lod]\ntua_px = 2\n"),
                HasSubstr("line 2: lod.tua_px is not a setting; the nearest one is lod.tau_px"));
    EXPECT_THAT(errorOf("[lot]\ntau_px = 2\n"), HasSubstr("lot is not a setting"));
    EXPECT_THAT(errorOf("tau_px = 2\n"), HasSubstr("tau_px is not a setting"));
    EXPECT_THAT(errorOf("lod = 2\n"), HasSubstr("lod is not a setting"));
}

TEST(Settings, BrokenTomlNamesItsLine) {
    EXPECT_THAT(errorOf("[lod]\ntau_px = \n"), HasSubstr("settings.toml: line 2: not TOML"));
}

TEST(Settings, AMissingFileIsAnError) {
    const planet::Result<Settings> loaded = loadSettings("/nonexistent/settings.toml");
    ASSERT_FALSE(loaded);
    EXPECT_THAT(loaded.error().message, HasSubstr("/nonexistent/settings.toml: no such file"));
}

}  // namespace
}  // namespace worldy
