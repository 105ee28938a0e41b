#include "ui/panels/measure/errors_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/base/glossary.h"
#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "ui/kit/chunk_link.h"
#include "ui/kit/columns.h"
#include "ui/kit/figure_rows.h"
#include "ui/kit/filter_box.h"
#include "ui/kit/inspection.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

using planet::ChunkError;

constexpr double logarithmicDecades = 4;

void errorsControls(const EditorView& view, ViewSettings& settings, Commands& commands) {
    const ErrorsView& errors = view.instruments.errors;
    beginGrey(errors.running, "A measurement is running.");
    if (button(
            "Measure",
            "Compares every finest sample under every drawn chunk with the drawn surface, for this frame's "
            "view. Runs in the background and reads blocks that are not in memory from the chunk file."))
        commands.push_back(MeasureErrors{});
    endGrey();
    sameLineIfRoom(checkboxWidth("Keep measuring"));
    bool keep = errors.keepMeasuring;
    if (ImGui::Checkbox("Keep measuring", &keep)) commands.push_back(KeepMeasuringErrors{keep});
    noteItem("Keep measuring");
    tooltip("Repeats the measurement continuously. Uses all cores but one, and the disk.");
    sameLineIfRoom(checkboxWidth("Tint chunks"));
    bool tint = settings.overlay.colourBy == ColourBy::Measured;
    if (ImGui::Checkbox("Tint chunks", &tint))
        settings.overlay.colourBy = tint ? ColourBy::Measured : ColourBy::None;
    noteItem("Tint chunks");
    tooltip(
        "Tints the chunks in the viewport by their measured error relative to τ, like Colour by in the "
        "Overlay panel. Chunks not drawn in the measured frame are grey.");
    if (errors.running) {
        ImGui::ProgressBar(static_cast<float>(errors.progress), {-1, 0},
                           fmt::format("measuring, {:.0f} %", 100 * errors.progress).c_str());
    }
    if (!errors.problem.empty()) wrappedText(errors.problem, palette().bad);
}

// Shows the measured frame and its settings.
void measuredWhen(const EditorView& view, const ErrorMeasurement& last) {
    const std::uint64_t since =
        view.instruments.errors.frame - std::min(view.instruments.errors.frame, last.frame);
    const std::string when =
        fmt::format("Frame {}, {} ago. {} {}, {} metric. Duration {}.", last.frame,
                    since == 1 ? "1 frame" : fmt::format("{} frames", since), tauSymbol(),
                    pixelsText(last.tauPx), last.metric == planet::ErrorMetric::Tight ? "tight" : "additive",
                    millisecondsText(1000 * last.tookS));
    if (view.instruments.errors.current)
        wrappedText(when, palette().dim);
    else
        wrappedText("Out of date: the view, the settings or the drawn chunks have changed. " + when,
                    view.instruments.errors.keepMeasuring ? palette().dim : palette().warning);
    tooltip("The list shows the chunks drawn in that frame for its LOD view.");
}

void figures(const ErrorMeasurement& last) {
    if (!beginValues("true error figures")) return;
    figureRows(errorFigures(last));
    endValues();
}

// The scatter.

struct ScatterScale {
    ImVec2 start;
    ImVec2 end;
    double top = 1;  // end of both axes, pixels
    bool logarithmic = true;

    float share(double px) const {
        const double position = logarithmic
                                    ? logarithmicPosition(px, top * std::pow(10, -logarithmicDecades), top)
                                    : linearPosition(px, 0, top);
        return static_cast<float>(position);
    }
    ImVec2 at(double drawnBoundPx, double measuredPx) const {
        return {start.x + share(drawnBoundPx) * (end.x - start.x),
                end.y - share(measuredPx) * (end.y - start.y)};
    }
    ImVec2 at(const ChunkError& chunk) const { return at(chunk.drawnBoundPx, chunk.facingPx); }
};

// Returns the end of the axes. The bound of a chunk that contains the eye is unbounded, so bounds are clamped
// at 4 tau.
double topOf(const ErrorMeasurement& last) {
    const double most = std::min(last.report.worstDrawnBoundPx, 4 * last.tauPx);
    return roundedTop(std::max({most, last.report.worstFacingPx, 1.2 * last.tauPx}));
}

