#include "app/data/bake_job.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "planet/format/chunk_file.h"
#include "tests/support/grey_faces.h"
#include "tests/support/job_result.h"
#include "tests/support/temporary_folder.h"

namespace worldy {

using tests::fileCountIn;
using tests::TemporaryFolder;
namespace {

namespace fs = std::filesystem;

fs::path writeImage(const TemporaryFolder& folder) {
    const fs::path file = folder.path() / "slope.pgm";
    std::ofstream stream(file, std::ios::binary);
    stream << "P5\n64 32\n255\n";
    for (int i = 0; i < 64 * 32; ++i) stream.put(static_cast<char>(i % 64 < 32 ? i % 64 : 63 - i % 64));
    return file;
}

TEST(BakeJob, LeavesAChunkFileAndReportsOnce) {
    const TemporaryFolder folder;
    BakeJob job({.source = writeImage(folder),
                 .settings = {.faceSize = 65, .chunkSize = 17},
                 .output = folder.path() / "slope.chk"});
    const planet::Result<planet::BakeReport> report = tests::resultOf(job);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(planet::ChunkFile::open(folder.path() / "slope.chk"));
    EXPECT_EQ(job.progress().bake.samplesDone, job.progress().bake.samplesTotal);
    EXPECT_FALSE(job.takeResult());
}

TEST(BakeJob, CancelledEndsWithoutAFile) {
    const TemporaryFolder folder;
    BakeJob job({.source = writeImage(folder),
                 .settings = {.faceSize = 16385, .chunkSize = 17},
                 .output = folder.path() / "slope.chk"});
    job.cancel();
    EXPECT_TRUE(job.cancelling());
    const planet::Result<planet::BakeReport> report = tests::resultOf(job);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_EQ(fileCountIn(folder.path()), 1u);
}

TEST(BakeJob, GoingOutOfScopeCancels) {
    const TemporaryFolder folder;
    const fs::path image = writeImage(folder);
    {
        const BakeJob job({.source = image,
                           .settings = {.faceSize = 16385, .chunkSize = 17},
                           .output = folder.path() / "slope.chk"});
    }
    EXPECT_EQ(fileCountIn(folder.path()), 1u);
}

BakeTask withFirstLook(const TemporaryFolder& folder, int faceSize) {
    return {.source = writeImage(folder),
            .settings = {.faceSize = faceSize, .chunkSize = 17},
            .output = folder.path() / "slope.chk",
            .firstLook = FirstLook{.settings = {.faceSize = 65, .chunkSize = 17},
                                   .output = folder.path() / "first.chk"}};
}

TEST(BakeJob, FirstLookIsThereBeforeTheWholeBake) {
    const TemporaryFolder folder;
    BakeJob job(withFirstLook(folder, 16385));
    while (!job.takeFirstLook()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ASSERT_FALSE(job.takeResult());
    }
    const auto first = planet::ChunkFile::open(folder.path() / "first.chk");
    ASSERT_TRUE(first);
    EXPECT_EQ(planet::faceCells(first->info().shape), 64);
    EXPECT_FALSE(job.takeFirstLook());
    job.cancel();
    EXPECT_FALSE(tests::resultOf(job));
    EXPECT_FALSE(fs::exists(folder.path() / "slope.chk"));
}

TEST(BakeJob, SmallFacesHaveNoFirstLook) {
    const TemporaryFolder folder;
    BakeJob job(withFirstLook(folder, 129));
    EXPECT_TRUE(tests::resultOf(job));
    EXPECT_FALSE(job.takeFirstLook());
    EXPECT_FALSE(fs::exists(folder.path() / "first.chk"));
}

TEST(BakeJob, SourceThatIsOpenIsNotReadAgain) {
    const TemporaryFolder folder;
    const fs::path image = writeImage(folder);
    const auto heights = planet::openHeightSource(image, {});
    ASSERT_TRUE(heights);
    BakeJob job({.source = folder.path() / "renamed.pgm",
                 .settings = {.faceSize = 65, .chunkSize = 17},
                 .output = folder.path() / "slope.chk",
                 .opened = *heights});
    EXPECT_TRUE(tests::resultOf(job));
}

void writeColourImage(const fs::path& file) {
    std::ofstream stream(file, std::ios::binary);
    stream << "P6\n16 8\n255\n";
    for (int i = 0; i < 16 * 8 * 3; ++i) stream.put(static_cast<char>(i % 200));
}

TEST(BakeJob, ReportsFacesOfColoursThatDifferAlongTheirEdges) {
    const TemporaryFolder folder;
    writeGreyFaces(folder);
    BakeJob job({.source = writeImage(folder),
                 .settings = {.faceSize = 65, .chunkSize = 17},
                 .output = folder.path() / "slope.chk",
                 .colour = {folder.path() / "grey", true}});
    const planet::Result<planet::BakeReport> report = tests::resultOf(job);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->colourNotice.starts_with("grey: the colours of faces ")) << report->colourNotice;
    EXPECT_EQ(job.colourProblem(), "");
}

TEST(BakeJob, LeavesAChunkFileWithColours) {
    const TemporaryFolder folder;
    writeColourImage(folder.path() / "map.ppm");
    BakeJob job({.source = writeImage(folder),
                 .settings = {.faceSize = 65, .chunkSize = 17},
                 .output = folder.path() / "slope.chk",
                 .colour = {folder.path() / "map.ppm"}});
    const planet::Result<planet::BakeReport> report = tests::resultOf(job);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->colourTiles, 6u);
    EXPECT_EQ(job.colourProblem(), "");
    EXPECT_EQ(report->colourNotice, "");
    EXPECT_EQ(job.progress().bake.samplesTotal, 6u * 64 * 64 + 6u * 256 * 256);
    EXPECT_EQ(job.progress().bake.samplesDone, job.progress().bake.samplesTotal);
    const auto file = planet::ChunkFile::open(folder.path() / "slope.chk");
    ASSERT_TRUE(file);
    EXPECT_TRUE(file->info().colour);
}

