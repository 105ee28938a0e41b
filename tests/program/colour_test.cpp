// Streamed colours through the whole program: a file that is damaged among them, or lies about them.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "planet/format/chunk_file.h"
#include "planet/format/chunk_file_format.h"
#include "tests/program/small_planet.h"
#include "tests/program/window/editor_window.h"
#include "tests/support/grey_faces.h"

namespace worldy {
namespace {

using testing::HasSubstr;

// Green land without a trace of red or blue, so that a magenta checker is told from it.
void writeMap(const TemporaryFolder& folder) {
    std::ofstream stream(folder.path() / "map.ppm", std::ios::binary);
    stream << "P6\n256 128\n255\n";
    for (int i = 0; i < 256 * 128; ++i) {
        stream.put(0);
        stream.put(static_cast<char>(120 + i % 7 * 8));
        stream.put(0);
    }
}

struct Shares {
    double green = 0;
    double magenta = 0;
};
Shares sharesOf(const std::filesystem::path& file) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) throw std::runtime_error("no picture");
    const auto count =
        static_cast<std::size_t>(input->spec().width) * static_cast<std::size_t>(input->spec().height);
    std::vector<std::uint8_t> pixels(3 * count);
    input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data());
    Shares shares;
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
        const bool green = pixels[i + 1] > 60 && pixels[i] < pixels[i + 1] / 2;
        const bool magenta = pixels[i] > 100 && pixels[i + 2] > 100 && pixels[i + 1] < pixels[i] / 2;
        shares.green += green ? 1.0 / static_cast<double>(count) : 0;
        shares.magenta += magenta ? 1.0 / static_cast<double>(count) : 0;
    }
    return shares;
}

TEST(ColourFaces, ThatDifferAlongTheirEdgesGiveAWarningOfTheBake) {
    const TemporaryFolder folder;
    writeHills(folder);
    writeGreyFaces(folder);
    const std::string bake = "bake hills.pgm -o planet.chk --chunk-size 17 --face-size 33 ";
    const Ran warned = runWorldy(folder, bake + "--colour grey --json");
    EXPECT_EQ(warned.exitCode, 0) << warned.errors;
    EXPECT_THAT(warned.errors, HasSubstr("worldy: grey: the colours of faces "));
    const std::string notice = nlohmann::json::parse(warned.output)["colour_notice"];
    EXPECT_THAT(warned.errors, HasSubstr(notice));
    writeMap(folder);
    const Ran whole = runWorldy(folder, bake + "--colour map.ppm --json");
    EXPECT_EQ(whole.exitCode, 0) << whole.errors;
    EXPECT_EQ(nlohmann::json::parse(whole.output)["colour_notice"], "");
}

class ColourProgram : public testing::Test {
protected:
    void SetUp() override {
        writeHills(folder_);
        writeMap(folder_);
        const Ran baked = runWorldy(folder_,
                                    "bake hills.pgm -o planet.chk --chunk-size 17 --radius 100000 "
                                    "--colour map.ppm --colour-face-size 513");
        ASSERT_EQ(baked.exitCode, 0) << baked.errors;
    }

