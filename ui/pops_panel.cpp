#include "ui/pops_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "ui/chunk_link.h"
#include "ui/columns.h"
#include "ui/item_map.h"
#include "ui/plot_scale.h"
#include "ui/plots.h"
#include "ui/tables.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

using planet::PopEvent;
using planet::PopMeter;

constexpr double popsSampledEveryS = 0.25;
constexpr std::size_t buckets = 40;

void refresh(const EditorView& view, PopsPanelState& state) {
    PopsPanelState::Sample& sample = state.sample;
    const PopMeter& meter = *view.pops.meter;
    const bool current = sample.meter == &meter && view.timeS >= sample.takenAtS &&
                         view.timeS < sample.takenAtS + popsSampledEveryS &&
                         meter.totals().switches >= sample.switches;
    if (current) return;
    sample = {};
    sample.meter = &meter;
    sample.takenAtS = view.timeS;
    sample.switches = meter.totals().switches;
    std::vector<float> positions;
    for (const PopEvent& event : meter.events()) {
        if (event.jump.places == 0) continue;
        const double px = std::max(event.jump.largestPx, leastPopPx);
        positions.push_back(static_cast<float>(logarithmicPosition(px, leastPopPx, mostPopPx)));
    }
    sample.seen = positions.size();
    sample.counts = bucketCounts(positions, buckets);
    sample.medianPx = meter.percentilePx(0.5);
    sample.p99Px = meter.percentilePx(0.99);
}

void popsControls(const EditorView& view, PopsPanelState& state, Commands& commands) {
    bool measuring = view.pops.measuring;
    if (ImGui::Checkbox("Measure", &measuring)) commands.push_back(MeasurePops{measuring});
    noteItem("Measure");
    tooltip(fmt::format("Measures every change of level as it happens: {:.0f} us each so far, only in frames "
                        "that have one. Off: nothing is seen, and nothing is spent.",
                        view.pops.meter->measuredUsPerSwitch())
                .c_str());
    ImGui::SameLine();
    if (button("Clear", "Forgets all that was measured.")) {
        commands.push_back(ClearPops{});
        state.selected.reset();
    }
}

void jumps(const EditorView& view, PopsPanelState& state, Commands& commands) {
    popsControls(view, state, commands);
    const PopsPanelState::Sample& sample = state.sample;
    if (sample.seen == 0) {
        wrappedText(view.pops.measuring ? "No change of level in the last minutes. Fly, or change a setting "
                                          "of the LOD panel."
                                        : "Not measuring.",
                    palette().dim);
    } else {
        // A line of its own: else it may be broken at its decimal point.
        ImGui::TextWrapped("99%% of switches move less than\n%s; %s measured.",
                           popPxText(std::max(sample.p99Px, leastPopPx)).c_str(),
                           countText(static_cast<double>(sample.seen)).c_str());
        tooltip(
            "Of the changes of level in the picture in the last five minutes: the largest distance on "
            "screen, "
            "pixels, that a point of the surface jumps in the frame of the switch, morphing counted in. "
            "Under 0.1 px nobody sees it.");
    }
    const std::array marks = {
        HistogramMark{logarithmicPosition(std::max(sample.p99Px, leastPopPx), leastPopPx, mostPopPx),
                      fmt::format("99%: {}", popPxText(sample.p99Px))}};
    histogram("jumps", sample.counts, fmt::format("{} px", leastPopPx), fmt::format("{} px", mostPopPx),
              sample.seen > 0 ? std::span<const HistogramMark>(marks) : std::span<const HistogramMark>(), 4,
              [](double position) { return popPxText(logarithmicValue(position, leastPopPx, mostPopPx)); });
    tooltip("Switches by their largest jump, pixels, on a logarithmic axis.");
}

