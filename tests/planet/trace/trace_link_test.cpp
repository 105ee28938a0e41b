// What a running engine sends is in files that can be read at any time, whatever the engine, the port or the disk does.
#include "planet/trace/trace_link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "planet/trace/lod_trace.h"
#include "planet/trace/trace_index.h"
#include "planet/trace/trace_state.h"
#include "tests/support/trace_bytes.h"
#include "tests/support/trace_events.h"

namespace planet {
namespace {

using std::chrono::milliseconds;
using test::joined;
using test::OpenTrace;
using test::ReadTrace;
using test::TraceBytes;
using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using tests::contentOf;
using tests::fileCountIn;
using tests::TemporaryFolder;

// Waits until a condition holds. It gives up after a time that no machine needs.
bool holdsSoon(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(milliseconds(1));
    }
    return true;
}

sockaddr_in addressOf(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return address;
}

// A program that listens and is no engine. It listens from its construction on.
class Listener {
public:
    explicit Listener(int port = 0, int backlog = 4) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
        const int on = 1;
        setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        sockaddr_in address = addressOf(port);
        socklen_t bytes = sizeof address;
        EXPECT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), bytes), 0);
        EXPECT_EQ(listen(socket_, backlog), 0);
        EXPECT_EQ(getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &bytes), 0);
        port_ = ntohs(address.sin_port);
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;
    ~Listener() {
        hangUp();
        close(socket_);
    }
    int port() const { return port_; }

    // Takes the next connection.
    void answer() {
        hangUp();
        peer_ = accept(socket_, nullptr, nullptr);
        ASSERT_GE(peer_, 0);
    }
    // Sends in pieces of 1,000 bytes.
    void say(std::span<const std::byte> bytes) const {
        while (!bytes.empty()) {
            const ssize_t count =
                send(peer_, bytes.data(), std::min<std::size_t>(bytes.size(), 1000), MSG_NOSIGNAL);
            if (count <= 0) return;  // the link has left
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        }
    }
    void say(const std::string& text) const { say(test::bytesOf(text)); }
    void hangUp() {
        if (peer_ >= 0) close(peer_);
        peer_ = -1;
    }

private:
    int socket_;
    int peer_ = -1;
    int port_ = 0;
};

int freePort() {
    return Listener().port();
}

