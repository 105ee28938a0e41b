#include "ui/panels/measure/pops_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/columns.h"
#include "ui/kit/figure_rows.h"
#include "ui/kit/filter_box.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

using planet::PopEvent;
using planet::PopMeter;

constexpr double popsSampledEveryS = 0.25;
constexpr std::size_t buckets = 40;

void refresh(const EditorView& view, PopsPanelState& state) {
    PopsPanelState::Sample& sample = state.sample;
    const PopMeter& meter = *view.instruments.pops.meter;
    const bool current = sample.meter == &meter && view.frames.timeS >= sample.takenAtS &&
                         view.frames.timeS < sample.takenAtS + popsSampledEveryS &&
                         meter.totals().switches >= sample.switches;
    if (current) return;
    sample = {};
    sample.meter = &meter;
    sample.takenAtS = view.frames.timeS;
    sample.switches = meter.totals().switches;
    std::vector<float> positions;
    for (const PopEvent& event : meter.events()) {
        if (!planet::counts(event)) continue;
        const double px = std::max(event.jump.largestPx, leastPopPx);
        positions.push_back(static_cast<float>(logarithmicPosition(px, leastPopPx, mostPopPx)));
    }
    sample.seen = positions.size();
    sample.counts = bucketCounts(positions, buckets);
    sample.medianPx = meter.percentilePx(0.5);
    sample.p99Px = meter.percentilePx(0.99);
}

void popsControls(const EditorView& view, PopsPanelState& state, Commands& commands) {
    bool measuring = view.instruments.pops.measuring;
    if (ImGui::Checkbox("Measure", &measuring)) commands.push_back(MeasurePops{measuring});
    noteItem("Measure");
    tooltip(fmt::format("Measures every level change as it happens; mean cost so far {:.0f} µs per change. "
                        "Off: no changes are recorded and no time is spent.",
                        view.instruments.pops.meter->measuredUsPerSwitch())
                .c_str());
    sameLineForButton("Clear");
    if (button("Clear", "Discards all measurements.")) {
        commands.push_back(ClearPops{});
        state.selected.reset();
    }
}

void jumps(const EditorView& view, PopsPanelState& state, Commands& commands) {
    popsControls(view, state, commands);
    const PopsPanelState::Sample& sample = state.sample;
    if (sample.seen == 0) {
        wrappedText(view.instruments.pops.measuring
                        ? "No level changes that count in the last five minutes. Fly, or "
                          "change a setting in the LOD panel."
                        : "Not measuring.",
                    palette().dim);
    } else {
        // The value has a line to itself; it could otherwise be broken at the decimal point.
        ImGui::TextWrapped("P99 jump:\n< %s; %s level changes",
                           popPxText(std::max(sample.p99Px, leastPopPx)).c_str(),
                           countText(static_cast<double>(sample.seen)).c_str());
        tooltip(
            "Level changes in the last five minutes that are visible and do not follow a camera jump: the "
            "largest screen-space distance, in "
            "pixels, that a surface point jumps in the frame of the level change, including morphing. Less "
            "than "
            "0.1 px is invisible.");
    }
    const std::array marks = {
        HistogramMark{logarithmicPosition(std::max(sample.p99Px, leastPopPx), leastPopPx, mostPopPx),
                      fmt::format("99 %: {}", popPxText(sample.p99Px))}};
    histogram("pop histogram", sample.counts, fmt::format("{} px", leastPopPx),
              fmt::format("{} px", mostPopPx),
              sample.seen > 0 ? std::span<const HistogramMark>(marks) : std::span<const HistogramMark>(), 4,
              [](double position) { return popPxText(logarithmicValue(position, leastPopPx, mostPopPx)); });
    tooltip("Histogram of level changes by largest jump in pixels, on a logarithmic axis.");
}

void totals(const EditorView& view, const PopsPanelState& state) {
    const PopMeter& meter = *view.instruments.pops.meter;
    if (!beginValues("pops")) return;
    const Figures figures = popFigures(meter, state.sample.medianPx);
    for (std::size_t i = 0; i < planet::popCauseCount; ++i) {
        const ImVec4 colour = popColour(static_cast<planet::PopCause>(i));
        const bool any = meter.totals().byCause[i] > 0;
        valueRow(figures[i].name.c_str(), figures[i].value, figures[i].explanation.c_str(),
                 any ? &colour : nullptr);
    }
    figureRows(std::span(figures).subspan(planet::popCauseCount));
    endValues();
}

