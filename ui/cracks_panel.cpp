#include "ui/cracks_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>

#include "ui/chunk_link.h"
#include "ui/inspection.h"
#include "ui/tables.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

void knobs(const EditorView& view, CrackKnobs& cracks, Commands& commands) {
    const CrackKnobs defaults;
    ImGui::BeginDisabled(!view.planet);
    if (button("Measure",
               "Draws the chunks three times without colour, with skirts to below all terrain, without any, "
               "and with those set, and compares the depths. Takes some frames' time."))
        commands.emplace_back(MeasureCracks{});
    sameLineIfRoom(ImGui::CalcTextSize("Find smallest skirts").x + ImGui::GetFontSize());
    ImGui::BeginDisabled(!view.cracks.current || view.cracks.measured->seams == planet::SeamMode::Stitched);
    if (button("Find smallest skirts",
               "The smallest fixed depth and the smallest automatic factor that leave no pixel of this view "
               "open, found by trying. For a whole flight: worldy cracks FILE --flight F --find-depth."))
        commands.emplace_back(FindSmallestSkirts{});
    ImGui::EndDisabled();
    ImGui::EndDisabled();
    checkbox("Measure while flying", cracks.live, defaults.live,
             "Measures again every so many frames. Each costs three frames' drawing and more: the picture "
             "stutters.");
    if (cracks.live) {
        slider("Every", cracks.everyFrames, defaults.everyFrames, 1, 1000, "%d frames",
               "Frames from one measurement to the next. Fewer: slower frames. More: figures of long ago.");
    }
    checkbox(
        "Mark in the viewport", cracks.mark, defaults.mark,
        "Paints the crack pixels over the picture, each at least some pixels wide, while the view is the "
        "one that was measured.");
}

void values(const CracksView& cracks) {
    const CrackMeasurement& measured = *cracks.measured;
    if (!beginValues("cracks")) return;
    const ImVec4 good = palette().good;
    const ImVec4 bad = palette().bad;
    valueRow("Crack pixels", fmt::format("{}", measured.map.pixels.size()),
             "Pixels whose depth differs between drawing with skirts down to below all terrain and without.");
    valueRow("Leaking pixels", fmt::format("{}", measured.map.leaking),
             "Crack pixels that the skirts as set do not hide. Must be 0.",
             measured.map.leaking == 0 ? &good : &bad);
    valueRow("Spots", fmt::format("{}", measured.spots.size()),
             "Crack pixels that touch, between the same two chunks.");
    valueRow("Pairs of two levels", fmt::format("{}", measured.levelPairs), "Drawn neighbours, this many.");
    valueRow("Skirt depth by the gaps", distanceText(measured.required.depthM),
             "The largest height by which an edge stands over the one beside it, metres.");
    valueRow("Factor by the gaps", fmt::format("{:.3f}", measured.required.factor),
             "The smallest automatic factor whose skirts reach down to every edge beside them.");
    if (cracks.smallest) {
        valueRow("Smallest depth", distanceText(cracks.smallest->depthM),
                 "Of a fixed skirt that leaves no pixel of this view open; within 0.5%.");
        valueRow("Smallest factor",
                 std::isfinite(cracks.smallest->factor) ? fmt::format("{:.3f}", cracks.smallest->factor)
                                                        : std::string("none"),
                 "Of automatic skirts; within 0.5%. None: not even 1000 is enough.");
    }
    valueRow("Picture", fmt::format("{} x {}", measured.map.widthPx, measured.map.heightPx),
             "That was measured, pixels.");
    valueRow("Took", millisecondsText(measured.tookMs), "The measurement, edges and pixels.");
    endValues();
}

void goButton(const EditorView& view, const planet::ChunkId& finer, const glm::dvec3& placeM,
              Commands& commands) {
    ImGui::TableNextColumn();
    const CrackMeasurement& measured = *view.cracks.measured;
    inspectButton(measured.lodView, measured.view, finer, placeM, view.planet->shape().radiusM, commands);
}

