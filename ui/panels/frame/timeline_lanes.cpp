#include "ui/panels/frame/timeline_lanes.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "ui/kit/exports.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/plots.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/time_axis.h"
#include "ui/panels/frame/timeline_export.h"

namespace worldy::ui {

namespace {

// Maps times to the screen: labels are left of x, and the lanes are between x and x + width.
struct TimeScale {
    TimeRange range;
    float x = 0;
    float width = 1;

    float at(std::int64_t ns) const {
        const double share = static_cast<double>(ns - range.fromNs) / static_cast<double>(range.lengthNs());
        // Far outside, floats would lose the rest of the rectangle.
        return x + width * static_cast<float>(std::clamp(share, -1.0, 2.0));
    }
    double placeOf(float px) const { return std::clamp(static_cast<double>((px - x) / width), 0.0, 1.0); }
    std::int64_t timeAt(float px) const {
        return range.fromNs + std::llround(placeOf(px) * static_cast<double>(range.lengthNs()));
    }
    float right() const { return x + width; }
};

// The heights of the parts, pixels.
struct LaneSizes {
    float row = std::round(1.2f * ImGui::GetFontSize());
    float gap = std::round(0.25f * ImGui::GetFontSize());
    float frames = std::round(2.6f * ImGui::GetFontSize());
    float change = std::round(0.3f * ImGui::GetFontSize());  // of one kind of changes
    float changes = 4 * change;
};

constexpr const char* timelineKeys =
    "Shift+Left, Right: frame   Shift+PageUp, PageDown: mark   Enter: zoom to it";
constexpr std::array shownChanges = {ChunkChangeKind::Came, ChunkChangeKind::Split, ChunkChangeKind::Merged,
                                     ChunkChangeKind::Popped};

ImVec4 changeColour(ChunkChangeKind kind) {
    switch (kind) {
        case ChunkChangeKind::Came:
            return palette().good;
        case ChunkChangeKind::Split:
            return palette().accent;
        case ChunkChangeKind::Merged:
            return palette().warning;
        default:
            return palette().bad;
    }
}

// Returns the colour of a stage, the same in all lanes; unknown names are grey.
ImVec4 spanColour(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 19> colours = {{{"planet", 0},
                                                                                   {"upload", 2},
                                                                                   {"upload block", 2},
                                                                                   {"select", 1},
                                                                                   {"paging", 4},
                                                                                   {"measure pops", 7},
                                                                                   {"draw", 0},
                                                                                   {"pictures", 6},
                                                                                   {"panels", 4},
                                                                                   {"draw panels", 4},
                                                                                   {"input", 7},
                                                                                   {"jobs", 5},
                                                                                   {"load", 0},
                                                                                   {"read", 1},
                                                                                   {"decode", 2},
                                                                                   {"derive", 7},
                                                                                   {"chunks", 0},
                                                                                   {"sky", 6},
                                                                                   {"shadows", 5}}};
    if (name == "injected delay") return palette().bad;
    const auto found = std::ranges::find(colours, name, &std::pair<std::string_view, std::size_t>::first);
    return found != colours.end() ? seriesColour(found->second) : palette().dim;
}

void drawAxis(const FrameTimeline& timeline, const TimeScale& scale, float y, float bottom) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float font = ImGui::GetFontSize();
    const auto most = static_cast<std::size_t>(std::max(scale.width / (6 * font), 1.0f));
    float free = scale.x;
    for (const TimeTick& tick : timeTicks(scale.range, timeline.originNs(), most)) {
        const float x = std::round(scale.at(tick.ns));
        list.AddLine({x, y}, {x, bottom}, packed(palette().dim, 0.35f));
        const float width = ImGui::CalcTextSize(tick.label.c_str()).x;
        if (x + 3 < free || x + 3 + width > scale.right()) continue;
        list.AddText({x + 3, y}, packed(palette().dim), tick.label.c_str());
        free = x + width + font;
    }
}

void drawLabel(const TimeScale& scale, float left, float y, const char* text) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float end = scale.x - ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::RenderTextEllipsis(&list, {left, y}, {end, y + ImGui::GetFontSize() * 1.3f}, end, end, text,
                              nullptr, nullptr);
}

