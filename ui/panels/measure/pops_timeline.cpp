#include "ui/panels/measure/pops_timeline.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "ui/kit/exports.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/plots.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

constexpr double leastSpanS = 0.5;

// The plot's rectangle on the screen, with the mapping of times and jumps.
struct Plot {
    ImVec2 start;
    ImVec2 end;
    float top = 0;  // top of the jumps; the bars are above it
    double fromS = 0;
    double toS = 1;

    float x(double timeS) const {
        return start.x + static_cast<float>((timeS - fromS) / (toS - fromS)) * (end.x - start.x);
    }
    float y(double px) const {
        const double share = logarithmicPosition(std::max(px, leastPopPx), leastPopPx, mostPopPx);
        return end.y - 1 - static_cast<float>(share) * (end.y - top - 2);
    }
    double timeAt(float atX) const {
        return fromS + static_cast<double>((atX - start.x) / std::max(end.x - start.x, 1.0f)) * (toS - fromS);
    }
};

void drawAxis(const Plot& plot) {
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    drawList.AddRectFilled(plot.start, plot.end, ImGui::GetColorU32(ImGuiCol_FrameBg),
                           ImGui::GetStyle().FrameRounding);
    for (const double px : {0.01, 0.1, 1.0, 10.0}) {
        const float y = std::round(plot.y(px));
        drawList.AddLine({plot.start.x, y}, {plot.end.x, y}, packed(palette().dim, 0.25f));
        const std::string label = fmt::format("{} px", axisText(px));
        if (y - ImGui::GetTextLineHeight() < plot.top) continue;
        drawList.AddText({plot.start.x + 3, y - ImGui::GetTextLineHeight()}, packed(palette().dim, 0.8f),
                         label.c_str());
    }
    // The steps are 1, 2 or 5 s times a power of ten, about eight of them.
    const double stepS = roundedTop((plot.toS - plot.fromS) / 8);
    for (int step = 0; step * stepS < planet::PopMeter::keptS; ++step) {
        const float x = plot.x(plot.toS - step * stepS);
        if (x < plot.start.x) break;
        drawList.AddLine({x, plot.start.y}, {x, plot.end.y}, packed(palette().dim, 0.12f));
    }
}

void drawLate(const Plot& plot, const planet::PopMeter& meter) {
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const float height = plot.top - plot.start.y;
    for (const planet::LateArrival& late : meter.late()) {
        if (late.untilS < plot.fromS || late.sinceS > plot.toS) continue;
        const float left = std::max(plot.x(late.sinceS), plot.start.x);
        const float right = std::min(std::max(plot.x(late.untilS), left + 1), plot.end.x);
        const ImVec4& colour = late.end == planet::LateEnd::Open ? palette().bad : palette().warning;
        drawList.AddRectFilled({left, plot.start.y + 1}, {right, plot.start.y + height - 1},
                               packed(colour, 0.35f));
    }
}

// Returns the event with the largest jump in each column of pixels; null for a column without events.
std::vector<const planet::PopEvent*> columnsOf(const Plot& plot, const planet::PopMeter& meter) {
    const auto columns = static_cast<std::size_t>(std::max(plot.end.x - plot.start.x, 1.0f));
    std::vector<const planet::PopEvent*> highest(columns, nullptr);
    for (const planet::PopEvent& event : meter.events()) {
        if (event.timeS < plot.fromS || event.timeS > plot.toS || event.jump.places == 0) continue;
        const auto column =
            std::min(static_cast<std::size_t>(plot.x(event.timeS) - plot.start.x), columns - 1);
        const planet::PopEvent*& best = highest[column];
        if (!best || planet::isWorsePop(event, *best)) best = &event;
    }
    return highest;
}

void drawTicks(const Plot& plot, const std::vector<const planet::PopEvent*>& columns) {
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    for (const planet::PopEvent* event : columns) {
        if (!event) continue;
        const float x = plot.x(event->timeS);
        const ImU32 colour = packed(popColour(event->cause), planet::counts(*event) ? 1.0f : 0.35f);
        drawList.AddLine({x, plot.end.y - 1}, {x, plot.y(event->jump.largestPx)}, colour, 1.5f);
        drawList.AddCircleFilled({x, plot.y(event->jump.largestPx)}, ImGui::GetFontSize() * 0.15f, colour);
    }
}

