// Seeking reads headers and definitions only, and gives the same frames as reading from the start.
#include "planet/trace/trace_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "planet/trace/trace_reading.h"
#include "tests/support/trace_bytes.h"
#include "tests/support/trace_events.h"

namespace planet {
namespace {

using tests::TemporaryFolder;

constexpr int frameCount = 2000;
constexpr std::uint64_t nodeCount = 3000;

// Writes a flight in which nodes become known, change and are paged over time.
void writeFlight(const std::filesystem::path& file) {
    test::OpenTrace trace(file.string(), {.ring_bytes = 4u << 20, .max_threads = 1, .wake_ms = 1});
    for (int frame = 0; frame < frameCount; ++frame) {
        const auto at = static_cast<std::uint64_t>(frame);
        auto node = test::sphereNode(at);
        lod_trace_node(trace, &node);
        node.id = at / 2;
        node.error = frame;
        if (frame % 100 == 0) lod_trace_node(trace, &node);
        if (frame % 50 == 0) lod_trace_setting(trace, LOD_TRACE_TAU, frame);
        lod_trace_frame_begin(trace, frame);
        const auto view = test::someView(frame);
        lod_trace_view(trace, 0, &view);
        lod_trace_requested(trace, at, 0, 1);
        if (frame >= 10) lod_trace_arrived(trace, at - 10, 0);
        for (std::uint64_t i = 0; i < 200; ++i)
            lod_trace_drawn(trace, 0, (at * 7 + i * 13) % nodeCount, 0.5f);
        lod_trace_frame_end(trace, 1, 1);
        if (frame % 20 == 19) lod_trace_flush(trace, 10'000);
    }
}

// The frame's numbers and the state at its end, in short.
struct Summary {
    std::uint64_t frame = 0;
    double eyeX = 0, tau = 0, errors = 0;
    std::size_t drawn = 0, requested = 0, resident = 0;
    std::vector<std::uint64_t> ids;
    bool operator==(const Summary&) const = default;
};

Summary summaryOf(const TraceState& state) {
    Summary summary;
    summary.frame = state.frame().number;
    summary.tau = state.setting("tau", 0).value_or(-1);
    for (const TraceNodeState& node : state.nodes()) {
        if (node.node.isTold) summary.errors += node.node.error;
        if (node.data[0].data == TraceData::Requested) ++summary.requested;
        if (node.data[0].data == TraceData::Resident) ++summary.resident;
    }
    for (const TraceFrameView& view : state.frame().views) {
        if (view.info) summary.eyeX = view.info->eye.x;
        for (const TraceDrawn& drawn : view.drawn) summary.ids.push_back(state.nodes()[drawn.node].node.id);
    }
    return summary;
}

// Seeks, and goes on to the frame. Returns nothing if it is not there.
std::optional<Summary> summaryAt(TraceFile& file, TraceState& state, std::uint64_t frame) {
    std::optional<Summary> found;
    const auto sink = [&](const TraceEvent& event) {
        if (state.add(event) && state.frame().number == frame) found = summaryOf(state);
    };
    EXPECT_TRUE(file.seek(frame, sink));
    while (!found) {
        const auto more = file.next(sink);
        EXPECT_TRUE(more);
        if (!more || !*more) break;
    }
    return found;
}

class TraceFlight : public testing::Test {
protected:
    static void SetUpTestSuite() {
        folder_ = new TemporaryFolder;
        writeFlight(path());
    }
    static void TearDownTestSuite() {
        delete folder_;
        folder_ = nullptr;
    }
    static std::filesystem::path path() { return *folder_ / "flight.lodtrace"; }
    static TemporaryFolder* folder_;
};
TemporaryFolder* TraceFlight::folder_ = nullptr;

TEST_F(TraceFlight, hasKeysAndAllFrames) {
    const auto file = TraceFile::open(path());
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_FALSE(file->problem());
    ASSERT_TRUE(file->frames());
    EXPECT_EQ(file->frames()->first, 1u);
    EXPECT_EQ(file->frames()->last, static_cast<std::uint64_t>(frameCount));
    const auto keys = std::count_if(file->blocks().begin(), file->blocks().end(),
                                    [](const TraceBlock& block) { return block.header.isKey; });
    EXPECT_GE(keys, frameCount / 256);
    EXPECT_GT(file->blocks().size(), static_cast<std::size_t>(keys));
}

TEST_F(TraceFlight, seekingGivesTheSameStateAsReadingFromTheStart) {
    std::vector<Summary> played;
    TraceState state;
    const std::string content = tests::contentOf(path());
    TraceReader reader("flight", [&](const TraceEvent& event) {
        if (state.add(event)) played.push_back(summaryOf(state));
    });
    ASSERT_TRUE(reader.feed(test::bytesOf(content)));
    ASSERT_TRUE(reader.finish());
    ASSERT_EQ(played.size(), static_cast<std::size_t>(frameCount));
    EXPECT_EQ(played[1500].requested, 10u);
    EXPECT_EQ(played[1500].resident, 1491u);
    EXPECT_EQ(played[1500].tau, 1500);

    auto file = TraceFile::open(path());
    ASSERT_TRUE(file);
    TraceState sought;
    // Forwards, backwards, near and far.
    for (const std::uint64_t frame : {1u, 2u, 1999u, 3u, 700u, 701u, 1300u, 1290u, 256u, 257u, 2000u, 1u})
        EXPECT_EQ(summaryAt(*file, sought, frame), played[frame - 1]) << frame;
    EXPECT_FALSE(summaryAt(*file, sought, 2001));
}

// Counts the bytes that opening and seeking read.
TEST_F(TraceFlight, openingAndSeekingReadASmallPart) {
    std::size_t read = 0;
    FileCalls calls = systemFileCalls();
    calls.pread = [&, pread = calls.pread](int descriptor, void* out, std::size_t bytes, off_t offset) {
        read += bytes;
        return pread(descriptor, out, bytes, offset);
    };
    auto file = TraceFile::open(path(), calls);
    ASSERT_TRUE(file);
    EXPECT_EQ(read, traceHeaderBytes + file->blocks().size() * traceBlockHeaderBytes);
    std::size_t definitions = 0;
    for (const TraceBlock& block : file->blocks()) definitions += block.header.definitionBytes;
    read = 0;
    const auto ignore = [](const TraceEvent&) {};
    ASSERT_TRUE(file->seek(frameCount, ignore));
    EXPECT_LE(read, definitions);
    read = 0;
    ASSERT_TRUE(file->seek(frameCount, ignore));
    EXPECT_EQ(read, 0u);
}

TEST_F(TraceFlight, aTruncatedFileKeepsTheBlocksBefore) {
    const TemporaryFolder folder;
    const std::filesystem::path cut = folder / "cut.lodtrace";
    const std::string content = tests::contentOf(path());
    const auto whole = TraceFile::open(path());
    ASSERT_TRUE(whole);
    const TraceBlock& last = whole->blocks().back();
    for (const std::size_t size : {content.size() - 1, static_cast<std::size_t>(last.offset) + 20}) {
        std::ofstream(cut, std::ios::binary).write(content.data(), static_cast<std::streamsize>(size));
        const auto file = TraceFile::open(cut);
        ASSERT_TRUE(file);
        EXPECT_EQ(file->blocks().size() + 1, whole->blocks().size());
        ASSERT_TRUE(file->problem());
        EXPECT_EQ(*file->problem(), cut.string() + ": byte " + std::to_string(last.offset) +
                                        ": the trace ends " + std::to_string(size - last.offset) +
                                        " bytes into a block; what came before is valid");
    }
}

// The stream reader is the measure: it gives all events that are whole.
TEST(TraceFile, whatCameBeforeTheCutIsReadAtEveryByte) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "whole.lodtrace", cut = folder / "cut.lodtrace";
    {
        test::OpenTrace trace(path.string());
        for (std::uint64_t frame = 1; frame <= 6; ++frame) {
            const auto node = test::sphereNode(frame);
            lod_trace_node(trace, &node);
            lod_trace_frame_begin(trace, static_cast<double>(frame));
            const auto view = test::someView(static_cast<double>(frame));
            lod_trace_view(trace, 0, &view);
            lod_trace_drawn(trace, 0, frame, 0.5f);
            lod_trace_frame_end(trace, 1, 1);
            if (frame % 2 == 0) lod_trace_flush(trace, 10'000);
        }
    }
    const std::string content = tests::contentOf(path);
    for (std::size_t size = traceHeaderBytes; size < content.size(); ++size) {
        std::ofstream(cut, std::ios::binary).write(content.data(), static_cast<std::streamsize>(size));
        auto file = TraceFile::open(cut);
        ASSERT_TRUE(file) << file.error().message;
        std::vector<TraceEvent> events;
        const auto sink = [&](const TraceEvent& event) { events.push_back(event); };
        const auto end = readTrace(*file, {}, sink);
        ASSERT_TRUE(end);
        EXPECT_FALSE(end->isDamaged);
        ASSERT_FALSE(events.empty());
        events.erase(events.begin());  // TraceRestarted
        const test::ReadTrace streamed = test::readTrace(test::bytesOf(content.substr(0, size)));
        ASSERT_EQ(events, streamed.events) << size;
        // Once only, and again after a seek.
        EXPECT_EQ(file->nextCut(sink), false);
        EXPECT_EQ(file->next(sink), false);
        std::vector<TraceEvent> again;
        ASSERT_TRUE(readTrace(*file, {}, [&](const TraceEvent& event) { again.push_back(event); }));
        EXPECT_EQ(again.size(), events.size() + 1);
    }
}

// The file may be opened while its last block is being written.
TEST(TraceFile, aCutBlockThatBecomesWholeIsReadAfterASeek) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "whole.lodtrace", cut = folder / "cut.lodtrace";
    {
        test::OpenTrace trace(path.string());
        const auto node = test::sphereNode(1);
        lod_trace_node(trace, &node);
        lod_trace_frame_begin(trace, 1);
        lod_trace_frame_end(trace, 1, 1);
    }
    const std::string content = tests::contentOf(path);
    std::ofstream growing(cut, std::ios::binary);
    growing << content.substr(0, content.size() - 2) << std::flush;
    auto file = TraceFile::open(cut);
    ASSERT_TRUE(file);
    std::size_t frames = 0;
    const auto sink = [&](const TraceEvent& event) {
        frames += std::holds_alternative<TraceFrameEnded>(event);
    };
    ASSERT_TRUE(readTrace(*file, {}, sink));
    EXPECT_EQ(frames, 0u);
    growing << content.substr(content.size() - 2) << std::flush;
    ASSERT_TRUE(file->refresh());
    EXPECT_FALSE(file->problem());
    EXPECT_EQ(file->next(sink), false);
    ASSERT_TRUE(file->seek(0, sink));
    EXPECT_EQ(file->next(sink), true);
    EXPECT_EQ(frames, 1u);
}

TEST_F(TraceFlight, aDamagedBlockIsAnErrorAndSeekingGoesOn) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "damaged.lodtrace";
    std::string content = tests::contentOf(TraceFlight::path());
    const auto whole = TraceFile::open(TraceFlight::path());
    ASSERT_TRUE(whole);
    const TraceBlock& block = whole->blocks()[1];
    // The last byte of the second block is an event's, so the definitions stay whole.
    content[block.offset + traceBlockHeaderBytes + block.header.bytes - 1] ^= 1;
    std::ofstream(path, std::ios::binary) << content;
    auto file = TraceFile::open(path);
    ASSERT_TRUE(file);
    const auto ignore = [](const TraceEvent&) {};
    ASSERT_TRUE(file->seek(1, ignore));
    EXPECT_EQ(file->next(ignore), true);
    const auto failed = file->next(ignore);
    ASSERT_FALSE(failed);
    EXPECT_EQ(failed.error().message,
              path.string() + ": byte " + std::to_string(block.offset) +
                  ": the checksum of the block does not match; expected an undamaged trace");
    TraceState state;
    EXPECT_TRUE(summaryAt(*file, state, frameCount));
}

TEST(TraceFile, errorsNameTheFile) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "notes.txt";
    EXPECT_FALSE(TraceFile::open(path));
    std::ofstream(path) << "notes";
    EXPECT_EQ(TraceFile::open(path).error().message,
              path.string() + ": byte 0: 5 bytes are no trace; expected a file that lod_trace.h wrote");
    std::ofstream(path) << "notes, but longer than the header of a trace";
    EXPECT_EQ(TraceFile::open(path).error().message,
              path.string() + ": byte 0: is no trace; expected a file that lod_trace.h wrote");
}