// A trace as an engine sends it: `frames` frames of 20 drawn nodes, in blocks of about 48 KiB.
TraceBytes traceOf(int frames) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "sent";
    OpenTrace trace(file.string());
    for (std::uint64_t id = 1; id <= 20; ++id) {
        const auto node = test::sphereNode(id);
        EXPECT_EQ(lod_trace_node(trace, &node), 1);
    }
    for (int frame = 0; frame < frames; ++frame) {
        lod_trace_frame_begin(trace, frame);
        const auto view = test::someView(frame);
        lod_trace_view(trace, 0, &view);
        for (std::uint64_t id = 1; id <= 20; ++id) lod_trace_drawn_px(trace, 0, id, 0.5f, 1.5f);
        lod_trace_frame_end(trace, 1, 1);
        // A flush ends a block.
        if (frame % 100 == 99) {
            EXPECT_EQ(lod_trace_flush(trace, 60'000), 1);
        }
    }
    trace.close();
    const std::string content = contentOf(file);
    const auto bytes = test::bytesOf(content);
    return {bytes.begin(), bytes.end()};
}

std::string textOf(const TraceBytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::vector<TraceBlock> blocksOf(const TraceBytes& bytes) {
    const TemporaryFolder folder;
    std::ofstream(folder / "t", std::ios::binary) << textOf(bytes);
    const auto file = TraceFile::open(folder / "t");
    return file ? file->blocks() : std::vector<TraceBlock>();
}

// Counts the frames of a file that are complete, and checks that none is missing in between.
struct FramesOfFile {
    std::uint64_t first = 0;
    std::uint64_t last = 0;
    std::uint64_t frames = 0;
    std::string problem;
};

FramesOfFile framesOf(const std::filesystem::path& path) {
    const std::string content = contentOf(path);
    const ReadTrace read = test::readTrace(test::bytesOf(content));
    FramesOfFile found{.problem = read.problem};
    TraceState state;
    const auto take = [&](const TraceFrame& frame) {
        if (!frame.isComplete()) return;
        if (found.frames == 0) found.first = frame.number;
        found.last = frame.number;
        ++found.frames;
    };
    for (const TraceEvent& event : read.events)
        if (state.add(event)) take(state.frame());
    return found;
}

class TraceLinks : public testing::Test {
protected:
    TraceLinkSettings settingsFor(int port) const {
        TraceLinkSettings settings;
        settings.port = port;
        settings.folder = folder.path();
        settings.retry = milliseconds(5);
        settings.slowRetry = milliseconds(20);
        settings.silentAfter = milliseconds(100);
        return settings;
    }
    static std::unique_ptr<TraceLink> started(const TraceLinkSettings& settings) {
        auto link = TraceLink::start(settings);
        EXPECT_TRUE(link) << (link ? "" : link.error().message);
        return link ? *std::move(link) : nullptr;
    }
    std::unique_ptr<TraceLink> linkTo(int port) const { return started(settingsFor(port)); }
    static testing::AssertionResult comesTo(const TraceLink& link, TraceLinkState state) {
        if (holdsSoon([&] { return link.status().state == state; })) return testing::AssertionSuccess();
        return testing::AssertionFailure() << link.status().message;
    }
    static bool hasFrames(const TraceLink& link, std::uint64_t frames) {
        return holdsSoon([&] { return link.status().file.frames >= frames; });
    }
    static bool hasBytes(const TraceLink& link, std::uint64_t bytes) {
        return holdsSoon([&] { return link.status().file.bytes >= bytes; });
    }
    // The end of a frame may lie in a later block than its beginning.
    bool completesFrames(const std::string& file, std::uint64_t frames) const {
        return holdsSoon([&] { return framesOf(folder / file).frames == frames; });
    }

    const TemporaryFolder folder;
};

// An engine of this process that draws 20 nodes in each frame.
class ListeningEngine {
public:
    explicit ListeningEngine(int port)
        : trace_(fmt::format("tcp:127.0.0.1:{}", port), {.ring_bytes = 0, .max_threads = 0, .wake_ms = 1}) {
        for (std::uint64_t id = 1; id <= 20; ++id) {
            const auto node = test::sphereNode(id);
            EXPECT_EQ(lod_trace_node(trace_, &node), 1);
        }
    }
    ListeningEngine(const ListeningEngine&) = delete;
    ListeningEngine& operator=(const ListeningEngine&) = delete;

    int port() const { return lod_trace_port(trace_); }
    lod_trace_stats stats() const { return lod_trace_get_stats(trace_); }
    void awaitTool() {
        EXPECT_TRUE(holdsSoon([&] { return lod_trace_listening(trace_) != 0; }));
    }
    // Returns once the frames were passed to the socket.
    void draw(int frames) {
        for (int i = 0; i < frames; ++i) {
            lod_trace_frame_begin(trace_, frame_++);
            const auto view = test::someView(frame_);
            lod_trace_view(trace_, 0, &view);
            for (std::uint64_t id = 1; id <= 20; ++id) lod_trace_drawn(trace_, 0, id, 0);
            lod_trace_frame_end(trace_, 1, 1);
        }
        EXPECT_EQ(lod_trace_flush(trace_, 60'000), 1);
    }

private:
    OpenTrace trace_;
    int frame_ = 0;
};

// ---- what comes is in the file ----

TEST_F(TraceLinks, theFileHasTheBytesThatCame) {
    const TraceBytes sent = traceOf(1000);
    Listener engine;
    const auto link = linkTo(engine.port());
    engine.answer();
    engine.say(sent);
    engine.hangUp();
    ASSERT_TRUE(hasBytes(*link, sent.size()));
    link->stop();
    EXPECT_EQ(contentOf(folder / "live.lodtrace"), textOf(sent));
    const TraceLinkStatus status = link->status();
    EXPECT_EQ(status.state, TraceLinkState::Ended);
    EXPECT_EQ(status.file.path, folder / "live.lodtrace");
    EXPECT_EQ(status.file.bytes, sent.size());
    EXPECT_EQ(status.file.frames, 1000u);
    EXPECT_EQ(status.file.nodes, 20u);
    EXPECT_EQ(status.file.dropped, 0u);
    EXPECT_EQ(status.bytes, sent.size());
    EXPECT_EQ(status.frames, 1000u);
    EXPECT_EQ(status.files, 1u);
    EXPECT_TRUE(status.lastByte);
    EXPECT_FALSE(status.problem) << *status.problem;
}

TEST_F(TraceLinks, countsWhatTheEngineDropped) {
    const TraceBytes node = test::bytes({3, 0, 0, 7, 0, 0, 0, 0, 0, 0, 0});
    const TraceBytes sent =
        joined({test::traceHeader(), test::traceBlock(node, test::bytes({16, 5, 16, 0x80, 1}))});
    Listener engine;
    const auto link = linkTo(engine.port());
    engine.answer();
    engine.say(sent);
    EXPECT_TRUE(comesTo(*link, TraceLinkState::Receiving));
    EXPECT_EQ(link->status().file.dropped, 133u);
    EXPECT_EQ(link->status().file.nodes, 1u);
}

TEST_F(TraceLinks, theFileCanBeReadWhileItGrows) {
    ListeningEngine engine(0);
    const auto link = linkTo(engine.port());
    engine.awaitTool();
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Receiving));
    auto file = TraceFile::open(link->status().file.path);
    ASSERT_TRUE(file) << file.error().message;
    std::uint64_t frames = 0;
    const auto count = [&](const TraceEvent& event) {
        if (std::holds_alternative<TraceFrameEnded>(event)) ++frames;
    };
    for (std::uint64_t drawn = 0; drawn < 500;) {
        engine.draw(50);
        drawn += 50;
        ASSERT_TRUE(holdsSoon([&] {
            EXPECT_TRUE(file->refresh());
            for (;;) {
                const auto next = file->next(count);
                EXPECT_TRUE(next) << next.error().message;
                if (!next || !*next) break;
            }
            return frames == drawn;
        })) << frames
            << " of " << drawn;
    }
    EXPECT_TRUE(hasFrames(*link, 500));
    EXPECT_EQ(link->status().file.frames, 500u);
}

// ---- engines come and go ----

TEST_F(TraceLinks, waitsForAnEngineThatStartsLater) {
    const int port = freePort();
    const auto link = linkTo(port);
    std::this_thread::sleep_for(milliseconds(50));
    EXPECT_EQ(link->status().state, TraceLinkState::Waiting);
    EXPECT_EQ(link->status().message,
              fmt::format("waits for an engine that listens at tcp:127.0.0.1:{}", port));
    EXPECT_EQ(fileCountIn(folder.path()), 0u);
    ListeningEngine engine(port);
    engine.awaitTool();
    engine.draw(10);
    ASSERT_TRUE(hasFrames(*link, 10));
    EXPECT_EQ(link->status().state, TraceLinkState::Receiving);
    EXPECT_TRUE(completesFrames("live.lodtrace", 10));
}

TEST_F(TraceLinks, eachConnectionHasANewFileAndNoneIsReplaced) {
    std::ofstream(folder / "live.lodtrace") << "of the user";
    std::filesystem::create_symlink("nowhere", folder / "live-3.lodtrace");
    const int port = freePort();
    const auto link = linkTo(port);
    for (const int frames : {10, 20}) {
        ListeningEngine engine(port);
        engine.awaitTool();
        engine.draw(frames);
        ASSERT_TRUE(completesFrames(frames == 10 ? "live-2.lodtrace" : "live-4.lodtrace",
                                    static_cast<std::uint64_t>(frames)));
    }
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Waiting));
    EXPECT_EQ(link->status().message,
              fmt::format("the engine at 127.0.0.1:{} left after 20 frames, which are in {}; waits for the "
                          "next one",
                          port, (folder / "live-4.lodtrace").string()));
    EXPECT_EQ(contentOf(folder / "live.lodtrace"), "of the user");
    EXPECT_FALSE(std::filesystem::exists(folder / "nowhere"));
    const std::vector<TraceLinkFile> files = link->files();
    ASSERT_EQ(files.size(), 2u);
    EXPECT_EQ(files[0].path, folder / "live-2.lodtrace");
    EXPECT_EQ(files[0].frames, 10u);
    EXPECT_EQ(files[1].path, folder / "live-4.lodtrace");
    EXPECT_EQ(link->status().frames, 30u);
    EXPECT_EQ(link->status().bytes, files[0].bytes + files[1].bytes);
    EXPECT_EQ(link->status().files, 2u);
}