void totals(const EditorView& view, const PopsPanelState& state) {
    const PopMeter& meter = *view.pops.meter;
    const planet::PopTotals& t = meter.totals();
    const auto count = [](std::uint64_t value) { return countText(static_cast<double>(value)); };
    if (!beginValues("totals")) return;
    constexpr std::array<const char*, planet::popCauseCount> meanings = {
        "The chunk's error on screen crossed the tolerance since the camera moved.",
        "A setting that chooses the level was changed: tolerance, hysteresis, metric, max level, culling, "
        "stitched seams, field of view, picture size or exaggeration. A switch that fades keeps this cause.",
        "The chunk was drawn too coarse, and its children came.",
        "The chunk's children are gone though they are wanted: the memory budget is too small.",
        "Stitched seams allow neighbours to differ by so many levels only, and a neighbour changed.",
        "The same, since a neighbour came into view or went out."};
    for (std::size_t i = 0; i < planet::popCauseCount; ++i) {
        const auto cause = static_cast<planet::PopCause>(i);
        const ImVec4 colour = popColour(cause);
        valueRow(planet::popCauseName(cause), count(t.byCause[i]), meanings[i],
                 t.byCause[i] > 0 ? &colour : nullptr);
    }
    valueRow("median jump", popPxText(state.sample.medianPx), "Of the switches in the histogram, pixels.");
    valueRow("worst jump", popPxText(t.worstPx), "Since it was cleared, pixels.");
    valueRow("worst beside", popPxText(t.worstBesidePx),
             "The largest jump along an edge of an unchanged chunk beside a switch, pixels: its edge follows "
             "its neighbour.");
    valueRow("late now", count(meter.lateOpen()),
             "Chunks drawn though their error is over the tolerance: their children have not come.",
             meter.lateOpen() > 0 ? &palette().warning : nullptr);
    valueRow("late in all", count(t.late), "Since it was cleared.");
    valueRow(
        "outside picture", count(t.outsidePicture),
        "Switches of which nothing lay in the picture; they are in no other figure here but their cause.");
    endValues();
}

void flip(const EditorView& view, Commands& commands) {
    const PopsView& pops = view.pops;
    constexpr std::array<const char*, 3> names = {"Live", "Before", "After"};
    constexpr std::array<const char*, 3> meanings = {
        "Draws what is chosen now.", "Draws all chunks as they were in the frame before the switch.",
        "Draws all chunks as they were in the frame of the switch."};
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        const auto side = static_cast<PopSide>(i);
        if (ImGui::RadioButton(names[i], pops.side == side)) commands.push_back(ShowPopSide{side});
        noteItem(names[i]);
        tooltip(fmt::format("Of the switch of {}, last gone back to. {}", planet::toString(pops.shown->chunk),
                            meanings[i])
                    .c_str());
    }
    if (!pops.problem.empty()) wrappedText(pops.problem, palette().warning);
}

void selectedValues(const PopEvent& event) {
    if (!beginValues("selected")) return;
    valueRow("levels", fmt::format("{} to {}", event.fromLevel, event.toLevel),
             "Of the finest chunk drawn there, before and after.");
    const ImVec4 colour = popColour(event.cause);
    valueRow("cause", planet::popCauseName(event.cause), "Why the level changed.", &colour);
    valueRow("largest", popPxText(event.jump.largestPx),
             "The largest distance on screen that a point jumps, pixels: between the projections before and "
             "after, through the new view.");
    valueRow(
        "facing", popPxText(event.jump.largestFacingPx),
        "The same as if the view were turned to face the place, pixels: without the stretching towards a "
        "flat picture's corners.");
    valueRow("mean", popPxText(event.jump.meanPx), "Over all grid points of it in the picture, pixels.");
    valueRow("beside", popPxText(event.besidePx), "Along edges of unchanged chunks beside it, pixels.");
    endValues();
}

