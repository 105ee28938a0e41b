#include "ui/panels/frame/timeline_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/measure/chrome_trace.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/columns.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/widgets.h"
#include "ui/model/figures.h"
#include "ui/model/time_axis.h"

namespace worldy::ui {

namespace {

void recordControls(const EditorView& view, TimelineLanesState& state, Commands& commands) {
    bool records = view.frames.recordsTimeline;
    if (ImGui::Checkbox("Record", &records)) commands.emplace_back(RecordTimeline{records});
    noteItem("Record");
    tooltip(
        "Records the last minutes of frames, threads and the GPU, for well under 1 % of a frame's time. What "
        "was "
        "recorded stays when this is off.");
    sameLineIfRoom(checkboxWidth("Hold"));
    ImGui::Checkbox("Hold", &state.held);
    noteItem("Hold");
    tooltip(
        "Keeps the view while recording goes on; otherwise it follows the newest frame. Zooming and dragging "
        "hold "
        "it. Key: End follows.");
}

void rangeButtons(const EditorView& view, const FrameTimeline& timeline, TimelineLanesState& state,
                  Commands& commands) {
    sameLineForButton("Fit");
    if (button("Fit", "Shows all that is kept. Key: F, while the lanes have the focus.")) {
        fitTimeline(timeline, state);
        state.held = true;
    }
    sameLineForButton("Clear range");
    beginGrey(!state.marked, "Mark a range first: Shift+drag over the lanes.");
    if (button("Clear range",
               "Removes the marked range. The percentiles are then those of the range in view."))
        state.marked.reset();
    endGrey();
    sameLineForButton("Save Chrome trace");
    if (button("Save Chrome trace",
               "Saves the marked range, or all that is kept, as a Chrome trace: JSON in the Trace Event "
               "Format, which "
               "Perfetto and chrome://tracing open. It has nothing to do with the LOD traces of the Trace "
               "panel. "
               "The file lies beside the screenshots."))
        commands.emplace_back(
            SaveExport{"timeline", "json",
                       chromeTrace(timeline, {.range = state.marked.value_or(timeline.extent()),
                                              .dataSet = view.data.name,
                                              .gpuErrorNs = view.frames.gpuClockErrorNs})});
}

std::vector<ValueRow> rangeRows(const EditorView& view, const FrameTimeline& timeline,
                                const TimelineLanesState& state) {
    const TimeRange range = toldRange(state);
    const FrameTimes times = timeline.frameTimesIn(range);
    const auto ms = [&](double value) {
        return times.frames > 0 ? millisecondsText(value) : std::string("-");
    };
    std::vector<ValueRow> rows = {
        {state.marked ? "Marked range" : "Range in view", spanTimeText(range.lengthNs()),
         "Shift+drag over the lanes marks a range. Without one, the figures are those of the range in view."},
        {"Frames", countText(static_cast<double>(times.frames)), "Frames that begin in the range."},
        {"p50", ms(times.p50Ms),
         "Half of these frames took at most this, from the start of a frame to the start of the next, "
         "without rests. "
         "By nearest rank, as in the Frame panel."},
        {"p95", ms(times.p95Ms), "95 % of these frames took at most this."},
        {"p99", ms(times.p99Ms), "99 % of these frames took at most this."},
        {"Longest", ms(times.maxMs), "Longest of these frames."},
        {"Recorded",
         durationText(static_cast<double>(timeline.extent().toNs - timeline.completeFromNs()) * 1e-9),
         "Of this time, everything is kept. When the memory for it is full, the oldest is discarded; what is "
         "incomplete is shaded."},
        {"GPU clock",
         view.frames.gpuClockErrorNs ? "± " + spanTimeText(*view.frames.gpuClockErrorNs)
                                     : std::string("none"),
         "How exactly the GPU's spans are placed between those of the CPU: both clocks are read together "
         "once a "
         "second, and their distance is known to within half the time that this takes. Durations do not "
         "depend on "
         "it. none: the driver has no timestamps."}};
    if (timeline.discarded() > 0)
        rows.push_back(
            {"Discarded", countText(static_cast<double>(timeline.discarded())),
             "Spans that were recorded and discarded since, because newer ones took their place."});
    if (timeline.dropped() > 0)
        rows.push_back({"Not recorded", countText(static_cast<double>(timeline.dropped())),
                        "Spans that are missing because they came faster than frames could take them."});
    if (timeline.changesMissed() > 0)
        rows.push_back(
            {"Changes missed", countText(static_cast<double>(timeline.changesMissed())),
             "Arrivals, failures and evictions that are missing, because one frame had more than 1000."});
    return rows;
}

std::string changeText(const ChunkChange& change) {
    constexpr std::array<const char*, planet::blockKindCount> kinds = {"heights", "colours", "normals"};
    const char* const name = chunkChangeName(change.kind);
    if (change.kind == ChunkChangeKind::Split || change.kind == ChunkChangeKind::Merged ||
        change.kind == ChunkChangeKind::Popped)
        return name;
    return fmt::format("{} {}", kinds.at(static_cast<std::size_t>(change.block.kind)), name);
}

std::string valueText(const ChunkChange& change) {
    const auto value = static_cast<double>(change.value);
    if (change.kind == ChunkChangeKind::Popped) return popPxText(value);
    const bool isRead = change.kind == ChunkChangeKind::Came || change.kind == ChunkChangeKind::Failed;
    return isRead ? millisecondsText(value) : std::string();
}

std::vector<ExportField<ChunkChange>> changeFields() {
    using C = ChunkChange;
    const auto valueOf = [](ChunkChangeKind kind) {
        return [kind](const C& c) { return c.kind == kind ? ExportCell(c.value) : ExportCell(); };
    };
    return {{"frame", [](const C& c) { return c.frame; }},
            {"change", [](const C& c) { return changeText(c); }},
            {"chunk", [](const C& c) { return planet::toString(c.block.parent); }},
            {"read_ms",
             [](const C& c) {
                 const bool isRead = c.kind == ChunkChangeKind::Came || c.kind == ChunkChangeKind::Failed;
                 return isRead ? ExportCell(c.value) : ExportCell();
             }},
            {"largest_px", valueOf(ChunkChangeKind::Popped)}};
}

std::array<TableColumn, 3> changeColumns(const std::string& widestChunk) {
    return {
        TableColumn{"Change", 1,
                    "came, evicted, failed: the four children of the chunk. split: it was replaced by its "
                    "children; merged: it replaced them. popped: the surface jumped in that switch.",
                    "normals evicted"},
        TableColumn{"Chunk", 1, nullptr, widestChunk.c_str()},
        TableColumn{
            "Value", 0.8f,
            "Of what came or failed: reading and decoding, with injected delays. Of a pop: the largest jump "
            "on the screen.",
            "< 0.001 px"}};
}

void frameChanges(const EditorView& view, const FrameTimeline& timeline, const TimelineLanesState& state,
                  Commands& commands) {
    if (!state.frame)
        return wrappedText("Click a frame to list the chunks that changed in it.",
                           ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
    const auto [first, last] = timeline.changesIn(*state.frame, *state.frame);
    const auto frame = std::ranges::lower_bound(timeline.frames(), *state.frame, {}, &TimelineFrame::number);
    if (frame == timeline.frames().end() || frame->number != *state.frame)
        return wrappedText(fmt::format("Frame {} is no longer kept.", *state.frame),
                           ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
    ImGui::TextUnformatted(fmt::format("Frame {}, {}", frame->number, millisecondsText(frame->ms())).c_str());
    if (first == last)
        return wrappedText(view.instruments.pops.measuring
                               ? "No chunk changed in this frame."
                               : "No chunk changed in this frame. Pops are not measured; "
                                 "turn them on in the Pops panel.",
                           ImGui::GetStyle().Colors[ImGuiCol_TextDisabled]);
    const std::string chunk = widestChunkName(view);
    const std::array columns = changeColumns(chunk);
    if (!beginListTable("changes", columns, last - first)) return;
    const auto at = [&timeline, first = first](std::size_t row) -> const ChunkChange& {
        return timeline.changes()[first + row];
    };
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const ChunkChange& change = at(row);
        if (column == 0) return changeText(change);
        if (column == 1) return sortKey(change.block.parent);
        return static_cast<double>(change.value);
    };
    tableRows(last - first, key, [&](std::size_t row) {
        const ChunkChange& change = at(row);
        cell(changeText(change));
        ImGui::TableNextColumn();
        if (change.block.kind == planet::BlockKind::Heights)
            chunkLink(change.block.parent, view, commands);
        else
            colourLink(change.block.parent, view, commands);
        noteItem(fmt::format("Change {}", row));
        rightCell(valueText(change), ImGui::GetStyle().Colors[ImGuiCol_Text]);
    });
    endTable(exportTable<ChunkChange>("chunk changes", last - first, at, changeFields()));
}

}  // namespace

void timelinePanel(const EditorView& view, TimelinePanelState& state, Commands& commands) {
    if (!view.planet || !view.frames.timeline)
        return emptyState("No planet is open. Open one to record its frames.");
    const FrameTimeline& timeline = *view.frames.timeline;
    TimelineLanesState& lanes = state.lanes;
    followNewest(timeline, lanes);
    recordControls(view, lanes, commands);
    rangeButtons(view, timeline, lanes, commands);
    if (timeline.frames().empty())
        return emptyState(view.frames.recordsTimeline
                              ? "No frame is recorded yet. Move the camera."
                              : "Nothing is recorded. Turn Record on and move the camera.");
    const std::vector<ValueRow> rows = rangeRows(view, timeline, lanes);
    const std::string chunk = widestChunkName(view);
    const float rowsWidth = valuesWidth(rows, "99 min 59 s");
    const std::array columns = {
        Column{.title = "Lanes",
               .share = 4,
               .stackedLines = 14,
               .draw = [&] { timelineLanes(timeline, lanes); },
               .needed = 20 * ImGui::GetFontSize()},
        Column{
            .title = "Range", .share = 0.5f, .draw = [&] { valueRows("range", rows); }, .needed = rowsWidth},
        Column{.title = "Frame",
               .share = 1,
               .draw = [&] { frameChanges(view, timeline, lanes, commands); },
               .needed = 14 * ImGui::GetFontSize(),
               .wanted = listTableWidth(changeColumns(chunk))}};
    drawColumns("timeline", columns);
}

}  // namespace worldy::ui