TEST_F(TraceLinks, theNameOfADeletedFileIsNotUsedAgain) {
    Listener engine;
    const auto link = linkTo(engine.port());
    for (const char* name : {"live.lodtrace", "live-2.lodtrace"}) {
        engine.answer();
        engine.say(traceOf(3));
        engine.hangUp();
        EXPECT_TRUE(completesFrames(name, 3));
        std::filesystem::remove(folder / name);
    }
    EXPECT_TRUE(holdsSoon([&] { return link->files().size() == 2; }));
}

TEST_F(TraceLinks, onceEndsAfterTheFirstTrace) {
    Listener engine;
    TraceLinkSettings settings = settingsFor(engine.port());
    settings.isOnce = true;
    const auto link = started(settings);
    engine.answer();
    engine.hangUp();  // brought nothing
    engine.answer();
    engine.say(traceOf(3));
    engine.hangUp();
    EXPECT_TRUE(comesTo(*link, TraceLinkState::Ended));
    EXPECT_EQ(link->status().message, fmt::format("received 3 frames from 127.0.0.1:{}; the last file is {}",
                                                  engine.port(), (folder / "live.lodtrace").string()));
}

// The terrain of tests/trace/geomipmap_client.c, which traces itself to a port.
class TerrainEngine {
public:
    explicit TerrainEngine(int port) {
        const std::string where = fmt::format("tcp:127.0.0.1:{}", port);
        std::array<int, 2> ends{};
        EXPECT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
        posix_spawn_file_actions_t actions{};
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        const char* const arguments[] = {GEOMIPMAP_CLIENT_BINARY, where.c_str(), "none", "50", nullptr};
        if (posix_spawn(&process_, GEOMIPMAP_CLIENT_BINARY, &actions, nullptr,
                        const_cast<char* const*>(arguments), environ) != 0)
            ADD_FAILURE() << "cannot start " GEOMIPMAP_CLIENT_BINARY;
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        said_ = fdopen(ends[0], "r");
    }
    TerrainEngine(const TerrainEngine&) = delete;
    TerrainEngine& operator=(const TerrainEngine&) = delete;
    ~TerrainEngine() {
        kill();
        std::fclose(said_);
    }
    // Returns the next frame that was passed to the socket; nothing at the end.
    std::optional<std::uint64_t> nextFrame() {
        std::array<char, 80> line{};
        const std::string word = "frame ";
        if (std::fgets(line.data(), line.size(), said_) == nullptr ||
            !std::string(line.data()).starts_with(word))
            return std::nullopt;
        return std::strtoul(line.data() + word.size(), nullptr, 10);
    }
    // Returns the signal that ended it.
    int kill() {
        if (process_ <= 0) return 0;
        int status = 0;
        ::kill(process_, SIGKILL);
        waitpid(process_, &status, 0);
        process_ = -1;
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }

private:
    pid_t process_ = -1;
    FILE* said_ = nullptr;
};