// Draws the time of each frame as a bar. Frames that share a column of pixels show the longest.
void drawFrames(const FrameTimeline& timeline, const TimeScale& scale, const TimelineLanesState& state,
                float left, float y, float height) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto [first, last] = timeline.framesIn(scale.range);
    double longestMs = 0;
    for (std::size_t i = first; i < last; ++i) longestMs = std::max(longestMs, timeline.frames()[i].ms());
    const double topMs = roundedTop(longestMs);
    list.AddRectFilled({scale.x, y}, {scale.right(), y + height}, ImGui::GetColorU32(ImGuiCol_FrameBg, 0.6f));
    const auto bar = [&](float from, float to, double ms, bool selected) {
        const float top = y + height * static_cast<float>(1 - ms / topMs);
        list.AddRectFilled({std::max(from, scale.x), top}, {std::min(to, scale.right()), y + height},
                           packed(selected ? palette().text : palette().accent, selected ? 0.9f : 0.65f));
    };
    for (std::size_t i = first; i < last;) {
        const TimelineFrame& frame = timeline.frames()[i];
        const float from = scale.at(frame.beginNs), to = scale.at(frame.endNs);
        if (to - from >= 2) {
            bar(from, to - 1, frame.ms(), state.frame == frame.number);
            ++i;
            continue;
        }
        const float column = std::floor(from);
        double ms = 0;
        bool selected = false;
        for (; i < last && scale.at(timeline.frames()[i].beginNs) < column + 1; ++i) {
            ms = std::max(ms, timeline.frames()[i].ms());
            selected |= state.frame == timeline.frames()[i].number;
        }
        bar(column, column + 1, ms, selected);
    }
    drawLabel(scale, left, y, "Frames");
    const std::string top =
        topMs < 1000 ? fmt::format("{} ms", axisText(topMs)) : fmt::format("{} s", axisText(topMs / 1000));
    if (last > first) drawLabel(scale, left, y + std::round(1.2f * ImGui::GetFontSize()), top.c_str());
}

void drawChanges(const FrameTimeline& timeline, const TimeScale& scale, float left, float y,
                 const LaneSizes& sizes) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({scale.x, y}, {scale.right(), y + sizes.changes},
                       ImGui::GetColorU32(ImGuiCol_FrameBg, 0.6f));
    drawLabel(scale, left, y + (sizes.changes - ImGui::GetFontSize()) / 2, "Chunks");
    const auto [first, last] = timeline.framesIn(scale.range);
    if (first == last) return;
    const auto& frames = timeline.frames();
    const auto [from, to] = timeline.changesIn(frames[first].number, frames[last - 1].number);
    std::array<float, shownChanges.size()> drawnTo{};
    std::size_t frame = first;
    for (std::size_t i = from; i < to; ++i) {
        const ChunkChange& change = timeline.changes()[i];
        const auto row = std::ranges::find(shownChanges, change.kind);
        if (row == shownChanges.end()) continue;
        while (frame + 1 < last && frames[frame].number < change.frame) ++frame;
        const float begin = std::max(scale.at(frames[frame].beginNs), scale.x);
        const float end = std::min(std::max(scale.at(frames[frame].endNs) - 1, begin + 1.5f), scale.right());
        float& drawn = drawnTo.at(static_cast<std::size_t>(row - shownChanges.begin()));
        if (end <= drawn) continue;
        drawn = end;
        const float top = y + sizes.change * static_cast<float>(row - shownChanges.begin());
        list.AddRectFilled({begin, top + 0.5f}, {end, top + sizes.change - 0.5f},
                           packed(changeColour(change.kind), 0.9f));
    }
}

struct HoveredBox {
    const TimelineLane* lane = nullptr;
    SpanBox box;
};

