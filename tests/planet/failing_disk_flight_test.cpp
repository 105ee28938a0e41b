// Flying over a baked file on a failing disk: each system call fails in turn, and the file is cut, replaced,
// overwritten or deleted while it is open. The planet is drawn whole throughout.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

#include "planet/bake/bake.h"
#include "planet/format/chunk_file.h"
#include "planet/planet.h"
#include "planet/planet_tools.h"
#include "tests/support/faulty_files.h"
#include "tests/support/planet_fixture.h"
#include "tests/support/sanitized.h"
#include "tests/support/sudden_lod.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using ::testing::AnyOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::tests::contentOf;
using tests::FaultyFiles;
using tests::FileFault;

constexpr int flownFrames = 24;

void overwrite(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
}

void bakeHills(const std::filesystem::path& path, double quantumM = 1) {
    BakeSettings settings{.faceSize = 129, .chunkSize = 17, .quantumM = quantumM};
    settings.colour.faceSize = 513;
    const ColourSource colours = test::mottledColours();
    ASSERT_TRUE(bake(test::hillsSource(), settings, path, {}, &colours));
}

// Baked once for all tests.
const std::string& bakedHills() {
    static const std::string content = [] {
        const tests::TemporaryFolder folder;
        bakeHills(folder / "hills.chk");
        return contentOf(folder / "hills.chk");
    }();
    return content;
}

class FailingDiskFlight : public testing::Test {
protected:
    void SetUp() override { overwrite(path_, bakedHills()); }

    // Read in the steps themselves, one block after another, so that calls are counted the same each time.
    static PagingSettings settings() {
        PagingSettings settings;
        settings.time = PagingTime::Simulated;
        settings.badDisk.latencyMs = 5;
        settings.loaderThreads = 4;
        settings.retry = {.retries = 3, .delayS = 0.05};
        return settings;
    }

    // Of everything, so that what is drawn must cover the six faces, however coarsely.
    static ViewInput inputAt(int frame) {
        CameraPose pose{.latitudeDeg = 10.0 + frame, .longitudeDeg = 20 + 8.0 * frame, .altitudeM = 4e5};
        pose.pitchDeg = -50;
        ViewInput input;
        input.lodView = viewFromPose(pose, 6'371'000, 1.0, 640, 480);
        input.lod = suddenLod(1.5);
        input.lod.frustumCulling = input.lod.horizonCulling = false;
        input.colours = {.enabled = true, .texelsPerPixel = 0.5};
        return input;
    }

    static void expectWhole(const Planet& planet) {
        double faces = 0;
        for (const DrawItem& item : planet.selection().draw) faces += std::ldexp(1.0, -2 * item.id.level);
        EXPECT_EQ(faces, 6);
    }

    // Flies some frames and settles; what is drawn then.
    static std::vector<ChunkId> fly(Planet& planet, int from = 0, int to = flownFrames) {
        for (int frame = from; frame < to; ++frame) {
            const ViewInput input = inputAt(frame);
            planet.step({&input, 1}, noUpload, 1.0 / 30);
            expectWhole(planet);
        }
        const ViewInput last = inputAt(to - 1);
        EXPECT_TRUE(planet.settle({&last, 1}, noUpload, 100));
        expectWhole(planet);
        return drawn(planet);
    }

    std::unique_ptr<Planet> open(const FileCalls& calls = systemFileCalls()) const {
        auto planet = Planet::open(path_, settings(), calls);
        EXPECT_TRUE(planet) << planet.error().message;
        return planet ? std::move(*planet) : nullptr;
    }

    tests::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "hills.chk";
};

TEST_F(FailingDiskFlight, EachCallInTurnIsTriedAgainAndTheSameIsDrawn) {
    FaultyFiles disk;
    std::vector<ChunkId> whole;
    std::size_t calls = 0;
    std::size_t callsToOpen = 0;
    {
        const auto planet = open(disk.calls());
        callsToOpen = disk.count();
        whole = fly(*planet);
        calls = disk.count();
        EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
    }
    EXPECT_EQ(disk.open(), 0);
    ASSERT_GT(calls, callsToOpen + 40);
    std::map<std::string, int> injected;
    int refused = 0, retried = 0;
    for (const FileFault& fault :
         {tests::eio, tests::eacces, tests::interrupted, tests::half, tests::nothing}) {
        for (std::size_t n = 0; n < calls; n += tests::sanitized && n >= callsToOpen ? 3 : 1) {
            SCOPED_TRACE(fmt::format("call {} of {} meets {}", n, calls, fault.name));
            disk.failAt(n, fault);
            const bool mustNotMatter = fault.error == EINTR || fault.kind == FileFault::Kind::DoesHalf;
            const auto planet = Planet::open(path_, settings(), disk.calls());
            if (!planet) {
                ++refused;
                EXPECT_LT(n, callsToOpen);
                EXPECT_FALSE(mustNotMatter);
                EXPECT_THAT(planet.error().message, HasSubstr("hills.chk"));
            } else {
                ASSERT_EQ(fly(**planet), whole);
                // But for what the flight has left behind meanwhile.
                for (const FailedBlock& block : (*planet)->inspect().failedBlocks())
                    EXPECT_EQ(block.retryInS, 0);
                retried += static_cast<int>((*planet)->paging()[BlockKind::Heights].failed);
                EXPECT_TRUE((*planet)->paging()[BlockKind::Heights].failed == 0 || !mustNotMatter);
                EXPECT_THAT((*planet)->takeProblems(), IsEmpty());
            }
            if (!disk.faulted().empty()) ++injected[fault.name];
            if (HasFailure()) return;
        }
    }
    EXPECT_GT(retried, tests::sanitized ? 30 : 100);
    EXPECT_GT(refused, 5);
    EXPECT_EQ(disk.open(), 0);
    for (const auto& [name, count] : injected) {
        RecordProperty(fmt::format("flight_{}", name), count);
        fmt::print("flight: {} x {}\n", name, count);
    }
    fmt::print("flight: {} calls in turn, {} of them to open; {} opens refused, {} reads tried again\n",
               calls, callsToOpen, refused, retried);
}

