// Bakes on several ranks, which mpirun starts. tests/planet/bake/job/ has what does not need MPI.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "tests/program/small_planet.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// More ranks than cores, as root where the tests run as root, and without what a container may forbid.
std::string ranks(int count) {
    return fmt::format(
        "mpirun --allow-run-as-root --oversubscribe --bind-to none --mca btl self,vader --mca "
        "btl_vader_single_copy_mechanism none -n {} ",
        count);
}

std::string bake(const std::string& arguments) {
    return "'" WORLDY_BINARY "' bake --threads 1 " + arguments + " ";
}

// 13 M samples: some seconds, in which it can be killed.
constexpr const char* slowBake = "noise:ridged,seed=2,octaves=14 --face-size 1025 --chunk-size 17 -o a.chk";

// Runs a bake of three ranks over an older file, and a command beside it when some units are finished.
Ran disturbed(const TemporaryFolder& folder, const std::string& command) {
    EXPECT_EQ(runWorldy(folder, "bake noise:ridged,seed=1 --face-size 65 -o a.chk").exitCode, 0);
    fs::copy_file(folder / "a.chk", folder / "old.chk");
    const std::string job = ranks(3) + bake(slowBake);
    // The last rank's process is the one whose file is the third.
    return runShell(folder,
                    job +
                        "& mpirun=$!\n"
                        "until [ -s a.chk.spool/0002.spool ] && [ $(stat -c %s a.chk.spool/0002.spool) "
                        "-gt 40000 ]; do sleep 0.02; done\n" +
                        command + "\nwait $mpirun");
}

// Returns the bytes of the slow bake by one process that nothing disturbs, which bakes it once for all tests.
const std::string& bakedAlone() {
    static const std::string content = [] {
        const TemporaryFolder folder;
        EXPECT_EQ(runShell(folder, bake(slowBake)).exitCode, 0);
        return contentOf(folder / "a.chk");
    }();
    return content;
}

void expectGoesOn(const TemporaryFolder& folder) {
    EXPECT_TRUE(contentOf(folder / "a.chk") == contentOf(folder / "old.chk"));
    const Ran refused = runShell(folder, ranks(2) + bake(slowBake));
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_THAT(refused.errors, HasSubstr("add --resume to go on with them, or remove the folder"));
    const Ran resumed = runShell(folder, ranks(2) + bake(slowBake) + "--resume --json");
    ASSERT_EQ(resumed.exitCode, 0) << resumed.errors;
    const auto report = nlohmann::json::parse(resumed.output);
    EXPECT_GT(report["resumed_units"], 0);
    EXPECT_LT(report["resumed_units"], report["units"]);
    EXPECT_TRUE(contentOf(folder / "a.chk") == bakedAlone());
    EXPECT_FALSE(fs::exists(folder / "a.chk.spool"));
}

TEST(MpiBake, anyNumberOfRanksGivesTheBytesOfABakeAlone) {
    const TemporaryFolder folder;
    writeHills(folder);
    for (const std::string& source : {std::string("noise:ridged,seed=7 --face-size 257 --chunk-size 17"),
                                      std::string("hills.pgm --metres-per-unit 20 --colour hills.pgm "
                                                  "--colour-face-size 1025 --face-size 129")}) {
        ASSERT_EQ(runShell(folder, bake(source) + "-o alone.chk --overwrite").exitCode, 0);
        for (const int count : {1, 2, 5}) {
            const Ran ran = runShell(folder, ranks(count) + bake(source) + "-o job.chk --overwrite --json");
            ASSERT_EQ(ran.exitCode, 0) << ran.errors;
            EXPECT_TRUE(contentOf(folder / "job.chk") == contentOf(folder / "alone.chk")) << source << count;
            const auto report = nlohmann::json::parse(ran.output);
            ASSERT_EQ(report["ranks"].size(), static_cast<std::size_t>(count));
            std::uint64_t units = 0;
            for (const auto& rank : report["ranks"]) {
                units += rank["units"].get<std::uint64_t>();
                EXPECT_THAT(rank["name"], testing::StartsWith("rank "));
                EXPECT_EQ(rank["threads"], 1);
                EXPECT_GT(rank["peak_memory_bytes"], 1 << 20);
            }
            EXPECT_EQ(units, report["units"]);
            EXPECT_EQ(report["finished_units"].size(), report["units"]);
        }
    }
}

