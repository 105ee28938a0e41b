#include "app/base/picture.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "app/base/picture_file.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using Samples = std::vector<std::uint8_t>;

// What is read of two pixels that were written with so many channels.
Samples readOf(const Samples& samples, int channels) {
    const tests::TemporaryFolder folder;
    const auto output = OIIO::ImageOutput::create("png");
    output->open((folder / "two.png").string(), OIIO::ImageSpec(2, 1, channels, OIIO::TypeDesc::UINT8));
    output->write_image(OIIO::TypeDesc::UINT8, samples.data());
    output->close();
    return readPicture(folder / "two.png").value().rgb;
}

TEST(ReadPicture, ColoursAreKeptOpacityIsLeftOutAndGreyIsSpread) {
    EXPECT_EQ(readOf({1, 2, 3, 4, 5, 6}, 3), (Samples{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(readOf({1, 2, 3, 255, 4, 5, 6, 255}, 4), (Samples{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(readOf({7, 8}, 1), (Samples{7, 7, 7, 8, 8, 8}));
    EXPECT_EQ(readOf({7, 255, 8, 255}, 2), (Samples{7, 7, 7, 8, 8, 8}));
}

Picture rampPicture(int width, int height) {
    Picture picture{width, height, {}};
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column)
            for (const int value : {10 * column, 20 * row, 0})
                picture.rgb.push_back(static_cast<std::uint8_t>(value));
    return picture;
}

TEST(PlacedPicture, onePixelCentredIsLeftAsItIs) {
    EXPECT_EQ(placedPicture(rampPicture(8, 4), planet::centredPlacement(8)).rgb, rampPicture(8, 4).rgb);
}

TEST(PlacedPicture, oneThatBeginsAtLongitudeZeroIsTurnedByHalf) {
    const Picture placed = placedPicture(rampPicture(8, 4), {8, -0.5, false});
    ASSERT_EQ(placed.width, 8);
    ASSERT_EQ(placed.height, 4);
    for (std::size_t column = 0; column < 8; ++column)
        EXPECT_EQ(placed.rgb[3 * column], 10 * ((column + 4) % 8)) << column;
}

TEST(PlacedPicture, gridPointsBecomePixelCentres) {
    const Picture placed = placedPicture(rampPicture(9, 5), {8, 4, true});
    ASSERT_EQ(placed.width, 8);
    ASSERT_EQ(placed.height, 4);
    for (std::size_t row = 0; row < 4; ++row) {
        EXPECT_EQ(placed.rgb[3 * 8 * row], 5) << "half way to the next column";
        EXPECT_EQ(placed.rgb[3 * 8 * row + 1], 20 * row + 10);
    }
}

TEST(ReadPlanetPicture, aGridOfPointsIsToldByItsSizeAndOtherShapesAreStretched) {
    const tests::TemporaryFolder folder;
    ASSERT_TRUE(writePicture(rampPicture(9, 5), folder / "grid.png"));
    EXPECT_EQ(readPlanetPicture(folder / "grid.png")->width, 8);
    ASSERT_TRUE(writePicture(rampPicture(6, 6), folder / "square.png"));
    EXPECT_EQ(readPlanetPicture(folder / "square.png")->rgb, rampPicture(6, 6).rgb);
}

}  // namespace
}  // namespace worldy
