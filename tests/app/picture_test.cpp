#include "app/picture.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include "tests/temporary_folder.h"

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

}  // namespace
}  // namespace worldy
