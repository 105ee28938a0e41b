// The arithmetic of a timeline: the range in view, its ticks, and what is drawn where. Pure functions, any thread.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/measure/frame_timeline.h"

namespace worldy::ui {

inline constexpr std::int64_t shortestRangeNs = 1'000;  // in view

// Returns the range zoomed by a factor about a place in it, [0, 1], which stays where it is: a factor of 0.5 shows half as much.
// The result lies in `all` if that is long enough, and is at least shortestRangeNs long.
TimeRange zoomed(const TimeRange& range, double place, double factor, const TimeRange& all);
// Returns the range moved by a share of its length, but not out of `all`.
TimeRange moved(const TimeRange& range, double share, const TimeRange& all);
// Returns the range moved and, if it is too long, shortened, so that it lies in `all`; at least shortestRangeNs long.
TimeRange within(const TimeRange& range, const TimeRange& all);

struct TimeTick {
    std::int64_t ns = 0;
    std::string label;  // relative to the origin: "12.5 s", "3 ms", "250 µs"
};
// Returns the ticks of an axis: about `most`, at multiples of 1, 2 or 5 times a power of ten, in the unit that suits the length
// of the range. If they lie far from the origin, for example 2 µs apart at 12 s, the first one tells its time and the others
// their distance from it: "12.000002 s", "+2 µs".
std::vector<TimeTick> timeTicks(const TimeRange& range, std::int64_t originNs, std::size_t most);

// Returns "1.25 s", "16.7 ms", "12.3 µs" or "250 ns".
std::string spanTimeText(std::int64_t ns);

// A rectangle in a row: one span, or several that share a column of pixels.
struct SpanBox {
    float fromPx = 0;  // [0, width]
    float toPx = 0;
    const planet::Span* longest = nullptr;  // the span, or the longest one
    std::size_t spans = 1;
    std::int64_t busyNs = 0;  // of all its spans, in the range
};
// Returns the boxes of a row, left to right. A span that is at least a pixel wide has a box of its own; narrower ones share one
// for each column of pixels, so there are at most about two boxes per pixel.
std::vector<SpanBox> boxesOf(const TimelineRow& row, const TimeRange& range, float widthPx);

}  // namespace worldy::ui