// Draws a row and returns the box under the pointer, if any.
std::optional<SpanBox> drawRow(const TimelineRow& row, const TimeScale& scale, float y, float height) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool isUnderPointer = mouse.y >= y && mouse.y < y + height;
    std::optional<SpanBox> hovered;
    for (const SpanBox& box : boxesOf(row, scale.range, scale.width)) {
        const float from = scale.x + box.fromPx, to = scale.x + box.toPx;
        // Columns that several spans share are as opaque as they are busy.
        const double columnNs =
            static_cast<double>(scale.range.lengthNs()) / static_cast<double>(scale.width);
        const double busy = std::min(static_cast<double>(box.busyNs) / columnNs, 1.0);
        const bool isOwn = to - from >= 1.01f || box.spans == 1;
        const float alpha = isOwn ? 0.6f : 0.2f + 0.4f * static_cast<float>(busy);
        const float inset = to - from > 3 ? 0.5f : 0.0f;
        list.AddRectFilled({from, y}, {to - inset, y + height - 1},
                           packed(spanColour(box.longest->name), alpha));
        const float room = to - from - 4;
        if (room > ImGui::GetFontSize() && ImGui::CalcTextSize(box.longest->name).x <= room)
            list.AddText({from + 2, y + (height - ImGui::GetFontSize()) / 2 - 1}, packed(palette().text),
                         box.longest->name);
        const float reach = std::max(2 - (to - from) / 2, 0.0f);
        if (isUnderPointer && mouse.x >= from - reach && mouse.x < to + reach) hovered = box;
    }
    return hovered;
}

HoveredBox drawLane(const TimelineLane& lane, const TimeScale& scale, float left, float y,
                    const LaneSizes& sizes) {
    HoveredBox hovered;
    const float height = static_cast<float>(lane.rows.size()) * sizes.row;
    ImGui::GetWindowDrawList()->AddRectFilled({scale.x, y}, {scale.right(), y + height},
                                              ImGui::GetColorU32(ImGuiCol_FrameBg, 0.6f));
    drawLabel(scale, left, y, lane.name.c_str());
    for (const TimelineRow& row : lane.rows) {
        if (const auto box = drawRow(row, scale, y, sizes.row)) hovered = {&lane, *box};
        y += sizes.row;
    }
    return hovered;
}

void tellSpan(const FrameTimeline& timeline, const HoveredBox& hovered) {
    const planet::Span& span = *hovered.box.longest;
    ImGui::BeginTooltip();
    if (hovered.box.spans > 1) {
        ImGui::Text("%zu spans, busy for %s; the longest:", hovered.box.spans,
                    spanTimeText(hovered.box.busyNs).c_str());
    }
    ImGui::Text("%s: %s, %s", hovered.lane->name.c_str(), span.name,
                spanTimeText(span.endNs - span.beginNs).c_str());
    if (span.hasBlock) ImGui::Text("children of %s", planet::toString(span.block).c_str());
    ImGui::TextDisabled("from %.6f s", static_cast<double>(span.beginNs - timeline.originNs()) * 1e-9);
    ImGui::EndTooltip();
}

const TimelineFrame* frameAt(const FrameTimeline& timeline, std::int64_t ns) {
    const auto [first, last] = timeline.framesIn({ns, ns + 1});
    return first < last ? &timeline.frames()[first] : nullptr;
}

// cursor: that of the keyboard, at this x; none for the pointer.
void tellFrame(const FrameTimeline& timeline, const TimelineFrame& frame, const PlotCursor& cursor = {},
               float x = 0) {
    std::array<std::size_t, chunkChangeKinds> counts{};
    float largestPx = 0;
    const auto [from, to] = timeline.changesIn(frame.number, frame.number);
    for (std::size_t i = from; i < to; ++i) {
        const ChunkChange& change = timeline.changes()[i];
        ++counts.at(static_cast<std::size_t>(change.kind));
        if (change.kind == ChunkChangeKind::Popped) largestPx = std::max(largestPx, change.value);
    }
    beginSampleTooltip(cursor, x, timelineKeys);
    ImGui::Text("frame %llu: %s", static_cast<unsigned long long>(frame.number),
                spanTimeText(frame.endNs - frame.beginNs).c_str());
    ImGui::Text("%zu blocks came, %zu split, %zu merged, %zu popped", counts[0], counts[1], counts[2],
                counts[3]);
    if (largestPx > 0) ImGui::Text("largest pop: %s", pixelsText(static_cast<double>(largestPx)).c_str());
    ImGui::TextDisabled("from %.6f s. Click: list its chunks. Double click: zoom to it.",
                        static_cast<double>(frame.beginNs - timeline.originNs()) * 1e-9);
    ImGui::EndTooltip();
}

