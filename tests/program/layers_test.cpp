// Texture layers through the whole program: sets, textures that are missing, pictures' notes.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/program/run_program.h"
#include "tests/program/small_planet.h"

namespace worldy {
namespace {

using testing::HasSubstr;

std::vector<std::uint8_t> pixelsOf(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) throw std::runtime_error("no picture");
    std::vector<std::uint8_t> pixels(static_cast<std::size_t>(input->spec().width) *
                                     static_cast<std::size_t>(input->spec().height) * 3);
    input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data());
    return pixels;
}

double magentaShare(const std::vector<std::uint8_t>& pixels) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < pixels.size(); i += 3)
        count += pixels[i] > 200 && pixels[i + 1] < 60 && pixels[i + 2] > 200 ? 1 : 0;
    return 3.0 * static_cast<double>(count) / static_cast<double>(pixels.size());
}

class LayersProgram : public testing::Test {
protected:
    void SetUp() override {
        bakePlanet(folder_);
        ASSERT_EQ(runWorldy(folder_, "make-layers -o layers --texels 16").exitCode, 0);
    }

    Ran shot(const std::string& name, const std::string& more) {
        return runWorldy(folder_, "shot planet.chk -o " + name +
                                      " --size 160x120 --samples 1 --camera=10,20,9000,0,-60 "
                                      "--set surface.lighting=false --set surface.layer_colour_below=0 --set "
                                      "surface.layer_begin_m=30000 " +
                                      more);
    }
    std::vector<std::uint8_t> pixels(const std::string& name) { return pixelsOf(folder_.path() / name); }

    const std::string on_ = "--set surface.layer_use=on --layers layers/earth.toml ";
    TemporaryFolder folder_;
};

TEST_F(LayersProgram, AShotShowsThemAndItsNoteShowsThemAgain) {
    ASSERT_EQ(shot("off.png", "--set surface.layer_use=off").exitCode, 0);
    const Ran on = shot("on.png", on_);
    ASSERT_EQ(on.exitCode, 0) << on.errors;
    EXPECT_EQ(on.errors, "");
    EXPECT_NE(pixels("off.png"), pixels("on.png"));
    EXPECT_LT(magentaShare(pixels("on.png")), 0.001);
    const Ran again =
        runWorldy(folder_,
                  "shot planet.chk -o again.png --size 160x120 --samples 1 --camera=10,20,9000,0,-60 "
                  "--settings on.png");
    ASSERT_EQ(again.exitCode, 0) << again.errors;
    EXPECT_EQ(pixels("on.png"), pixels("again.png"));
}

TEST_F(LayersProgram, ALayerInASettingIsDrawnAsItSays) {
    const std::string layer =
        "--set 'surface.layers=[{ name = \"all\", albedo = \"sand_albedo.png\", tint = \"#ff0000\" }]' ";
    const Ran red = shot("red.png", on_ + layer);
    ASSERT_EQ(red.exitCode, 0) << red.errors;
    const std::vector<std::uint8_t> seen = pixels("red.png");
    const std::size_t middle = 3 * (60 * 160 + 80);
    EXPECT_GT(seen[middle], 60);
    EXPECT_EQ(seen[middle + 1], 0);
}

TEST_F(LayersProgram, AMissingTextureIsNamedAndLoudAndTheRestGoesOn) {
    std::filesystem::remove(folder_.path() / "layers" / "rock_normal.png");
    const Ran ran = shot("missing.png", on_ + "--set surface.sea=false");
    EXPECT_EQ(ran.exitCode, 0);
    EXPECT_THAT(ran.errors, HasSubstr("Layer 2 \"rock\": "));
    EXPECT_THAT(ran.errors, HasSubstr("rock_normal.png: cannot be read"));
    EXPECT_EQ(std::count(ran.errors.begin(), ran.errors.end(), '\n'), 1) << ran.errors;
    const Ran solo =
        shot("solo.png", on_ +
                             "--set 'surface.layers=[{ name = \"rock\", albedo = \"rock_albedo.png\", "
                             "normal = \"rock_normal.png\", scale_m = 4000 }]'");
    EXPECT_EQ(solo.exitCode, 0);
    EXPECT_GT(magentaShare(pixels("solo.png")), 0.2);
}

TEST_F(LayersProgram, AContradictoryRangeIsNamedAndLoud) {
    const Ran ran =
        shot("range.png", on_ +
                              "--set 'surface.layers=[{ name = \"rock\", albedo = \"rock_albedo.png\", "
                              "scale_m = 4000, height_m = [900, 300, 10] }]'");
    EXPECT_EQ(ran.exitCode, 0);
    EXPECT_THAT(ran.errors, HasSubstr("\"rock\": heights: [900, 300] m is inverted"));
    EXPECT_GT(magentaShare(pixels("range.png")), 0.2);
}

}  // namespace
}  // namespace worldy
