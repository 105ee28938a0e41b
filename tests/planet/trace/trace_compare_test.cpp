// Two traces of one flight are compared frame by frame: equal traces have no difference, and a change is found where it is.
#include "planet/trace/trace_compare.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/trace_events.h"

namespace planet {
namespace {

// What differs from an ordinary trace of a root, 1, with the children 2 and 3.
struct Change {
    int coarseFrame = -1;  // draws the root instead of its children
    int frames = 200;
    int skippedFrame = -1;  // is missing
    double timeOffsetS = 0;
    double cpuMs = 2;
    bool turnsBack = false;  // the clock does
    bool namesMore = false;  // a node is told first that nothing draws, so that the others have other numbers
};

class TraceComparisons : public testing::Test {
protected:
    std::filesystem::path write(const std::string& name, const Change& change = {}) const {
        const std::filesystem::path file = folder_ / name;
        test::OpenTrace trace(file.string());
        const lod_trace_description description{};
        lod_trace_describe(trace, &description);
        if (change.namesMore) tell(trace, 77);
        for (const std::uint64_t id : {1u, 2u, 3u}) tell(trace, id);
        for (int frame = 0; frame < change.frames; ++frame) {
            if (frame == change.skippedFrame) continue;
            lod_trace_frame_begin(trace,
                                  (change.turnsBack && frame == 50 ? 0 : frame / 60.0) + change.timeOffsetS);
            const lod_trace_view_info view = test::someView(1000);
            lod_trace_view(trace, 0, &view);
            if (frame == change.coarseFrame) {
                lod_trace_drawn(trace, 0, 1, 0);
            } else {
                lod_trace_drawn(trace, 0, 3, 0);
                lod_trace_drawn(trace, 0, 2, 0);
            }
            lod_trace_frame_end(trace, change.cpuMs, -1);
        }
        return file;
    }
    static void tell(lod_trace* trace, std::uint64_t id) {
        lod_trace_node_info node = test::sphereNode(id, id == 1 ? 0 : 1);
        node.has_parent = id == 2 || id == 3;
        node.parent = 1;
        node.triangles = 100;
        ASSERT_EQ(lod_trace_node(trace, &node), 1);
    }
    static Result<TraceComparison> compare(const std::filesystem::path& a, const std::filesystem::path& b,
                                           const TraceCompareSettings& settings = {}) {
        auto fileA = TraceFile::open(a), fileB = TraceFile::open(b);
        return compareTraces(*fileA, *fileB, settings);
    }

    const tests::TemporaryFolder folder_;
};

TEST_F(TraceComparisons, equalTracesHaveNoDifference) {
    const auto found = compare(write("a"), write("b", {.namesMore = true}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->frames, 200u);
    EXPECT_EQ(found->framesOnlyInA + found->framesOnlyInB + found->skippedFrames, 0u);
    EXPECT_EQ(found->framesThatDiffer, 0u);
    EXPECT_TRUE(found->differences.empty());
    ASSERT_EQ(found->views.size(), 1u);
    EXPECT_EQ(found->views[0].frames, 200u);
    EXPECT_EQ(found->views[0].a.meanTriangles, 200);
    EXPECT_EQ(found->views[0].a.worstErrorPx, found->views[0].b.worstErrorPx);
    EXPECT_EQ(found->views[0].a.splits, 0u);
}

TEST_F(TraceComparisons, aFrameThatChangedIsTheOnlyOneFound) {
    const auto found = compare(write("a"), write("b", {.coarseFrame = 70, .cpuMs = 3}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->framesThatDiffer, 1u);
    ASSERT_EQ(found->differences.size(), 1u);
    const TraceFrameDifference& difference = found->differences[0];
    EXPECT_EQ(difference.frameA, 71u);  // numbers begin with 1
    EXPECT_EQ(difference.frameB, 71u);
    EXPECT_EQ(difference.timeS, 70 / 60.0);
    EXPECT_EQ(difference.nodesA, (std::vector<std::uint64_t>{2, 3}));
    EXPECT_EQ(difference.nodesB, (std::vector<std::uint64_t>{1}));
    EXPECT_EQ(difference.trianglesA, 200u);
    EXPECT_EQ(difference.trianglesB, 100u);
    EXPECT_EQ(found->views[0].b.merges, 1u);
    EXPECT_EQ(found->views[0].b.splits, 1u);
    EXPECT_EQ(found->cpuMsA.median, 2);
    EXPECT_EQ(found->cpuMsB.median, 3);
}

TEST_F(TraceComparisons, framesAreMatchedByTime) {
    const auto found = compare(write("a", {.skippedFrame = 10}), write("b", {.skippedFrame = 20}));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->frames, 198u);
    EXPECT_EQ(found->framesOnlyInA, 1u);
    EXPECT_EQ(found->framesOnlyInB, 1u);
    EXPECT_EQ(found->framesThatDiffer, 0u);
}

TEST_F(TraceComparisons, framesAreMatchedByNumberIfAsked) {
    const auto a = write("a"), b = write("b", {.frames = 150, .timeOffsetS = 100});
    const auto byTime = compare(a, b);
    ASSERT_TRUE(byTime);
    EXPECT_EQ(byTime->frames, 0u);
    const auto byNumber = compare(a, b, {.match = TraceMatch::Number});
    ASSERT_TRUE(byNumber);
    EXPECT_EQ(byNumber->frames, 150u);
    EXPECT_EQ(byNumber->framesOnlyInA, 50u);
}

TEST_F(TraceComparisons, timesThatTurnBackAreRefused) {
    const auto a = write("a"), b = write("b", {.turnsBack = true});
    const auto found = compare(a, b);
    ASSERT_FALSE(found);
    EXPECT_NE(found.error().message.find("trace B: the time of frame 51"), std::string::npos)
        << found.error().message;
    EXPECT_TRUE(compare(a, b, {.match = TraceMatch::Number}));
}

TEST_F(TraceComparisons, listsAreLimitedAndCountsAreNot) {
    const auto a = write("a", {.coarseFrame = 5}), b = write("b", {.coarseFrame = 6});
    const auto found = compare(a, b, {.maxFrames = 1, .maxNodes = 1});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->framesThatDiffer, 2u);
    ASSERT_EQ(found->differences.size(), 1u);
    EXPECT_EQ(found->unlistedDifferences, 1u);
    EXPECT_EQ(found->differences[0].onlyInB, 2u);
    EXPECT_EQ(found->differences[0].nodesB.size(), 1u);
}

TEST_F(TraceComparisons, aTraceThatIsCutOffIsComparedUpToThere) {
    const auto a = write("a"), b = write("b");
    std::filesystem::resize_file(b, std::filesystem::file_size(b) - 3);
    const auto found = compare(a, b);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->problemA);
    EXPECT_TRUE(found->problemB);
    EXPECT_EQ(found->framesThatDiffer, 0u);
}

}  // namespace
}  // namespace planet
