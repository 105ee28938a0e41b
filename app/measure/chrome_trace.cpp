#include "app/measure/chrome_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>

namespace worldy {

namespace {

constexpr int framesThread = 1;

std::string jsonText(std::string_view text) {
    using Json = nlohmann::json;
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

// Appends events to the array of a trace.
class TraceEvents {
public:
    TraceEvents(std::string& text, std::int64_t originNs) : text_(text), originNs_(originNs) {}

    void metadata(const char* name, int thread, const std::string& arguments) {
        begin();
        fmt::format_to(out(), R"({{"name":"{}","ph":"M","pid":1,"tid":{},"args":{{{}}}}})", name, thread,
                       arguments);
    }
    void thread(int number, std::string_view name) {
        metadata("thread_name", number, fmt::format(R"("name":{})", jsonText(name)));
        metadata("thread_sort_index", number, fmt::format(R"("sort_index":{})", number));
    }
    void complete(std::string_view name, const char* category, int thread, std::int64_t beginNs,
                  std::int64_t endNs, const std::string& arguments) {
        begin();
        fmt::format_to(out(),
                       R"({{"name":{},"cat":"{}","ph":"X","ts":{:.3f},"dur":{:.3f},"pid":1,"tid":{}{}}})",
                       jsonText(name), category, us(beginNs - originNs_), us(endNs - beginNs), thread,
                       arguments.empty() ? std::string() : fmt::format(R"(,"args":{{{}}})", arguments));
    }
    void instant(std::string_view name, int thread, std::int64_t atNs, const std::string& arguments) {
        begin();
        fmt::format_to(
            out(),
            R"({{"name":{},"cat":"chunk","ph":"i","s":"t","ts":{:.3f},"pid":1,"tid":{},"args":{{{}}}}})",
            jsonText(name), us(atNs - originNs_), thread, arguments);
    }

private:
    static double us(std::int64_t ns) { return static_cast<double>(ns) * 1e-3; }
    std::back_insert_iterator<std::string> out() { return std::back_inserter(text_); }
    void begin() {
        if (!isFirst_) text_ += ',';
        text_ += '\n';
        isFirst_ = false;
    }

    std::string& text_;
    std::int64_t originNs_;
    bool isFirst_ = true;
};

std::string chunkArgument(const planet::BlockId& block) {
    return fmt::format(R"("chunk":{})", jsonText(planet::toString(block)));
}

void writeRow(TraceEvents& events, const TimelineRow& row, const TimeRange& range, const char* category,
              int thread) {
    auto span = std::ranges::lower_bound(row, range.fromNs, {}, &planet::Span::endNs);
    for (; span != row.end() && span->beginNs < range.toNs; ++span)
        events.complete(span->name, category, thread, span->beginNs, span->endNs,
                        span->hasBlock ? chunkArgument(span->block) : std::string());
}

// Rows that nest are one thread. Viewers need a thread of its own for each row of spans that overlap otherwise.
void writeLane(TraceEvents& events, const TimelineLane& lane, const TimeRange& range, int& thread) {
    const char* const category = lane.name == "GPU" ? "gpu" : "cpu";
    events.thread(++thread, lane.name);
    for (std::size_t row = 0; row < lane.rows.size(); ++row) {
        if (row > 0 && !lane.nests) events.thread(++thread, fmt::format("{}, row {}", lane.name, row + 1));
        writeRow(events, lane.rows[row], range, category, thread);
    }
}

std::string changeArguments(const ChunkChange& change) {
    std::string arguments = fmt::format(R"({},"frame":{})", chunkArgument(change.block), change.frame);
    if (change.kind == ChunkChangeKind::Popped)
        arguments += fmt::format(R"(,"largest_px":{})", change.value);
    else if (change.kind == ChunkChangeKind::Came || change.kind == ChunkChangeKind::Failed)
        arguments += fmt::format(R"(,"read_ms":{})", change.value);
    return arguments;
}

void writeFrames(TraceEvents& events, const FrameTimeline& timeline, const TimeRange& range) {
    events.thread(framesThread, "frames");
    const auto [first, last] = timeline.framesIn(range);
    for (std::size_t i = first; i < last; ++i) {
        const TimelineFrame& frame = timeline.frames()[i];
        events.complete("frame", "frame", framesThread, frame.beginNs, frame.endNs,
                        fmt::format(R"("frame":{},"frame_ms":{})", frame.number, frame.ms()));
        const auto [from, to] = timeline.changesIn(frame.number, frame.number);
        for (std::size_t change = from; change < to; ++change)
            events.instant(chunkChangeName(timeline.changes()[change].kind), framesThread, frame.beginNs,
                           changeArguments(timeline.changes()[change]));
    }
}

}  // namespace

std::string chromeTrace(const FrameTimeline& timeline, const ChromeTraceOptions& options) {
    std::string text = R"({"traceEvents":[)";
    TraceEvents events(text, timeline.originNs());
    events.metadata("process_name", 0, R"("name":"Worldy")");
    writeFrames(events, timeline, options.range);
    int thread = framesThread;
    for (const std::size_t lane : laneOrder(timeline))
        writeLane(events, timeline.lanes()[lane], options.range, thread);
    const auto us = [&](std::int64_t ns) { return static_cast<double>(ns - timeline.originNs()) * 1e-3; };
    nlohmann::ordered_json about = {{"program", "Worldy"},
                                    {"data_set", options.dataSet},
                                    {"from_us", us(options.range.fromNs)},
                                    {"to_us", us(options.range.toNs)},
                                    {"complete_from_us", us(timeline.completeFromNs())},
                                    {"spans_discarded", timeline.discarded()},
                                    {"spans_dropped", timeline.dropped()},
                                    {"changes_missed", timeline.changesMissed()}};
    if (options.gpuErrorNs) about["gpu_clock_error_us"] = static_cast<double>(*options.gpuErrorNs) * 1e-3;
    text += "\n],\n\"displayTimeUnit\":\"ms\",\n\"otherData\":";
    text += about.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text += "}\n";
    return text;
}

}  // namespace worldy
