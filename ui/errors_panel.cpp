#include "ui/errors_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "ui/chunk_link.h"
#include "ui/columns.h"
#include "ui/inspection.h"
#include "ui/item_map.h"
#include "ui/plot_scale.h"
#include "ui/tables.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

using planet::ChunkError;

constexpr double logarithmicDecades = 4;

// Finer than pixelsText: what is compared here is often a tenth of a pixel.
std::string finePx(double px, const char* unit = " px") {
    return fmt::format("{:.3g}{}", px, unit);
}

void errorsControls(const EditorView& view, ViewSettings& settings, Commands& commands) {
    const ErrorsView& errors = view.errors;
    ImGui::BeginDisabled(errors.running);
    if (button(
            "Measure",
            "Compares every finest sample under every drawn chunk with the surface that is drawn there, for "
            "this frame's view. Runs in the background; what is not in memory is read from the chunk file."))
        commands.push_back(MeasureErrors{});
    ImGui::EndDisabled();
    sameLineIfRoom(checkboxWidth("Keep measuring"));
    bool keep = errors.keepMeasuring;
    if (ImGui::Checkbox("Keep measuring", &keep)) commands.push_back(KeepMeasuringErrors{keep});
    noteItem("Keep measuring");
    tooltip("Starts over as soon as a measurement is done. Takes all cores but one, and the disk.");
    sameLineIfRoom(checkboxWidth("Tint chunks"));
    bool tint = settings.overlay.colourBy == ColourBy::Measured;
    if (ImGui::Checkbox("Tint chunks", &tint))
        settings.overlay.colourBy = tint ? ColourBy::Measured : ColourBy::None;
    noteItem("Tint chunks");
    tooltip(
        "Colours the chunks in the viewport by their measured error against tau, as Colour by in the "
        "Overlay panel. What was not drawn when it was measured is grey.");
    if (errors.running) {
        ImGui::ProgressBar(static_cast<float>(errors.progress), {-1, 0},
                           fmt::format("measuring, {:.0f} %", 100 * errors.progress).c_str());
    }
    if (!errors.problem.empty()) wrappedText(errors.problem, palette().bad);
}

// Which frame the figures are of.
void measuredWhen(const EditorView& view, const ErrorMeasurement& last) {
    const std::uint64_t since = view.errors.frame - std::min(view.errors.frame, last.frame);
    wrappedText(
        fmt::format("Frame {}, {} ago. {} {}, {} metric. Took {}.", last.frame,
                    since == 1 ? "1 frame" : fmt::format("{} frames", since), tauSymbol(),
                    pixelsText(last.tauPx), last.metric == planet::ErrorMetric::Tight ? "tight" : "additive",
                    durationText(last.tookS)),
        palette().dim);
    tooltip("What is listed was drawn in that frame, from its lod view. The camera may have moved since.");
}

void figures(const ErrorMeasurement& last) {
    const planet::TrueErrorReport& report = last.report;
    if (!beginValues("errors")) return;
    const bool wrong = report.violations > 0;
    valueRow("Violations", fmt::format("{}", report.violations),
             "Chunks whose measured error is over what was predicted: the prediction promised too much. Must "
             "be 0. Judged by facing pixels.",
             wrong ? &palette().bad : &palette().good);
    if (report.violationsInSeams > 0)
        valueRow(
            "  beside seams", fmt::format("{}", report.violationsInSeams),
            "Of them, those whose worst place lies in a cell beside an edge that is stitched to a coarser "
            "chunk. Triangles there reach over several cells, which no delta_c looks at.",
            &palette().bad);
    valueRow(
        "Worst, facing", finePx(report.worstFacingPx),
        "The largest error of any finest sample, pixels, as if the view were turned to face it: K' times "
        "the angle between where it is and where it is drawn. What eps bounds.");
    valueRow(
        "Worst, in picture", finePx(report.worstScreenPx),
        "The largest error in the flat picture, pixels, of the samples that lie in it, hidden ones too. A "
        "flat picture stretches towards its corners, so this can be larger than facing.");
    valueRow("99th percentile", finePx(report.p99FacingPx),
             "99 of 100 chunks have no larger error, facing pixels; each chunk counts once.");
    valueRow("Worst predicted", finePx(report.worstPredictedPx),
             "The largest eps of what was drawn, morphing counted in: eps + m (parent's eps - eps).");
    valueRow(
        "Slack", fmt::format("{:.0f} %", 100 * report.meanSlack),
        "The share of the prediction that was not needed, 1 - measured / predicted, mean over the chunks. "
        "More: more triangles than the tolerance asks for.");
    valueRow("Chunks", fmt::format("{}", report.chunks.size()), "Drawn in that frame.");
    valueRow("Samples", countText(static_cast<double>(report.samples)), "Finest samples that were compared.");
    endValues();
}

