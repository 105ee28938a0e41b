#include "ui/panels/sweep/sweep_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

#include "app/base/text.h"
#include "app/measure/sweep.h"
#include "ui/kit/front_chart.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"

namespace worldy::ui {

namespace {

struct SweepColumn {
    const char* title;
    float share;
    double (*value)(const SweepPoint&);
    std::string (*text)(double value);
    const char* explanation;
    const char* widest;
};

std::string whole(double value) {
    return fmt::format("{:.0f}", value);
}
std::string fine(double value) {
    return fmt::format("{:.3g}", value);
}

// There is no useful bound if the eye lies within a chunk's bounds.
std::string bound(double px) {
    return px < 1e5 ? fine(px) : "none";
}

constexpr std::array<SweepColumn, 11> sweepColumns = {{
    {"Chunk", 1.15f, [](const SweepPoint& p) { return double{1} * p.chunkSize; }, whole,
     "Vertices along a chunk side. Ringed: on the Pareto front; no other point is both cheaper and more "
     "accurate.",
     "xx 129"},
    {"Metric", 1.2f, [](const SweepPoint& p) { return p.metric == planet::ErrorMetric::Tight ? 1.0 : 0.0; },
     [](double tight) { return std::string(tight > 0 ? "tight" : "additive"); },
     "Geometric error metric used for selection.", "additive"},
    {"τ", 0.7f, [](const SweepPoint& p) { return p.tauPx; }, fine, "Tolerance in pixels.", "0.123"},
    {"Triangles", 1.2f, [](const SweepPoint& p) { return p.figures.meanTriangles; }, countText,
     "Ground triangles and skirt triangles, mean over the sample frames.", "99.9 M"},
    {"Measured", 1.2f, [](const SweepPoint& p) { return p.figures.worstMeasuredPx; }, fine,
     "Largest true error of any finest sample in any sample frame, in facing pixels.", "0.000123"},
    {"99 %", 0.8f, [](const SweepPoint& p) { return p.figures.p99MeasuredPx; }, fine,
     "99 % of the chunks of all sample frames have no larger true error, in pixels.", "0.000123"},
    {"ε", 0.9f, [](const SweepPoint& p) { return p.figures.worstEpsPx; }, bound,
     "Largest predicted error of a drawn chunk's own surface, in pixels. It exceeds the tolerance where the "
     "data has no finer level. None: the camera was inside the bounds of a chunk.",
     "0.000123"},
    {"Bound", 0.9f, [](const SweepPoint& p) { return p.figures.worstDrawnBoundPx; }, bound,
     "Largest drawn bound, in pixels: the bound of the error of what is drawn, including morphing. None: the "
     "camera was inside the bounds of a chunk, where there is no bound.",
     "0.000123"},
    {"MiB", 0.8f, [](const SweepPoint& p) { return p.figures.mostResidentMiB; }, fine,
     "Largest memory of resident chunks, CPU and GPU together, in MiB.", "1.23e+03"},
    {"Frame", 0.9f, [](const SweepPoint& p) { return p.figures.medianFrameMs; },
     [](double ms) { return fmt::format("{:.3g} ms", ms); },
     "Median time of selection and drawing, including the GPU. It is longer than without a window, because "
     "the window draws too.",
     "12.3 ms"},
    {"Violations", 1.2f, [](const SweepPoint& p) { return static_cast<double>(p.figures.violations); }, whole,
     "Chunks whose true error exceeds the drawn bound. Must be 0.", "0"},
}};

void pointRow(const SweepPoint& point, std::size_t index, const ImVec4& colour,
              std::optional<std::size_t>& selected) {
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable("##row", selected == index, ImGuiSelectableFlags_SpanAllColumns)) selected = index;
    noteItem(fmt::format("Row {}", index));
    const float line = ImGui::GetTextLineHeight();
    frontMark({at.x + line * 0.5f, at.y + line * 0.5f}, colour, point.onFront);
    ImGui::SameLine(line * 1.2f);
    for (const SweepColumn& column : sweepColumns) {
        if (&column != &sweepColumns.front()) ImGui::TableNextColumn();
        const bool violation = &column == &sweepColumns.back() && point.figures.violations > 0;
        ImGui::PushStyleColor(ImGuiCol_Text, violation ? palette().bad : palette().text);
        ImGui::TextUnformatted(column.text(column.value(point)).c_str());
        ImGui::PopStyleColor();
    }
}

ExportTable sweepExport(const char* name, std::span<const SweepPoint> points) {
    ExportTable table{.name = name, .rows = points.size()};
    const std::span<const SweepFigure> figures = sweepFigures();
    for (const SweepFigure& figure : figures) table.columns.push_back({figure.name});
    table.cell = [=](std::size_t row, std::size_t column) -> ExportCell {
        return std::visit([](const auto& value) { return ExportCell(value); },
                          figures[column].of(points[row]));
    };
    return table;
}

std::array<TableColumn, sweepColumns.size()> tableColumns() {
    std::array<TableColumn, sweepColumns.size()> columns{};
    std::transform(sweepColumns.begin(), sweepColumns.end(), columns.begin(), [](const SweepColumn& column) {
        return TableColumn{column.title, column.share, column.explanation, column.widest};
    });
    return columns;
}

}  // namespace

float sweepTableWidth() {
    return listTableWidth(tableColumns());
}

void sweepTable(std::span<const SweepPoint> points, std::optional<std::size_t>& selected) {
    const std::array columns = tableColumns();
    if (!beginWideTable("points", columns, 1)) return;
    const std::vector<SweepSeries> series = seriesOf(points);
    std::vector<std::size_t> seriesIndex(points.size());
    for (std::size_t s = 0; s < series.size(); ++s) {
        for (const std::size_t i : series[s].points) seriesIndex[i] = s;
    }
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        return sweepColumns[column].value(points[row]);
    };
    for (const std::size_t i : tableOrder(points.size(), chosenSort(), key))
        tableRow(i, [&] { pointRow(points[i], i, seriesColour(seriesIndex[i]), selected); });
    endTable(sweepExport("sweep", points));
}

}  // namespace worldy::ui
