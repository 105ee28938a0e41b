#include "ui/panels/measure/cracks_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/base/text.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/figure_rows.h"
#include "ui/kit/inspection.h"
#include "ui/kit/item_map.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

const char* whyNoSkirts(const CracksView& cracks) {
    if (!cracks.measured) return "Measure first.";
    if (!cracks.current) return "The camera or the drawn chunks have changed; measure again.";
    return "Stitched seams have no skirts.";
}

void measureControls(const EditorView& view, ViewSettings& settings, Commands& commands) {
    beginGrey(!view.planet, "Open a planet first.");
    if (button("Measure",
               "Renders the depth of the chunks three times (with full-depth skirts, without skirts, with "
               "the current skirts) and compares them. Takes as long as several frames."))
        commands.emplace_back(MeasureCracks{});
    sameLineIfRoom(ImGui::CalcTextSize("Find smallest skirts").x + ImGui::GetFontSize());
    beginGrey(!view.instruments.cracks.current ||
                  view.instruments.cracks.measured->seams == planet::SeamMode::Stitched,
              whyNoSkirts(view.instruments.cracks));
    if (button(
            "Find smallest skirts",
            "Searches for the smallest fixed depth and the smallest automatic factor that leave no uncovered "
            "pixel in this view. For a whole flight use worldy cracks FILE --flight F --find-depth."))
        commands.emplace_back(FindSmallestSkirts{});
    endGrey();
    endGrey();
    const SettingControls control(settings);
    control(settings.cracks.live);
    if (settings.cracks.live) control(settings.cracks.everyFrames);
    control(settings.cracks.mark);
}

// Draws a suggested value with a button that applies it. whyNot: why it cannot be applied; empty if it can.
// Returns true if the button is pressed.
bool foundRow(const char* name, const std::string& value, const char* explanation,
              const std::string& whyNot) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    noteValue(name, value);
    ImGui::TextColored(palette().dim, "%s", name);
    tooltip(explanation);
    ImGui::TableNextColumn();
    const ImGuiStyle& style = ImGui::GetStyle();
    // The texts are measured separately, because each width is rounded up: a wider row would widen the column
    // every frame.
    const float wide = ImGui::CalcTextSize(value.c_str()).x + style.ItemSpacing.x +
                       ImGui::CalcTextSize("Apply").x + 2 * style.FramePadding.x;
    const float slack = ImGui::GetContentRegionAvail().x - wide;
    if (slack > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + slack);
    ImGui::TextUnformatted(value.c_str());
    tooltip(explanation);
    ImGui::SameLine();
    ImGui::PushID(name);
    beginGrey(!whyNot.empty(), whyNot.c_str());
    const bool pressed = ImGui::SmallButton("Apply");
    noteItem(std::string("Apply ") + name);
    tooltip("Applies this value in the Seams panel. Undo reverts it.");
    endGrey();
    ImGui::PopID();
    return pressed;
}

void depthRow(const char* name, double depthM, const char* explanation, bool replayed,
              planet::LodSettings& lod) {
    const std::string whyNot = replayed      ? "Settings are locked during a replay; end it first."
                               : depthM <= 0 ? "No cracks found."
                                             : "";
    if (!foundRow(name, distanceText(depthM), explanation, whyNot)) return;
    lod.seams = planet::SeamMode::Skirts;
    lod.skirtDepth = planet::SkirtDepth::Fixed;
    lod.skirtDepthM = std::min(depthM, rangeOf("seams.skirt_depth_m").max);
}

void factorRow(const char* name, double factor, const char* explanation, bool replayed,
               planet::LodSettings& lod) {
    const double mostFactor = rangeOf("seams.skirt_factor").max;
    const std::string whyNot = replayed              ? "Settings are locked during a replay; end it first."
                               : factor <= 0         ? "No cracks found."
                               : factor > mostFactor ? "The factor exceeds 10; apply the depth instead."
                                                     : "";
    if (!foundRow(name, factorText(factor), explanation, whyNot)) return;
    lod.seams = planet::SeamMode::Skirts;
    lod.skirtDepth = planet::SkirtDepth::Automatic;
    lod.skirtFactor = factor;
}

