#include "app/settings/layer_file.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/base/toml_file.h"
#include "app/data/layer_materials.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class LayerFile : public testing::Test {
protected:
    fs::path write(const std::string& text) {
        const fs::path file = folder_.path() / "set.toml";
        std::ofstream(file) << text;
        return file;
    }
    std::string problemOf(const std::string& text) {
        const auto set = loadLayerSet(write(text));
        return set ? "none" : set.error().message;
    }

    tests::TemporaryFolder folder_;
};

fs::path layersFolder() {
    return fs::path(WORLDY_SOURCE_DIR) / "data" / "layers";
}

std::vector<std::uint8_t> bytesOf(const fs::path& file, int& size, int& channels) {
    const auto input = OIIO::ImageInput::open(file.string());
    if (!input) throw std::runtime_error(OIIO::geterror());
    size = input->spec().width;
    channels = input->spec().nchannels;
    OIIO::ImageSpec asIs;
    asIs.attribute("oiio:UnassociatedAlpha", 1);
    input->close();
    OIIO::ImageSpec spec;
    input->open(file.string(), spec, asIs);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size) * static_cast<std::size_t>(size) *
                                    static_cast<std::size_t>(channels));
    input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, bytes.data());
    return bytes;
}

TEST_F(LayerFile, WhatIsSavedIsReadBackTheSame) {
    planet::LayerSet set = planet::earthLayers();
    set.blend = planet::LayerBlend::Weight;
    set.blendDepth = 0.123456789;
    set.layers[2].name = "a \"quoted\" name, and \\ more";
    set.layers[2].tint = {51 / 255.0f, 102 / 255.0f, 1};
    set.layers[3].muted = set.layers[4].solo = true;
    set.layers[5].heightM = {-17.25, 1234.5, 0.1};
    ASSERT_TRUE(saveLayerSet(set, folder_.path(), folder_.path() / "set.toml"));
    const auto read = loadLayerSet(folder_.path() / "set.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, set);
}

TEST_F(LayerFile, ALayerInOneLineIsReadBackTheSame) {
    for (const planet::TextureLayer& layer : planet::earthLayers().layers) {
        const toml::table document = toml::parse("layers = [" + layerLine(layer) + "]");
        const auto read = layersFromToml("test", "layers", *document.get("layers"));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->front(), layer);
    }
}

TEST_F(LayerFile, TheShippedSetsAreTheLibrarysOwn) {
    const auto earth = loadLayerSet(layersFolder() / "earth.toml");
    ASSERT_TRUE(earth) << earth.error().message;
    EXPECT_EQ(*earth, planet::earthLayers());
    const auto two = loadLayerSet(layersFolder() / "two_layer_height_blend.toml");
    ASSERT_TRUE(two) << two.error().message;
    EXPECT_EQ(*two, planet::twoLayerHeightBlend());
}

TEST_F(LayerFile, ContradictoryRangesAreReadSoThatTheyCanBeShown) {
    const auto set = loadLayerSet(write("[[layer]]\nname = \"rock\"\nheight_m = [900, 300, 10]\n"));
    ASSERT_TRUE(set) << set.error().message;
    EXPECT_THAT(planet::layerProblem(set->layers[0]), HasSubstr("heights: [900, 300] m is inverted"));
}