TEST_F(TraceLinks, nothingThatAKilledEngineSentIsLost) {
    const int port = freePort();
    const auto link = linkTo(port);
    std::uint64_t files = 0;
    for (const char* name : {"live.lodtrace", "live-2.lodtrace"}) {
        TerrainEngine engine(port);
        std::uint64_t sent = 0;
        while (sent < 15) {
            const auto frame = engine.nextFrame();
            ASSERT_TRUE(frame);
            sent = *frame;
        }
        EXPECT_EQ(engine.kill(), SIGKILL);
        while (const auto frame = engine.nextFrame()) sent = *frame;
        ++files;
        ASSERT_TRUE(holdsSoon([&] {
            const TraceLinkStatus status = link->status();
            return status.files == files && status.state == TraceLinkState::Waiting;
        }));
        const FramesOfFile found = framesOf(folder / name);
        EXPECT_EQ(found.problem, "");
        EXPECT_EQ(found.first, 1u);
        EXPECT_GE(found.last, sent);
        EXPECT_EQ(found.frames, found.last);
        EXPECT_EQ(link->status().file.path, folder / name);
        EXPECT_EQ(link->status().file.nodes, 1025u);
    }
    EXPECT_EQ(fileCountIn(folder.path()), 2u);
}

TEST_F(TraceLinks, twoLinksToTwoEnginesStayApart) {
    ListeningEngine first(0);
    ListeningEngine second(0);
    TraceLinkSettings other = settingsFor(second.port());
    other.name = "other";
    const auto firstLink = linkTo(first.port());
    const auto secondLink = started(other);
    first.awaitTool();
    second.awaitTool();
    for (int i = 0; i < 10; ++i) {
        first.draw(10);
        second.draw(20);
    }
    EXPECT_TRUE(completesFrames("live.lodtrace", 100));
    EXPECT_TRUE(completesFrames("other.lodtrace", 200));
    EXPECT_TRUE(hasFrames(*firstLink, 100));
    EXPECT_TRUE(hasFrames(*secondLink, 200));
    EXPECT_EQ(firstLink->status().file.frames, 100u);
    EXPECT_EQ(secondLink->status().file.frames, 200u);
}

