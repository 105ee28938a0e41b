// Texts that fuzzing and looking hard have shown to be more than a reader could take.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "app/base/toml_file.h"
#include "app/flight/flight_path_file.h"
#include "app/flight/flight_record.h"
#include "app/settings/layer_file.h"
#include "app/settings/region_file.h"
#include "app/settings/settings_text.h"
#include "tests/support/sanitized.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::HasSubstr;

std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

// Tables in one another, which are let go of one in another.
TEST(HostileText, AKeyOfAMillionPartsIsRefused) {
    const std::string key = repeated("a.", 1'000'000) + "a";
    for (const std::string& text :
         {key + " = 1\n", "\n[" + key + "]\n", "\n[[" + key + "]]\n", "\nx = [{" + key + " = 1}]\n",
          "\nx = [\"\"\"\n#\"\"\", {" + key + "=1}]\n", repeated("\"=\" . ", 1'000'000) + "a = 1\n"}) {
        const auto parsed = parseTomlText(text, "deep.toml");
        ASSERT_FALSE(parsed);
        EXPECT_THAT(parsed.error().message, HasSubstr("deep.toml: line "));
        EXPECT_FALSE(settingsFromText(text, "deep.toml"));
        EXPECT_FALSE(layerSetFromText(text, "deep.toml"));
        EXPECT_FALSE(regionsFromText(text, "deep.toml"));
        EXPECT_FALSE(flightPathFromText(text, "deep.toml"));
    }
    Settings settings;
    EXPECT_FALSE(setSetting(settings, "lod.tau_px=1\n" + key + "=2"));
}

// To find the nearest name took the square of its length, for each setting that there is.
TEST(HostileText, ANameOfMillionsOfLettersIsRefusedInFewWords) {
    const std::string text = std::string(tests::sanitized ? 1'000'000 : 8'000'000, 'a') + " = 1\n";
    for (const std::string& whole : {text, "[lod]\n" + text, "[[key]]\n" + text}) {
        for (const auto& error :
             {settingsFromText(whole, "long.toml").error(), viewPartFromText(whole, "long.toml").error(),
              layerSetFromText(whole, "long.toml").error(), regionsFromText(whole, "long.toml").error(),
              flightPathFromText(whole, "long.toml").error()}) {
            EXPECT_THAT(error.message, HasSubstr("long.toml: line "));
            EXPECT_LT(error.message.size(), 1000u);
        }
    }
}

TEST(HostileText, ManyDotsThatAreNoKeyAreTaken) {
    const std::string text = "# " + repeated(".", 20'000) + "\nnumbers = [" + repeated("0.5, ", 2000) +
                             "]\n" + repeated("# e.g.\n", 20'000) + "text = \"" + repeated(".", 20'000) +
                             "\"\n";
    const auto parsed = parseTomlText(text, "dots.toml");
    EXPECT_TRUE(parsed) << parsed.error().message;
}

// Reading from some of them would wait for ever, or never end.
TEST(HostileText, WhatIsNoFileIsRefused) {
    const tests::TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe.flight").c_str(), 0600), 0);
    std::filesystem::create_symlink("pipe.flight", folder / "link.toml");
    std::filesystem::create_symlink("loop.toml", folder / "loop.toml");
    for (const std::filesystem::path& path :
         {folder / "pipe.flight", folder / "link.toml", folder / "loop.toml", folder.path(),
          std::filesystem::path("/dev/zero"), std::filesystem::path("/dev/null"), folder / "missing.toml"}) {
        EXPECT_FALSE(loadSettings(path)) << path;
        EXPECT_FALSE(loadViewPart(path)) << path;
        EXPECT_FALSE(loadLayerSet(path)) << path;
        EXPECT_FALSE(loadRegions(path)) << path;
        EXPECT_FALSE(loadFlightPath(path)) << path;
        EXPECT_FALSE(loadFlightRecord(path)) << path;
    }
}

TEST(HostileText, AnEmptyFileIsSettingsThatSayNothingAndNoFlightOrLayers) {
    const tests::TemporaryFolder folder;
    const auto path = folder / "empty.toml";
    std::ofstream(path).close();
    EXPECT_TRUE(loadSettings(path));
    EXPECT_FALSE(loadLayerSet(path));
    EXPECT_FALSE(loadFlightPath(path));
    EXPECT_FALSE(loadFlightRecord(path));
}

}  // namespace
}  // namespace worldy