const TimelineFrame* selectedFrame(const FrameTimeline& timeline, const TimelineLanesState& state) {
    if (!state.frame) return nullptr;
    const auto frame = std::ranges::lower_bound(timeline.frames(), *state.frame, {}, &TimelineFrame::number);
    return frame != timeline.frames().end() && frame->number == *state.frame ? &*frame : nullptr;
}

// Draws the selected frame and the marked range over all lanes, and shades the time of which not all is kept.
void drawMarks(const FrameTimeline& timeline, const TimeScale& scale, const TimelineLanesState& state,
               float y, float bottom) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto area = [&](std::int64_t fromNs, std::int64_t toNs, const ImVec4& colour, float alpha) {
        const float from = std::max(scale.at(fromNs), scale.x);
        const float to = std::min(std::max(scale.at(toNs), from + 1), scale.right());
        if (to > from) list.AddRectFilled({from, y}, {to, bottom}, packed(colour, alpha));
        return std::pair(from, to);
    };
    if (timeline.completeFromNs() > scale.range.fromNs)
        area(scale.range.fromNs, timeline.completeFromNs(), palette().dim, 0.15f);
    if (state.marked && state.marked->toNs > scale.range.fromNs && state.marked->fromNs < scale.range.toNs) {
        const auto [from, to] = area(state.marked->fromNs, state.marked->toNs, palette().warning, 0.13f);
        for (const float x : {from, to}) list.AddLine({x, y}, {x, bottom}, packed(palette().warning), 1);
    }
    const TimelineFrame* const frame = selectedFrame(timeline, state);
    if (!frame) return;
    if (frame->endNs > scale.range.fromNs && frame->beginNs < scale.range.toNs)
        area(frame->beginNs, frame->endNs, palette().text, 0.12f);
}

void holdAt(TimelineLanesState& state, const TimeRange& range) {
    state.shown = range;
    state.held = true;
}

void stepFrame(const FrameTimeline& timeline, TimelineLanesState& state, const TimeRange& all, int step) {
    const auto& frames = timeline.frames();
    if (frames.empty()) return;
    auto frame = state.frame ? std::ranges::lower_bound(frames, *state.frame, {}, &TimelineFrame::number)
                             : std::prev(frames.end());
    if (frame == frames.end()) frame = std::prev(frame);
    if (step < 0 && frame != frames.begin()) --frame;
    if (step > 0 && std::next(frame) != frames.end()) ++frame;
    state.frame = frame->number;
    const std::int64_t middleNs = (frame->beginNs + frame->endNs) / 2, halfNs = state.shown.lengthNs() / 2;
    if (frame->beginNs < state.shown.fromNs || frame->endNs > state.shown.toNs)
        state.shown = within({middleNs - halfNs, middleNs + halfNs}, all);
    state.held = true;
}

// Selects the next frame and adds it to the marked range, which begins with the frame that was selected before.
void markFrame(const FrameTimeline& timeline, TimelineLanesState& state, const TimeRange& all, int step) {
    const auto add = [&] {
        const TimelineFrame* const frame = selectedFrame(timeline, state);
        if (!frame) return;
        const TimeRange marked = state.marked.value_or(TimeRange{frame->beginNs, frame->endNs});
        state.marked =
            TimeRange{std::min(marked.fromNs, frame->beginNs), std::max(marked.toNs, frame->endNs)};
    };
    add();
    stepFrame(timeline, state, all, step);
    add();
}

void zoomToFrame(const TimelineFrame& frame, TimelineLanesState& state, const TimeRange& all) {
    const std::int64_t marginNs = (frame.endNs - frame.beginNs) / 20;
    holdAt(state, within({frame.beginNs - marginNs, frame.endNs + marginNs}, all));
    state.frame = frame.number;
}