void flip(const EditorView& view, Commands& commands) {
    const PopsView& pops = view.instruments.pops;
    constexpr std::array<const char*, 3> names = {"Live", "Before", "After"};
    constexpr std::array<const char*, 3> meanings = {
        "Draws the current selection.", "Draws all chunks as in the frame before the level change.",
        "Draws all chunks as in the frame of the level change."};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        const auto side = static_cast<PopSide>(i);
        if (ImGui::RadioButton(names[i], pops.side == side)) commands.push_back(ShowPopSide{side});
        noteItem(names[i]);
        tooltip(
            fmt::format("Level change of {}: {}", planet::toString(pops.shown->chunk), meanings[i]).c_str());
    }
    if (!pops.problem.empty()) wrappedText(pops.problem, palette().warning);
}

std::string jumpText(const PopEvent& event, double px) {
    return event.measured ? popPxText(px) : "-";
}

void selectedValues(const PopEvent& event) {
    if (!beginValues("selected")) return;
    valueRow("levels", fmt::format("{} to {}", event.fromLevel, event.toLevel),
             "Level of the finest chunk drawn there, before and after.");
    const ImVec4 colour = popColour(event.cause);
    valueRow("cause", planet::popCauseName(event.cause), "Cause of the level change.", &colour);
    if (!planet::counts(event))
        valueRow("note", planet::popNote(event), "Why the level change does not count.", &palette().warning);
    valueRow("largest", jumpText(event, event.jump.largestPx),
             "Largest screen-space distance that a point jumps, in pixels, between the projections before "
             "and after through the new view.");
    valueRow("facing", jumpText(event, event.jump.largestFacingPx),
             "Largest jump in pixels as if the view faced the place, without the stretching towards the "
             "picture's corners.");
    valueRow("mean", jumpText(event, event.jump.meanPx),
             "Mean over its screen area in the picture, in pixels, without what a drawn sea covers.");
    valueRow("adjacent", jumpText(event, event.besidePx),
             "Largest jump along edges of unchanged adjacent chunks, in pixels.");
    endValues();
}

void selectedEvent(const EditorView& view, PopsPanelState& state, Commands& commands) {
    const auto& events = view.instruments.pops.meter->events();
    const auto found = std::find_if(events.begin(), events.end(), [&](const PopEvent& event) {
        return state.selected && keyOf(event) == *state.selected;
    });
    if (found == events.end()) {
        wrappedText(
            "Click a tick or a row to select a level change. Drag the timeline to pan; use the wheel to "
            "zoom.",
            palette().dim);
    } else {
        if (button("Go to view",
                   "Moves the camera to where the level change was seen, freezes LOD there, and selects its "
                   "chunk."))
            commands.push_back(GoBackToPop{found->frame, found->chunk});
        ImGui::SameLine();
        chunkLink(found->chunk, view, commands);
    }
    const planet::PopEvent* const shown = view.instruments.pops.shown;
    const bool isOther = shown && found != events.end() && keyOf(*shown) != keyOf(*found);
    if (isOther)
        wrappedText(fmt::format("The view is that of the level change of {}. Go to the view of this one to "
                                "draw it before and after.",
                                planet::toString(shown->chunk)),
                    palette().dim);
    else if (shown)
        flip(view, commands);
    if (found != events.end()) selectedValues(*found);
}

void timeline(const EditorView& view, PopsPanelState& state, bool wide, Commands& commands) {
    const float spare = ImGui::GetContentRegionAvail().y / ImGui::GetTextLineHeightWithSpacing();
    const float lines = wide ? std::clamp(spare * 0.4f, 3.0f, 12.0f) : 6;
    if (const auto clicked = popTimeline(*view.instruments.pops.meter, lines, state.selected, state.timeline))
        state.selected = clicked;
    ImGui::TextDisabled("%s up to %s", durationText(state.timeline.spanS).c_str(),
                        state.timeline.behindS > 0
                            ? fmt::format("{} ago", durationText(state.timeline.behindS)).c_str()
                            : "now");
    if (state.timeline.behindS > 0) {
        ImGui::SameLine();
        if (ImGui::SmallButton("Now")) state.timeline.behindS = 0;
        noteItem("Now");
    }
    selectedEvent(view, state, commands);
}

void eventRow(const EditorView& view, const PopEvent& event, std::size_t row, PopsPanelState& state) {
    if (!planet::counts(event)) ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
    ImGui::TableNextColumn();
    const bool isSelected = state.selected == keyOf(event);
    const double agoS = std::max(view.instruments.pops.meter->lastTimeS() - event.timeS, 0.0);
    // The id after ### keeps the row's identity while the time changes.
    const std::string ago = fmt::format("{:.{}f} s###row", agoS, agoS < 10 ? 1 : 0);
    if (ImGui::Selectable(ago.c_str(), isSelected, ImGuiSelectableFlags_SpanAllColumns))
        state.selected = keyOf(event);
    if (row < 3) noteItem(fmt::format("Row {}", row));
    cell(jumpText(event, event.jump.largestPx));
    cell(planet::popCauseName(event.cause), popColour(event.cause));
    cell(fmt::format("{} > {}", event.fromLevel, event.toLevel));
    cell(planet::toString(event.chunk));
    cell(planet::popNote(event), palette().dim);
    cell(jumpText(event, event.jump.meanPx));
    cell(jumpText(event, event.besidePx));
    if (!planet::counts(event)) ImGui::PopStyleColor();
}