    // Bytes of the block that holds the children of the +x face's root tile.
    void damageChildren() {
        const planet::ChunkFile file = planet::ChunkFile::open(planetFile()).value();
        const planet::TileData root = file.readColourRoot(planet::Face::PosX).value();
        std::fstream stream(planetFile(), std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(static_cast<std::streamoff>(root.children.offset + 200));
        for (int i = 0; i < 4; ++i) stream.put('\x5A');
    }

    Ran shot(const std::string& name) {
        return runWorldy(folder_, "shot planet.chk -o " + name +
                                      " --size 160x120 --samples 1 --camera=10,20,20000,0,-88 --set "
                                      "surface.lighting=false --set surface.sea=false --set "
                                      "surface.atmosphere=false");
    }
    std::filesystem::path planetFile() const { return folder_.path() / "planet.chk"; }

    const TemporaryFolder folder_;
};

TEST_F(ColourProgram, ADamagedBlockIsALoudCheckerAndIsNamedAndTheRestGoesOn) {
    const Ran whole = shot("whole.png");
    ASSERT_EQ(whole.exitCode, 0) << whole.errors;
    EXPECT_EQ(whole.errors, "");
    EXPECT_GT(sharesOf(folder_.path() / "whole.png").green, 0.9);

    damageChildren();
    const Ran damaged = shot("damaged.png");
    EXPECT_EQ(damaged.exitCode, 0);
    EXPECT_THAT(
        damaged.errors,
        HasSubstr("planet.chk: the block of colour tile x_pos/0/0/0 is damaged: its checksum does not "
                  "match"));
    EXPECT_EQ(std::count(damaged.errors.begin(), damaged.errors.end(), '\n'), 1) << damaged.errors;
    EXPECT_GT(sharesOf(folder_.path() / "damaged.png").magenta, 0.3);
    // Another face's are as they were.
    const Ran other =
        runWorldy(folder_,
                  "shot planet.chk -o other.png --size 160x120 --samples 1 "
                  "--camera=10,110,20000,0,-88 --set surface.lighting=false --set surface.sea=false "
                  "--set surface.atmosphere=false");
    EXPECT_EQ(other.errors, "");
    EXPECT_GT(sharesOf(folder_.path() / "other.png").green, 0.9);
    const Ran verified = runWorldy(folder_, "verify planet.chk");
    EXPECT_EQ(verified.exitCode, 1);
    EXPECT_THAT(verified.output + verified.errors, HasSubstr("colour tile x_pos/0/0/0 is damaged"));
}

TEST_F(ColourProgram, AHeaderThatLiesAboutColoursIsRefusedWithWhatIsWrong) {
    planet::ChunkFileInfo info = planet::ChunkFile::open(planetFile())->info();
    info.colour->roots[1] = info.colour->roots[0];
    const auto header = planet::headerBytes(info, std::filesystem::file_size(planetFile()));
    std::fstream stream(planetFile(), std::ios::in | std::ios::out | std::ios::binary);
    stream.write(reinterpret_cast<const char*>(header.data()), static_cast<std::streamsize>(header.size()));
    stream.close();
    for (const std::string& command :
         {std::string("info planet.chk"), std::string("verify planet.chk"),
          std::string("shot planet.chk -o never.png"), std::string("planet.chk")}) {
        const Ran ran = runWorldy(folder_, command);
        EXPECT_EQ(ran.exitCode, 2) << command;
        EXPECT_THAT(ran.errors, HasSubstr("planet.chk: invalid header: root blocks of colour tile "
                                          "x_pos/0/0/0 and colour tile x_neg/0/0/0 overlap"));
    }
}

TEST_F(ColourProgram, TheWindowDrawsACheckerWhereABlockIsDamagedAndGoesOn) {
    if (!canOpenWindows()) GTEST_SKIP() << "needs Xvfb, xdotool and ImageMagick";
    damageChildren();
    writeWindowSettings(folder_,
                        "[window]\nbottom_height = 400\n[camera]\nlatitude_deg = 10\nlongitude_deg = "
                        "20\naltitude_m = 20000\npitch_deg = -88\n");
    const Ran ran = runInWindow(folder_, "planet.chk", R"sh(
expect says 'planet.chk: the block of colour tile x_pos/0/0/0 is damaged'
expect counts failed_colours -eq 1; expect counts colour_tiles -gt 6
broken=$(viewport)
click "paging/Retry failed"; expect times_said 'colour tile x_pos/0/0/0 is damaged' 2
settle; same "$broken" || echo "tried again it looks different"
counts drawn -gt 0 || echo "nothing is drawn any more"
for kind in colours heights "heights, colours"; do choose paging/Kind "$kind" || echo "no $kind"; done
)sh");
    expectQuiet(ran);
}

}  // namespace
}  // namespace worldy
