// worldy attach: what a running engine sends is in files, and the exit code says whether a trace came.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "planet/trace/lod_trace.h"
#include "planet/trace/trace_index.h"
#include "tests/program/run_program.h"

namespace worldy {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

// Waits until a condition holds. It gives up after a time that no machine needs.
bool holdsInTime(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

// An engine of this process. It draws `frames` frames once a tool is attached, and then leaves unless it stays.
class TracedEngine {
public:
    TracedEngine(int frames, bool stays) : trace_(lod_trace_open("tcp:127.0.0.1:0", nullptr, nullptr, 0)) {
        EXPECT_NE(trace_, nullptr);
        port_ = lod_trace_port(trace_);
        thread_ = std::thread([this, frames, stays] { run(frames, stays); });
    }
    TracedEngine(const TracedEngine&) = delete;
    TracedEngine& operator=(const TracedEngine&) = delete;
    ~TracedEngine() {
        isOver_ = true;
        thread_.join();
    }
    int port() const { return port_; }
    // Returns how many frames were passed to the socket.
    int sent() const { return sent_; }

private:
    void run(int frames, bool stays) {
        while (!isOver_ && !lod_trace_listening(trace_))
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        for (int frame = 0; !isOver_ && frame < frames; ++frame) {
            lod_trace_frame_begin(trace_, frame);
            lod_trace_drawn(trace_, 0, 7, 0);
            lod_trace_frame_end(trace_, 1, 1);
            if (lod_trace_flush(trace_, 60'000) == 1) ++sent_;
        }
        while (stays && !isOver_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        lod_trace_close(trace_);
    }

    lod_trace* trace_;
    int port_ = 0;
    std::atomic<bool> isOver_ = false;
    std::atomic<int> sent_ = 0;
    std::thread thread_;
};

// worldy attach, as a process of its own that gets signals.
class RunningAttach {
public:
    RunningAttach(const TemporaryFolder& folder, const std::string& arguments) {
        const std::string command = "cd '" + folder.path().string() +
                                    "' && exec '" WORLDY_BINARY "' attach " + arguments +
                                    " >.stdout 2>.stderr";
        const char* const words[] = {"sh", "-c", command.c_str(), nullptr};
        if (::posix_spawn(&process_, "/bin/sh", nullptr, nullptr, const_cast<char* const*>(words), environ) !=
            0)
            ADD_FAILURE() << "cannot start the shell";
    }
    RunningAttach(const RunningAttach&) = delete;
    RunningAttach& operator=(const RunningAttach&) = delete;
    ~RunningAttach() { end(SIGKILL); }
    // Sends a signal. Returns the exit code, or 128 + the signal that ended it.
    int end(int signal) {
        if (process_ <= 0) return -1;
        int status = 0;
        ::kill(process_, signal);
        ::waitpid(process_, &status, 0);
        process_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

private:
    pid_t process_ = -1;
};

std::uint64_t framesIn(const fs::path& file) {
    const auto trace = planet::TraceFile::open(file);
    if (!trace) return 0;
    EXPECT_FALSE(trace->problem()) << *trace->problem();
    const auto frames = trace->frames();
    return frames ? frames->last - frames->first + 1 : 0;
}

TEST(AttachCommand, onceWritesTheTraceUntilTheEngineLeaves) {
    const TemporaryFolder folder;
    const TracedEngine engine(50, false);
    const Ran ran = runWorldy(folder, fmt::format("attach {} --once --out made.lodtrace", engine.port()));
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_THAT(ran.output, HasSubstr("made.lodtrace: 50 frames, 1 node, "));
    EXPECT_THAT(ran.errors, HasSubstr(fmt::format("receives from 127.0.0.1:{} into ", engine.port())));
    EXPECT_EQ(framesIn(folder / "made.lodtrace"), 50u);
    const Ran summed = runWorldy(folder, "trace made.lodtrace --json");
    EXPECT_EQ(summed.exitCode, 0) << summed.errors;
    EXPECT_EQ(json::parse(summed.output)["frames"], 50);
}

TEST(AttachCommand, aFolderGetsFilesByThePortAndTheReportListsThem) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "traces");
    const TracedEngine engine(50, false);
    const Ran ran = runWorldy(folder, fmt::format("attach {} --once --json -o traces", engine.port()));
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    const json report = json::parse(ran.output);
    const std::string file = fmt::format("traces/engine-{}.lodtrace", engine.port());
    ASSERT_EQ(report["trace"].size(), 1u);
    EXPECT_EQ(report["trace"][0]["file"], file);
    EXPECT_EQ(report["trace"][0]["frames"], 50);
    EXPECT_EQ(report["trace"][0]["dropped_events"], 0);
    EXPECT_EQ(report["trace"][0]["bytes"], fs::file_size(folder / file));
    EXPECT_EQ(report["frames"], 50);
    EXPECT_EQ(report["port"], engine.port());
    EXPECT_TRUE(report["problem"].is_null());
}

TEST(AttachCommand, endsAfterTheTimeWhileTheEngineRunsOn) {
    const TemporaryFolder folder;
    const TracedEngine engine(1'000'000, true);
    const Ran ran = runWorldy(folder, fmt::format("attach {} --seconds 2", engine.port()));
    EXPECT_EQ(ran.exitCode, 0) << ran.errors;
    EXPECT_GT(framesIn(folder / fmt::format("engine-{}.lodtrace", engine.port())), 0u);
}

TEST(AttachCommand, endsOrderlyWhenItIsInterrupted) {
    const TemporaryFolder folder;
    const TracedEngine engine(20, true);
    RunningAttach attach(folder, fmt::format("{} --out made.lodtrace", engine.port()));
    ASSERT_TRUE(holdsInTime([&] { return framesIn(folder / "made.lodtrace") == 20; }));
    EXPECT_EQ(attach.end(SIGINT), 0);
    EXPECT_THAT(contentOf(folder / ".stdout"), HasSubstr("made.lodtrace: 20 frames"));
}

TEST(AttachCommand, aKilledOneLeavesAValidFileOfWhatCame) {
    const TemporaryFolder folder;
    const TracedEngine engine(1'000'000, true);
    RunningAttach attach(folder, fmt::format("{} --out made.lodtrace", engine.port()));
    ASSERT_TRUE(holdsInTime([&] {
        std::error_code ignored;
        return fs::file_size(folder / "made.lodtrace", ignored) + 1 > 20'000;
    }));
    EXPECT_EQ(attach.end(SIGKILL), 128 + SIGKILL);
    const std::uint64_t frames = framesIn(folder / "made.lodtrace");
    EXPECT_GT(frames, 10u);
    EXPECT_LE(frames, static_cast<std::uint64_t>(engine.sent()) + 1);
    const Ran summed = runWorldy(folder, "trace made.lodtrace --json");
    EXPECT_EQ(summed.exitCode, 0) << summed.errors;
    EXPECT_EQ(json::parse(summed.output)["missing_frames"], 0);
}

TEST(AttachCommand, exitsWithOneIfNoTraceCame) {
    const TemporaryFolder folder;
    int port = 0;
    {
        const TracedEngine engine(0, false);
        port = engine.port();
    }
    const Ran ran = runWorldy(folder, fmt::format("attach {} --seconds 0.1", port));
    EXPECT_EQ(ran.exitCode, 1);
    EXPECT_THAT(ran.errors, HasSubstr(fmt::format(
                                "worldy: waits for an engine that listens at tcp:127.0.0.1:{}\n", port)));
    EXPECT_THAT(ran.errors, HasSubstr(fmt::format("worldy: no trace came from 127.0.0.1:{}\n", port)));
    EXPECT_EQ(ran.output, "");
}

TEST(AttachCommand, replacesNoFile) {
    const TemporaryFolder folder;
    std::ofstream(folder / "made.lodtrace") << "of the user";
    const Ran ran = runWorldy(folder, "attach 9910 --out made.lodtrace");
    EXPECT_EQ(ran.exitCode, 2);
    EXPECT_EQ(ran.errors,
              "worldy: made.lodtrace: exists already, and no trace is replaced; expected a new name\n");
    EXPECT_EQ(contentOf(folder / "made.lodtrace"), "of the user");
}

}  // namespace
}  // namespace worldy
