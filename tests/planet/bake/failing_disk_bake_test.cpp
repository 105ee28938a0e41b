// A bake on a failing disk: each system call that it makes fails in turn, in each way that a disk can.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>

#include "planet/bake/bake.h"
#include "planet/bake/file_report.h"
#include "planet/base/atomic_file.h"
#include "planet/format/chunk_file.h"
#include "tests/support/faulty_files.h"
#include "tests/support/sanitized.h"
#include "tests/support/synthetic_colours.h"
#include "tests/support/synthetic_source.h"
#include "tests/support/temporary_folder.h"

namespace planet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::tests::contentOf;
using tests::FaultyFiles;
using tests::FileFault;

std::vector<std::string> namesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

// A bake that reads back what it has written, over an older file of the same name.
class FailingDiskBake : public testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(bakeTo(path_, systemFileCalls(), 2));
        old_ = contentOf(path_);
        ASSERT_TRUE(bakeTo(folder_ / "new.chk", systemFileCalls()));
        new_ = contentOf(folder_ / "new.chk");
        std::filesystem::remove(folder_ / "new.chk");
        ASSERT_NE(old_, new_);
    }

    Result<BakeReport> bakeTo(const std::filesystem::path& path, const FileCalls& calls,
                              double quantumM = 1) const {
        BakeSettings settings{.faceSize = 65, .chunkSize = 17, .quantumM = quantumM, .threads = 1};
        settings.tileLevels = 0;
        settings.colour.faceSize = 257;
        settings.fileCalls = calls;
        const ColourSource colours = test::mottledColours();
        return bake(test::hillsSource(), settings, path, {}, withColours_ ? &colours : nullptr);
    }

    std::size_t callsOfABake() {
        FaultyFiles disk;
        EXPECT_TRUE(bakeTo(folder_ / "count.chk", disk.calls()));
        std::filesystem::remove(folder_ / "count.chk");
        return disk.count();
    }

    void putOldBack() const { std::ofstream(path_, std::ios::binary) << old_; }

    // Whole, the old or the new one, as the bake has said.
    void expectWhole(const Result<BakeReport>& baked) const {
        EXPECT_EQ(contentOf(path_) == new_, baked.has_value());
        EXPECT_EQ(contentOf(path_) == old_, !baked.has_value());
        if (!baked) {
            EXPECT_EQ(baked.error().kind, ErrorKind::Io);
            EXPECT_THAT(baked.error().message, HasSubstr("a.chk"));
        }
    }

    // One bake with the n-th call failing.
    void failOne(std::size_t n, const FileFault& fault) {
        SCOPED_TRACE(fmt::format("call {} meets {}", n, fault.name));
        putOldBack();
        FaultyFiles disk;
        disk.failAt(n, fault);
        const auto baked = bakeTo(path_, disk.calls());
        const std::vector<std::string> faulted = disk.faulted();
        if (faulted.empty()) return;  // a call that can only fail, not do less
        ++injected_[fault.name];
        failed_ += !baked;
        expectWhole(baked);
        EXPECT_EQ(disk.open(), 0);
        EXPECT_THAT(namesIn(folder_.path()), ElementsAre("a.chk"));
        const bool mustNotMatter = fault.error == EINTR || fault.kind == FileFault::Kind::DoesHalf;
        if (mustNotMatter) {
            EXPECT_TRUE(baked) << baked.error().message;
        }
        const bool mustMatter = !mustNotMatter && (faulted[0] == "pwrite" || faulted[0] == "pread" ||
                                                   faulted[0] == "fsync" || faulted[0] == "rename");
        if (mustMatter && n + 3 < calls_) {  // but for the folder's sync
            EXPECT_FALSE(baked);
        }
    }

    void report(const char* what) {
        for (const auto& [name, count] : injected_) {
            RecordProperty(fmt::format("{}_{}", what, name), count);
            fmt::print("{}: {} x {}\n", what, name, count);
        }
        fmt::print("{}: {} calls in turn, {} bakes failed\n", what, calls_, failed_);
    }

    bool withColours_ = false;
    tests::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "a.chk";
    std::string old_;
    std::string new_;
    std::size_t calls_ = 0;
    std::map<std::string, int> injected_;
    int failed_ = 0;
};

