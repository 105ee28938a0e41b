#include "app/data/write_check.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <fstream>
#include <string>

#include "app/base/picture_file.h"
#include "app/settings/layer_file.h"
#include "planet/bake/bake.h"
#include "planet/source/height_source.h"
#include "planet/surface/layer_set.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using planet::Result;
using testing::HasSubstr;
using tests::TemporaryFolder;

fs::path written(const fs::path& file, std::string_view text) {
    std::ofstream(file, std::ios::binary) << text;
    return file;
}

std::string refusal(const Result<void>& result) {
    return result ? "" : result.error().message;
}

TEST(WriteCheck, outputThatIsAnInputIsRefusedUnderAnyOfItsNames) {
    const TemporaryFolder folder;
    const fs::path input = written(folder / "input.tif", "II*");
    fs::create_symlink("input.tif", folder / "symbolic.tif");
    fs::create_symlink(folder.path(), folder / "here");
    fs::create_hard_link(input, folder / "hard.tif");
    for (const fs::path& output : {input, folder / "symbolic.tif", folder / "hard.tif",
                                   folder / "here/input.tif", folder / "here/./input.tif"}) {
        const CommandFiles files{{input}, {{output, OutputKind::ChunkFile}}};
        for (const bool overwrite : {false, true}) {
            const Result<void> checked = checkOutputs(files, overwrite);
            ASSERT_FALSE(checked) << output;
            EXPECT_EQ(checked.error().kind, planet::ErrorKind::BadInput);
            EXPECT_THAT(checked.error().message, HasSubstr(output.string() + ": is "));
            EXPECT_THAT(checked.error().message, HasSubstr("is an input of this command"));
        }
    }
}

TEST(WriteCheck, linkInAnInputsNameIsSeenThroughToo) {
    const TemporaryFolder folder;
    written(folder / "file.json", "{}");
    fs::create_symlink("file.json", folder / "link.json");
    EXPECT_FALSE(checkOutputs({{folder / "link.json"}, {{folder / "file.json", OutputKind::Json}}}, true));
}

TEST(WriteCheck, folderAmongTheInputsStandsForItsFiles) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "shaders/deep");
    written(folder / "shaders/deep/sky.frag", "void main() {}");
    EXPECT_FALSE(checkOutputs(
        {{folder / "shaders"}, {{folder / "shaders/deep/sky.frag", OutputKind::Picture}}}, true));
    EXPECT_TRUE(
        checkOutputs({{folder / "shaders"}, {{folder / "shaders/new.png", OutputKind::Picture}}}, false));
}

TEST(WriteCheck, twoOutputsOfOneNameAreRefused) {
    const TemporaryFolder folder;
    fs::create_symlink("a", folder / "link");
    EXPECT_THAT(refusal(checkOutputs(
                    {{}, {{folder / "a", OutputKind::Csv}, {folder / "link", OutputKind::Json}}}, true)),
                HasSubstr("is the name of two outputs"));
    EXPECT_TRUE(checkOutputs({{}, {{"", OutputKind::Csv}, {"", OutputKind::Json}}}, false));
}

TEST(WriteCheck, sourceStandsForAllItsFilesAndTheColoursBesideThem) {
    const TemporaryFolder folder;
    for (const char* face : {"x_pos", "x_neg", "y_pos", "y_neg", "z_pos", "z_neg"})
        written(folder / ("faces2_" + std::string(face) + ".raw"), "1234");
    written(folder / "colour.jpg", "\xff\xd8\xff");
    for (const char* source : {"faces2", "faces2_y_neg.raw"}) {
        CommandFiles files;
        addSource(files, folder / source);
        for (const char* output : {"faces2_x_pos.raw", "faces2_z_neg.raw", "colour.jpg"}) {
            files.outputs = {{folder / output, OutputKind::ChunkFile}};
            EXPECT_FALSE(checkOutputs(files, true)) << source << " into " << output;
        }
    }
    CommandFiles detail;
    addSource(detail, "detail:seed=2,of=" + (folder / "faces2").string());
    detail.outputs = {{folder / "faces2_x_neg.raw", OutputKind::ChunkFile}};
    EXPECT_FALSE(checkOutputs(detail, true));
    CommandFiles chunks;
    addChunkFile(chunks, folder / "planet.chk");
    chunks.outputs = {{folder / "colour.jpg", OutputKind::Picture}};
    EXPECT_FALSE(checkOutputs(chunks, true));
}

