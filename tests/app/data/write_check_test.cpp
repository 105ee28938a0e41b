#include "app/data/write_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "app/base/picture.h"
#include "app/settings/layer_file.h"
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
                HasSubstr("file.png: exists and is not a JSON report; expected another name, or "
                          "--overwrite to replace it"));
}

TEST(WriteCheck, ownKindIsReplacedWithoutAWord) {
    const TemporaryFolder folder;
    const auto passes = [&](const fs::path& file, OutputKind kind) {
        return refusal(checkOutputs({{}, {{file, kind}}}, false));
    };
    EXPECT_EQ(passes(folder / "new", OutputKind::Json), "");
    EXPECT_EQ(passes(written(folder / "empty", ""), OutputKind::ChunkFile), "");
    EXPECT_EQ(passes(written(folder / "a.chk", "WORLDYCH and more"), OutputKind::ChunkFile), "");
    EXPECT_EQ(passes(written(folder / "a.json", "{\n \"file\": 1}"), OutputKind::Json), "");
    EXPECT_EQ(passes(written(folder / "a.csv", "metric,tau_px\nadditive,2\n"), OutputKind::Csv), "");
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
