// Hostile, damaged and truncated streams: an error says where and what, and what came before is kept.
#include "planet/trace/trace_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/trace_bytes.h"
#include "tests/support/trace_events.h"

namespace planet {
namespace {

using test::bytes;
using test::eventsOf;
using test::joined;
using test::ReadTrace;
using test::readTrace;
using test::traceBlock;
using test::traceBlockHeader;
using test::TraceBytes;
using test::traceHeader;

// Every kind of event, in several blocks.
const std::string& wholeTrace() {
    static const std::string content = [] {
        const tests::TemporaryFolder folder;
        test::OpenTrace trace((folder / "made").string());
        lod_trace_description description{};
        description.name = "engine";
        lod_trace_describe(trace, &description);
        lod_trace_thread_begin(trace, "main");
        lod_trace_setting(trace, LOD_TRACE_TAU, 2);
        for (int frame = 0; frame < 4; ++frame) {
            const auto id = static_cast<std::uint64_t>(frame);
            const auto node = test::sphereNode(id);
            const auto view = test::someView(frame);
            lod_trace_node(trace, &node);
            lod_trace_frame_begin(trace, frame);
            lod_trace_view(trace, frame % 2, &view);
            lod_trace_drawn(trace, 0, id, 0.25f);
            lod_trace_drawn_px(trace, 1, id, 1, 0.5f);
            lod_trace_culled(trace, 1, 0, LOD_TRACE_CULLED_OTHER);
            lod_trace_requested(trace, id, 1, 3);
            lod_trace_started(trace, id, 1);
            lod_trace_failed(trace, id, 1, "disk");
            lod_trace_counter(trace, "drawn", 1.5);
            lod_trace_counter(trace, "drawn", 1e6);
            lod_trace_setting_text(trace, "mode", "fast");
            lod_trace_message(trace, LOD_TRACE_ERROR, "message");
            lod_trace_frame_end(trace, 1, 2);
            lod_trace_flush(trace, 10'000);
        }
        trace.close();
        return tests::contentOf(folder / "made");
    }();
    return content;
}

bool isPrefix(const std::vector<TraceEvent>& events, const std::vector<TraceEvent>& whole) {
    return events.size() <= whole.size() && std::equal(events.begin(), events.end(), whole.begin());
}

TEST(TraceReader, piecesOfAnySizeGiveTheSameEvents) {
    const auto content = test::bytesOf(wholeTrace());
    const ReadTrace whole = readTrace(content);
    EXPECT_EQ(whole.problem, "");
    EXPECT_GT(whole.events.size(), 60u);
    for (const std::size_t size : {1u, 7u, 50u, 1000u}) {
        std::vector<TraceEvent> events;
        TraceReader reader("made", [&](const TraceEvent& event) { events.push_back(event); });
        for (std::size_t at = 0; at < content.size(); at += size)
            ASSERT_TRUE(reader.feed(content.subspan(at, std::min(size, content.size() - at))));
        EXPECT_TRUE(reader.finish());
        EXPECT_EQ(events, whole.events);
    }
}

TEST(TraceReader, truncatedAtAnyByteKeepsWhatCameBefore) {
    const auto content = test::bytesOf(wholeTrace());
    const ReadTrace whole = readTrace(content);
    std::size_t before = 0;
    for (std::size_t size = 0; size < content.size(); ++size) {
        const ReadTrace read = readTrace(content.first(size));
        ASSERT_TRUE(isPrefix(read.events, whole.events)) << size;
        ASSERT_GE(read.events.size(), before) << size;
        before = read.events.size();
    }
    EXPECT_EQ(readTrace(content.first(0)).problem,
              "made: byte 0: the trace ends 0 bytes into a header; what came before is valid");
    const ReadTrace cut = readTrace(content.first(content.size() - 1));
    EXPECT_NE(cut.problem.find("bytes into a block; what came before is valid"), std::string::npos);
    EXPECT_EQ(cut.events.size() + 1, whole.events.size());
}

TEST(TraceReader, eachChangedByteIsFound) {
    const ReadTrace whole = readTrace(test::bytesOf(wholeTrace()));
    for (std::size_t at = 0; at < wholeTrace().size(); ++at) {
        std::string changed = wholeTrace();
        changed[at] = static_cast<char>(changed[at] ^ 1 << at % 8);
        const ReadTrace read = readTrace(test::bytesOf(changed));
        ASSERT_NE(read.problem, "") << at;
        ASSERT_TRUE(isPrefix(read.events, whole.events)) << at;
    }
}

// Nothing but a message may come of it; the sanitizers watch.
TEST(TraceReader, hostileBytesWithChecksumsThatMatchAreHarmless) {
    std::mt19937 random(7);
    const auto content = test::bytesOf(wholeTrace());
    std::vector<std::pair<TraceBlockHeader, TraceBytes>> blocks;
    for (std::size_t at = traceHeaderBytes; at < content.size();) {
        const auto header = traceBlockHeaderFrom(content.subspan(at).first<traceBlockHeaderBytes>());
        ASSERT_TRUE(header);
        const auto payload = content.subspan(at + traceBlockHeaderBytes, header->bytes);
        blocks.emplace_back(*header, TraceBytes(payload.begin(), payload.end()));
        at += traceBlockHeaderBytes + header->bytes;
    }
    ASSERT_GE(blocks.size(), 4u);
    int refused = 0;
    for (int i = 0; i < 20'000; ++i) {
        TraceBytes stream = traceHeader();
        for (auto [header, payload] : blocks) {
            for (int change = 0; change < 2; ++change)
                payload[random() % payload.size()] = static_cast<std::byte>(random());
            stream = joined({stream,
                             traceBlockHeader(header.bytes, header.definitionBytes, traceChecksum(payload)),
                             payload});
        }
        TraceState state;
        TraceReader reader("hostile", [&](const TraceEvent& event) { state.add(event); });
        if (!reader.feed(stream)) ++refused;
    }
    EXPECT_GT(refused, 5'000);
    EXPECT_LT(refused, 20'000);
}

struct Refused {
    TraceBytes stream;
    std::string problem;
};

// The definition of node 0 with id 5 and no values.
TraceBytes bareNode(int index = 0) {
    return bytes({3, 0, index, 5, 0, 0, 0, 0, 0, 0, 0});
}

TEST(TraceReader, errorsSayTheByteAndWhatIsWrong) {
    const TraceBytes header = traceHeader();
    const auto events = [&](const TraceBytes& made) {
        return joined({header, traceBlock(bareNode(), made)});
    };
    const auto definitions = [&](const TraceBytes& made) { return joined({header, traceBlock(made, {})}); };
    const std::string damaged = "; expected an undamaged trace";
    const std::vector<Refused> cases = {
        {traceHeader(2), "made: byte 0: version: 2 is unknown; expected 1"},
        {traceHeader(1, 24), "made: byte 0: the header is inconsistent" + damaged},
        {bytes({'P', 'N', 'G', 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}),
         "made: byte 0: is no trace; expected a file that lod_trace.h wrote"},
        {joined({header, TraceBytes(48)}), "made: byte 16: no block begins here; expected \"LTB1\""},
        {joined({header, traceBlockHeader(0xFFFFFFFFu, 0, 0)}),
         "made: byte 16: block: 4294967295 bytes are too many; expected at most 134217728"},
        {joined({header, traceBlockHeader(4, 5, 0)}),
         "made: byte 16: the block's header is inconsistent" + damaged},
        {joined({header, traceBlockHeader(4, 4, 0, 4)}),
         "made: byte 16: the block's header is inconsistent" + damaged},
        {joined({header, traceBlockHeader(1, 0, 99), bytes({4})}),
         "made: byte 16: the checksum of the block does not match" + damaged},
        {definitions(bytes({9})),
         "made: byte 16: byte 0 of the block: a definition has an unknown type" + damaged},
        {definitions(bareNode(1)),
         "made: byte 16: byte 0 of the block: a node is defined out of order" + damaged},
        {definitions(bytes({2, 1, 0})),
         "made: byte 16: byte 0 of the block: a name is defined out of order" + damaged},
        {definitions(bytes({2, 0, 0x80, 2})),
         "made: byte 16: byte 0 of the block: a text is too long" + damaged},
        {definitions(bytes({3, 16, 0})),
         "made: byte 16: byte 0 of the block: a node has unknown flags" + damaged},
        {definitions(bytes({3, 0, 0, 5})),
         "made: byte 16: byte 0 of the block: the bytes end inside a value" + damaged},
        {definitions(bytes({1, 2, 0, 0, 0})),
         "made: byte 16: byte 0 of the block: an enumeration has an unknown value" + damaged},
        {events(bytes({0})), "made: byte 16: byte 11 of the block: an event has an unknown type" + damaged},
        {events(bytes({20})), "made: byte 16: byte 11 of the block: an event has an unknown type" + damaged},
        {events(bytes({4, 2})), "made: byte 16: byte 11 of the block: a node is not defined" + damaged},
        {events(bytes({4, 1})), "made: byte 16: byte 11 of the block: a node is not defined" + damaged},
        {events(bytes({4, 0, 4 | 0x60, 0})),
         "made: byte 16: byte 13 of the block: a morph has an unknown form" + damaged},
        {events(bytes({6, 16})),
         "made: byte 16: byte 11 of the block: a view's number is too large" + damaged},
        {events(bytes({3, 16})),
         "made: byte 16: byte 11 of the block: a view's number is too large" + damaged},
        {events(bytes({7 | 0x20, 4, 0, 0})),
         "made: byte 16: byte 11 of the block: a kind's number is too large" + damaged},
        {events(bytes({8 | 0x40, 0, 0})),
         "made: byte 16: byte 11 of the block: a paging event has unknown flags" + damaged},
        {events(bytes({13, 0})), "made: byte 16: byte 11 of the block: a name is not defined" + damaged},
        {events(bytes({17, 64})),
         "made: byte 16: byte 11 of the block: there are too many threads" + damaged},
        {events(bytes({19, 5, 0})),
         "made: byte 16: byte 11 of the block: an enumeration has an unknown value" + damaged},
        {events(bytes({16, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 2})),
         "made: byte 16: byte 11 of the block: a number has more than 64 bits" + damaged},
        {events(bytes({2, 0})),
         "made: byte 16: byte 11 of the block: the bytes end inside a value" + damaged},
    };
    for (const Refused& refused : cases) EXPECT_EQ(readTrace(refused.stream).problem, refused.problem);
}

TEST(TraceReader, nothingIsReadAfterAnError) {
    TraceBytes stream = joined({traceHeader(), traceBlock({}, bytes({0}))});
    std::size_t events = 0;
    TraceReader reader("made", [&](const TraceEvent&) { ++events; });
    const auto first = reader.feed(stream);
    ASSERT_FALSE(first);
    const std::size_t before = events;
    const auto second = reader.feed(traceBlock(bareNode(), bytes({4, 0})));
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message, first.error().message);
    EXPECT_EQ(reader.finish().error().message, first.error().message);
    EXPECT_EQ(events, before);
}

TEST(TraceReader, givesTheBytesOfCheckedPartsOnly) {
    const TraceBytes header = traceHeader();
    const TraceBytes first = traceBlock(bareNode(), bytes({4, 0}));
    const TraceBytes second = traceBlock({}, bytes({4, 0, 4, 0}));
    TraceBytes damaged = first;
    damaged.back() ^= std::byte{1};
    std::vector<TraceBytes> parts;
    std::size_t events = 0;
    std::vector<std::size_t> eventsBefore;
    TraceReader reader(
        "made", [&](const TraceEvent&) { ++events; },
        [&](std::span<const std::byte> part) {
            parts.emplace_back(part.begin(), part.end());
            eventsBefore.push_back(events);
        });
    for (const std::byte byte : joined({header, first, second})) EXPECT_TRUE(reader.feed({&byte, 1}));
    EXPECT_EQ(reader.checkedBytes(), reader.bytes());
    EXPECT_FALSE(reader.feed(damaged));
    EXPECT_EQ(parts, (std::vector{header, first, second}));
    EXPECT_EQ(eventsBefore.size(), 3u);
    EXPECT_EQ(eventsBefore.front(), 0u);
    EXPECT_EQ(eventsBefore.back(), events);
    EXPECT_EQ(reader.checkedBytes() + damaged.size(), reader.bytes());
}

// Names go to terminals, and into lists whose entries end with a zero.
TEST(TraceReader, controlCharactersOfTextsAreSpaces) {
    const TraceBytes name = bytes({2, 0, 11, 'a', 0, 0x1B, '\n', 0x7F, 0xC2, 0x9B, 0xCF, 0x84, 0xC2, 0xB5});
    const TraceBytes message = bytes({15, 0, 3, 'a', 9, 'b'});
    const ReadTrace read = readTrace(joined({traceHeader(), traceBlock(name, message)}));
    EXPECT_EQ(read.problem, "");
    ASSERT_EQ(eventsOf<TraceNamed>(read.events).size(), 1u);
    EXPECT_EQ(eventsOf<TraceNamed>(read.events)[0].name, "a      \xCF\x84\xC2\xB5");
    ASSERT_EQ(eventsOf<TraceMessage>(read.events).size(), 1u);
    EXPECT_EQ(eventsOf<TraceMessage>(read.events)[0].text, "a b");
}

// A header may claim a large block; memory grows only with the bytes that come.
TEST(TraceReader, aLargeBlockIsAwaitedWithoutItsMemory) {
    TraceReader reader("made", [](const TraceEvent&) {});
    EXPECT_TRUE(reader.feed(joined({traceHeader(), traceBlockHeader(100u << 20, 0, 0)})));
    EXPECT_EQ(reader.finish().error().message,
              "made: byte 16: the trace ends 48 bytes into a block; what came before is valid");
}

}  // namespace
}  // namespace planet