TEST_F(FailingDiskBake, EachCallInTurnLeavesTheOldFileOrTheNewOneAndNothingElse) {
    calls_ = callsOfABake();
    ASSERT_GE(calls_, 50u);
    for (const FileFault& fault :
         {tests::eio, tests::enospc, tests::eacces, tests::interrupted, tests::half, tests::nothing})
        for (std::size_t n = 0; n < calls_; n += tests::sanitized ? 3 : 1) failOne(n, fault);
    EXPECT_GT(failed_, tests::sanitized ? 33 : 100);
    report("bake");
}

TEST_F(FailingDiskBake, WithColoursTheSameHoldsOfADiskThatIsFull) {
    withColours_ = true;
    ASSERT_TRUE(bakeTo(folder_ / "new.chk", systemFileCalls()));
    new_ = contentOf(folder_ / "new.chk");
    std::filesystem::remove(folder_ / "new.chk");
    calls_ = callsOfABake();
    // The blocks of colours are the last that are written, but for the header.
    for (std::size_t n = calls_ - 16; n < calls_; ++n) failOne(n, tests::enospc);
    EXPECT_GT(failed_, 6);
    report("colours");
}

// Then not even what is half done can be removed.
TEST_F(FailingDiskBake, ADiskThatStaysDeadLeavesTheOldFileAndTheNextBakeCleansUp) {
    calls_ = callsOfABake();
    for (std::size_t n = 0; n < calls_; n += 3) {
        SCOPED_TRACE(fmt::format("dead from call {} on", n));
        FaultyFiles disk;
        disk.failFrom(n, n % 2 == 0 ? tests::eio : tests::enospc);
        const auto baked = bakeTo(path_, disk.calls());
        expectWhole(baked);
        EXPECT_EQ(disk.open(), 0);
        ASSERT_TRUE(bakeTo(path_, systemFileCalls()));
        EXPECT_EQ(contentOf(path_), new_);
        EXPECT_THAT(namesIn(folder_.path()), ElementsAre("a.chk"));
        putOldBack();
    }
}

TEST_F(FailingDiskBake, EveryTransferByHalvesGivesTheSameBytes) {
    FaultyFiles disk;
    disk.failFrom(0, tests::half);
    ASSERT_TRUE(bakeTo(path_, disk.calls()));
    EXPECT_GT(disk.faulted().size(), 100u);
    EXPECT_EQ(contentOf(path_), new_);
}

TEST_F(FailingDiskBake, AFolderThatMayNotBeWrittenToIsAnErrorThatSaysSo) {
    FaultyFiles disk;
    disk.failAlways("open", tests::eacces);
    const auto baked = bakeTo(path_, disk.calls());
    ASSERT_FALSE(baked);
    EXPECT_THAT(baked.error().message, HasSubstr("a.chk: cannot be written: Permission denied"));
    EXPECT_EQ(contentOf(path_), old_);
}

TEST_F(FailingDiskBake, ADiskThatWritesNothingIsAnErrorAndNoEndlessLoop) {
    FaultyFiles disk;
    disk.failAlways("pwrite", tests::nothing);
    const auto baked = bakeTo(path_, disk.calls());
    ASSERT_FALSE(baked);
    EXPECT_THAT(baked.error().message, HasSubstr("a.chk: writing failed: nothing was written"));
}

TEST_F(FailingDiskBake, AFolderThatCannotTellWhatIsInItIsAnErrorAndNoEndlessLoop) {
    FaultyFiles disk;
    disk.failAlways("stat", tests::eio);
    const auto baked = bakeTo(path_, disk.calls());
    ASSERT_FALSE(baked);
    EXPECT_THAT(baked.error().message, HasSubstr("a.chk: cannot be written: Input/output error"));
    EXPECT_EQ(contentOf(path_), old_);
}

TEST_F(FailingDiskBake, ALockThatCannotBeHadForOtherReasonsIsNotAnotherProgram) {
    FaultyFiles disk;
    disk.failAlways("flock", {FileFault::Kind::Fails, ENOLCK, "ENOLCK"});
    const auto baked = bakeTo(path_, disk.calls());
    ASSERT_FALSE(baked);
    EXPECT_THAT(baked.error().message, HasSubstr("a.chk: cannot be locked: No locks available"));
    EXPECT_THAT(namesIn(folder_.path()), ElementsAre("a.chk"));
}

