#include "app/bake_job.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "planet/chunk_file.h"
#include "tests/temporary_folder.h"

namespace worldy {

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

planet::Result<planet::BakeReport> waitFor(BakeJob& job) {
    for (;;) {
        if (auto result = job.takeResult()) return *result;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

std::size_t fileCount(const fs::path& folder) {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
}

TEST(BakeJob, LeavesAChunkFileAndReportsOnce) {
    const TemporaryFolder folder;
    BakeJob job(writeImage(folder), {.faceSize = 65, .chunkSize = 17}, folder.path() / "slope.chk");
    const planet::Result<planet::BakeReport> report = waitFor(job);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(planet::ChunkFile::open(folder.path() / "slope.chk"));
    EXPECT_EQ(job.progress().samplesDone, job.progress().samplesTotal);
    EXPECT_FALSE(job.takeResult());
}

TEST(BakeJob, CancelledEndsWithoutAFile) {
    const TemporaryFolder folder;
    BakeJob job(writeImage(folder), {.faceSize = 16385, .chunkSize = 17}, folder.path() / "slope.chk");
    job.cancel();
    EXPECT_TRUE(job.cancelling());
    const planet::Result<planet::BakeReport> report = waitFor(job);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, planet::ErrorKind::Cancelled);
    EXPECT_EQ(fileCount(folder.path()), 1u);
}

TEST(BakeJob, GoingOutOfScopeCancels) {
    const TemporaryFolder folder;
    const fs::path image = writeImage(folder);
    { const BakeJob job(image, {.faceSize = 16385, .chunkSize = 17}, folder.path() / "slope.chk"); }
    EXPECT_EQ(fileCount(folder.path()), 1u);
}

TEST(BakeJob, ABadSourceIsAnError) {
    const TemporaryFolder folder;
    BakeJob job("/nonexistent/slope.tif", {}, folder.path() / "slope.chk");
    const planet::Result<planet::BakeReport> report = waitFor(job);
    ASSERT_FALSE(report);
    EXPECT_NE(report.error().message.find("/nonexistent/slope.tif"), std::string::npos);
}

}  // namespace
}  // namespace worldy