// The scatter.

struct ScatterScale {
    ImVec2 start;
    ImVec2 end;
    double top = 1;  // of both axes, pixels
    bool logarithmic = true;

    float share(double px) const {
        const double position = logarithmic
                                    ? logarithmicPosition(px, top * std::pow(10, -logarithmicDecades), top)
                                    : linearPosition(px, 0, top);
        return static_cast<float>(position);
    }
    ImVec2 at(double predictedPx, double measuredPx) const {
        return {start.x + share(predictedPx) * (end.x - start.x),
                end.y - share(measuredPx) * (end.y - start.y)};
    }
    ImVec2 at(const ChunkError& chunk) const { return at(chunk.predictedPx, chunk.facingPx); }
};

// Where an eye stands in a chunk's bounds its prediction has no end, so a few times tau is enough.
double topOf(const ErrorMeasurement& last) {
    const double most = std::min(last.report.worstPredictedPx, 4 * last.tauPx);
    return roundedTop(std::max({most, last.report.worstFacingPx, 1.2 * last.tauPx}));
}

void drawAxes(const ScatterScale& scale, double tauPx) {
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const float gap = ImGui::GetFontSize() * 0.3f;
    drawList.AddRectFilled(scale.start, scale.end, ImGui::GetColorU32(ImGuiCol_FrameBg),
                           ImGui::GetStyle().FrameRounding);
    // Above the diagonal no chunk may lie.
    drawList.AddTriangleFilled({scale.start.x, scale.end.y}, scale.start, {scale.end.x, scale.start.y},
                               packed(palette().bad, 0.13f));
    drawList.AddLine({scale.start.x, scale.end.y}, {scale.end.x, scale.start.y}, packed(palette().bad, 0.7f));
    const ImVec2 tau = scale.at(tauPx, tauPx);
    drawList.AddLine({tau.x, scale.start.y}, {tau.x, scale.end.y}, packed(palette().warning, 0.5f));
    drawList.AddLine({scale.start.x, tau.y}, {scale.end.x, tau.y}, packed(palette().warning, 0.5f));
    const std::string name = tauSymbol();
    drawList.AddText({tau.x - ImGui::CalcTextSize(name.c_str()).x - gap, 0.5f * (tau.y + scale.end.y)},
                     packed(palette().warning), name.c_str());
    drawList.AddText({scale.start.x + gap, scale.start.y + gap}, packed(palette().dim),
                     fmt::format("measured, to {} px", axisText(scale.top)).c_str());
    const std::string predicted = "predicted";
    drawList.AddText({scale.end.x - ImGui::CalcTextSize(predicted.c_str()).x - gap,
                      scale.end.y - ImGui::GetTextLineHeight() - gap},
                     packed(palette().dim), predicted.c_str());
}

std::optional<std::size_t> nearestToPointer(const ScatterScale& scale,
                                            const std::vector<ChunkError>& chunks) {
    if (!ImGui::IsItemHovered()) return std::nullopt;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float reach = ImGui::GetFontSize() * 0.8f;
    float best = reach * reach;
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        const ImVec2 at = scale.at(chunks[i]);
        const float squared = (at.x - mouse.x) * (at.x - mouse.x) + (at.y - mouse.y) * (at.y - mouse.y);
        if (squared >= best) continue;
        best = squared;
        nearest = i;
    }
    return nearest;
}

void ring(const ScatterScale& scale, const ErrorMeasurement& last, const std::optional<planet::ChunkId>& id,
          const ImVec4& colour) {
    if (!id) return;
    const auto found = last.indexOf.find(*id);
    if (found == last.indexOf.end()) return;
    ImGui::GetWindowDrawList()->AddCircle(scale.at(last.report.chunks[found->second]),
                                          ImGui::GetFontSize() * 0.35f, packed(colour), 0, 2);
}

void pointerOnChunk(const ChunkError& chunk, Commands& commands) {
    commands.push_back(HoverChunk{chunk.id});
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) commands.push_back(SelectChunk{chunk.id});
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) commands.push_back(LookAtChunk{chunk.id});
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(planet::toString(chunk.id).c_str());
    ImGui::Text("measured %s of %s predicted", finePx(chunk.facingPx).c_str(),
                finePx(chunk.predictedPx).c_str());
    ImGui::Text("%s off at the worst place", distanceText(chunk.errorM).c_str());
    if (planet::isViolation(chunk)) ImGui::TextColored(palette().bad, "violation");
    ImGui::TextDisabled("click: select   double click: look at");
    ImGui::EndTooltip();
}