TEST(WriteCheck, fileOfAnotherKindIsReplacedOnlyWhenAskedFor) {
    const TemporaryFolder folder;
    const fs::path file = folder / "file.png";
    const auto refused = [&](OutputKind kind) {
        EXPECT_TRUE(checkOutputs({{}, {{file, kind}}}, true));
        return !checkOutputs({{}, {{file, kind}}}, false);
    };
    for (const std::string_view other :
         {"II*", "# flight, of keys\nname = \"x\"\n", "[[key]]\ntime_s = 0\n", "text\n"}) {
        written(file, other);
        for (const OutputKind kind :
             {OutputKind::ChunkFile, OutputKind::Json, OutputKind::Csv, OutputKind::Picture,
              OutputKind::PngImage, OutputKind::LayerSet, OutputKind::ItemMap})
            EXPECT_TRUE(refused(kind)) << other << " as " << static_cast<int>(kind);
    }
    EXPECT_THAT(refusal(checkOutputs({{}, {{file, OutputKind::Json}}}, false)),
                HasSubstr("file.png: exists and is not a JSON report of Worldy; expected another name, or "
                          "--overwrite to replace it"));
}

void writeImage(const fs::path& file, OIIO::TypeDesc type, const char* geoTag = nullptr) {
    const auto output = OIIO::ImageOutput::create(file.string());
    OIIO::ImageSpec spec(2, 2, 3, type);
    if (geoTag) spec.attribute(geoTag, "1");
    const std::vector<float> pixels(12);
    ASSERT_TRUE(output && output->open(file.string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && output->close());
}

TEST(WriteCheck, filesThatOnlyResembleOwnOnesAreKept) {
    const TemporaryFolder folder;
    const auto refused = [](const fs::path& file, OutputKind kind) {
        return !checkOutputs({{}, {{file, kind}}}, false);
    };
    EXPECT_TRUE(
        refused(written(folder / "a.geojson", "{\"type\": \"FeatureCollection\"}"), OutputKind::Json));
    EXPECT_TRUE(
        refused(written(folder / "b.json", "{\"type\": 1, \"schema_version\": 1}"), OutputKind::Json));
    EXPECT_TRUE(refused(written(folder / "note.csv", "place,height\nhere,3\n"), OutputKind::Csv));
    writeImage(folder / "deep.png", OIIO::TypeDesc::UINT16);
    EXPECT_TRUE(refused(folder / "deep.png", OutputKind::Picture));
    writeImage(folder / "deep.tif", OIIO::TypeDesc::FLOAT);
    EXPECT_TRUE(refused(folder / "deep.tif", OutputKind::Picture));
    writeImage(folder / "map.tif", OIIO::TypeDesc::UINT8);
    EXPECT_FALSE(refused(folder / "map.tif", OutputKind::Picture));
    TIFF* const tiff = TIFFOpen((folder / "map.tif").c_str(), "r+");
    ASSERT_TRUE(tiff);
    const TIFFFieldInfo noData = {42113, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("nodata")};
    TIFFMergeFieldInfo(tiff, &noData, 1);
    TIFFSetField(tiff, 42113, "0");
    TIFFRewriteDirectory(tiff);
    TIFFClose(tiff);
    EXPECT_TRUE(refused(folder / "map.tif", OutputKind::Picture));
}

TEST(WriteCheck, placesThatCannotBeWrittenAreToldBeforeTheWork) {
    const TemporaryFolder folder;
    fs::create_symlink("loop", folder / "loop");
    fs::create_symlink("nowhere", folder / "dangling");
    const auto told = [](const OutputFile& output) { return refusal(checkOutputs({{}, {output}}, true)); };
    EXPECT_THAT(told({folder / "nodir/x.json"}), HasSubstr("nodir/x.json: cannot be written: "));
    EXPECT_THAT(told({folder / "loop"}), HasSubstr("loop: cannot be written: "));
    EXPECT_THAT(told({folder.path()}), HasSubstr("is a folder or a device"));
    EXPECT_THAT(told({folder / "x.xyz", OutputKind::Picture}),
                HasSubstr("x.xyz: the extension names no picture format; expected"));
    EXPECT_EQ(told({folder / "made/deep/x.png", OutputKind::Picture, true}), "");
    EXPECT_THAT(told({folder / "dangling/x.png", OutputKind::Picture, true}),
                HasSubstr("dangling is a link to a folder that does not exist"));
}

TEST(WriteCheck, colourImageOfTheSourceOfAChunkFileIsAnInput) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "src");
    written(folder / "src/colour.jpg", "\xff\xd8\xff");
    written(folder / "src/n.pgm", "P5\n64 32\n255\n" + std::string(64 * 32, 'h'));
    const auto source = planet::openHeightSource("detail:seed=2,of=" + (folder / "src/n.pgm").string(), {});
    ASSERT_TRUE(source) << source.error().message;
    ASSERT_TRUE(planet::bake(*source, planet::BakeSettings{.faceSize = 65}, folder / "d.chk"));
    for (const bool window : {false, true}) {
        CommandFiles files;
        if (window)
            addSource(files, folder / "d.chk");
        else
            addChunkFile(files, folder / "d.chk");
        files.outputs = {{folder / "src/colour.jpg", OutputKind::Picture}};
        EXPECT_THAT(refusal(checkOutputs(files, true)), HasSubstr("colour.jpg: is an input of this command"));
    }
}