TEST_F(TraceLinks, aSecondEngineAtThePortIsTold) {
    ListeningEngine engine(0);
    const auto link = linkTo(engine.port());
    engine.awaitTool();
    std::array<char, 512> error{};
    EXPECT_EQ(lod_trace_open(fmt::format("tcp:127.0.0.1:{}", engine.port()).c_str(), nullptr, error.data(),
                             error.size()),
              nullptr);
    EXPECT_THAT(error.data(), AllOf(HasSubstr(fmt::format("{}: cannot listen: ", engine.port())),
                                    EndsWith("; expected a free port")));
    engine.draw(10);
    EXPECT_TRUE(hasFrames(*link, 10));
}

TEST_F(TraceLinks, aSecondToolIsTurnedAwayAndAttachesWhenTheFirstLeaves) {
    ListeningEngine engine(0);
    const auto first = linkTo(engine.port());
    engine.awaitTool();
    TraceLinkSettings other = settingsFor(engine.port());
    other.name = "second";
    other.silentAfter = std::chrono::hours(1);
    const auto second = started(other);
    ASSERT_TRUE(comesTo(*second, TraceLinkState::TurnedAway));
    EXPECT_EQ(second->status().message,
              fmt::format("127.0.0.1:{} closed the connection before it sent a byte: another tool is "
                          "attached to the engine, which takes one at a time, or another program listens "
                          "there; tries again",
                          engine.port()));
    engine.draw(10);
    EXPECT_TRUE(hasFrames(*first, 10));
    EXPECT_EQ(second->status().state, TraceLinkState::TurnedAway);
    EXPECT_FALSE(std::filesystem::exists(folder / "second.lodtrace"));
    first->stop();
    ASSERT_TRUE(comesTo(*second, TraceLinkState::Receiving));
    engine.draw(10);
    EXPECT_TRUE(hasFrames(*second, 10));
}

TEST_F(TraceLinks, anEngineThatSendsNothingIsSilentAndNoError) {
    ListeningEngine engine(0);
    const auto link = linkTo(engine.port());
    engine.awaitTool();
    engine.draw(10);
    ASSERT_TRUE(hasFrames(*link, 10));
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Silent));
    EXPECT_THAT(link->status().message,
                AllOf(HasSubstr("has sent nothing for "), HasSubstr("10 frames came")));
    std::this_thread::sleep_for(milliseconds(500));
    EXPECT_EQ(link->status().state, TraceLinkState::Silent);
    engine.draw(10);
    ASSERT_TRUE(hasFrames(*link, 20));
    EXPECT_EQ(link->status().files, 1u);
    EXPECT_EQ(engine.stats().connections, 1u);
}

// ---- what listens is no engine, or sends wrong bytes ----

struct AlienAnswer {
    std::string answer;
    std::string message;  // after the address
};

TEST_F(TraceLinks, anotherProgramIsNamedByItsFirstLineAndLeavesNoFile) {
    const std::string expected = "; expected an engine that traces itself with lod_trace.h";
    const std::vector<AlienAnswer> cases = {
        {"HTTP/1.1 400 Bad Request\r\nServer: some\r\n\r\n",
         ": another program listens there, which sent \"HTTP/1.1 400 Bad Request\"" + expected},
        {"220 hi", ": another program listens there, which sent \"220 hi\"" + expected},
        {std::string("LODTRUCE\0\x01\xFF", 11),
         ": another program listens there, which sent \"LODTRUCE...\"" + expected},
        {textOf(test::traceHeader(2)), ": byte 0: version: 2 is unknown; expected 1"},
        {textOf(joined({test::traceHeader(), TraceBytes(48)})),
         ": byte 16: no block begins here; expected \"LTB1\""},
        {textOf(joined({test::traceHeader(), test::traceBlockHeader(0xFFFFFFFFu, 0, 0)})),
         ": byte 16: block: 4294967295 bytes are too many; expected at most 134217728"},
    };
    for (const AlienAnswer& one : cases) {
        Listener alien;
        const auto link = linkTo(alien.port());
        for (int tries = 0; tries < 2; ++tries) {
            alien.answer();
            alien.say(one.answer);
            ASSERT_TRUE(comesTo(*link, TraceLinkState::Refused));
            EXPECT_EQ(link->status().message, fmt::format("127.0.0.1:{}{}", alien.port(), one.message));
        }
        // Once an engine listens there, its trace is taken.
        alien.answer();
        alien.say(traceOf(3));
        EXPECT_TRUE(hasFrames(*link, 3)) << link->status().message;
        link->stop();
        EXPECT_EQ(fileCountIn(folder.path()), 1u);
        std::filesystem::remove(folder / "live.lodtrace");
    }
}