void keyboard(const FrameTimeline& timeline, TimelineLanesState& state, const TimeRange& all) {
    const PlotKeys keys = takePlotKeys(PlotReads::View);
    constexpr double step = 0.1, page = 0.9, factor = 0.7;
    if (keys.right != 0 && keys.withShift) stepFrame(timeline, state, all, keys.right);
    if (keys.right != 0 && !keys.withShift) holdAt(state, moved(state.shown, keys.right * step, all));
    if (keys.pagesDown != 0 && keys.withShift) markFrame(timeline, state, all, keys.pagesDown);
    if (keys.pagesDown != 0 && !keys.withShift) holdAt(state, moved(state.shown, keys.pagesDown * page, all));
    if (const int in = keys.up + keys.zoomIn; in != 0)
        holdAt(state, zoomed(state.shown, 0.5, std::pow(factor, in), all));
    if (keys.toFirst) holdAt(state, within({all.fromNs, all.fromNs + state.shown.lengthNs()}, all));
    if (keys.toLast) state.held = false;
    const TimelineFrame* const frame = selectedFrame(timeline, state);
    if (keys.acts && frame) zoomToFrame(*frame, state, all);
    if (!ImGui::IsItemFocused() || ImGui::GetIO().WantTextInput || ImGui::GetIO().KeyCtrl) return;
    for (const ImWchar typed : ImGui::GetIO().InputQueueCharacters)
        if (typed == 'f' || typed == 'F') fitTimeline(timeline, state);
}

void drag(const TimeScale& scale, TimelineLanesState& state, const TimeRange& all) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActivated()) {
        state.movedPx = 0;
        state.marks = io.KeyShift;
        state.markFromNs = scale.timeAt(io.MousePos.x);
        if (state.marks) state.marked.reset();
    }
    if (!ImGui::IsItemActive()) return;
    const ImVec2 delta = dragDelta(ImGuiMouseButton_Left);
    state.movedPx += static_cast<double>(std::abs(delta.x) + std::abs(delta.y));
    if (state.movedPx < 3) return;
    if (state.marks) {
        const std::int64_t toNs = scale.timeAt(io.MousePos.x);
        const auto [first, last] = std::minmax(state.markFromNs, toNs);
        if (last > first) state.marked = TimeRange{first, last};
        state.held = true;
    } else if (delta.x != 0) {
        holdAt(state, moved(state.shown, static_cast<double>(-delta.x / scale.width), all));
    }
    if (!state.marks && delta.y != 0) ImGui::SetScrollY(ImGui::GetScrollY() - delta.y);
}

void mouse(const FrameTimeline& timeline, const TimeScale& scale, TimelineLanesState& state,
           const TimeRange& all) {
    const ImGuiIO& io = ImGui::GetIO();
    drag(scale, state, all);
    const TimelineFrame* const frame = frameAt(timeline, scale.timeAt(io.MousePos.x));
    const bool clicked = ImGui::IsItemDeactivated() && state.movedPx < 3 && !state.marks;
    if (clicked && frame) state.frame = frame->number;
    if (!plotIsHovered()) return;
    ImGui::SetItemUsingMouseWheel();
    if (frame && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !io.KeyShift)
        zoomToFrame(*frame, state, all);
    if (io.MouseWheel == 0) return;
    if (io.KeyShift)
        ImGui::SetScrollY(ImGui::GetScrollY() - 3 * io.MouseWheel * ImGui::GetFontSize());
    else
        holdAt(state, zoomed(state.shown, scale.placeOf(io.MousePos.x),
                             std::pow(0.8, static_cast<double>(io.MouseWheel)), all));
}

float lanesHeight(const FrameTimeline& timeline, const LaneSizes& sizes) {
    float height = sizes.frames + sizes.changes + 2 * sizes.gap;
    for (const std::size_t lane : laneOrder(timeline))
        height += static_cast<float>(timeline.lanes()[lane].rows.size()) * sizes.row + sizes.gap;
    return height;
}

void tellChanges() {
    ImGui::BeginTooltip();
    for (const ChunkChangeKind kind : shownChanges)
        ImGui::TextColored(changeColour(kind), "%s", chunkChangeName(kind));
    ImGui::EndTooltip();
}