const planet::PopEvent* nearestTo(const Plot& plot, const std::vector<const planet::PopEvent*>& columns,
                                  float x) {
    const auto reach = static_cast<int>(ImGui::GetFontSize() * 0.5f);
    const auto middle = static_cast<int>(x - plot.start.x);
    const planet::PopEvent* best = nullptr;
    for (int column = std::max(middle - reach, 0);
         column <= middle + reach && column < static_cast<int>(columns.size()); ++column) {
        const planet::PopEvent* event = columns[static_cast<std::size_t>(column)];
        if (event && (!best || event->jump.largestPx > best->jump.largestPx)) best = event;
    }
    return best;
}

constexpr const char* popKeys =
    "Left, Right: event   PageUp, PageDown: move   Up, Down, + -: zoom   End: newest";

void tellAt(const Plot& plot, const planet::PopMeter& meter, const planet::PopEvent* event, float x,
            const PlotCursor& cursor = {}) {
    const double atS = plot.timeAt(x);
    std::size_t late = 0;
    double worstPx = 0;
    for (const planet::LateArrival& arrival : meter.late()) {
        if (arrival.sinceS > atS || arrival.untilS < atS) continue;
        ++late;
        worstPx = std::max(worstPx, arrival.worstEpsPx);
    }
    beginSampleTooltip(cursor, x, popKeys);
    ImGui::Text("%s ago", durationText(std::max(meter.lastTimeS() - atS, 0.0)).c_str());
    if (event) {
        ImGui::Text("%s, level %d to %d", planet::toString(event->chunk).c_str(), event->fromLevel,
                    event->toLevel);
        const std::string jump =
            event->measured ? ", jumps " + popPxText(event->jump.largestPx) : std::string();
        ImGui::TextColored(popColour(event->cause), "%s%s", planet::popCauseName(event->cause), jump.c_str());
        if (!planet::counts(*event)) ImGui::TextUnformatted(planet::popNote(*event));
    }
    if (late > 0) ImGui::Text("%zu late chunks, max error %s", late, pixelsText(worstPx).c_str());
    ImGui::EndTooltip();
}

void moveInTime(const Plot& plot, PopTimelineState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    const double width = std::max(static_cast<double>(plot.end.x - plot.start.x), 1.0);
    if (ImGui::IsItemActive()) {
        const auto movedPx = static_cast<double>(dragDelta(ImGuiMouseButton_Left).x);
        state.behindS += movedPx / width * state.spanS;
        state.movedPx += std::abs(movedPx);
    }
    if (plotIsHovered() && io.MouseWheel != 0) {
        // The time under the pointer stays under it.
        const double right = static_cast<double>((plot.end.x - io.MousePos.x)) / width;
        const double before = state.spanS;
        state.spanS = std::clamp(before * std::pow(0.8, static_cast<double>(io.MouseWheel)), leastSpanS,
                                 planet::PopMeter::keptS);
        state.behindS += right * (before - state.spanS);
    }
    state.behindS = std::clamp(state.behindS, 0.0, planet::PopMeter::keptS - state.spanS);
}

// Returns the place of the selected event in the meter's list; none if it is gone.
std::optional<std::size_t> placeOf(const planet::PopMeter& meter, const std::optional<PopKey>& selected) {
    const auto& events = meter.events();
    const auto found = std::find_if(events.begin(), events.end(),
                                    [&](const auto& event) { return keyOf(event) == selected; });
    if (found == events.end()) return std::nullopt;
    return static_cast<std::size_t>(found - events.begin());
}