TEST_F(TraceLinks, aProgramThatSaysNothingIsReportedAndLeavesNoFile) {
    Listener alien;
    const auto link = linkTo(alien.port());
    alien.answer();
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Silent));
    EXPECT_THAT(link->status().message,
                AllOf(HasSubstr(fmt::format("127.0.0.1:{} took the connection and has sent nothing for ",
                                            alien.port())),
                      HasSubstr("expected an engine that traces itself with lod_trace.h")));
    alien.say("LODT");
    EXPECT_TRUE(holdsSoon([&] {
        return link->status().message.find("has sent 4 bytes, no whole block") != std::string::npos;
    })) << link->status().message;
    alien.hangUp();
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Refused));
    EXPECT_THAT(link->status().message,
                HasSubstr("closed the connection after 4 bytes, before a block was whole"));
    link->stop();
    EXPECT_EQ(fileCountIn(folder.path()), 0u);
}

TEST_F(TraceLinks, aBlockThatNeverComesWholeLeavesNoFile) {
    Listener alien;
    const auto link = linkTo(alien.port());
    alien.answer();
    alien.say(joined({test::traceHeader(), test::traceBlockHeader(100u << 20, 0, 0)}));
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Silent));
    EXPECT_THAT(link->status().message, HasSubstr("has sent 48 bytes, no whole block"));
    link->stop();
    EXPECT_EQ(fileCountIn(folder.path()), 0u);
}

TEST_F(TraceLinks, aStreamThatIsCutOffKeepsAllThatCame) {
    const TraceBytes sent = traceOf(1000);
    const std::vector<TraceBlock> blocks = blocksOf(sent);
    ASSERT_GE(blocks.size(), 3u);
    const std::size_t whole = blocks[2].offset;
    Listener engine;
    const auto link = linkTo(engine.port());
    engine.answer();
    engine.say(std::span(sent).first(whole + 2000));
    engine.hangUp();
    ASSERT_TRUE(holdsSoon([&] { return link->status().problem.has_value(); }));
    EXPECT_EQ(*link->status().problem,
              fmt::format("127.0.0.1:{}: the stream ended 2000 bytes into a block; what came is in {}",
                          engine.port(), (folder / "live.lodtrace").string()));
    EXPECT_EQ(contentOf(folder / "live.lodtrace"), textOf(sent).substr(0, whole + 2000));
    EXPECT_EQ(link->status().file.bytes, whole + 2000);
    const std::uint64_t frames = blocks[0].header.frames + blocks[1].header.frames;
    EXPECT_GT(link->status().file.frames, frames + 1);
    // The last frame lacks its end.
    EXPECT_EQ(framesOf(folder / "live.lodtrace").frames + 1, link->status().file.frames);
}

// An engine that is killed while it sends its first block has told its nodes already.
TEST_F(TraceLinks, aStreamThatIsCutOffInItsFirstBlockIsKept) {
    const TraceBytes sent = traceOf(10);
    Listener engine;
    const auto link = linkTo(engine.port());
    engine.answer();
    engine.say(std::span(sent).first(sent.size() - 1));
    engine.hangUp();
    ASSERT_TRUE(holdsSoon([&] { return link->status().problem.has_value(); }));
    EXPECT_EQ(contentOf(folder / "live.lodtrace"), textOf(sent).substr(0, sent.size() - 1));
    EXPECT_EQ(link->status().file.nodes, 20u);
    EXPECT_EQ(link->status().file.frames, 10u);
}

