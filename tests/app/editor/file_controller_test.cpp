// The list of recent files.
#include "app/editor/file_controller.h"

#include <gtest/gtest.h>

#include "app/flight/flight_record.h"

namespace worldy {
namespace {

struct FileControllerTest : testing::Test {
    const Log log_;
    Notices notices_{log_};
    FileController files_;
    Session session_;
};

TEST_F(FileControllerTest, AFileIsRecentOnceItIsOpenAndNotBefore) {
    files_.opening = "/maps/good.tif";
    session_.bake.emplace();
    EXPECT_FALSE(followOpening(files_, session_, notices_));
    EXPECT_TRUE(files_.recent.empty());
    session_.bake.reset();
    EXPECT_TRUE(followOpening(files_, session_, notices_));
    EXPECT_EQ(files_.recent, (std::vector<std::filesystem::path>{"/maps/good.tif"}));
    EXPECT_FALSE(followOpening(files_, session_, notices_));
}

TEST_F(FileControllerTest, AFileThatCannotBeBakedIsNotRecent) {
    files_.opening = "/maps/bad.tif";
    session_.problem = planet::Error{planet::ErrorKind::BadInput, "/maps/bad.tif: truncated or damaged"};
    EXPECT_FALSE(followOpening(files_, session_, notices_));
    EXPECT_TRUE(files_.recent.empty());
    EXPECT_FALSE(files_.opening);
    EXPECT_TRUE(notices_.message.title.empty());  // the viewport says so, since no planet is open
}

TEST_F(FileControllerTest, aRecordedFlightIsReplayed) {
    SettingsController settings;
    CameraController camera;
    ui::Commands next;
    execute(files_, ui::OpenFile{std::string("canyon") + recordedFlightEnding}, {session_, settings, camera},
            notices_, next);
    ASSERT_EQ(next.size(), 1u);
    EXPECT_TRUE(next[0].as<ui::StartReplay>());
    EXPECT_FALSE(files_.opening);
}

TEST_F(FileControllerTest, aDroppedRegionsFileIsNoPreset) {
    SettingsController settings;
    CameraController camera;
    ui::Commands next;
    execute(files_, ui::OpenFile{"/maps/valley.regions.toml"}, {session_, settings, camera}, notices_, next);
    ASSERT_EQ(next.size(), 1u);
    ASSERT_TRUE(next[0].as<ui::LoadRegions>());
    EXPECT_EQ(next[0].as<ui::LoadRegions>()->file, "/maps/valley.regions.toml");
}

TEST_F(FileControllerTest, anAtlasIsShownAndIsNoPlanet) {
    SettingsController settings;
    CameraController camera;
    ui::Commands next;
    execute(files_, ui::OpenFile{"/maps/earth.atlas"}, {session_, settings, camera}, notices_, next);
    ASSERT_EQ(next.size(), 1u);
    ASSERT_TRUE(next[0].as<ui::OpenAtlas>());
    EXPECT_EQ(next[0].as<ui::OpenAtlas>()->file, "/maps/earth.atlas");
    EXPECT_FALSE(files_.opening);
}

// Its error is that of a trace, which names what is expected.
TEST_F(FileControllerTest, aMissingTraceIsOpenedAsATrace) {
    SettingsController settings;
    CameraController camera;
    ui::Commands next;
    execute(files_, ui::OpenFile{"/nowhere/gone.lodtrace"}, {session_, settings, camera}, notices_, next);
    ASSERT_EQ(next.size(), 1u);
    EXPECT_TRUE(next[0].as<ui::OpenTrace>());
    EXPECT_TRUE(files_.recent.empty());
}

}  // namespace
}  // namespace worldy
