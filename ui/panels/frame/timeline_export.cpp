#include "ui/panels/frame/timeline_export.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace worldy::ui {

ExportTable timelineFramesTable(const FrameTimeline& timeline, const TimeRange& range) {
    auto [first, last] = timeline.framesIn(range);
    if (first < last && timeline.frames()[first].beginNs < range.fromNs) ++first;
    const auto at = [&timeline, first = first](std::size_t row) -> const TimelineFrame& {
        return timeline.frames()[first + row];
    };
    const auto count = [&timeline](const TimelineFrame& frame, ChunkChangeKind kind) {
        const auto [from, to] = timeline.changesIn(frame.number, frame.number);
        const auto begin = timeline.changes().begin();
        return std::count_if(begin + static_cast<std::ptrdiff_t>(from),
                             begin + static_cast<std::ptrdiff_t>(to),
                             [&](const ChunkChange& change) { return change.kind == kind; });
    };
    using F = TimelineFrame;
    std::vector<ExportField<F>> fields = {
        {"frame", [](const F& f) { return f.number; }, true},
        {"begin_s",
         [&timeline](const F& f) { return static_cast<double>(f.beginNs - timeline.originNs()) * 1e-9; }},
        {"frame_ms", [](const F& f) { return f.ms(); }}};
    constexpr std::array<std::pair<const char*, ChunkChangeKind>, 6> kinds = {
        {{"came_blocks", ChunkChangeKind::Came},
         {"splits", ChunkChangeKind::Split},
         {"merges", ChunkChangeKind::Merged},
         {"pops", ChunkChangeKind::Popped},
         {"evicted_blocks", ChunkChangeKind::Evicted},
         {"failed_blocks", ChunkChangeKind::Failed}}};
    for (const auto& [name, kind] : kinds)
        fields.push_back({name, [count, kind = kind](const F& f) { return count(f, kind); }});
    fields.push_back({"largest_pop_px", [&timeline](const F& f) {
                          const auto [from, to] = timeline.changesIn(f.number, f.number);
                          float largestPx = 0;
                          for (std::size_t i = from; i < to; ++i)
                              if (timeline.changes()[i].kind == ChunkChangeKind::Popped)
                                  largestPx = std::max(largestPx, timeline.changes()[i].value);
                          return largestPx;
                      }});
    return exportTable<F>("frame timeline", last - first, at, std::move(fields));
}

}  // namespace worldy::ui