// Moves and zooms the timeline by the keys. Returns the event that they lead to; it is brought into view.
std::optional<PopKey> popsByKeys(const planet::PopMeter& meter, const std::optional<PopKey>& selected,
                                 PopTimelineState& state) {
    const PlotKeys keys = takePlotKeys(PlotReads::View);
    const double before = state.spanS;
    state.spanS =
        std::clamp(before * std::pow(0.8, keys.up + keys.zoomIn), leastSpanS, planet::PopMeter::keptS);
    state.behindS += (before - state.spanS) / 2 - 0.5 * keys.pagesDown * state.spanS;
    if (keys.toFirst) state.behindS = planet::PopMeter::keptS;
    if (keys.toLast) state.behindS = 0;
    std::optional<PopKey> reached;
    if (keys.right != 0 && !meter.events().empty()) {
        const std::size_t count = meter.events().size();
        const auto at = placeOf(meter, selected);
        const planet::PopEvent& event =
            meter.events()[at ? movedCursor(*at, count, {.right = keys.right}) : count - 1];
        reached = keyOf(event);
        const double agoS = meter.lastTimeS() - event.timeS;
        if (agoS < state.behindS || agoS > state.behindS + state.spanS)
            state.behindS = agoS - state.spanS / 2;
    }
    state.behindS = std::clamp(state.behindS, 0.0, planet::PopMeter::keptS - state.spanS);
    return reached;
}

}  // namespace

ImVec4 popColour(planet::PopCause cause) {
    return seriesColour(static_cast<std::size_t>(cause));
}

// The names are those of worldy pops --json.
std::vector<ExportField<planet::PopEvent>> popFields() {
    using E = planet::PopEvent;
    const auto px = [](const E& e, double value) { return e.measured ? ExportCell(value) : ExportCell(); };
    return {{"time_s", [](const E& e) { return e.timeS; }, true},
            {"chunk", [](const E& e) { return planet::toString(e.chunk); }, true},
            {"from_level", [](const E& e) { return e.fromLevel; }},
            {"to_level", [](const E& e) { return e.toLevel; }},
            {"cause", [](const E& e) { return planet::popCauseName(e.cause); }},
            {"note", [](const E& e) { return planet::popNote(e); }},
            {"largest_px", [=](const E& e) { return px(e, e.jump.largestPx); }},
            {"largest_facing_px", [=](const E& e) { return px(e, e.jump.largestFacingPx); }},
            {"mean_px", [=](const E& e) { return px(e, e.jump.meanPx); }},
            {"beside_px", [=](const E& e) { return px(e, e.besidePx); }}};
}

std::optional<PopKey> popTimeline(const planet::PopMeter& meter, float lines,
                                  const std::optional<PopKey>& selected, PopTimelineState& state) {
    const float width = std::max(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize());
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const float height = std::round(lines * ImGui::GetTextLineHeightWithSpacing());
    plotItem("timeline", {width, height});
    ImGui::SetItemUsingMouseWheel();
    noteItem("Timeline");
    Plot plot{start, {start.x + width, start.y + height}};
    plot.top = start.y + std::round(ImGui::GetFontSize() * 0.6f);
    if (ImGui::IsItemActivated()) state.movedPx = 0;
    moveInTime(plot, state);
    const std::optional<PopKey> reached = popsByKeys(meter, selected, state);
    const bool hovered = plotIsHovered();
    const bool clicked = ImGui::IsItemDeactivated() && state.movedPx < 4;
    plot.toS = meter.lastTimeS() - state.behindS;
    plot.fromS = plot.toS - state.spanS;
    drawAxis(plot);
    ImGui::PushClipRect(plot.start, plot.end, true);
    drawLate(plot, meter);
    const std::vector<const planet::PopEvent*> columns = columnsOf(plot, meter);
    drawTicks(plot, columns);
    for (const planet::PopEvent& event : meter.events()) {
        if (!selected || keyOf(event) != *selected) continue;
        const float x = plot.x(event.timeS);
        ImGui::GetWindowDrawList()->AddLine({x, plot.start.y}, {x, plot.end.y}, packed(palette().text), 1.5f);
    }
    ImGui::PopClipRect();
    const auto& events = meter.events();
    exportPlot("pops timeline",
               exportTable<planet::PopEvent>(
                   "pops timeline", events.size(),
                   [&](std::size_t row) -> const planet::PopEvent& { return events[row]; }, popFields()));
    if (const auto at = placeOf(meter, selected); at && plotHasKeyboard()) {
        const planet::PopEvent& event = events[*at];
        tellAt(plot, meter, &event, plot.x(event.timeS), {.at = at});
    }
    if (!hovered) return reached;
    const float x = ImGui::GetIO().MousePos.x;
    const planet::PopEvent* event = nearestTo(plot, columns, x);
    tellAt(plot, meter, event, x);
    return clicked && event ? std::optional(keyOf(*event)) : reached;
}

}  // namespace worldy::ui