TEST_F(TraceLinks, aLinkThatIsStoppedInsideABlockKeepsAllThatCame) {
    const TraceBytes sent = traceOf(1000);
    const std::size_t whole = blocksOf(sent).at(2).offset;
    Listener engine;
    const auto link = linkTo(engine.port());
    engine.answer();
    engine.say(std::span(sent).first(whole + 2000));
    ASSERT_TRUE(holdsSoon([&] { return link->status().file.bytes == whole; }));
    link->stop();
    EXPECT_EQ(link->status().file.bytes, whole + 2000);
    EXPECT_EQ(contentOf(folder / "live.lodtrace"), textOf(sent).substr(0, whole + 2000));
}

TEST_F(TraceLinks, aDamagedStreamKeepsWhatCameBeforeAndConnectsAgain) {
    const TraceBytes sent = traceOf(1000);
    const std::vector<TraceBlock> blocks = blocksOf(sent);
    ASSERT_GE(blocks.size(), 3u);
    TraceBytes damaged = sent;
    damaged[blocks[2].offset - 1] ^= std::byte{1};
    Listener engine;
    const auto link = linkTo(engine.port());
    engine.answer();
    engine.say(damaged);
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Refused));
    const std::string message = fmt::format(
        "127.0.0.1:{}: byte {}: the checksum of the block does not match; expected an undamaged "
        "trace; what came before is in {}",
        engine.port(), blocks[1].offset, (folder / "live.lodtrace").string());
    EXPECT_EQ(link->status().message, message);
    EXPECT_EQ(link->status().problem, message);
    const std::uint64_t framesBefore = blocks[0].header.frames;
    EXPECT_EQ(link->status().file.frames, framesBefore);
    engine.answer();
    engine.say(sent);
    ASSERT_TRUE(holdsSoon([&] { return link->status().bytes == sent.size() + blocks[1].offset; }));
    EXPECT_EQ(link->status().frames, 1000 + framesBefore);
    EXPECT_EQ(contentOf(folder / "live.lodtrace"), textOf(sent).substr(0, blocks[1].offset));
    EXPECT_EQ(contentOf(folder / "live-2.lodtrace"), textOf(sent));
}

// ---- the disk ----

TEST_F(TraceLinks, aFullDiskEndsTheLinkAndKeepsWholeBlocks) {
    const TraceBytes sent = traceOf(1000);
    const std::vector<TraceBlock> blocks = blocksOf(sent);
    ASSERT_GE(blocks.size(), 3u);
    Listener engine;
    TraceLinkSettings settings = settingsFor(engine.port());
    const auto room = static_cast<off_t>(blocks[2].offset + 100);  // inside a block
    settings.calls.pwrite = [room](int descriptor, const void* from, std::size_t bytes, off_t offset) {
        if (offset >= room) {
            errno = ENOSPC;
            return ssize_t{-1};
        }
        return pwrite(descriptor, from, std::min(bytes, static_cast<std::size_t>(room - offset)), offset);
    };
    const auto link = started(settings);
    engine.answer();
    engine.say(sent);
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Failed));
    const std::string file = (folder / "live.lodtrace").string();
    EXPECT_EQ(
        link->status().message,
        fmt::format("{}: writing failed: No space left on device; what came before is in {}", file, file));
    EXPECT_EQ(contentOf(file), textOf(sent).substr(0, blocks[2].offset));
    EXPECT_EQ(link->status().file.bytes, blocks[2].offset);
    link->stop();
    EXPECT_EQ(link->status().state, TraceLinkState::Failed);
}

TEST_F(TraceLinks, aDiskWithoutRoomForABlockKeepsNoFile) {
    Listener engine;
    TraceLinkSettings settings = settingsFor(engine.port());
    settings.calls.pwrite = [](int descriptor, const void* from, std::size_t bytes, off_t offset) {
        if (bytes <= traceHeaderBytes) return pwrite(descriptor, from, bytes, offset);
        errno = ENOSPC;
        return ssize_t{-1};
    };
    const auto link = started(settings);
    engine.answer();
    engine.say(traceOf(10));
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Failed));
    EXPECT_EQ(link->status().message, fmt::format("{}: writing failed: No space left on device",
                                                  (folder / "live.lodtrace").string()));
    EXPECT_EQ(fileCountIn(folder.path()), 0u);
}

