#include "planet/gl/device/gpu_clock.h"

#include <string>
#include <thread>
#include <vector>

#include "planet/gl/device/gpu_timer.h"
#include "planet/spans/span_recorder.h"
#include "tests/planet/gl/gl_test.h"

namespace planet::gl {
namespace {

class GpuClock : public GlTest {
protected:
    static std::vector<Span> gpuSpans() {
        std::vector<Span> spans;
        drainSpans([&](const SpanBatch& batch) {
            if (batch.name == "GPU") spans.insert(spans.end(), batch.spans.begin(), batch.spans.end());
        });
        return spans;
    }
    // Measures one clear of a target, waiting for the GPU.
    static void measureAClear() {
        const RenderTarget target = valueOf(RenderTarget::create(256, 256));
        target.bind();
        GpuTimer timer("clear");
        timer.begin();
        glClear(GL_COLOR_BUFFER_BIT);
        timer.end();
        glFinish();
        timer.lastMs();
    }
};

TEST_F(GpuClock, placesAMeasurementBetweenTheTimesBeforeAndAfterIt) {
    if (!readGpuClock()) GTEST_SKIP() << "the driver has no timestamps";
    gpuSpans();
    recordSpans(true);
    followGpuClock();
    ASSERT_TRUE(gpuClock());
    const std::int64_t beforeNs = spanClockNs();
    measureAClear();
    const std::int64_t afterNs = spanClockNs();
    recordSpans(false);
    const std::vector<Span> spans = gpuSpans();
    ASSERT_EQ(spans.size(), 1u);
    EXPECT_STREQ(spans[0].name, "clear");
    EXPECT_LE(spans[0].beginNs, spans[0].endNs);
    // Resolution of timestamps is a microsecond or better.
    const std::int64_t errorNs = gpuClock()->errorNs + 1000;
    EXPECT_GE(spans[0].beginNs, beforeNs - errorNs);
    EXPECT_LE(spans[0].endNs, afterNs + errorNs);
}

// A lane has one writer: a sweep draws on a thread of its own while the window draws.
TEST_F(GpuClock, recordsNothingOfAThreadThatDoesNotFollowTheClock) {
    if (!readGpuClock()) GTEST_SKIP() << "the driver has no timestamps";
    gpuSpans();
    recordSpans(true);
    followGpuClock();
    std::thread([] { recordGpuSpan("sweep", 1000, 2000); }).join();
    recordGpuSpan("window", 1000, 2000);
    recordSpans(false);
    const std::vector<Span> spans = gpuSpans();
    ASSERT_EQ(spans.size(), 1u);
    EXPECT_STREQ(spans[0].name, "window");
}

TEST_F(GpuClock, recordsNothingWhileSpansAreNotRecorded) {
    gpuSpans();
    measureAClear();
    EXPECT_TRUE(gpuSpans().empty());
}

}  // namespace
}  // namespace planet::gl