TEST(WriteCheck, ownKindIsReplacedWithoutAWord) {
    const TemporaryFolder folder;
    const auto passes = [&](const fs::path& file, OutputKind kind) {
        return refusal(checkOutputs({{}, {{file, kind}}}, false));
    };
    EXPECT_EQ(passes(folder / "new", OutputKind::Json), "");
    EXPECT_EQ(passes(written(folder / "empty", ""), OutputKind::ChunkFile), "");
    EXPECT_EQ(passes(written(folder / "a.chk", "WORLDYCH and more"), OutputKind::ChunkFile), "");
    EXPECT_EQ(passes(written(folder / "a.json", "{\n \"schema_version\": 1}"), OutputKind::Json), "");
    EXPECT_EQ(
        passes(written(folder / "a.csv", "schema_version,metric,tau_px\n1,additive,2\n"), OutputKind::Csv),
        "");
    EXPECT_EQ(passes(written(folder / "map", "counter/frames\t3\n"), OutputKind::ItemMap), "");
    const Picture picture{2, 2, std::vector<std::uint8_t>(12)};
    for (const char* name : {"a.png", "a.jpg", "a.tif"}) {
        ASSERT_TRUE(writePicture(picture, folder / name));
        EXPECT_EQ(passes(folder / name, OutputKind::Picture), "");
    }
    EXPECT_EQ(passes(folder / "a.png", OutputKind::PngImage), "");
    EXPECT_NE(passes(folder / "a.jpg", OutputKind::PngImage), "");
    ASSERT_TRUE(saveLayerSet(planet::earthLayers(), folder.path(), folder / "set.toml"));
    EXPECT_EQ(passes(folder / "set.toml", OutputKind::LayerSet), "");
    EXPECT_EQ(passes(written(folder / "own.toml", "[lod]\ntau_px = 3\n"), OutputKind::Preset), "");
    EXPECT_NE(passes(written(folder / "flight.toml", "[[key]]\ntime_s = 3\n"), OutputKind::Preset), "");
}

}  // namespace
}  // namespace worldy