TEST_F(LayerFile, HostileFilesAreToldByLineAndWhatWouldBeRight) {
    EXPECT_THAT(
        problemOf("[[layer]]\nname = \"a\"\nscale_m = 0\n"),
        testing::AllOf(HasSubstr("set.toml: line 3: layer 1: scale_m is 0"), HasSubstr("[0.01, 100000] m")));
    EXPECT_THAT(
        problemOf("[[layer]]\nscale = 3\n"),
        testing::AllOf(HasSubstr("line 2"), HasSubstr("scale is an unknown key"), HasSubstr("scale_m")));
    EXPECT_THAT(problemOf("[[layer]]\nheight_m = [1, 2]\n"), HasSubstr("[lowest, highest, falloff]"));
    EXPECT_THAT(problemOf("[[layer]]\nheight_m = [nan, 2, 3]\n"), HasSubstr("[-20000, 20000] m"));
    EXPECT_THAT(problemOf("[[layer]]\ntint = \"green\"\n"), HasSubstr("#rrggbb"));
    EXPECT_THAT(problemOf("[[layer]]\nmuted = 1\n"), HasSubstr("true or false"));
    EXPECT_THAT(problemOf("blend = \"best\"\n[[layer]]\n"), HasSubstr("\"weight\" or \"height\""));
    EXPECT_THAT(problemOf("blend_depth = -1\n[[layer]]\n"), HasSubstr("[0.05, 2]"));
    EXPECT_THAT(problemOf("layer = 5\n"), HasSubstr("array of tables"));
    EXPECT_THAT(problemOf("layer = [5]\n"), HasSubstr("layer 1 is not a layer"));
    EXPECT_THAT(problemOf("colour = 1\n"), HasSubstr("colour is an unknown key"));
    EXPECT_THAT(problemOf("# nothing\n"), HasSubstr("has no layers"));
    EXPECT_THAT(problemOf("[[layer]\n"), HasSubstr("not TOML"));
    std::string nine;
    for (int i = 0; i < 9; ++i) nine += "[[layer]]\n";
    EXPECT_THAT(problemOf(nine), HasSubstr("layer has 9 layers; expected at most 8"));
    const auto missing = loadLayerSet(folder_.path() / "nowhere.toml");
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message, HasSubstr("nowhere.toml"));
}

TEST_F(LayerFile, ASetSavedElsewhereStillFindsItsTextures) {
    planet::LayerSet set = planet::twoLayerHeightBlend();
    set.layers[1].normal.clear();
    const fs::path inside = layersFolder() / "mine" / "..";
    EXPECT_EQ(movedTo(inside, layersFolder(), set), set);
    const planet::LayerSet moved = movedTo(folder_.path(), layersFolder(), set);
    EXPECT_EQ(fs::path(moved.layers[0].albedo), (layersFolder() / "grass_albedo.png").lexically_normal());
    EXPECT_EQ(moved.layers[1].normal, "");
    EXPECT_EQ(movedTo(layersFolder().parent_path(), layersFolder(), set).layers[0].albedo,
              "layers/grass_albedo.png");
}

TEST_F(LayerFile, TheShippedTexturesAreWhatTheProgramMakes) {
    for (std::size_t m = 0; m < planet::materialNames.size(); ++m) {
        const planet::MaterialMaps made = planet::makeMaterial(
            static_cast<planet::Material>(m), planet::shippedMaterialSize, planet::shippedMaterialSeed);
        const std::string name(planet::materialNames[m]);
        const std::vector<std::pair<std::string, const std::vector<std::uint8_t>*>> files = {
            {"_albedo.png", &made.albedo},
            {"_normal.png", &made.normal},
            {"_roughness.png", &made.roughness}};
        for (const auto& [ending, bytes] : files) {
            int size = 0, channels = 0;
            const std::vector<std::uint8_t> there = bytesOf(layersFolder() / (name + ending), size, channels);
            ASSERT_EQ(there.size(), bytes->size());
            // Another compiler's last bit may round a texel the other way.
            std::size_t different = 0;
            for (std::size_t i = 0; i < there.size(); ++i) different += there[i] != (*bytes)[i] ? 1 : 0;
            EXPECT_LE(different, there.size() / 10000) << name << ending;
        }
    }
}

TEST_F(LayerFile, MakeLayersWritesWhatTheSetsName) {
    ASSERT_TRUE(makeLayers({folder_.path() / "made", 16, 3}));
    for (const char* name : {"earth.toml", "two_layer_height_blend.toml"}) {
        const auto set = loadLayerSet(folder_.path() / "made" / name);
        ASSERT_TRUE(set) << set.error().message;
        for (const planet::TextureLayer& layer : set->layers) {
            for (const std::string& texture : {layer.albedo, layer.normal, layer.roughness})
                EXPECT_TRUE(fs::exists(folder_.path() / "made" / texture)) << texture;
        }
    }
    std::ofstream(folder_.path() / "file") << "x";
    const auto refused = makeLayers({folder_.path() / "file", 16, 3});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("file"));
}

}  // namespace
}  // namespace worldy