void values(const CracksView& cracks, bool replayed, planet::LodSettings& lod) {
    const CrackMeasurement& measured = *cracks.measured;
    const double worstGapM = measured.gaps.empty() ? 0 : measured.gaps.front().gapM;
    const char* const note = roundingNote(measured.map.pixels.size(), worstGapM);
    if (*note != '\0') wrappedText(note, palette().dim);
    if (!beginValues("cracks")) return;
    figureRows(crackFigures(measured));
    depthRow("Required depth (max gap)", measured.required.depthM,
             "Largest height difference between two adjacent edges, in metres.", replayed, lod);
    factorRow("Required factor (max gap)", measured.required.factor,
              "Smallest automatic factor whose skirts reach every adjacent edge.", replayed, lod);
    if (cracks.smallest) {
        depthRow("Smallest depth", cracks.smallest->depthM,
                 "Smallest fixed skirt depth that leaves no uncovered pixel in this view; within 0.5 %.",
                 replayed, lod);
        factorRow("Smallest factor", cracks.smallest->factor,
                  "Smallest automatic factor that leaves no uncovered pixel in this view; within 0.5 %. "
                  "None: a factor "
                  "of 1000 is not enough.",
                  replayed, lod);
    }
    valueRow("Picture", fmt::format("{} x {}", measured.map.widthPx, measured.map.heightPx),
             "Size of the measured picture, in pixels.");
    valueRow("Duration", millisecondsText(measured.tookMs),
             "Duration of the measurement, including edges and pixels.");
    endValues();
}

void goButton(const EditorView& view, const planet::ChunkId& finer, const glm::dvec3& placeM,
              Commands& commands) {
    ImGui::TableNextColumn();
    const CrackMeasurement& measured = *view.instruments.cracks.measured;
    inspectButton(measured.lodView, measured.view, finer, placeM, view.planet->tree().shape.radiusM,
                  commands);
}

void spotRow(const EditorView& view, const planet::CrackSpot& spot, Commands& commands) {
    const CrackMeasurement& measured = *view.instruments.cracks.measured;
    const bool hasPair = spot.pair != planet::noPair;
    if (hasPair)
        goButton(view, measured.items[measured.pairs[spot.pair].finer], spot.placeM, commands);
    else
        cell("");
    cell(fmt::format("{}", spot.pixels));
    cell(fmt::format("{}", spot.leaking), spot.leaking > 0 ? palette().bad : palette().dim);
    if (!hasPair) return cell("no drawn neighbour");
    chunkCell(measured.items[measured.pairs[spot.pair].finer], view, commands);
    chunkLink(measured.items[measured.pairs[spot.pair].coarser], view, commands);
}

void spotTable(const EditorView& view, Commands& commands) {
    const std::vector<planet::CrackSpot>& spots = view.instruments.cracks.measured->spots;
    if (spots.empty()) return wrappedText("There are no crack pixels in this view.", palette().dim);
    // Go comes first: a narrow panel scrolls the last columns out of sight.
    const std::string chunk = widestChunkName(view);
    const std::array columns = {TableColumn{"##go", 0.1f, nullptr, "Go xx"}, TableColumn{"Pixels", 0.5f},
                                TableColumn{"Uncovered", 0.5f},
                                TableColumn{"Finer, coarser", 2, nullptr, chunk.c_str()}};
    if (!beginListTable("spots", columns, 2 * spots.size())) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const planet::CrackSpot& spot = spots[row];
        if (column <= 1) return static_cast<double>(spot.pixels);
        if (column == 2) return static_cast<double>(spot.leaking);
        if (spot.pair == planet::noPair) return std::string();
        const CrackMeasurement& measured = *view.instruments.cracks.measured;
        const planet::DrawnPair& pair = measured.pairs[spot.pair];
        return sortKey(measured.items[pair.finer]);
    };
    tableRows(spots.size(), key, [&](std::size_t row) { spotRow(view, spots[row], commands); });
    const CrackMeasurement& measured = *view.instruments.cracks.measured;
    const auto nameOf = [&](const planet::CrackSpot& spot, auto side) -> ExportCell {
        if (spot.pair == planet::noPair) return {};
        return planet::toString(measured.items[measured.pairs[spot.pair].*side]);
    };
    // The names are those of worldy cracks --json.
    using Spot = planet::CrackSpot;
    endTable(exportTable<Spot>(
        "crack clusters", spots.size(), [&](std::size_t row) { return spots[row]; },
        {{"pixels", [](const Spot& spot) { return spot.pixels; }},
         {"leaking", [](const Spot& spot) { return spot.leaking; }},
         {"finer", [&](const Spot& spot) { return nameOf(spot, &planet::DrawnPair::finer); }},
         {"coarser", [&](const Spot& spot) { return nameOf(spot, &planet::DrawnPair::coarser); }},
         {"centre_x_px", [](const Spot& spot) { return spot.centre.x; }},
         {"centre_y_px", [](const Spot& spot) { return spot.centre.y; }}}));
}