TEST(MpiBake, aKilledRankEndsTheJobAndAnotherGoesOn) {
    const TemporaryFolder folder;
    const Ran killed = disturbed(folder,
                                 "kill -KILL $(grep -lz OMPI_COMM_WORLD_RANK=2 $(pgrep -P $mpirun | sed "
                                 "'s|.*|/proc/&/environ|') | sed 's|/proc/||; s|/environ||')");
    EXPECT_NE(killed.exitCode, 0);
    EXPECT_THAT(killed.errors + killed.output, AllOf(HasSubstr("rank 2"), HasSubstr("signal 9")));
    expectGoesOn(folder);
}

TEST(MpiBake, anInterruptedJobKeepsItsFinishedUnits) {
    const TemporaryFolder folder;
    const Ran interrupted = disturbed(folder, "kill -INT $mpirun");
    EXPECT_NE(interrupted.exitCode, 0);
    expectGoesOn(folder);
}

TEST(MpiBake, aBakeAloneGoesOnToo) {
    const TemporaryFolder folder;
    const Ran killed = runShell(folder, bake(slowBake) +
                                            "--resume & worldy=$!\n"
                                            "until [ -s a.chk.spool/0000.spool ] && [ $(stat -c %s "
                                            "a.chk.spool/0000.spool) -gt 200000 ]; do sleep 0.02; done\n"
                                            "kill -KILL $worldy; wait $worldy");
    EXPECT_EQ(killed.exitCode, 128 + 9);
    EXPECT_FALSE(fs::exists(folder / "a.chk"));
    const Ran resumed = runShell(folder, bake(slowBake) + "--resume --json");
    ASSERT_EQ(resumed.exitCode, 0) << resumed.errors;
    EXPECT_GT(nlohmann::json::parse(resumed.output)["resumed_units"], 0);
    EXPECT_TRUE(contentOf(folder / "a.chk") == bakedAlone());
}

// The report of a bake predicts bakes on more ranks.
TEST(MpiBake, aScheduleIsPredictedFromAReport) {
    const TemporaryFolder folder;
    const std::string small = bake("noise:ridged --face-size 257 --chunk-size 17 -o a.chk");
    ASSERT_EQ(runShell(folder, small + "--resume --json > report.json").exitCode, 0);
    const Ran ran = runWorldy(folder, "schedule report.json --ranks 1,8 --bandwidth 500 --json");
    ASSERT_EQ(ran.exitCode, 0) << ran.errors;
    const auto schedules = nlohmann::json::parse(ran.output)["schedules"];
    ASSERT_EQ(schedules.size(), 2u);
    EXPECT_EQ(schedules[1]["ranks"], 8);
    EXPECT_GT(schedules[0]["efficiency"], schedules[1]["efficiency"]);
    EXPECT_GT(schedules[0]["bake_s"], schedules[1]["bake_s"]);
    const Ran table = runWorldy(folder, "schedule report.json");
    EXPECT_THAT(table.output, AllOf(HasSubstr("efficiency"), HasSubstr("512 ")));

    std::ofstream(folder / "bad.json") << "{\"finished_units\": [[1, -2, 3]], \"ranks\": [1]}";
    ASSERT_EQ(runShell(folder, small + "--overwrite --json > plain.json").exitCode, 0);
    for (const char* file : {"bad.json", "plain.json", "a.chk", "gone.json"}) {
        const Ran refused = runWorldy(folder, std::string("schedule ") + file);
        EXPECT_EQ(refused.exitCode, 2) << file;
        EXPECT_THAT(refused.errors,
                    AllOf(HasSubstr(file), HasSubstr("expected what worldy bake --json prints")));
    }
}

