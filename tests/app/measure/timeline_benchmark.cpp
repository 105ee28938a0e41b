// Measures the cost of recording the timeline: a span on the thread that records it, and taking it over on the main thread.
// An iteration of takeASpan is a frame of 80 spans; items_per_second counts spans. The last benchmark draws nothing, but finds the
// boxes of a row with five minutes of spans.
#include <benchmark/benchmark.h>

#include <vector>

#include "app/measure/frame_timeline.h"
#include "planet/spans/span_recorder.h"
#include "ui/model/time_axis.h"

namespace worldy {
namespace {

void spanWhileOff(benchmark::State& state) {
    planet::nameSpanThread("main");
    planet::recordSpans(false);
    for (auto _ : state) {
        const planet::SpanScope span("work");
        benchmark::ClobberMemory();
    }
}

void spanWhileOn(benchmark::State& state) {
    planet::nameSpanThread("main");
    planet::recordSpans(true);
    const planet::BlockId block({planet::Face::PosY, 4, 6, 13});
    std::size_t spans = 0;
    for (auto _ : state) {
        const planet::SpanScope span("work", block);
        benchmark::ClobberMemory();
        if (++spans % (planet::spansPerLane / 2) != 0) continue;
        state.PauseTiming();
        planet::drainSpans([](const planet::SpanBatch&) {});
        state.ResumeTiming();
    }
    planet::recordSpans(false);
}

std::vector<planet::Span> spansOfAFrame(std::int64_t beginNs) {
    constexpr std::size_t spans = 20;
    std::vector<planet::Span> made(spans);
    for (std::size_t i = 0; i < spans; ++i) {
        made[i].name = "work";
        made[i].beginNs = beginNs + static_cast<std::int64_t>(i) * 800'000;
        made[i].endNs = made[i].beginNs + 700'000;
    }
    return made;
}

// Takes spans into a timeline that is full, so that each discards one.
void takeASpan(benchmark::State& state) {
    FrameTimeline timeline({.spans = 100'000});
    std::int64_t atNs = 0;
    const auto addFrame = [&] {
        for (std::size_t lane = 0; lane < 4; ++lane)
            timeline.add(planet::SpanBatch{lane, "loader", spansOfAFrame(atNs), 0});
        atNs += 16'700'000;
    };
    while (timeline.discarded() == 0) addFrame();
    for (auto _ : state) addFrame();
    state.SetItemsProcessed(80 * state.iterations());  // items are spans
}

void boxesOfFiveMinutes(benchmark::State& state) {
    TimelineRow row;
    for (std::int64_t frame = 0; frame < 18'000; ++frame)
        for (const planet::Span& span : spansOfAFrame(frame * 16'700'000)) row.push_back(span);
    for (auto _ : state) benchmark::DoNotOptimize(ui::boxesOf(row, {0, row.back().endNs}, 1500));
}

BENCHMARK(spanWhileOff);
BENCHMARK(spanWhileOn);
BENCHMARK(takeASpan);
BENCHMARK(boxesOfFiveMinutes)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace worldy
