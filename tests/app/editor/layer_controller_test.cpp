#include "app/editor/layer_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>
#include <fstream>

#include "app/data/layer_pictures.h"
#include "app/settings/layer_file.h"
#include "tests/support/temporary_folder.h"
#include "ui/panels/surface/layer_edit.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

fs::path shippedLayers() {
    return fs::path(WORLDY_SOURCE_DIR) / "data" / "layers";
}

void writePng(const fs::path& file, int width, int height, int channels, std::uint8_t value) {
    const auto output = OIIO::ImageOutput::create(file.string());
    const OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    const std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width * height * channels), value);
    if (!output || !output->open(file.string(), spec) ||
        !output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) || !output->close())
        throw std::runtime_error("no picture");
}

TEST(LayerController, ListsShippedSetsFirstAndSavesOnesOwn) {
    const tests::TemporaryFolder folder;
    LayerController controller = openLayers({shippedLayers(), folder.path() / "own"});
    ASSERT_EQ(controller.sets.size(), 2u);
    EXPECT_EQ(controller.sets[0].name, "earth");
    EXPECT_TRUE(controller.sets[1].shipped);
    LayerSettings layers;
    layers.file = (shippedLayers() / "earth.toml").string();
    layers.set.layers.resize(3);
    ASSERT_TRUE(saveAs(controller, "mine", layers));
    ASSERT_EQ(controller.sets.size(), 3u);
    EXPECT_EQ(controller.sets[2].name, "mine");
    EXPECT_EQ(fs::path(layers.file), folder.path() / "own" / "mine.toml");
    EXPECT_TRUE(fs::exists(layerFolderOf(layers.file) / layers.set.layers[1].albedo));
    LayerSettings loaded;
    ASSERT_TRUE(loadInto(controller, layers.file, loaded));
    EXPECT_EQ(loaded.set, layers.set);
    EXPECT_EQ(loaded.file, layers.file);
}

TEST(LayerController, WhatCannotBeReadOrWrittenIsToldAndChangesNothing) {
    const tests::TemporaryFolder folder;
    LayerController controller = openLayers({shippedLayers(), folder.path()});
    LayerSettings layers;
    std::ofstream(folder.path() / "broken.toml") << "[[layer]\n";
    EXPECT_FALSE(loadInto(controller, folder.path() / "broken.toml", layers));
    EXPECT_THAT(controller.setProblem, HasSubstr("broken.toml: line 1"));
    EXPECT_EQ(layers, LayerSettings{});
    EXPECT_FALSE(saveAs(controller, "earth", layers));
    EXPECT_THAT(controller.setProblem, HasSubstr("is built-in"));
    EXPECT_FALSE(saveAs(controller, "a/b", layers));
    EXPECT_EQ(layers, LayerSettings{});
    fs::create_directories(controller.folders.own);
    std::ofstream(controller.folders.own / "flight.toml") << "[[key]]\ntime_s = 0\n";
    EXPECT_FALSE(saveAs(controller, "flight", layers));
    EXPECT_THAT(controller.setProblem, HasSubstr("flight.toml: exists and is not a layer set"));
    EXPECT_EQ(tests::contentOf(controller.folders.own / "flight.toml"), "[[key]]\ntime_s = 0\n");
    ASSERT_TRUE(saveAs(controller, "fine", layers));
    EXPECT_EQ(controller.setProblem, "");
}

TEST(LayerController, TheReadoutFollowsTheLayersWhileThePointerIsAway) {
    LayerController controller;
    controller.under = ui::LayerReadout{{{0, 0, 6.371e6}, 51, 0, 90}, {}};
    LayerSettings layers;
    layers.set = planet::twoLayerHeightBlend();
    EXPECT_NEAR(layersViewOf(controller, nullptr, layers).under->weights[1], 0.2, 1e-12);
    layers.set.layers[1].muted = true;
    EXPECT_EQ(layersViewOf(controller, nullptr, layers).under->weights[1], 0);
    EXPECT_EQ(layersViewOf(controller, nullptr, layers).under->weights[0], 1);
}

TEST(LayerPictures, AreReadEnlargedToTheLargest) {
    const tests::TemporaryFolder folder;
    writePng(folder.path() / "albedo.png", 16, 16, 3, 100);
    writePng(folder.path() / "rough.png", 32, 32, 1, 50);
    const auto texels = readLayerTexels(folder.path(), {"albedo.png", "", "rough.png"});
    ASSERT_TRUE(texels) << texels.error().message;
    EXPECT_EQ(texels->size, 32);
    ASSERT_EQ(texels->picture.albedo.size(), 4u * 32 * 32);
    EXPECT_EQ(texels->picture.albedo[0], 100);
    EXPECT_EQ(texels->picture.albedo[3], 128) << "no alpha: even relief";
    EXPECT_EQ(texels->picture.surface[0], 128);
    EXPECT_EQ(texels->picture.surface[2], 50);
    EXPECT_EQ(enlarged(*texels, 64).picture.surface.size(), 4u * 64 * 64);
}

TEST(LayerPictures, EnlargingGoesAroundTheEdges) {
    LayerTexels texels{8, {std::vector<std::uint8_t>(4 * 64), std::vector<std::uint8_t>(4 * 64)}};
    for (std::size_t y = 0; y < 8; ++y) texels.picture.albedo[4 * 8 * y] = 200;  // the first column
    const LayerTexels large = enlarged(texels, 16);
    EXPECT_EQ(large.picture.albedo[0], 150);
    EXPECT_EQ(large.picture.albedo[4 * 15], 50) << "a quarter of the first column, from beyond the edge";
    EXPECT_EQ(large.picture.albedo[4 * 8], 0);
}

TEST(LayerPictures, WhatIsMissingOrOfAWrongSizeIsNamed) {
    const tests::TemporaryFolder folder;
    writePng(folder.path() / "good.png", 16, 16, 4, 100);
    writePng(folder.path() / "wide.png", 32, 16, 3, 1);
    writePng(folder.path() / "odd.png", 24, 24, 3, 1);
    std::ofstream(folder.path() / "junk.png") << "no picture";
    const auto problemOf = [&](const LayerFiles& files) {
        const auto texels = readLayerTexels(folder.path(), files);
        return texels ? "none" : texels.error().message;
    };
    EXPECT_EQ(problemOf({"good.png", "good.png", "good.png"}), "none");
    EXPECT_THAT(problemOf({"none.png", "", ""}), HasSubstr("none.png: cannot be read"));
    EXPECT_THAT(problemOf({"good.png", "wide.png", ""}),
                HasSubstr("wide.png: is 32 x 16 pixels; expected a square"));
    EXPECT_THAT(problemOf({"odd.png", "", ""}),
                HasSubstr("odd.png: is 24 x 24 pixels; expected a square with a power-of-two side"));
    EXPECT_THAT(problemOf({"good.png", "", "junk.png"}), HasSubstr("junk.png"));
    EXPECT_THAT(problemOf({"", "", ""}), HasSubstr("albedo: is empty"));
}

TEST(LayerEdit, MovesKeepAllLayers) {
    const ui::LayerList earth = planet::earthLayers().layers;
    for (std::size_t from = 0; from < earth.size(); ++from) {
        for (std::size_t to = 0; to < earth.size(); ++to) {
            ui::LayerList layers = earth;
            ui::moveLayer(layers, from, to);
            EXPECT_EQ(layers[to], earth[from]);
            ui::moveLayer(layers, to, from);
            EXPECT_EQ(layers, earth);
        }
    }
}

}  // namespace
}  // namespace worldy
