#include "app/settings/camera_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace worldy {
namespace {

using testing::HasSubstr;

TEST(CameraText, ASizeIsWidthTimesHeight) {
    const planet::Result<PictureSize> size = pictureSizeFromText("1920x1080");
    ASSERT_TRUE(size);
    EXPECT_EQ(size->widthPx, 1920);
    EXPECT_EQ(size->heightPx, 1080);
}

TEST(CameraText, OtherSizesAreRefused) {
    for (const char* text : {"", "1920", "1920x", "x1080", "1920x1080x3", "15x100", "100x16385", "19.5x100",
                             "-640x480", "axb", "1e3x1e", "nanx100", " 640x480"}) {
        const planet::Result<PictureSize> size = pictureSizeFromText(text);
        ASSERT_FALSE(size) << text;
        EXPECT_THAT(size.error().message, HasSubstr("WIDTHxHEIGHT")) << text;
    }
}

TEST(CameraText, ACameraMayLeaveOutHeadingAndPitch) {
    const planet::Result<planet::CameraPose> pose = poseFromText("-28.5,86,2e4");
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->latitudeDeg, -28.5);
    EXPECT_EQ(pose->altitudeM, 2e4);
    EXPECT_EQ(pose->headingDeg, 0);
    EXPECT_EQ(pose->pitchDeg, -90);
    EXPECT_EQ(poseFromText("1,2,3,4,5")->pitchDeg, 5);
}

TEST(CameraText, ReportsLeaveOutTheRoundingErrorsOfTheEye) {
    const planet::CameraPose pose =
        roundedPose({26.999999999999996, 86.40000000000001, 20000.000000004, 359.9999999999, -1e-14});
    EXPECT_EQ(cameraText(pose), "27,86.4,20000,0,0");
    EXPECT_EQ(roundedPose({1.234567891, 0, 12.345678, 10, -90}).latitudeDeg, 1.234567891);
    EXPECT_EQ(roundedPose({0, 0, 12.345678, 10, -90}).altitudeM, 12.345678);
}

TEST(CameraText, OtherCamerasAreRefusedWithWhatWouldBeRight) {
    for (const char* text : {"", "1", "1,2", "1,2,3,4,5,6", "1,,3", "1,2,x", "1,2,inf"}) {
        const planet::Result<planet::CameraPose> pose = poseFromText(text);
        ASSERT_FALSE(pose) << text;
        EXPECT_THAT(pose.error().message, HasSubstr("LAT,LON,ALT,HEADING,PITCH")) << text;
    }
    EXPECT_THAT(poseFromText("91,0,0").error().message, HasSubstr("latitude is 91; expected [-90, 90]"));
    EXPECT_THAT(poseFromText("0,0,0,0,-91").error().message, HasSubstr("pitch is -91"));
}

}  // namespace
}  // namespace worldy
