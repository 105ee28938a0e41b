#include "app/settings/screenshot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/base/picture_file.h"
#include "app/settings/camera_text.h"
#include "app/settings/settings_text.h"
#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::TemporaryFolder;
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

Picture smallPicture() {
    Picture picture{5, 3, std::vector<std::uint8_t>(45)};
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = static_cast<std::uint8_t>(5 * i);
    return picture;
}

ScreenshotNote someNote() {
    Settings settings;
    settings.view.lod.tauPx = 0.3;
    settings.view.surface.ramp = {{-10.25, {0, 0, 1}}, {1e-3, {1, 1, 1}}};
    settings.dataSet = "/Erde ä/earth.chk";
    return {settingsText(settings),
            {-27.98812345678901, 86.92512345678902, 8848.860000000001, 359.9999999, -0.1},
            "/Erde ä/earth.chk",
            "worldy shot '/Erde ä/earth.chk' --set lod.tau_px=0.3",
            "0.2.0"};
}

std::tm someTime() {
    std::tm time{};
    time.tm_year = 126;
    time.tm_mon = 10;
    time.tm_mday = 21;
    time.tm_hour = 14;
    time.tm_min = 3;
    time.tm_sec = 22;
    return time;
}

TEST(Screenshot, KeepsItsNoteAndItsPicture) {
    const TemporaryFolder folder;
    const ScreenshotNote note = someNote();
    const planet::Result<void> written = writeScreenshot(smallPicture(), folder / "s.png", note);
    ASSERT_TRUE(written) << written.error().message;
    const planet::Result<ScreenshotNote> read = readScreenshotNote(folder / "s.png");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->settings, note.settings);
    EXPECT_EQ(cameraText(read->camera), cameraText(note.camera));
    EXPECT_EQ(read->camera.latitudeDeg, note.camera.latitudeDeg);
    EXPECT_EQ(read->dataSet, note.dataSet);
    EXPECT_EQ(read->shotLine, note.shotLine);
    EXPECT_EQ(read->version, note.version);
    EXPECT_EQ(readPicture(folder / "s.png")->rgb, smallPicture().rgb);
    EXPECT_EQ(readPictureText(folder / "s.png", "ImageDescription"), note.shotLine);
}

TEST(Screenshot, ServesAsASettingsFile) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeScreenshot(smallPicture(), folder / "s.png", someNote()));
    const planet::Result<Settings> settings = loadSettingsOfAnyKind(folder / "s.png");
    ASSERT_TRUE(settings) << settings.error().message;
    EXPECT_EQ(settings->view.lod.tauPx, 0.3);
    EXPECT_EQ(settings->view.surface.ramp.size(), 2u);
    EXPECT_EQ(settings->camera.altitudeM, 8848.860000000001);
    std::ofstream(folder / "s.toml") << "[lod]\ntau_px = 7\n";
    EXPECT_EQ(loadSettingsOfAnyKind(folder / "s.toml")->view.lod.tauPx, 7);
}

TEST(Screenshot, PicturesWithoutANoteAreRefusedWithWhatWouldBeRight) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writePicture(smallPicture(), folder / "plain.png"));
    EXPECT_THAT(readScreenshotNote(folder / "plain.png").error().message,
                HasSubstr("plain.png: contains no settings; expected an unmodified Worldy screenshot"));
    EXPECT_THAT(loadSettingsOfAnyKind(folder / "plain.png").error().message,
                HasSubstr("contains no settings"));
    std::ofstream(folder / "junk.png") << "no picture";
    EXPECT_THAT(readScreenshotNote(folder / "junk.png").error().message,
                HasSubstr("junk.png: cannot be read"));
    EXPECT_FALSE(readScreenshotNote(folder / "none.png"));
}

TEST(Screenshot, DamagedNotesAreRefused) {
    const TemporaryFolder folder;
    const std::vector<PictureText> badCamera = {{"worldy:settings", "[lod]\n"}, {"worldy:camera", "1,2,x"}};
    ASSERT_TRUE(writePicture(smallPicture(), folder / "camera.png", badCamera));
    EXPECT_THAT(readScreenshotNote(folder / "camera.png").error().message,
                HasSubstr("camera.png: invalid camera metadata: 1,2,x; expected LAT,LON,ALT"));
    const std::vector<PictureText> badSettings = {{"worldy:settings", "[lod]\ntau_px = 1000\n"},
                                                  {"worldy:camera", "1,2,3"}};
    ASSERT_TRUE(writePicture(smallPicture(), folder / "settings.png", badSettings));
    EXPECT_THAT(loadSettingsOfAnyKind(folder / "settings.png").error().message,
                HasSubstr("settings.png: line 2: lod.tau_px is 1000"));
    // Cut off in the middle of the note.
    ASSERT_TRUE(writeScreenshot(smallPicture(), folder / "cut.png", someNote()));
    fs::resize_file(folder / "cut.png", 400);
    EXPECT_FALSE(loadSettingsOfAnyKind(folder / "cut.png"));
}

TEST(Screenshot, NamesAreOfTheTimeAndNeverTaken) {
    const TemporaryFolder folder;
    EXPECT_EQ(newScreenshotFile(folder.path(), someTime()), folder / "worldy 2026-11-21 14.03.22.png");
    EXPECT_EQ(newScreenshotFile(folder.path(), someTime()), folder / "worldy 2026-11-21 14.03.22 2.png");
    EXPECT_EQ(newScreenshotFile(folder.path(), someTime()), folder / "worldy 2026-11-21 14.03.22 3.png");
    EXPECT_TRUE(writeScreenshot(smallPicture(), folder / "worldy 2026-11-21 14.03.22.png", someNote()));
    const planet::Result<fs::path> nowhere = newScreenshotFile(folder / "none", someTime());
    ASSERT_FALSE(nowhere);
    EXPECT_THAT(nowhere.error().message, HasSubstr("none: cannot be written: "));
}

}  // namespace
}  // namespace worldy