TEST(BakeJob, AnImageThatMustBeThereIsAnErrorAndOneThatMayFailIsToldAndLeftOut) {
    const TemporaryFolder folder;
    const fs::path source = writeImage(folder);
    const fs::path broken = folder.path() / "map.ppm";
    std::ofstream(broken, std::ios::binary) << "P6\n16 8\n255\ntoo short";
    const fs::path noImage = folder.path() / "note.png";
    std::ofstream(noImage) << "no image";
    const fs::path output = folder.path() / "slope.chk";
    for (const fs::path& image : {broken, noImage}) {
        BakeJob strict({.source = source,
                        .settings = {.faceSize = 65, .chunkSize = 17},
                        .output = output,
                        .colour = {image}});
        const planet::Result<planet::BakeReport> refused = tests::resultOf(strict);
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().message.find(image.string()), std::string::npos) << refused.error().message;
        EXPECT_EQ(fileCountIn(folder.path()), 3u);
        BakeJob lenient({.source = source,
                         .settings = {.faceSize = 65, .chunkSize = 17},
                         .output = output,
                         .colour = {image, true}});
        const planet::Result<planet::BakeReport> baked = tests::resultOf(lenient);
        ASSERT_TRUE(baked) << baked.error().message;
        EXPECT_EQ(baked->colourTiles, 0u);
        EXPECT_NE(lenient.colourProblem().find(image.string()), std::string::npos);
        fs::remove(output);
    }
    // What is wrong with the heights' settings is not taken for the image's.
    BakeJob bad({.source = source,
                 .settings = {.faceSize = 66, .chunkSize = 17},
                 .output = output,
                 .colour = {broken, true}});
    ASSERT_FALSE(tests::resultOf(bad));
    EXPECT_EQ(bad.colourProblem(), "");
}

TEST(BakeJob, CancelledAmongColoursItEndsWithoutAFile) {
    const TemporaryFolder folder;
    writeColourImage(folder.path() / "map.ppm");
    BakeJob job({.source = writeImage(folder),
                 .settings = {.faceSize = 65, .chunkSize = 17, .colour = {.faceSize = 16385}},
                 .output = folder.path() / "slope.chk",
                 .colour = {folder.path() / "map.ppm", true}});
    while (job.progress().bake.samplesDone < 6u * 64 * 64 + 1) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        ASSERT_FALSE(job.takeResult());
    }
    job.cancel();
    const planet::Result<planet::BakeReport> report = tests::resultOf(job);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_EQ(fileCountIn(folder.path()), 2u);
}

TEST(BakeJob, ABadSourceIsAnError) {
    const TemporaryFolder folder;
    BakeJob job({.source = "/nonexistent/slope.tif", .output = folder.path() / "slope.chk"});
    const planet::Result<planet::BakeReport> report = tests::resultOf(job);
    ASSERT_FALSE(report);
    EXPECT_NE(report.error().message.find("/nonexistent/slope.tif"), std::string::npos);
}

}  // namespace
}  // namespace worldy