// Returns the skirt depth of the higher edge, metres.
float skirtOf(const planet::EdgeGap& gap) {
    return gap.finerAboveM >= gap.coarserAboveM ? gap.finerSkirtM : gap.coarserSkirtM;
}

void gapRow(const EditorView& view, const planet::EdgeGap& gap, Commands& commands) {
    goButton(view, gap.finer, gap.placeM, commands);
    cell(distanceText(gap.gapM));
    tooltip("Largest distance between the two edges at the same position.");
    cell(pixelsText(gap.facingPx, ""));
    tooltip("The gap in pixels, facing the view.");
    const bool tooShort = gap.finerAboveM > static_cast<double>(gap.finerSkirtM) ||
                          gap.coarserAboveM > static_cast<double>(gap.coarserSkirtM);
    cell(distanceText(static_cast<double>(skirtOf(gap))), tooShort ? palette().bad : palette().text);
    tooltip("Skirt depth of the higher edge. Red: it does not reach the lower edge.");
    chunkCell(gap.finer, view, commands);
    chunkLink(gap.coarser, view, commands);
}

void gapTable(const EditorView& view, Commands& commands) {
    const std::vector<planet::EdgeGap>& gaps = view.instruments.cracks.measured->gaps;
    if (gaps.empty()) return wrappedText("All adjacent edges match.", palette().dim);
    const std::string chunk = widestChunkName(view);
    const std::array columns = {TableColumn{"##go", 0.1f, nullptr, "Go xx"},
                                TableColumn{"Gap", 0.5f, nullptr, "12.3 km"}, TableColumn{"Gap, px", 0.5f},
                                TableColumn{"Skirt", 0.5f, nullptr, "12.3 km"},
                                TableColumn{"Finer, coarser", 2, nullptr, chunk.c_str()}};
    if (!beginListTable("gaps", columns, 2 * gaps.size())) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const planet::EdgeGap& gap = gaps[row];
        if (column <= 1) return gap.gapM;
        if (column == 2) return gap.facingPx;
        if (column == 3) return static_cast<double>(skirtOf(gap));
        return sortKey(gap.finer);
    };
    tableRows(gaps.size(), key, [&](std::size_t row) { gapRow(view, gaps[row], commands); });
    // The names are those of worldy cracks --json.
    using Gap = planet::EdgeGap;
    endTable(
        exportTable<Gap>("edge gaps", gaps.size(), [&](std::size_t row) { return gaps[row]; },
                         {{"finer", [](const Gap& gap) { return planet::toString(gap.finer); }, true},
                          {"coarser", [](const Gap& gap) { return planet::toString(gap.coarser); }, true},
                          {"gap_m", [](const Gap& gap) { return gap.gapM; }},
                          {"radial_m", [](const Gap& gap) { return gap.radialM; }},
                          {"facing_px", [](const Gap& gap) { return gap.facingPx; }},
                          {"screen_px", [](const Gap& gap) { return gap.screenPx; }},
                          {"finer_above_m", [](const Gap& gap) { return gap.finerAboveM; }},
                          {"coarser_above_m", [](const Gap& gap) { return gap.coarserAboveM; }},
                          {"finer_skirt_m", [](const Gap& gap) { return gap.finerSkirtM; }},
                          {"coarser_skirt_m", [](const Gap& gap) { return gap.coarserSkirtM; }}}));
}

}  // namespace

void cracksPanel(const EditorView& view, ViewSettings& settings, Commands& commands) {
    if (section("Cracks")) measureControls(view, settings, commands);
    if (!view.planet) return emptyState("No planet is open. Open one to measure cracks.");
    if (!view.instruments.cracks.measured)
        return emptyState("Not measured yet. Press Measure to count the crack pixels of the current view.");
    // While one of its places is inspected, the measurement still leads to the others.
    const bool isOutOfDate = !view.instruments.cracks.current && !view.camera.inspecting;
    if (isOutOfDate) {
        wrappedText("Out of date: the camera or the drawn chunks have changed since this measurement.",
                    palette().warning);
    } else if (!view.instruments.cracks.current) {
        wrappedText("Measured from the view before this one, in which its pixels are marked.", palette().dim);
    }
    beginGrey(isOutOfDate, "Out of date: measure again.");
    if (section("Results")) values(view.instruments.cracks, view.recording.replay.has_value(), settings.lod);
    if (section("Crack clusters")) spotTable(view, commands);
    if (section("Edge gaps")) gapTable(view, commands);
    endGrey();
}

}  // namespace worldy::ui