void drawLanes(const FrameTimeline& timeline, const TimeScale& scale, TimelineLanesState& state,
               ImVec2 corner, const LaneSizes& sizes, bool isHovered) {
    const float left = corner.x;
    float y = corner.y;
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    const auto isOver = [&](float top, float bottom) {
        return isHovered && pointer.y >= top && pointer.y < bottom && !ImGui::IsItemActive();
    };
    drawFrames(timeline, scale, state, left, y, sizes.frames);
    const TimelineFrame* const frame = frameAt(timeline, scale.timeAt(pointer.x));
    if (isOver(y, y + sizes.frames) && pointer.x >= scale.x && frame) tellFrame(timeline, *frame);
    y += sizes.frames + sizes.gap;
    drawChanges(timeline, scale, left, y, sizes);
    if (isOver(y, y + sizes.changes)) tellChanges();
    y += sizes.changes + sizes.gap;
    const ImRect clip = ImGui::GetCurrentWindow()->ClipRect;
    for (const std::size_t number : laneOrder(timeline)) {
        const TimelineLane& lane = timeline.lanes()[number];
        const float bottom = y + static_cast<float>(lane.rows.size()) * sizes.row;
        if (bottom > clip.Min.y && y < clip.Max.y) {
            const HoveredBox hovered = drawLane(lane, scale, left, y, sizes);
            if (hovered.lane && isOver(y, bottom) && pointer.x >= scale.x) tellSpan(timeline, hovered);
        }
        y = bottom + sizes.gap;
    }
    drawMarks(timeline, scale, state, corner.y, y - sizes.gap);
}

float labelWidth(const FrameTimeline& timeline) {
    float width = ImGui::CalcTextSize("500 ms").x;
    for (const std::size_t lane : laneOrder(timeline))
        width = std::max(width, ImGui::CalcTextSize(timeline.lanes()[lane].name.c_str()).x);
    return std::min(width, 9 * ImGui::GetFontSize()) + 2 * ImGui::GetStyle().ItemInnerSpacing.x;
}

}  // namespace

TimeRange toldRange(const TimelineLanesState& state) {
    return state.marked.value_or(state.shown);
}

void followNewest(const FrameTimeline& timeline, TimelineLanesState& state) {
    const TimeRange all = timeline.extent();
    if (!state.held) state.shown = {all.toNs - state.shown.lengthNs(), all.toNs};
}

void fitTimeline(const FrameTimeline& timeline, TimelineLanesState& state) {
    state.shown = within(timeline.extent(), timeline.extent());
}

void timelineLanes(const FrameTimeline& timeline, TimelineLanesState& state) {
    const TimeRange all = timeline.extent();
    const LaneSizes sizes;
    const float scrollbar = ImGui::GetStyle().ScrollbarSize;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float label = labelWidth(timeline);
    const float width = ImGui::GetContentRegionAvail().x - label - scrollbar;
    TimeScale scale{state.shown, corner.x + label, std::max(width, ImGui::GetFontSize())};
    ImGui::Dummy({label + scale.width, ImGui::GetFontSize()});
    drawAxis(timeline, scale, corner.y, corner.y + ImGui::GetFontSize() + 2);
    const float height = std::max(ImGui::GetContentRegionAvail().y, 4 * ImGui::GetFontSize());
    ImGui::BeginChild("lanes", {label + scale.width + scrollbar, height}, false,
                      ImGuiWindowFlags_NoScrollWithMouse);
    const ImVec2 start = ImGui::GetCursorScreenPos();
    plotItem("lanes", {label + scale.width, lanesHeight(timeline, sizes)});
    noteItem("Lanes");
    const bool isHovered = plotIsHovered();
    mouse(timeline, scale, state, all);
    keyboard(timeline, state, all);
    if (const TimelineFrame* const frame = selectedFrame(timeline, state); frame && plotHasKeyboard())
        tellFrame(timeline, *frame, {.at = frame->number}, scale.at(frame->beginNs));
    exportPlot("timeline", timelineFramesTable(timeline, toldRange(state)));
    drawLanes(timeline, scale, state, start, sizes, isHovered);
    ImGui::EndChild();
}

}  // namespace worldy::ui