void spotRow(const EditorView& view, const planet::CrackSpot& spot, Commands& commands) {
    const CrackMeasurement& measured = *view.cracks.measured;
    cell(fmt::format("{}", spot.pixels));
    cell(fmt::format("{}", spot.leaking), spot.leaking > 0 ? palette().bad : palette().dim);
    if (spot.pair == planet::noPair) return cell("beside nothing drawn");
    const planet::DrawnPair& pair = measured.pairs[spot.pair];
    chunkCell(measured.items[pair.finer], view, commands);
    chunkCell(measured.items[pair.coarser], view, commands);
    goButton(view, measured.items[pair.finer], spot.placeM, commands);
}

void spotTable(const EditorView& view, Commands& commands) {
    const std::vector<planet::CrackSpot>& spots = view.cracks.measured->spots;
    if (spots.empty()) return wrappedText("No pixel of this view shows a crack.", palette().dim);
    constexpr std::array columns = {TableColumn{"Pixels", 0.8f}, TableColumn{"Leak", 0.6f},
                                    TableColumn{"Finer", 1.6f}, TableColumn{"Coarser", 1.6f},
                                    TableColumn{"##go", 0.5f}};
    if (!beginListTable("spots", columns, spots.size())) return;
    tableRows(spots.size(), [&](std::size_t row) { spotRow(view, spots[row], commands); });
    ImGui::EndTable();
}

void gapRow(const EditorView& view, const planet::EdgeGap& gap, Commands& commands) {
    cell(distanceText(gap.gapM));
    tooltip("Largest distance between the two edges at the same place.");
    cell(pixelsText(gap.facingPx, ""));
    tooltip("The same in pixels of the view, as if it were turned to face it.");
    const bool tooShort = gap.finerAboveM > static_cast<double>(gap.finerSkirtM) ||
                          gap.coarserAboveM > static_cast<double>(gap.coarserSkirtM);
    const float skirtM = gap.finerAboveM >= gap.coarserAboveM ? gap.finerSkirtM : gap.coarserSkirtM;
    cell(distanceText(static_cast<double>(skirtM)), tooShort ? palette().bad : palette().text);
    tooltip("The skirt of the edge that stands higher. Red: it does not reach down to the other.");
    chunkCell(gap.finer, view, commands);
    chunkLink(gap.coarser, view, commands);
    goButton(view, gap.finer, gap.placeM, commands);
}

void gapTable(const EditorView& view, Commands& commands) {
    const std::vector<planet::EdgeGap>& gaps = view.cracks.measured->gaps;
    if (gaps.empty())
        return wrappedText("All edges that are drawn side by side are the same.", palette().dim);
    constexpr std::array columns = {TableColumn{"Gap", 0.9f}, TableColumn{"px", 0.6f},
                                    TableColumn{"Skirt", 0.9f}, TableColumn{"Finer, coarser", 1.7f},
                                    TableColumn{"##go", 0.5f}};
    if (!beginListTable("gaps", columns, 2 * gaps.size())) return;
    tableRows(gaps.size(), [&](std::size_t row) { gapRow(view, gaps[row], commands); });
    ImGui::EndTable();
}

}  // namespace

void cracksPanel(const EditorView& view, CracksPanelState&, ViewSettings& settings, Commands& commands) {
    if (section("Cracks")) knobs(view, settings.cracks, commands);
    if (!view.planet) return emptyState("Cracks are measured once a planet is open.");
    if (!view.cracks.measured)
        return emptyState("Nothing measured yet: Measure counts the crack pixels of the view as it is now.");
    if (!view.cracks.current) {
        wrappedText("Of an earlier view: the camera or what is drawn has changed since.", palette().warning);
    }
    const float alpha = ImGui::GetStyle().Alpha * (view.cracks.current ? 1.0f : 0.6f);
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, alpha);
    if (section("Found")) values(view.cracks);
    if (section("Spots, largest first")) spotTable(view, commands);
    if (section("Gaps between edges, worst first")) gapTable(view, commands);
    ImGui::PopStyleVar();
}

}  // namespace ui
