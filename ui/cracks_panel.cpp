#include "ui/cracks_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "ui/chunk_link.h"
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

// Nearer along the line from the measured eye, from which the place can be seen.
MoveCamera towards(const CrackMeasurement& measured, const glm::dvec3& placeM, double radiusM) {
    planet::View view = measured.view;
    const glm::dvec3 back = view.eyeM - placeM;
    view.eyeM = placeM + 0.35 * back;
    view.back = glm::normalize(back);
    const glm::dvec3 aside = glm::cross(glm::normalize(view.eyeM), view.back);
    if (glm::length(aside) > 1e-3) view.right = glm::normalize(aside);
    view.up = glm::normalize(glm::cross(view.back, view.right));
    view.right = glm::cross(view.up, view.back);
    return {planet::poseFromView(view, radiusM)};
}

void jump(const EditorView& view, const planet::ChunkId& finer, const glm::dvec3& placeM,
          Commands& commands) {
    commands.emplace_back(SelectChunk{finer});
    commands.emplace_back(towards(*view.cracks.measured, placeM, view.planet->shape().radiusM));
}

bool beginTable(const char* id, int columns, std::size_t rows) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg |
                                      ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp;
    const float lines = static_cast<float>(std::clamp<std::size_t>(rows + 1, 4, 12));
    if (!ImGui::BeginTable(id, columns, flags, {0, lines * ImGui::GetTextLineHeightWithSpacing()}))
        return false;
    ImGui::TableSetupScrollFreeze(0, 1);
    return true;
}

void goButton(const EditorView& view, const planet::ChunkId& finer, const glm::dvec3& placeM,
              Commands& commands) {
    ImGui::TableNextColumn();
    if (ImGui::SmallButton("Go")) jump(view, finer, placeM, commands);
    tooltip("Moves the camera nearer to it and selects the finer chunk.");
}

void note(const char* text) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
    ImGui::TextWrapped("%s", text);
    ImGui::PopStyleColor();
}

void spotRow(const EditorView& view, const planet::CrackSpot& spot, Commands& commands) {
    const CrackMeasurement& measured = *view.cracks.measured;
    ImGui::TableNextColumn();
    ImGui::Text("%d", spot.pixels);
    ImGui::TableNextColumn();
    ImGui::TextColored(spot.leaking > 0 ? palette().bad : palette().dim, "%d", spot.leaking);
    if (spot.pair == planet::noPair) {
        ImGui::TableNextColumn();
        ImGui::TextUnformatted("beside nothing drawn");
        ImGui::TableNextColumn();
        ImGui::TableNextColumn();
        return;
    }
    const planet::DrawnPair& pair = measured.pairs[spot.pair];
    ImGui::TableNextColumn();
    chunkLink(measured.items[pair.finer], view, commands);
    ImGui::TableNextColumn();
    ImGui::PushID("coarser");
    chunkLink(measured.items[pair.coarser], view, commands);
    ImGui::PopID();
    goButton(view, measured.items[pair.finer], spot.placeM, commands);
}

void spotTable(const EditorView& view, Commands& commands) {
    const std::vector<planet::CrackSpot>& spots = view.cracks.measured->spots;
    if (spots.empty()) return note("No pixel of this view shows a crack.");
    if (!beginTable("spots", 5, spots.size())) return;
    ImGui::TableSetupColumn("Pixels", 0, 0.8f);
    ImGui::TableSetupColumn("Leak", 0, 0.6f);
    ImGui::TableSetupColumn("Finer", 0, 1.6f);
    ImGui::TableSetupColumn("Coarser", 0, 1.6f);
    ImGui::TableSetupColumn("##go", 0, 0.5f);
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(spots.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            ImGui::PushID(i);
            ImGui::TableNextRow();
            spotRow(view, spots[static_cast<std::size_t>(i)], commands);
            ImGui::PopID();
        }
    }
    ImGui::EndTable();
}

void gapRow(const EditorView& view, const planet::EdgeGap& gap, Commands& commands) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(distanceText(gap.gapM).c_str());
    tooltip("Largest distance between the two edges at the same place.");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(pixelsText(gap.facingPx, "").c_str());
    tooltip("The same in pixels of the view, as if it were turned to face it.");
    ImGui::TableNextColumn();
    const bool tooShort = gap.finerAboveM > static_cast<double>(gap.finerSkirtM) ||
                          gap.coarserAboveM > static_cast<double>(gap.coarserSkirtM);
    const float skirtM = gap.finerAboveM >= gap.coarserAboveM ? gap.finerSkirtM : gap.coarserSkirtM;
    ImGui::TextColored(tooShort ? palette().bad : palette().text, "%s",
                       distanceText(static_cast<double>(skirtM)).c_str());
    tooltip("The skirt of the edge that stands higher. Red: it does not reach down to the other.");
    ImGui::TableNextColumn();
    chunkLink(gap.finer, view, commands);
    ImGui::PushID("coarser");
    chunkLink(gap.coarser, view, commands);
    ImGui::PopID();
    goButton(view, gap.finer, gap.placeM, commands);
}

void gapTable(const EditorView& view, Commands& commands) {
    const std::vector<planet::EdgeGap>& gaps = view.cracks.measured->gaps;
    if (gaps.empty()) return note("All edges that are drawn side by side are the same.");
    if (!beginTable("gaps", 5, 2 * gaps.size())) return;
    ImGui::TableSetupColumn("Gap", 0, 0.9f);
    ImGui::TableSetupColumn("px", 0, 0.6f);
    ImGui::TableSetupColumn("Skirt", 0, 0.9f);
    ImGui::TableSetupColumn("Finer, coarser", 0, 1.7f);
    ImGui::TableSetupColumn("##go", 0, 0.5f);
    ImGui::TableHeadersRow();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(gaps.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            ImGui::PushID(i);
            ImGui::TableNextRow();
            gapRow(view, gaps[static_cast<std::size_t>(i)], commands);
            ImGui::PopID();
        }
    }
    ImGui::EndTable();
}

}  // namespace

void cracksPanel(const EditorView& view, CracksPanelState&, ViewSettings& settings, Commands& commands) {
    if (section("Cracks")) knobs(view, settings.cracks, commands);
    if (!view.planet) return emptyState("Cracks are measured once a planet is open.");
    if (!view.cracks.measured)
        return emptyState("Nothing measured yet: Measure counts the crack pixels of the view as it is now.");
    if (!view.cracks.current) {
        ImGui::PushStyleColor(ImGuiCol_Text, palette().warning);
        ImGui::TextWrapped("Of an earlier view: the camera or what is drawn has changed since.");
        ImGui::PopStyleColor();
    }
    const float alpha = ImGui::GetStyle().Alpha * (view.cracks.current ? 1.0f : 0.6f);
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, alpha);
    if (section("Found")) values(view.cracks);
    if (section("Spots, largest first")) spotTable(view, commands);
    if (section("Gaps between edges, worst first")) gapTable(view, commands);
    ImGui::PopStyleVar();
}

}  // namespace ui