void scatter(const EditorView& view, ErrorsPanelState& state, Commands& commands) {
    const ErrorMeasurement& last = *view.errors.last;
    checkbox("Logarithmic", state.logarithmic, true,
             "Both axes over four decades. Off: from 0, where small errors lie on each other.");
    const float width = std::max(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize());
    const float height = std::round(std::min(width, 13 * ImGui::GetTextLineHeightWithSpacing()));
    const ImVec2 start = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("scatter", {width, height});
    noteItem("scatter");
    const ScatterScale scale{start, {start.x + width, start.y + height}, topOf(last), state.logarithmic};
    ImGui::PushClipRect(scale.start, scale.end, true);
    drawAxes(scale, last.tauPx);
    const float half = std::max(std::round(ImGui::GetFontSize() * 0.13f), 1.0f);
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const ImU32 usual = packed(palette().accent, 0.8f);
    const ImU32 wrong = packed(palette().bad);
    for (const ChunkError& chunk : last.report.chunks) {
        const ImVec2 at = scale.at(chunk);
        drawList.AddRectFilled({at.x - half, at.y - half}, {at.x + half, at.y + half},
                               planet::isViolation(chunk) ? wrong : usual);
    }
    ring(scale, last, view.focus.selected, palette().text);
    ring(scale, last, view.focus.hovered, palette().warning);
    ImGui::PopClipRect();
    if (const auto nearest = nearestToPointer(scale, last.report.chunks))
        return pointerOnChunk(last.report.chunks[*nearest], commands);
    tooltip(
        "A dot a chunk: to the right what was predicted, up what was measured, facing pixels. On the "
        "diagonal the prediction is exact, above it wrong; far below it wastes triangles.");
}

void goToWorst(const ChunkError& chunk, const EditorView& view, Commands& commands) {
    const planet::View& from = view.errors.last->lodView;
    inspectButton(from, from, chunk.id, chunk.worstM, view.planet->shape().radiusM, commands);
}

void chunkRow(const ChunkError& chunk, const EditorView& view, Commands& commands) {
    const bool wrong = planet::isViolation(chunk);
    if (wrong) ImGui::PushStyleColor(ImGuiCol_Text, palette().bad);
    chunkCell(chunk.id, view, commands,
              ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap);
    ImGui::TableNextColumn();
    goToWorst(chunk, view, commands);
    cell(finePx(chunk.facingPx, ""));
    cell(finePx(chunk.predictedPx, ""));
    cell(fmt::format("{:.0f} %", 100 * planet::slackOf(chunk)));
    cell(finePx(chunk.screenPx, ""));
    cell(distanceText(chunk.errorM));
    cell(finePx(chunk.meanPx, ""));
    if (wrong) ImGui::PopStyleColor();
}

constexpr std::array worstColumns = {
    TableColumn{"Chunk", 1.9f, "Click selects it, a double click looks at it."},
    TableColumn{"##go", 0.6f},
    TableColumn{"Facing", 0.9f, "Measured, pixels, the view turned to face the sample."},
    TableColumn{"Predicted", 1.1f, "Pixels, morphing counted in."},
    TableColumn{"Slack", 0.8f, "1 - facing / predicted."},
    TableColumn{"Picture", 0.9f, "Measured in the flat picture, pixels; 0 where nothing of it lies there."},
    TableColumn{"Error", 0.9f, "Metres between the sample and what is drawn there, where facing is largest."},
    TableColumn{"Mean", 0.9f, "Facing pixels, mean over all finest samples under the chunk."}};

void worstList(const EditorView& view, Commands& commands) {
    if (!beginWideTable("worst", worstColumns, 30, 1)) return;
    const ErrorMeasurement& last = *view.errors.last;
    tableRows(last.worstFirst.size(),
              [&](std::size_t row) { chunkRow(last.report.chunks[last.worstFirst[row]], view, commands); });
    ImGui::EndTable();
}

}  // namespace

void errorsPanel(const EditorView& view, ErrorsPanelState& state, ViewSettings& settings,
                 Commands& commands) {
    if (!view.planet) return emptyState("The error of what is drawn is measured here once a planet is open.");
    errorsControls(view, settings, commands);
    if (!view.errors.last) {
        return emptyState(view.errors.running
                              ? "The first measurement is on its way."
                              : "Measure tells how far what is drawn lies from the finest data.");
    }
    constexpr float tableLines = 12;
    const std::array columns = {
        Column{"Measured", 1, 0,
               [&] {
                   measuredWhen(view, *view.errors.last);
                   figures(*view.errors.last);
               }},
        Column{"Measured against predicted", 1, 0, [&] { scatter(view, state, commands); }},
        Column{"Worst first", 1.6f, tableLines, [&] { worstList(view, commands); }}};
    drawColumns("errors", columns);
}

}  // namespace ui