TEST_F(FailingDiskFlight, ADiskThatDiesInFlightLeavesWhatIsThereAndAllComesOnceItIsWell) {
    const std::vector<ChunkId> whole = fly(*open());
    for (const std::size_t n : {16u, 25u, 40u}) {
        FaultyFiles disk;
        disk.failFrom(n, tests::eio);
        const auto planet = open(disk.calls());
        ASSERT_TRUE(planet);
        fly(*planet);
        EXPECT_GT(planet->paging().failedPermanently(), 0u);
        const std::vector<std::string> problems = planet->takeProblems();
        EXPECT_EQ(problems.size(), planet->paging().failedPermanently());
        EXPECT_THAT(problems,
                    Each(HasSubstr("hills.chk: reading failed: Input/output error (tried 4 times)")));
        // Not asked for again, however long one flies.
        const std::uint64_t failed = planet->paging()[BlockKind::Heights].failed;
        fly(*planet, flownFrames - 1);
        EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, failed);
        disk.beWhole();
        planet->tools().retryFailed();
        EXPECT_EQ(fly(*planet), whole);
        EXPECT_THAT(planet->inspect().failedBlocks(), IsEmpty());
    }
}

TEST_F(FailingDiskFlight, ReadsBeyondWhatIsAllowedAreErrorsThatSayWhatIsWrong) {
    FaultyFiles disk;
    disk.failAlways("open", tests::eacces);
    const auto refused = Planet::open(path_, settings(), disk.calls());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::Io);
    EXPECT_THAT(refused.error().message, HasSubstr("hills.chk: cannot be opened: Permission denied"));
    const auto absent = Planet::open(folder_ / "absent.chk", settings());
    ASSERT_FALSE(absent);
    EXPECT_THAT(absent.error().message, HasSubstr("absent.chk: cannot be opened: No such file"));
}

TEST_F(FailingDiskFlight, ADeletedFileGoesOn) {
    const std::vector<ChunkId> whole = fly(*open());
    const auto planet = open();
    fly(*planet, 0, 2);
    std::filesystem::remove(path_);
    EXPECT_EQ(fly(*planet, 2), whole);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
}

TEST_F(FailingDiskFlight, AFileThatAnotherIsRenamedOverGoesOnAsItWas) {
    const std::vector<ChunkId> whole = fly(*open());
    const auto planet = open();
    fly(*planet, 0, 2);
    bakeHills(path_, 2);
    ASSERT_NE(contentOf(path_), bakedHills());
    EXPECT_EQ(fly(*planet, 2), whole);
    EXPECT_EQ(planet->paging()[BlockKind::Heights].failed, 0u);
}

TEST_F(FailingDiskFlight, AFileThatIsCutAndWrittenAgainHealsByItself) {
    const std::vector<ChunkId> whole = fly(*open());
    const auto planet = open();
    const ViewInput input = inputAt(flownFrames - 1);
    std::filesystem::resize_file(path_, bakedHills().size() / 3);
    for (int i = 0; i < 3; ++i) planet->step({&input, 1}, noUpload, 1.0 / 30);
    ASSERT_GT(planet->paging().awaitingRetry(), 0u);
    expectWhole(*planet);
    overwrite(path_, bakedHills());
    EXPECT_EQ(fly(*planet), whole);
    EXPECT_THAT(planet->inspect().failedBlocks(), IsEmpty());
    EXPECT_THAT(planet->takeProblems(), IsEmpty());
}

TEST_F(FailingDiskFlight, AFileThatStaysCutIsDrawnAsFarAsItGoes) {
    const auto planet = open();
    std::filesystem::resize_file(path_, bakedHills().size() / 3);
    fly(*planet);
    EXPECT_GT(planet->paging().failedPermanently(), 0u);
    EXPECT_THAT(planet->takeProblems(), Each(HasSubstr("while open: it was truncated")));
    for (const FailedBlock& block : planet->inspect().failedBlocks()) EXPECT_EQ(block.attempts, 4u);
}

TEST_F(FailingDiskFlight, AFileThatIsOverwrittenInPlaceIsReportedBlockByBlock) {
    std::mt19937 random(5);
    std::string noise(bakedHills().size(), '\0');
    for (char& byte : noise) byte = static_cast<char>(random());
    tests::TemporaryFolder other;
    bakeHills(other / "other.chk", 2);
    for (const std::string& content :
         {noise, contentOf(other / "other.chk"), std::string(noise.size(), '\0')}) {
        overwrite(path_, bakedHills());
        const auto planet = open();
        fly(*planet, 0, 2);
        const std::uint64_t before = planet->paging()[BlockKind::Heights].loaded;
        overwrite(path_, content);
        fly(*planet, 2);
        EXPECT_GT(planet->paging().failedPermanently(), 0u);
        EXPECT_GE(planet->paging()[BlockKind::Heights].loaded, before);
        for (const std::string& problem : planet->takeProblems())
            EXPECT_THAT(problem, AnyOf(HasSubstr("hills.chk"), HasSubstr("_pos/"), HasSubstr("_neg/")));
        // The old file again, and all is well.
        overwrite(path_, bakedHills());
        planet->tools().retryFailed();
        fly(*planet);
        EXPECT_EQ(planet->paging().failedPermanently(), 0u);
    }
}

}  // namespace
}  // namespace planet