void selectedEvent(const EditorView& view, PopsPanelState& state, Commands& commands) {
    const auto& events = view.pops.meter->events();
    const auto found = std::find_if(events.begin(), events.end(), [&](const PopEvent& event) {
        return state.selected && keyOf(event) == *state.selected;
    });
    if (found == events.end()) {
        wrappedText("Click a tick or a row to select a switch. Drag the timeline, or turn the wheel.",
                    palette().dim);
    } else {
        if (button(
                "Go back",
                "Moves the camera to where the switch was seen, freezes LOD there, and selects its chunk."))
            commands.push_back(GoBackToPop{found->frame, found->chunk});
        ImGui::SameLine();
        chunkLink(found->chunk, view, commands);
    }
    if (view.pops.shown) flip(view, commands);
    if (found != events.end()) selectedValues(*found);
}

void timeline(const EditorView& view, PopsPanelState& state, bool wide, Commands& commands) {
    const float spare = ImGui::GetContentRegionAvail().y / ImGui::GetTextLineHeightWithSpacing();
    const float lines = wide ? std::clamp(spare * 0.4f, 3.0f, 12.0f) : 6;
    if (const auto clicked = popTimeline(*view.pops.meter, lines, state.selected, state.timeline))
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
    ImGui::TableNextColumn();
    const bool isSelected = state.selected == keyOf(event);
    const double agoS = std::max(view.pops.meter->lastTimeS() - event.timeS, 0.0);
    // The same row whatever the time.
    const std::string ago = fmt::format("{:.{}f} s###row", agoS, agoS < 10 ? 1 : 0);
    if (ImGui::Selectable(ago.c_str(), isSelected, ImGuiSelectableFlags_SpanAllColumns))
        state.selected = keyOf(event);
    if (row < 3) noteItem(fmt::format("Row {}", row));
    cell(popPxText(event.jump.largestPx));
    cell(planet::toString(event.chunk));
    cell(fmt::format("{} > {}", event.fromLevel, event.toLevel));
    cell(planet::popCauseName(event.cause), popColour(event.cause));
    cell(popPxText(event.jump.meanPx));
    cell(popPxText(event.besidePx));
}

void worstFirst(const EditorView& view, PopsPanelState& state) {
    const auto& events = view.pops.meter->events();
    if (events.empty()) return emptyState("Changes of level are listed here, worst first.");
    constexpr std::array columns = {TableColumn{"Ago", 0.8f},   TableColumn{"Largest"},
                                    TableColumn{"Chunk", 1.6f}, TableColumn{"Levels", 0.9f},
                                    TableColumn{"Cause", 1.7f}, TableColumn{"Mean"},
                                    TableColumn{"Beside"}};
    if (!beginWideTable("worst", columns, 33)) return;
    std::vector<std::size_t> order(events.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto larger = [&](std::size_t a, std::size_t b) {
        const double pxA = events[a].jump.largestPx;
        const double pxB = events[b].jump.largestPx;
        return pxA != pxB ? pxA > pxB : a > b;
    };
    sortedTableRows(order, larger,
                    [&](std::size_t event, std::size_t row) { eventRow(view, events[event], row, state); });
    ImGui::EndTable();
}

}  // namespace

void popsPanel(const EditorView& view, PopsPanelState& state, ViewSettings&, Commands& commands) {
    if (!view.planet || !view.pops.meter)
        return emptyState("Jumps at changes of level show here once a planet is open.");
    refresh(view, state);
    const bool wide = hasWideRoom();
    const auto rows =
        static_cast<float>(std::clamp<std::size_t>(view.pops.meter->events().size() + 2, 3, 14));
    const std::array columns = {Column{"Jumps", 1, 0,
                                       [&] {
                                           jumps(view, state, commands);
                                           totals(view, state);
                                       }},
                                Column{"Timeline", 1.5f, 0, [&] { timeline(view, state, wide, commands); }},
                                Column{"Worst first", 1.6f, rows, [&] { worstFirst(view, state); }}};
    drawColumns("pops", columns);
}

}  // namespace ui
