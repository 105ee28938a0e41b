// What tracing costs the engine's thread, and how many bytes the events take. Each iteration traces one frame; the wait for
// the writer is not counted. ns_an_event is of the calls named, frame_share_percent of a frame of 16.7 ms, and bytes_an_event
// of all that the stream holds, frames and views included.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

#include "planet/trace/lod_trace.h"

namespace {

constexpr double frameNs = 1e9 / 60;
constexpr std::uint64_t nodeCount = 20'000;

lod_trace_node_info boxOf(std::uint64_t id) {
    lod_trace_node_info node{};
    node.id = id;
    node.has_parent = id > 0;
    node.parent = id / 4;
    node.bounds = LOD_TRACE_BOUNDS_BOX;
    node.axes[0] = node.axes[4] = node.axes[8] = 1;
    node.half_size[0] = node.half_size[1] = node.half_size[2] = 1;
    node.error = 1.0 / static_cast<double>(id + 1);
    return node;
}

lod_trace_view_info viewOf(std::uint64_t frame) {
    lod_trace_view_info view{};
    for (int i = 0; i < 16; ++i) view.view[i] = view.projection[i] = 1.0 / (i + 1);
    view.eye[0] = view.view[12] = static_cast<double>(frame) * 0.1;
    view.viewport[2] = 1280;
    view.viewport[3] = 720;
    return view;
}

// Draws 1,000 nodes. Of neighbours in a tree, so ids jump by little, and one in ten morphs.
void drawThousand(lod_trace* trace, std::uint64_t frame) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const std::uint64_t id = (frame * 3 + i * 7) % nodeCount;
        lod_trace_drawn(trace, 0, id, i % 10 == 0 ? 0.3f : 0.0f);
    }
}

void pageThousand(lod_trace* trace, std::uint64_t frame) {
    for (std::uint64_t i = 0; i < 250; ++i) {
        const std::uint64_t id = (frame * 3 + i) % nodeCount;
        lod_trace_requested(trace, id, 0, 1.5f);
        lod_trace_started(trace, id, 0);
        lod_trace_arrived(trace, id, 0);
        lod_trace_evicted(trace, id, 0);
    }
}

void countThousand(lod_trace* trace, std::uint64_t frame) {
    for (std::uint64_t i = 0; i < 1000; ++i)
        lod_trace_counter(trace, "drawn nodes", static_cast<double>(frame + i));
}

void tellThousand(lod_trace* trace, std::uint64_t frame) {
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const lod_trace_node_info node = boxOf((frame * 1000 + i) % nodeCount);
        benchmark::DoNotOptimize(lod_trace_node(trace, &node));
    }
}

// A whole frame, as an engine traces it.
void wholeFrame(lod_trace* trace, std::uint64_t frame) {
    const lod_trace_view_info view = viewOf(frame);
    lod_trace_view(trace, 0, &view);
    drawThousand(trace, frame);
    for (std::uint64_t i = 0; i < 4; ++i) {
        lod_trace_requested(trace, (frame + i) % nodeCount, 0, 1.5f);
        lod_trace_arrived(trace, (frame + i) % nodeCount, 0);
    }
    for (const char* name : {"triangles", "resident", "queue"}) lod_trace_counter(trace, name, 12345);
}

void traceFrames(benchmark::State& state, const char* where, void (*events)(lod_trace*, std::uint64_t)) {
    const lod_trace_options options{.ring_bytes = 4u << 20, .max_threads = 1, .wake_ms = 1};
    char error[256];
    lod_trace* trace = lod_trace_open(where, &options, error, sizeof error);
    if (trace == nullptr) {
        state.SkipWithError(error);
        return;
    }
    for (std::uint64_t id = 0; id < nodeCount; ++id) {
        const lod_trace_node_info node = boxOf(id);
        while (lod_trace_node(trace, &node) == 0) lod_trace_flush(trace, 1000);
    }
    lod_trace_flush(trace, 10'000);
    const lod_trace_stats before = lod_trace_get_stats(trace);
    std::uint64_t frame = 0;
    double seconds = 0;
    for (auto _ : state) {
        const auto began = std::chrono::steady_clock::now();
        lod_trace_frame_begin(trace, static_cast<double>(frame) / 60);
        events(trace, frame);
        lod_trace_frame_end(trace, 1, 1);
        const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - began;
        state.SetIterationTime(taken.count());
        seconds += taken.count();
        ++frame;
        lod_trace_flush(trace, 10'000);
    }
    const lod_trace_stats after = lod_trace_get_stats(trace);
    const double frames = static_cast<double>(frame);
    state.counters["ns_an_event"] = seconds * 1e9 / (frames * 1000);
    state.counters["frame_share_percent"] = seconds * 1e9 / frames / frameNs * 100;
    // Nodes that are told again unchanged are no events.
    if (after.events - before.events > 500 * frame)
        state.counters["bytes_an_event"] = static_cast<double>(after.bytes - before.bytes) /
                                           static_cast<double>(after.events - before.events);
    state.counters["dropped"] = static_cast<double>(after.dropped);
    lod_trace_close(trace);
}

BENCHMARK_CAPTURE(traceFrames, a_frame_with_1000_drawn_nodes, "/dev/null", wholeFrame)->UseManualTime();
BENCHMARK_CAPTURE(traceFrames, drawn, "/dev/null", drawThousand)->UseManualTime();
BENCHMARK_CAPTURE(traceFrames, paging, "/dev/null", pageThousand)->UseManualTime();
BENCHMARK_CAPTURE(traceFrames, counters, "/dev/null", countThousand)->UseManualTime();
BENCHMARK_CAPTURE(traceFrames, nodes, "/dev/null", tellThousand)->UseManualTime();
BENCHMARK_CAPTURE(traceFrames, a_frame_with_1000_drawn_nodes_and_no_listener, "tcp:127.0.0.1:0", wholeFrame)
    ->UseManualTime();

}  // namespace