TEST(TraceFile, followsAFileThatGrows) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "live.lodtrace";
    test::OpenTrace trace(path.string());
    const auto draw = [&](int frame) {
        lod_trace_frame_begin(trace, frame);
        lod_trace_frame_end(trace, 1, 1);
        lod_trace_flush(trace, 10'000);
    };
    draw(0);
    auto file = TraceFile::open(path);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->frames()->last, 1u);
    std::size_t frames = 0;
    const auto sink = [&](const TraceEvent& event) {
        frames += std::holds_alternative<TraceFrameEnded>(event);
    };
    ASSERT_TRUE(file->seek(1, sink));
    while (file->next(sink).value()) continue;
    EXPECT_EQ(frames, 1u);
    draw(1);
    draw(2);
    ASSERT_TRUE(file->refresh());
    EXPECT_EQ(file->frames()->last, 3u);
    while (file->next(sink).value()) continue;
    EXPECT_EQ(frames, 3u);
}

TEST(TraceFile, countsFramesAlsoIfBlocksBeginInsideThem) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "made.lodtrace";
    test::OpenTrace trace(path.string());
    lod_trace_setting(trace, LOD_TRACE_TAU, 1);
    for (int frame = 1; frame <= 3; ++frame) {
        lod_trace_flush(trace, 10'000);
        lod_trace_frame_begin(trace, frame);
        lod_trace_flush(trace, 10'000);
        lod_trace_drawn(trace, 0, 1, 0);
        lod_trace_frame_end(trace, 1, 1);
        if (frame == 2) lod_trace_setting(trace, LOD_TRACE_TAU, 2);
        lod_trace_flush(trace, 10'000);
        const auto file = TraceFile::open(path);
        ASSERT_TRUE(file);
        ASSERT_TRUE(file->frames());
        EXPECT_EQ(file->frames()->first, 1u);
        EXPECT_EQ(file->frames()->last, static_cast<std::uint64_t>(frame));
    }
    const auto inside = [&] {
        const auto file = TraceFile::open(path);
        return std::count_if(file->blocks().begin(), file->blocks().end(),
                             [](const TraceBlock& block) { return block.header.isInside; });
    };
    EXPECT_GE(inside(), 3);
}

// Ten gigabytes of frames as a file with holes: only headers and a few blocks are there.
TEST(TraceFile, aFileOfTenGigabytesOpensAndSeeksAtOnce) {
    constexpr std::uint32_t blockBytes = 100u << 20;
    constexpr std::uint64_t blocks = 103;
    const TemporaryFolder folder;
    const std::filesystem::path path = folder / "large.lodtrace";
    {
        std::ofstream out(path, std::ios::binary);
        const auto put = [&](const test::TraceBytes& bytes) {
            out.write(reinterpret_cast<const char*>(bytes.data()),
                      static_cast<std::streamsize>(bytes.size()));
        };
        put(test::traceHeader());
        for (std::uint64_t block = 0; block < blocks; ++block) {
            put(test::traceBlockHeader(blockBytes, 0, 0, 1, 1 + block));
            out.seekp(blockBytes, std::ios::cur);
        }
        // A frame with a drawn node; the block's first event begins frame 104.
        test::TraceBytes frame = test::bytes({1, 0, 0});
        ByteWriter(frame).put(2.5);
        frame = test::joined({frame, test::bytes({4, 0})});
        const test::TraceBytes node = test::bytes({3, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0});
        const test::TraceBytes content = test::joined({node, frame});
        put(test::traceBlockHeader(static_cast<std::uint32_t>(content.size()),
                                   static_cast<std::uint32_t>(node.size()), traceChecksum(content), 1,
                                   1 + blocks));
        put(content);
        ASSERT_TRUE(out.good());
    }
    ASSERT_GT(std::filesystem::file_size(path), 10'000'000'000u);
    auto file = TraceFile::open(path);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_EQ(file->blocks().size(), blocks + 1);
    std::vector<TraceEvent> events;
    const auto sink = [&](const TraceEvent& event) { events.push_back(event); };
    ASSERT_TRUE(file->seek(1 + blocks, sink));
    EXPECT_EQ(file->next(sink), true);
    ASSERT_EQ(test::eventsOf<TraceFrameBegan>(events).size(), 1u);
    EXPECT_EQ(test::eventsOf<TraceFrameBegan>(events)[0].number, 1 + blocks);
    EXPECT_EQ(test::eventsOf<TraceFrameBegan>(events)[0].timeS, 2.5);
    EXPECT_EQ(test::eventsOf<TraceDrawn>(events).size(), 1u);
}

}  // namespace
}  // namespace planet