// widestChunk: must outlive the columns.
std::array<TableColumn, 8> eventColumns(const std::string& widestChunk) {
    return {TableColumn{"Ago", 0.8f, nullptr, "123 s"},
            TableColumn{"Largest", 1.1f, nullptr, "< 0.001 px"},
            TableColumn{"Cause", 1.8f, nullptr, "settings changed"},
            TableColumn{"Levels", 0.9f, nullptr, "10 > 11"},
            TableColumn{"Chunk", 1.6f, nullptr, widestChunk.c_str()},
            TableColumn{"Note", 1.3f, nullptr, "outside picture"},
            TableColumn{"Mean", 1.1f, nullptr, "< 0.001 px"},
            TableColumn{"Adjacent", 1.1f, nullptr, "< 0.001 px"}};
}

void worstFirst(const EditorView& view, PopsPanelState& state) {
    const auto& events = view.instruments.pops.meter->events();
    if (events.empty()) return emptyState("No level changes recorded.");
    filterBox(state.filter, "level changes");
    std::vector<std::size_t> order;
    order.reserve(events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
        const PopEvent& event = events[i];
        if (state.filter.empty() ||
            passes(state.filter.view(), {planet::popCauseName(event.cause), planet::toString(event.chunk),
                                         planet::popNote(event)}))
            order.push_back(i);
    }
    if (order.empty()) return emptyState("No level change matches the filter.");
    const HitHighlight highlight(state.filter);
    const std::string chunk = widestChunkName(view);
    const std::array columns = eventColumns(chunk);
    if (!beginWideTable("worst", columns)) return;
    const auto worse = [&](std::size_t a, std::size_t b) { return planet::isWorsePop(events[a], events[b]); };
    if (const std::optional<TableSort> sort = chosenSort()) {
        const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
            const PopEvent& event = events[order[row]];
            switch (column) {
                case 0:
                    return -event.timeS;
                case 1:
                    return event.jump.largestPx;
                case 2:
                    return std::string(planet::popCauseName(event.cause));
                case 3:
                    return static_cast<double>(event.fromLevel);
                case 4:
                    return sortKey(event.chunk);
                case 5:
                    return std::string(planet::popNote(event));
                case 6:
                    return event.jump.meanPx;
                default:
                    return event.besidePx;
            }
        };
        const std::vector<std::size_t> sorted = tableOrder(order.size(), sort, key);
        tableRows(sorted.size(),
                  [&](std::size_t row) { eventRow(view, events[order[sorted[row]]], row, state); });
    } else {
        sortedTableRows(order, worse, [&](std::size_t event, std::size_t row) {
            eventRow(view, events[event], row, state);
        });
    }
    ExportTable table = exportTable<PopEvent>(
        "pops", order.size(), [&](std::size_t row) -> const PopEvent& { return events[order[row]]; },
        popFields());
    if (!chosenSort()) table.sortAll = [&] { std::sort(order.begin(), order.end(), worse); };
    endTable(table);
}

}  // namespace

void popsPanel(const EditorView& view, PopsPanelState& state, Commands& commands) {
    if (!view.planet || !view.instruments.pops.meter)
        return emptyState("No planet is open. Open one to measure jumps at level changes.");
    refresh(view, state);
    const bool wide = hasWideRoom();
    const auto rows =
        static_cast<float>(std::clamp<std::size_t>(view.instruments.pops.meter->events().size() + 2, 3, 14));
    const float font = ImGui::GetFontSize();
    const std::string chunk = widestChunkName(view);
    const std::array columns = {Column{.title = "Jumps",
                                       .draw =
                                           [&] {
                                               jumps(view, state, commands);
                                               totals(view, state);
                                           },
                                       .wanted = 16 * font},
                                Column{.title = "Timeline",
                                       .share = 1.5f,
                                       .draw = [&] { timeline(view, state, wide, commands); },
                                       .wanted = 18 * font},
                                Column{.title = "Level changes",
                                       .share = 1.6f,
                                       .stackedLines = rows,
                                       .draw = [&] { worstFirst(view, state); },
                                       .wanted = listTableWidth(eventColumns(chunk))}};
    drawColumns("pops", columns);
}

}  // namespace worldy::ui