// Of a planet so large that its coarsest chunks are measured against what has been written.
TEST(FailingDiskReadBack, WhatIsWrittenAndCannotBeReadBackLeavesTheOldFile) {
    const tests::TemporaryFolder folder;
    const auto path = folder / "a.chk";
    for (const FileFault& fault : {tests::half, tests::interrupted, tests::eio, tests::nothing}) {
        SCOPED_TRACE(fault.name);
        std::ofstream(path) << "old";
        BakeSettings settings{.faceSize = 513, .chunkSize = 17};
        settings.tileLevels = 0;
        FaultyFiles disk;
        settings.fileCalls = disk.calls();
        if (fault.error == EINTR)
            disk.failOnce("pread", fault);  // one for ever interrupted would never end
        else
            disk.failAlways("pread", fault);
        const auto baked = bake(test::hillsSource(), settings, path);
        EXPECT_FALSE(disk.faulted().empty());
        const bool matters = fault.error == EIO || fault.kind == FileFault::Kind::DoesNothing;
        ASSERT_EQ(baked.has_value(), !matters);
        EXPECT_EQ(contentOf(path) == "old", matters);
        if (matters) {
            EXPECT_THAT(baked.error().message, HasSubstr("a.chk"));
        }
        EXPECT_EQ(disk.open(), 0);
        EXPECT_THAT(namesIn(folder.path()), ElementsAre("a.chk"));
    }
}

TEST(FailingDiskSource, RawFacesAreReadWholeOrAreAnErrorThatNamesOne) {
    const tests::TemporaryFolder folder;
    for (const Face face : allFaces) {
        // Each face has its own value inside; all have one on the edges that they share.
        std::string bytes(std::size_t{17} * 17 * 2, 1);
        for (std::size_t row = 1; row < 16; ++row)
            std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(row * 34 + 2), 30,
                        static_cast<char>(1 + static_cast<int>(face)));
        std::ofstream(folder / fmt::format("earth17_{}.raw", faceName(face)), std::ios::binary) << bytes;
    }
    const auto sampled = [&](const FileCalls& calls) -> Result<std::vector<float>> {
        HeightSourceSettings settings;
        settings.fileCalls = calls;
        const auto source = openHeightSource(folder / "earth17", settings);
        if (!source) return tl::unexpected(source.error());
        std::vector<float> out(std::size_t{17} * 17);
        if (auto done = source->sample({Face::PosY, 16, 0, 0, 17, 17}, out); !done)
            return tl::unexpected(done.error());
        return out;
    };
    FaultyFiles disk;
    const auto whole = sampled(disk.calls());
    ASSERT_TRUE(whole) << whole.error().message;
    const std::size_t calls = disk.count();
    int injected = 0;
    for (std::size_t n = 0; n < calls; ++n) {
        for (const FileFault& fault :
             {tests::eio, tests::eacces, tests::interrupted, tests::half, tests::nothing}) {
            SCOPED_TRACE(fmt::format("call {} meets {}", n, fault.name));
            disk.failAt(n, fault);
            const auto met = sampled(disk.calls());
            if (disk.faulted().empty()) continue;
            ++injected;
            EXPECT_EQ(disk.open(), 0);
            const bool mustNotMatter = fault.error == EINTR || fault.kind == FileFault::Kind::DoesHalf;
            EXPECT_TRUE(met || !mustNotMatter);
            if (met) {
                EXPECT_EQ(*met, *whole);
            } else {
                EXPECT_THAT(met.error().message, HasSubstr("earth17_"));
            }
        }
    }
    EXPECT_GT(injected, 100);
    RecordProperty("raw_faults", injected);
}

// A bake that is killed leaves a file behind. It must not open as a chunk file, although the bake has read blocks of it.
TEST_F(FailingDiskBake, nothingButTheLastWriteHasAHeader) {
    std::vector<bool> writesHeader;
    FileCalls calls = systemFileCalls();
    calls.pwrite = [&](int descriptor, const void* from, std::size_t bytes, off_t offset) {
        const auto* const begin = static_cast<const char*>(from);
        writesHeader.push_back(offset == 0 &&
                               std::any_of(begin, begin + bytes, [](char byte) { return byte != 0; }));
        return ::pwrite(descriptor, from, bytes, offset);
    };
    ASSERT_TRUE(bakeTo(path_, calls));
    ASSERT_GT(writesHeader.size(), 3u);
    EXPECT_EQ(std::ranges::count(writesHeader, true), 1);
    EXPECT_TRUE(writesHeader.back());
}

}  // namespace
}  // namespace planet
