// Bakes that a command line of the user's starts. Scripts stand in for mpirun and for the program that it starts.
#include "app/data/launched_bake.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace worldy {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using ::tests::TemporaryFolder;

class LaunchedBake : public testing::Test {
protected:
    // Returns a launcher that runs a script instead of the program, whose arguments it has.
    std::string launcher(const std::string& script) const {
        std::ofstream(folder_ / "launcher.sh") << script << "\n";
        return "sh '" + (folder_ / "launcher.sh").string() + "'";
    }
    planet::Result<planet::BakeReport> run(const std::string& script) {
        return runLaunchedBake(launcher(script), task_, stop_.get_token(),
                               [&](const planet::JobProgress& progress) { progress_.push_back(progress); });
    }

    TemporaryFolder folder_;
    BakeTask task_{.source = "noise:ridged,seed=3", .output = folder_ / "a.chk"};
    std::stop_source stop_;
    std::vector<planet::JobProgress> progress_;
};

TEST_F(LaunchedBake, theCommandHasTheWholeTask) {
    task_.source = "it's.tif";
    task_.settings.faceSize = 1025;
    task_.settings.quantumM = 0.25;
    task_.settings.radiusM = 1737400;
    task_.settings.threads = 3;
    task_.colour.image = "c.jpg";
    task_.settings.colour.format = planet::ColourFormat::Lossless;
    task_.sourceSettings.noDataValue = -9999;
    task_.sourceSettings.rawSigned = true;
    const std::string command = launchedCommand("mpirun -n 4", task_);
    EXPECT_THAT(command,
                AllOf(StartsWith("exec mpirun -n 4 '"), HasSubstr("' 'bake' 'it'\\''s.tif' '--output' '")));
    for (const char* part :
         {"'--face-size' '1025'", "'--quantum' '0.25'", "'--radius' '1737400'", "'--threads' '3'",
          "'--colour' 'c.jpg'", "'--colour-format' 'lossless'", "'--no-data' '-9999'", "'--raw-signed'",
          "'--resume' '--json' '--progress-json'"})
        EXPECT_THAT(command, HasSubstr(part));
}

TEST_F(LaunchedBake, itsProgressAndReportAreRead) {
    ASSERT_TRUE(planet::bake(planet::test::hillsSource(), {.faceSize = 33, .chunkSize = 17}, task_.output));
    const auto report = run(
        "echo 'a line that a launcher writes' >&2\n"
        "echo "
        "'{\"samples_done\":50,\"samples_total\":200,\"remaining_s\":1.5,\"units_done\":3,\"units_total\":8,"
        "\"ranks\":4,\"slowest_rank\":2,\"slowest_samples_per_s\":7}' >&2\n"
        "echo '{\"seconds\": 2.5, \"colour_tiles\": 6,'; sleep 0.1; echo '\"root_delta_c_m\": 12}'");
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->chunks, 30u);
    EXPECT_EQ(report->seconds, 2.5);
    EXPECT_EQ(report->colourTiles, 6u);
    EXPECT_EQ(report->largestDeltaCM, 12);
    EXPECT_EQ(report->fileBytes, std::filesystem::file_size(task_.output));
    ASSERT_EQ(progress_.size(), 1u);
    EXPECT_EQ(progress_[0].bake.samplesDone, 50u);
    EXPECT_EQ(progress_[0].bake.samplesTotal, 200u);
    EXPECT_EQ(progress_[0].unitsDone, 3u);
    EXPECT_EQ(progress_[0].ranks, 4);
    EXPECT_EQ(progress_[0].slowestRank, 2);
}

TEST_F(LaunchedBake, itsErrorIsTheLastMessageOfTheProgram) {
    const auto report = run("echo 'worldy: a.tif: no such file' >&2; echo 'mpirun has ended' >&2; exit 2");
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().message, "a.tif: no such file");
}

TEST_F(LaunchedBake, aLauncherThatFailsIsShownWithItsLines) {
    const auto report = run("echo 'not enough slots' >&2; exit 1");
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message,
                AllOf(HasSubstr("ended with exit code 1"), HasSubstr("not enough slots")));
    const auto missing =
        runLaunchedBake("no-such-launcher -n 4", task_, {}, [](const planet::JobProgress&) {});
    ASSERT_FALSE(missing);
    EXPECT_THAT(missing.error().message,
                AllOf(StartsWith("no-such-launcher -n 4: ended with exit code 127"), HasSubstr("not found")));
}

TEST_F(LaunchedBake, aReportThatIsNoneIsRefused) {
    ASSERT_TRUE(planet::bake(planet::test::hillsSource(), {.faceSize = 33, .chunkSize = 17}, task_.output));
    const auto report = run("echo hello");
    ASSERT_FALSE(report);
    EXPECT_THAT(report.error().message, HasSubstr("printed no report"));
}

TEST_F(LaunchedBake, cancellingInterruptsTheCommandAndAllThatItStarted) {
    const std::string script =
        "trap 'echo interrupted > " + (folder_ / "log").string() + "; exit 130' INT\nsleep 600 & wait";
    std::jthread canceller([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        stop_.request_stop();
    });
    const auto report = run(script);
    ASSERT_FALSE(report);
    EXPECT_EQ(report.error().kind, planet::ErrorKind::Cancelled);
}

}  // namespace
}  // namespace worldy