TEST(MpiBake, aFullDiskIsNamedAndKeepsFinishedUnits) {
    const TemporaryFolder folder;
    // No file may be larger than 16 MiB, which the output is, and the signal that would end the program is ignored.
    const std::string job = bake("noise:ridged --face-size 2049 -o a.chk --compression-level 1");
    const Ran full = runShell(folder, ranks(2) + "sh -c \"trap '' XFSZ; ulimit -f 32768; exec " + job + "\"");
    EXPECT_EQ(full.exitCode, 2);
    // It is the output, or the finished units of a rank that has baked nearly all.
    EXPECT_THAT(full.errors, AllOf(HasSubstr("worldy: rank "), HasSubstr("a.chk"),
                                   HasSubstr(": writing failed: File too large")));
    std::smatch kept;
    ASSERT_TRUE(std::regex_search(full.errors, kept,
                                  std::regex("([0-9]+) of 1536 units are finished and kept in a.chk.spool")))
        << full.errors;
    EXPECT_FALSE(fs::exists(folder / "a.chk"));
    const Ran resumed = runShell(folder, ranks(2) + job + "--resume --json");
    ASSERT_EQ(resumed.exitCode, 0) << resumed.errors;
    EXPECT_EQ(nlohmann::json::parse(resumed.output)["resumed_units"], std::stoi(kept[1]));
}

TEST(MpiBake, aRankWithAnotherSourceIsNamed) {
    const TemporaryFolder folder;
    const std::string one = bake("noise:ridged,seed=1 --face-size 65 -o a.chk");
    const std::string other = bake("noise:ridged,seed=2 --face-size 65 -o a.chk");
    const Ran ran = runShell(folder, ranks(1) + one + ": -n 1 " + other);
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors,
                AllOf(HasSubstr("worldy: rank 1 on "), HasSubstr("differs from the source of rank 0")));
    EXPECT_FALSE(fs::exists(folder / "a.chk"));
    EXPECT_FALSE(fs::exists(folder / "a.chk.spool"));
}

TEST(MpiBake, aRankOfAnotherBuildIsNamed) {
    const TemporaryFolder folder;
    const fs::path other = folder / "other";
    fs::create_directories(other);
    for (const char* name : {"worldy", "worldy_images.so", "worldy_rasters.so", "worldy_mpi.so"})
        fs::copy_file(fs::path(WORLDY_BINARY).parent_path() / name, other / name);
    // A byte after the end of the program changes nothing but its hash.
    std::ofstream(other / "worldy", std::ios::app) << "x";
    const std::string source = "bake noise:ridged,seed=1 --face-size 65 -o a.chk ";
    const Ran ran =
        runShell(folder, ranks(1) + "'" WORLDY_BINARY "' " + source + ": -n 1 other/worldy " + source);
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(ran.errors,
                AllOf(HasSubstr("rank 1 on "), HasSubstr("expected the same program on all ranks")));
}

TEST(MpiBake, anErrorOfAllRanksIsWrittenOnce) {
    const TemporaryFolder folder;
    const Ran ran = runShell(folder, ranks(3) + bake("nothing.tif -o a.chk"));
    EXPECT_EQ(ran.exitCode, 2);
    const auto first = ran.errors.find("worldy: ");
    ASSERT_NE(first, std::string::npos) << ran.errors;
    EXPECT_THAT(ran.errors.substr(first + 1), Not(HasSubstr("worldy: ")));
    EXPECT_THAT(ran.errors, HasSubstr("nothing.tif: no such file"));
}

// Rank 0 writes its message into a full pipe, which is read two seconds later.
TEST(MpiBake, anErrorIsWrittenBeforeAnyRankEnds) {
    const TemporaryFolder folder;
    constexpr int pipeBytes = 65536;
    const std::string job = bake("nothing.tif -o a.chk");
    const Ran ran =
        runShell(folder, fmt::format("mkfifo pipe; (exec 3< pipe; sleep 2; cat <&3 > read) & {}"
                                     "sh -c \"exec 2> pipe; head -c {} /dev/zero >&2; exec {}\" : -n 2 {}; "
                                     "job=$?; wait; exit $job",
                                     ranks(1), pipeBytes, job, job));
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_THAT(contentOf(folder / "read").substr(pipeBytes), HasSubstr("nothing.tif: no such file"));
}

}  // namespace
}  // namespace worldy
