// Bakes that are killed, over an older file: at random moments, and at random sizes of what they have
// written, so that every phase is hit however fast the machine is.
#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "planet/format/chunk_file.h"
#include "tests/program/run_program.h"
#include "tests/program/small_planet.h"
#include "tests/support/sanitized.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;
using Clock = std::chrono::steady_clock;

constexpr int killsByTime = 26, killsBySize = 16, killsAtTheEnd = 8;
constexpr const char* bakeOptions = "--face-size 129 --chunk-size 17 --colour map.ppm --colour-face-size 257";

std::uint64_t sizeOf(const fs::path& file) {
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::vector<std::string> namesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

// Leaves out what the thread sanitizer's runtime makes in the folder of temporary files before main() begins
// and removes at once: a kill in between leaves it there.
std::vector<std::string> temporaryNamesIn(const fs::path& folder) {
    std::vector<std::string> names = namesIn(folder);
    if (tests::sanitized)
        std::erase_if(names, [](const std::string& name) { return name.starts_with("tsan.rodata."); });
    return names;
}

void writeMap(const fs::path& file) {
    std::ofstream stream(file, std::ios::binary);
    stream << "P6\n64 32\n255\n";
    for (int i = 0; i < 64 * 32 * 3; ++i) stream.put(static_cast<char>(i * 37 % 251));
}

// worldy bake, as a process of its own that can be killed.
class RunningBake {
public:
    explicit RunningBake(const TemporaryFolder& folder) {
        const std::string home = folder.path().string();
        const std::string command = "cd '" + home + "' && export TMPDIR='" + home +
                                    "/tmp' && exec '" WORLDY_BINARY
                                    "' bake noise:ridged,seed=2 -o out/a.chk " +
                                    bakeOptions + " >/dev/null 2>&1";
        const char* const arguments[] = {"sh", "-c", command.c_str(), nullptr};
        if (::posix_spawn(&process_, "/bin/sh", nullptr, nullptr, const_cast<char* const*>(arguments),
                          environ) != 0)
            throw std::runtime_error("cannot start");
    }
    RunningBake(const RunningBake&) = delete;
    RunningBake& operator=(const RunningBake&) = delete;
    ~RunningBake() { kill(); }

    bool hasEnded() {
        if (process_ < 0) return true;
        if (::waitpid(process_, nullptr, WNOHANG) != process_) return false;
        process_ = -1;
        return true;
    }
    void kill() {
        if (hasEnded()) return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
        process_ = -1;
    }

private:
    pid_t process_ = -1;
};

class KilledBake : public testing::Test {
protected:
    void SetUp() override {
        writeMap(folder_ / "map.ppm");
        fs::create_directories(folder_ / "out");
        fs::create_directories(folder_ / "tmp");
        const auto bake = [&](const std::string& source, const std::string& output) {
            const Ran ran = runWorldy(folder_, "bake " + source + " -o " + output + " " + bakeOptions);
            ASSERT_EQ(ran.exitCode, 0) << ran.errors;
            const Ran verified = runWorldy(folder_, "verify " + output);
            ASSERT_EQ(verified.exitCode, 0) << verified.errors;
        };
        bake("noise:ridged,seed=1", "old.chk");
        bake("noise:ridged,seed=2", "new.chk");
        old_ = contentOf(folder_ / "old.chk");
        new_ = contentOf(folder_ / "new.chk");
        ASSERT_NE(old_, new_);
        const planet::ChunkFile baked = planet::ChunkFile::open(folder_ / "new.chk").value();
        for (const planet::BlockLocation& root : baked.info().roots)
            heightsEnd_ = std::max(heightsEnd_, root.offset + root.size);
        putOldBack();
    }

    void putOldBack() { std::ofstream(file_, std::ios::binary | std::ios::trunc) << old_; }

    // The old file or the new one is there, whole, and nothing else can be taken for one.
    void expectWhole(int kill) {
        SCOPED_TRACE(fmt::format("kill {}", kill));
        const std::string content = contentOf(file_);
        const bool isNew = content == new_;
        ASSERT_TRUE(isNew || content == old_);
        const std::string part = contentOf(part_);
        const bool hasPart = fs::exists(part_);
        ++phases_[isNew                       ? "renamed"
                  : !hasPart                  ? "not begun"
                  : part.size() <= 512        ? "heights not written yet"
                  : part == new_              ? "about to be renamed"
                  : part.size() < heightsEnd_ ? "writing heights"
                  : part.size() < new_.size() ? "writing colours"
                                              : "without its header"];
        const std::vector<std::string> names = namesIn(folder_ / "out");
        if (hasPart)
            EXPECT_THAT(names, ElementsAre(".a.chk.part", "a.chk"));
        else
            EXPECT_THAT(names, ElementsAre("a.chk"));
        EXPECT_THAT(temporaryNamesIn(folder_ / "tmp"), IsEmpty());
        if (hasPart && part != new_) {
            EXPECT_FALSE(planet::ChunkFile::open(part_))
                << part.size() << " of " << new_.size() << " bytes, " << sizeOf(part_) << " now";
        }
        if (isNew) putOldBack();
    }

    void expectTheNextBakeCleansUp() {
        RunningBake bake(folder_);
        while (!bake.hasEnded()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        EXPECT_EQ(contentOf(file_), new_);
        EXPECT_THAT(namesIn(folder_ / "out"), ElementsAre("a.chk"));
        EXPECT_THAT(temporaryNamesIn(folder_ / "tmp"), IsEmpty());
        putOldBack();
    }

    // Waits until the bake has written so much; what an earlier one left must be gone.
    void waitForSize(RunningBake& bake, std::uint64_t bytes) {
        while (!bake.hasEnded() && sizeOf(part_) < bytes)
            std::this_thread::sleep_for(std::chrono::microseconds(100));
    }

    const TemporaryFolder folder_;
    const fs::path file_ = folder_ / "out/a.chk";
    const fs::path part_ = folder_ / "out/.a.chk.part";
    std::string old_;
    std::string new_;
    std::uint64_t heightsEnd_ = 0;
    std::map<std::string, int> phases_;
};

TEST_F(KilledBake, AtFiftyMomentsLeavesTheOldFileOrTheNewOneWhole) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> share(0, 1);
    const Clock::time_point start = Clock::now();
    expectTheNextBakeCleansUp();
    const std::chrono::duration<double> whole = Clock::now() - start;
    int kills = 0;
    for (int i = 0; i < killsByTime; ++i) {
        RunningBake bake(folder_);
        std::this_thread::sleep_for(share(random) * 1.05 * whole);
        bake.kill();
        expectWhole(++kills);
        if (HasFatalFailure()) return;
    }
    expectTheNextBakeCleansUp();
    for (int i = 0; i < killsBySize; ++i) {
        fs::remove(part_);
        RunningBake bake(folder_);
        waitForSize(bake, static_cast<std::uint64_t>(share(random) * static_cast<double>(new_.size())));
        bake.kill();
        expectWhole(++kills);
        if (HasFatalFailure()) return;
    }
    expectTheNextBakeCleansUp();
    for (int i = 0; i < killsAtTheEnd; ++i) {
        fs::remove(part_);
        RunningBake bake(folder_);
        waitForSize(bake, new_.size());
        std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(share(random) * 4000)));
        bake.kill();
        expectWhole(++kills);
        if (HasFatalFailure()) return;
    }
    expectTheNextBakeCleansUp();
    EXPECT_EQ(kills, 50);
    EXPECT_GT(phases_["writing heights"] + phases_["heights not written yet"], 0);
    EXPECT_GT(phases_["writing colours"], 0);
    for (const auto& [phase, count] : phases_) {
        RecordProperty(phase, count);
        fmt::print("killed: {} x {}\n", phase, count);
    }
}

}  // namespace
}  // namespace worldy
