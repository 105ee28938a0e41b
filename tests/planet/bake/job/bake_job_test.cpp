// Jobs of several ranks, which are threads here: their files, their failures, and going on after them.
#include "planet/bake/job/bake_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include "planet/bake/bake.h"
#include "planet/bake/bake_tile.h"
#include "planet/bake/job/job_units.h"
#include "planet/source/height_source.h"
#include "tests/support/faulty_files.h"
#include "tests/support/sparse_source.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/thread_ranks.h"

namespace planet {
namespace {

namespace fs = std::filesystem;
using test::onRanks;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using ::tests::contentOf;
using ::tests::TemporaryFolder;

void writeText(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

// Small tasks, so that a small planet has many units, and chunks whose tight metrics are searched for.
BakeSettings smallTasks(int faceSize) {
    BakeSettings settings;
    settings.faceSize = faceSize;
    settings.chunkSize = 17;
    settings.tileLevels = 0;
    settings.threads = 2;
    return settings;
}

auto runJob(int ranks, const HeightSource& source, const JobSettings& settings, const fs::path& output,
            const ColourSource* colour = nullptr, const JobProgressCallback& progress = {}) {
    return onRanks(ranks,
                   [&](Ranks& own) { return bakeJob(own, source, settings, output, progress, colour); });
}

void expectSameBytes(const HeightSource& source, const BakeSettings& settings,
                     std::initializer_list<int> ranks, const ColourSource* colour = nullptr) {
    const TemporaryFolder folder;
    const auto alone = bake(source, settings, folder / "alone.chk", {}, colour);
    ASSERT_TRUE(alone) << alone.error().message;
    const std::string expected = contentOf(folder / "alone.chk");
    for (const int count : ranks) {
        const auto reports = runJob(count, source, {settings}, folder / "job.chk", colour);
        for (const auto& report : reports) ASSERT_TRUE(*report) << report->error().message;
        EXPECT_TRUE(contentOf(folder / "job.chk") == expected) << count << " ranks";
        EXPECT_FALSE(fs::exists(folder / "job.chk.spool"));
        const JobReport& report = **reports[0];
        EXPECT_EQ(report.bake.chunks, alone->chunks);
        EXPECT_EQ(report.bake.samples, alone->samples);
        EXPECT_EQ(report.bake.fileBytes, alone->fileBytes);
        EXPECT_EQ(report.bake.colourBytes, alone->colourBytes);
        EXPECT_EQ(report.bake.largestDeltaCM, alone->largestDeltaCM);
        EXPECT_EQ(report.bake.largestDeltaTightM, alone->largestDeltaTightM);
        EXPECT_EQ(report.ranks.size(), static_cast<std::size_t>(count));
        std::uint64_t units = 0;
        std::uint64_t written = 0;
        for (const RankReport& rank : report.ranks) {
            units += rank.units;
            written += rank.writtenBytes;
        }
        EXPECT_EQ(units, report.units);
        EXPECT_LT(written, report.bake.fileBytes);
    }
}

TEST(BakeJob, AnyNumberOfRanksGivesTheBytesOfABakeAlone) {
    expectSameBytes(test::hillsSource(), smallTasks(513), {1, 2, 3, 5, 8});
}

TEST(BakeJob, ASparseTreeOfAnyNumberOfRanksHasTheSameBytes) {
    BakeSettings settings = smallTasks(4097);
    expectSameBytes(test::sparseHills(4096), settings, {1, 2, 3, 5, 8});
    settings.tileLevels = 2;
    expectSameBytes(test::sparseHills(4096), settings, {3});
}

TEST(BakeJob, ColoursOfAnyNumberOfRanksHaveTheSameBytes) {
    ColourSource colours = test::mottledColours(2049);
    const ChunkId fine{Face::PosY, 3, 5, 2};
    colours.finestCells = [&](const ChunkId& square) {
        const bool meets =
            square.level <= 3 ? ancestorOf(fine, square.level) == square : ancestorOf(square, 3) == fine;
        return meets ? 2048 : 512;
    };
    expectSameBytes(test::hillsSource(), smallTasks(65), {1, 2, 3, 5, 8}, &colours);
}

TEST(BakeJob, TheEarthWithItsInsetsHasTheSameBytesOnThreeRanks) {
    const auto earth = openHeightSource(WORLDY_SOURCE_DIR "/data/earth/earth.toml", {});
    ASSERT_TRUE(earth) << earth.error().message;
    BakeSettings settings;
    settings.threads = 1;
    expectSameBytes(*earth, settings, {3});
}

// A unit holds several tiles, which are merged before they are spooled.
TEST(BakeJob, UnitsOfSeveralTilesHaveTheSameBytes) {
    const HeightSource source = test::hillsSource();
    const BakeSettings settings = smallTasks(1025);
    ASSERT_GT(jobUnitLevels(chooseShape(source, settings).value(), 6ull << 20, 0), 0);
    expectSameBytes(source, settings, {2, 5});
}

TEST(BakeJob, TheErrorOfARankComesToAllAndNamesIt) {
    const TemporaryFolder folder;
    writeText(folder / "a.chk", "old");
    const auto reports = onRanks(3, [&](Ranks& ranks) {
        HeightSource source = test::hillsSource();
        std::atomic<int> samples = 0;
        if (ranks.rank() == 1) {
            source.sample = [&, sample = source.sample](const SampleTile& tile, std::span<float> out) {
                if (++samples > 5) return Result<void>(ioError("hills: block 7 cannot be read"));
                return sample(tile, out);
            };
        }
        return bakeJob(ranks, source, {smallTasks(513)}, folder / "a.chk");
    });
    for (const auto& report : reports) {
        ASSERT_FALSE(*report);
        EXPECT_THAT(report->error().message,
                    AllOf(StartsWith("rank 1 on "), HasSubstr("hills: block 7 cannot be read")));
    }
    EXPECT_THAT(reports[0]->error().message, HasSubstr("--resume goes on with them"));
    EXPECT_EQ(contentOf(folder / "a.chk"), "old");
}

// Bakes with a source that fails after some tiles on each rank, then goes on without the fault.
void failAndResume(const TemporaryFolder& folder, int ranksBefore, int ranksAfter) {
    const HeightSource source = test::sparseHills(4096);
    const JobSettings settings{smallTasks(4097), false, {}};
    ASSERT_TRUE(bake(source, settings.bake, folder / "alone.chk"));
    HeightSource failing = source;
    std::atomic<int> samples = 0;
    failing.sample = [&](const SampleTile& tile, std::span<float> out) {
        if (++samples > 3000) return Result<void>(ioError("the disk is gone"));
        return source.sample(tile, out);
    };
    const auto failed = runJob(ranksBefore, failing, settings, folder / "a.chk");
    ASSERT_FALSE(*failed[0]);
    ASSERT_FALSE(fs::exists(folder / "a.chk"));
    // A record that was cut off, as by a kill, and a damaged one.
    const fs::path spool = folder / "a.chk.spool" / "0000.spool";
    std::string bytes = contentOf(spool);
    bytes.resize(bytes.size() - 5);
    bytes[100] = static_cast<char>(bytes[100] ^ 1);
    writeText(spool, bytes);

    const auto again = runJob(ranksAfter, source, settings, folder / "a.chk");
    ASSERT_FALSE(*again[0]);
    EXPECT_THAT(again[0]->error().message,
                HasSubstr("add --resume to go on with them, or remove the folder"));

    JobSettings resume = settings;
    resume.resume = true;
    const auto resumed = runJob(ranksAfter, source, resume, folder / "a.chk");
    ASSERT_TRUE(*resumed[0]) << resumed[0]->error().message;
    const JobReport& report = **resumed[0];
    EXPECT_GT(report.resumedUnits, 1000u);
    EXPECT_LT(report.resumedUnits, 3000u);
    std::uint64_t baked = 0;
    for (const RankReport& rank : report.ranks) baked += rank.units;
    EXPECT_EQ(baked + report.resumedUnits, report.units);
    EXPECT_TRUE(contentOf(folder / "a.chk") == contentOf(folder / "alone.chk"));
    EXPECT_FALSE(fs::exists(folder / "a.chk.spool"));
}

TEST(BakeJob, ALaterJobGoesOnWithTheFinishedUnits) {
    const TemporaryFolder one;
    failAndResume(one, 2, 2);
    const TemporaryFolder two;
    failAndResume(two, 3, 1);
    const TemporaryFolder three;
    failAndResume(three, 1, 5);
}

TEST(BakeJob, FinishedUnitsOfAnotherBakeAreRefused) {
    const TemporaryFolder folder;
    const HeightSource source = test::hillsSource();
    HeightSource failing = source;
    std::atomic<int> samples = 0;
    failing.sample = [&](const SampleTile& tile, std::span<float> out) {
        if (++samples > 50) return Result<void>(ioError("the disk is gone"));
        return source.sample(tile, out);
    };
    ASSERT_FALSE(*runJob(1, failing, {smallTasks(513)}, folder / "a.chk")[0]);
    BakeSettings other = smallTasks(513);
    other.compressionLevel = 1;
    const auto report = runJob(2, source, {other, true, {}}, folder / "a.chk");
    ASSERT_FALSE(*report[0]);
    EXPECT_THAT(report[0]->error().message,
                AllOf(HasSubstr("0000.spool"), HasSubstr("belongs to a bake of another source")));
    EXPECT_TRUE(fs::exists(folder / "a.chk.spool" / "0000.spool"));
}

TEST(BakeJob, ResumingNothingBakesFromTheBeginning) {
    const TemporaryFolder folder;
    const auto report = runJob(2, test::hillsSource(), {smallTasks(65), true, {}}, folder / "a.chk");
    ASSERT_TRUE(*report[0]) << report[0]->error().message;
    EXPECT_EQ((*report[0])->resumedUnits, 0u);
}

TEST(BakeJob, RanksThatDifferAreRefusedByName) {
    const TemporaryFolder folder;
    const auto differing = [&](const std::function<void(HeightSource&, JobSettings&)>& change) {
        const auto reports = onRanks(3, [&](Ranks& ranks) {
            HeightSource source = test::hillsSource();
            JobSettings settings{smallTasks(65), false, "Worldy 1"};
            if (ranks.rank() == 2) change(source, settings);
            return bakeJob(ranks, source, settings, folder / "a.chk");
        });
        EXPECT_FALSE(*reports[0]);
        EXPECT_FALSE(fs::exists(folder / "a.chk.spool"));
        return *reports[0] ? std::string() : reports[0]->error().message;
    };
    EXPECT_THAT(differing([](HeightSource&, JobSettings& settings) { settings.program = "Worldy 2"; }),
                AllOf(StartsWith("rank 2 on "), HasSubstr("runs Worldy 2, and rank 0 runs Worldy 1")));
    EXPECT_THAT(differing([](HeightSource& source, JobSettings&) { source.description = "other hills"; }),
                AllOf(StartsWith("rank 2 on "), HasSubstr("other hills: differs from the source of rank 0")));
    EXPECT_THAT(differing([](HeightSource&, JobSettings& settings) { settings.bake.compressionLevel = 1; }),
                AllOf(StartsWith("rank 2 on "), HasSubstr("other settings than rank 0")));
    EXPECT_THAT(differing([](HeightSource&, JobSettings& settings) { settings.bake.faceSize = 7; }),
                AllOf(StartsWith("rank 2 on "), HasSubstr("face size: 7 is invalid")));
}

TEST(BakeJob, AnyRankCanCancelIt) {
    const TemporaryFolder folder;
    for (const int cancelling : {0, 2}) {
        const auto reports = onRanks(3, [&](Ranks& ranks) {
            const int rank = ranks.rank();
            HeightSource source = test::hillsSource();
            // Slow enough to be asked.
            source.sample = [sample = source.sample](const SampleTile& tile, std::span<float> out) {
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
                return sample(tile, out);
            };
            return bakeJob(ranks, source, {smallTasks(513), true, {}}, folder / "a.chk",
                           [&](const JobProgress&) { return rank != cancelling; });
        });
        for (const auto& report : reports) {
            ASSERT_FALSE(*report);
            EXPECT_EQ(report->error().kind, ErrorKind::Cancelled);
        }
        EXPECT_FALSE(fs::exists(folder / "a.chk"));
    }
}

TEST(BakeJob, ProgressCountsTheUnitsOfAllRanks) {
    const TemporaryFolder folder;
    std::atomic<std::uint64_t> last = 0;
    const auto reports = onRanks(3, [&](Ranks& ranks) {
        const bool leads = ranks.rank() == 0;
        return bakeJob(ranks, test::hillsSource(), {smallTasks(513)}, folder / "a.chk",
                       [&, leads](const JobProgress& now) {
                           if (!leads) return now.bake.samplesTotal == 0;
                           if (now.unitsTotal > 0) {
                               EXPECT_GE(now.unitsDone, last);
                               EXPECT_EQ(now.ranks, 3);
                               last = now.unitsDone;
                           }
                           return true;
                       });
    });
    ASSERT_TRUE(*reports[0]) << reports[0]->error().message;
    EXPECT_EQ(last, (*reports[0])->units);
}

// The disk fails at each call in turn: of the finished units, or of the output.
TEST(BakeJob, AFailingDiskLosesNothing) {
    const TemporaryFolder folder;
    const HeightSource source = test::hillsSource();
    JobSettings settings{smallTasks(65), true, {}};
    settings.bake.threads = 1;
    const ::tests::FaultyFiles counted;
    settings.bake.fileCalls = counted.calls();
    ASSERT_TRUE(*runJob(1, source, settings, folder / "whole.chk")[0]);
    const std::string whole = contentOf(folder / "whole.chk");
    int failed = 0;
    for (std::size_t call = 0; call < counted.count(); call += 7) {
        writeText(folder / "a.chk", "old");
        ::tests::FaultyFiles files;
        files.failAt(call, ::tests::enospc);
        JobSettings faulty = settings;
        faulty.bake.fileCalls = files.calls();
        const auto report = runJob(1, source, faulty, folder / "a.chk");
        EXPECT_EQ(files.open(), 0) << call;
        // A fault of the last calls, when the file has its name, is no failure.
        EXPECT_TRUE(contentOf(folder / "a.chk") == (*report[0] ? whole : "old")) << call;
        failed += *report[0] ? 0 : 1;
    }
    EXPECT_GT(failed, 5);
    const auto again = runJob(2, source, settings, folder / "a.chk");
    ASSERT_TRUE(*again[0]) << again[0]->error().message;
    EXPECT_TRUE(contentOf(folder / "a.chk") == whole);
}

}  // namespace
}  // namespace planet