TEST_F(TraceLinks, aFolderThatIsGoneIsAnError) {
    Listener engine;
    TraceLinkSettings settings = settingsFor(engine.port());
    settings.folder = folder / "gone";
    std::filesystem::create_directory(settings.folder);
    const auto link = started(settings);
    std::filesystem::remove(settings.folder);
    engine.answer();
    engine.say(traceOf(10));
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Failed));
    EXPECT_EQ(
        link->status().message,
        fmt::format("{}: cannot be created: No such file or directory; expected a folder that can be written",
                    (settings.folder / "live.lodtrace").string()));
}

// ---- settings, and the end ----

TEST_F(TraceLinks, wrongSettingsAreNamed) {
    const auto errorOf = [](const TraceLinkSettings& settings) {
        const auto link = TraceLink::start(settings);
        return link ? std::string() : link.error().message;
    };
    for (const int port : {-1, 0, 65536})
        EXPECT_EQ(errorOf(settingsFor(port)),
                  fmt::format("port: {} is out of range; expected one in [1, 65535]", port));
    TraceLinkSettings settings = settingsFor(1);
    settings.folder = folder / "none";
    EXPECT_EQ(errorOf(settings),
              (folder / "none").string() + ": is no folder; expected one to write traces into");
    settings = settingsFor(1);
    for (const char* name : {"", "a/b"}) {
        settings.name = name;
        EXPECT_EQ(
            errorOf(settings),
            fmt::format("name of the traces: \"{}\" is no file name; expected one without \"/\"", name));
    }
}

TEST_F(TraceLinks, aFolderThatCannotBeWrittenIsNamed) {
    if (geteuid() == 0) GTEST_SKIP() << "the superuser writes into any folder";
    std::filesystem::permissions(folder.path(),
                                 std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    const auto link = TraceLink::start(settingsFor(1));
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
    ASSERT_FALSE(link);
    EXPECT_THAT(link.error().message, HasSubstr("cannot be written"));
}

// Each of these would hang if a wait did not end.
TEST_F(TraceLinks, stopsWhileItWaits) {
    TraceLinkSettings settings = settingsFor(freePort());
    settings.retry = std::chrono::hours(1);
    const auto link = started(settings);
    link->stop();
    EXPECT_EQ(link->status().state, TraceLinkState::Ended);
    EXPECT_EQ(link->status().message, fmt::format("no trace came from 127.0.0.1:{}", settings.port));
}

TEST_F(TraceLinks, stopsWhileItConnects) {
    // The queue of the listener is full, so the system lets a further connection wait.
    const Listener busy(0, 0);
    std::vector<int> queued;
    for (int i = 0; i < 4; ++i) {
        queued.push_back(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
        const sockaddr_in address = addressOf(busy.port());
        EXPECT_LE(connect(queued.back(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    }
    TraceLinkSettings settings = settingsFor(busy.port());
    const auto late = started(settings);
    EXPECT_TRUE(holdsSoon([&] {
        return late->status().message.find("does not take the connection") != std::string::npos;
    })) << late->status().message;
    settings.silentAfter = std::chrono::hours(1);
    const auto link = started(settings);
    std::this_thread::sleep_for(milliseconds(20));
    link->stop();
    EXPECT_EQ(link->status().state, TraceLinkState::Ended);
    for (const int one : queued) close(one);
}

TEST_F(TraceLinks, stopsWhileItReceives) {
    ListeningEngine engine(0);
    const auto link = linkTo(engine.port());
    engine.awaitTool();
    std::atomic<bool> isDone = false;
    std::thread drawing([&] {
        while (!isDone) engine.draw(1);
    });
    ASSERT_TRUE(hasFrames(*link, 10));
    std::thread other([&] { link->stop(); });
    link->stop();
    other.join();
    isDone = true;
    drawing.join();
    const FramesOfFile found = framesOf(folder / "live.lodtrace");
    EXPECT_EQ(found.problem, "");
    EXPECT_LE(found.frames, link->status().file.frames);
    EXPECT_GE(found.frames + 1, link->status().file.frames);  // the last one may lack its end
}

TEST_F(TraceLinks, stopsWhileNothingComes) {
    Listener alien;
    TraceLinkSettings settings = settingsFor(alien.port());
    settings.silentAfter = std::chrono::hours(1);
    const auto link = started(settings);
    alien.answer();
    ASSERT_TRUE(comesTo(*link, TraceLinkState::Connected));
    link->stop();
    EXPECT_EQ(link->status().state, TraceLinkState::Ended);
}

}  // namespace
}  // namespace planet