void drawAxes(const ScatterScale& scale, double tauPx) {
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const float gap = ImGui::GetFontSize() * 0.3f;
    drawList.AddRectFilled(scale.start, scale.end, ImGui::GetColorU32(ImGuiCol_FrameBg),
                           ImGui::GetStyle().FrameRounding);
    // No chunk may lie above the diagonal.
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
    const std::string bound = "drawn bound";
    drawList.AddText({scale.end.x - ImGui::CalcTextSize(bound.c_str()).x - gap,
                      scale.end.y - ImGui::GetTextLineHeight() - gap},
                     packed(palette().dim), bound.c_str());
}

std::optional<std::size_t> nearestToPointer(const ScatterScale& scale,
                                            const std::vector<ChunkError>& chunks) {
    if (!plotIsHovered()) return std::nullopt;
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

void pointerOnChunk(const ChunkError& chunk, const PlotCursor& cursor, float x, const EditorView& view,
                    Commands& commands) {
    commands.push_back(HoverChunk{chunk.id});
    if (cursor.acts || (!cursor.at && ImGui::IsMouseClicked(ImGuiMouseButton_Left)))
        commands.push_back(SelectChunk{chunk.id});
    if (!cursor.at && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        const planet::View& from = view.instruments.errors.last->lodView;
        commands.push_back(inspectionOf(from, from, chunk.worstM, view.planet->tree().shape.radiusM));
    }
    beginSampleTooltip(cursor, x);
    ImGui::TextUnformatted(planet::toString(chunk.id).c_str());
    ImGui::Text("measured %s, drawn bound %s", finePx(chunk.facingPx).c_str(),
                finePx(chunk.drawnBoundPx).c_str());
    ImGui::Text("max error %s", distanceText(chunk.errorM).c_str());
    if (planet::isViolation(chunk)) ImGui::TextColored(palette().bad, "violation");
    ImGui::TextDisabled("click or Enter: select   double-click: go to the max error");
    ImGui::EndTooltip();
}

// The names are those of worldy audit --json.
std::vector<ExportField<ChunkError>> errorFields() {
    using E = ChunkError;
    return {{"chunk", [](const E& e) { return planet::toString(e.id); }, true},
            {terms::measuredPx.key, [](const E& e) { return e.facingPx; }},
            {terms::drawnBoundPx.key, [](const E& e) { return e.drawnBoundPx; }},
            {"slack", [](const E& e) { return planet::slackOf(e); }},
            {terms::screenPx.key, [](const E& e) { return e.screenPx; }},
            {"error_m", [](const E& e) { return e.errorM; }},
            {"mean_px", [](const E& e) { return e.meanPx; }},
            {terms::epsPx.key, [](const E& e) { return e.epsPx; }},
            {"samples", [](const E& e) { return e.samples; }},
            {"violation", [](const E& e) { return planet::isViolation(e); }}};
}

void scatter(const EditorView& view, ErrorsPanelState& state, Commands& commands) {
    const ErrorMeasurement& last = *view.instruments.errors.last;
    checkbox("Logarithmic", state.logarithmic, true,
             "Shows both axes over four decades. Off: linear from 0, where small errors overlap.");
    const float width = std::max(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize());
    const float height = std::round(std::min(width, 13 * ImGui::GetTextLineHeightWithSpacing()));
    const ImVec2 start = ImGui::GetCursorScreenPos();
    plotItem("scatter", {width, height});
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
    const auto& chunks = last.report.chunks;
    exportPlot("scatter", exportTable<ChunkError>(
                              "true error plot", chunks.size(), [&](std::size_t row) { return chunks[row]; },
                              errorFields()));
    const PlotCursor cursor = plotCursor(chunks.size());
    if (const auto told = cursor.at ? cursor.at : nearestToPointer(scale, chunks))
        return pointerOnChunk(chunks[*told], cursor, scale.at(chunks[*told]).x, view, commands);
    tooltip(
        "One dot per chunk: drawn bound on the horizontal axis, measured error on the vertical axis, in "
        "facing pixels. On the diagonal the bound is exact; above it, it is violated; far below it, "
        "triangles are wasted.");
}

void goToWorst(const ChunkError& chunk, const EditorView& view, Commands& commands) {
    const planet::View& from = view.instruments.errors.last->lodView;
    inspectButton(from, from, chunk.id, chunk.worstM, view.planet->tree().shape.radiusM, commands);
}

void chunkRow(const ChunkError& chunk, const EditorView& view, Commands& commands) {
    const bool wrong = planet::isViolation(chunk);
    if (wrong) ImGui::PushStyleColor(ImGuiCol_Text, palette().bad);
    chunkCell(chunk.id, view, commands,
              ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap);
    ImGui::TableNextColumn();
    goToWorst(chunk, view, commands);
    cell(finePx(chunk.facingPx, ""));
    cell(finePx(chunk.drawnBoundPx, ""));
    cell(fmt::format("{:.0f} %", 100 * planet::slackOf(chunk)));
    cell(finePx(chunk.screenPx, ""));
    cell(distanceText(chunk.errorM));
    cell(finePx(chunk.meanPx, ""));
    if (wrong) ImGui::PopStyleColor();
}

constexpr const char* widestError = "0.000123";  // as finePx() writes it

constexpr std::array worstColumns = {
    TableColumn{"Chunk", 1.9f, "Click to select the chunk; double-click to look at it."},
    TableColumn{"##go", 0.1f, nullptr, "Go xx"},
    TableColumn{"Measured", 1.1f, terms::measuredPx.meaning, widestError},
    TableColumn{"Bound", 0.9f, terms::drawnBoundPx.meaning, widestError},
    TableColumn{"Slack", 0.8f, "1 - measured / bound."},
    TableColumn{"Screen space", 1.3f,
                "Measured error in the projected picture, in pixels; 0 if no sample lies in it.",
                widestError},
    TableColumn{
        "Error", 0.9f,
        "Distance in metres between the sample and the drawn surface, where the measured error is largest.",
        "123.4 km"},
    TableColumn{"Mean", 0.9f, "Mean error in facing pixels over all finest samples under the chunk.",
                widestError}};

// widestChunk: must outlive the columns.
auto worstColumnsFor(const std::string& widestChunk) {
    std::array columns = worstColumns;
    columns[0].widest = widestChunk.c_str();
    return columns;
}

void worstList(const EditorView& view, ErrorsPanelState& state, Commands& commands) {
    const ErrorMeasurement& last = *view.instruments.errors.last;
    filterBox(state.filter, "chunks");
    std::vector<std::size_t> rows;  // indices of the report's chunks
    for (const std::size_t chunk : last.worstFirst)
        if (state.filter.empty() ||
            passes(state.filter.view(), {planet::toString(last.report.chunks[chunk].id)}))
            rows.push_back(chunk);
    if (rows.empty() && !state.filter.empty()) return emptyState("No chunk matches the filter.");
    const HitHighlight highlight(state.filter);
    const std::string widest = widestChunkName(view);
    const std::array columns = worstColumnsFor(widest);
    if (!beginWideTable("worst", columns, 1)) return;
    const auto chunkOf = [&](std::size_t row) -> const ChunkError& { return last.report.chunks[rows[row]]; };
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const ChunkError& chunk = chunkOf(row);
        switch (column) {
            case 0:
                return sortKey(chunk.id);
            case 2:
                return chunk.facingPx;
            case 3:
                return chunk.drawnBoundPx;
            case 4:
                return planet::slackOf(chunk);
            case 5:
                return chunk.screenPx;
            case 6:
                return chunk.errorM;
            default:
                return chunk.meanPx;
        }
    };
    tableRows(rows.size(), key, [&](std::size_t row) { chunkRow(chunkOf(row), view, commands); });
    endTable(exportTable<ChunkError>("true error", rows.size(), chunkOf, errorFields()));
}

}  // namespace

void errorsPanel(const EditorView& view, ErrorsPanelState& state, ViewSettings& settings,
                 Commands& commands) {
    if (!view.planet)
        return emptyState("No planet is open. Open one to measure the true error of drawn chunks.");
    errorsControls(view, settings, commands);
    if (!view.instruments.errors.last) {
        return emptyState(view.instruments.errors.running
                              ? "The first measurement is running."
                              : "Press Measure to compare the drawn surface with the finest data.");
    }
    constexpr float tableLines = 12;
    const float font = ImGui::GetFontSize();
    const std::string widest = widestChunkName(view);
    const std::array columns = {
        Column{.title = "Measured",
               .draw =
                   [&] {
                       measuredWhen(view, *view.instruments.errors.last);
                       figures(*view.instruments.errors.last);
                   },
               .wanted = 18 * font},
        Column{
            .title = "Error and bound", .draw = [&] { scatter(view, state, commands); }, .wanted = 15 * font},
        Column{.title = "Chunks",
               .share = 1.6f,
               .stackedLines = tableLines,
               .draw = [&] { worstList(view, state, commands); },
               .wanted = listTableWidth(worstColumnsFor(widest))}};
    drawColumns("errors", columns);
}

}  // namespace worldy::ui
