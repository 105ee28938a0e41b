// Writes a timeline as a Chrome trace, JSON in the "Trace Event Format", which Perfetto and chrome://tracing read. Pure
// function, any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/measure/frame_timeline.h"

namespace worldy {

struct ChromeTraceOptions {
    TimeRange range;        // what overlaps it is written
    std::string dataSet{};  // name of what was drawn
    std::optional<std::int64_t>
        gpuErrorNs{};  // how exactly GPU spans are placed on the clock; unset: unknown
};

// Returns the text of the file. Times are microseconds since the begin of the recording. Spans are complete events ("X") in the
// thread of their lane; the block that a span worked on is its argument "chunk". Frames are complete events in a thread of
// their own, which also has the changes of chunks, as instant events ("i") at the start of their frame.
std::string chromeTrace(const FrameTimeline& timeline, const ChromeTraceOptions& options);

}  // namespace worldy
