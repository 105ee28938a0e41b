#include "ui/sweep_table.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "ui/item_map.h"
#include "ui/sweep_chart.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

struct SweepColumn {
    const char* title;
    float share;
    double (*value)(const SweepPoint&);
    std::string (*text)(double value);
    const char* explanation;
};

std::string whole(double value) {
    return fmt::format("{:.0f}", value);
}
std::string fine(double value) {
    return fmt::format("{:.3g}", value);
}

// Where an eye stands in a chunk's bounds its prediction has next to no end.
std::string predicted(double px) {
    return px < 1e5 ? fine(px) : "none";
}

constexpr std::array<SweepColumn, 10> sweepColumns = {{
    {"Chunk", 1.15f, [](const SweepPoint& p) { return double{1} * p.chunkSize; }, whole,
     "Vertices a side. Ringed: on the Pareto front, no other point is both cheaper and truer."},
    {"Metric", 1.2f, [](const SweepPoint& p) { return p.metric == planet::ErrorMetric::Tight ? 1.0 : 0.0; },
     [](double tight) { return std::string(tight > 0 ? "tight" : "additive"); },
     "What chunks are chosen by."},
    {"Tau", 0.7f, [](const SweepPoint& p) { return p.tauPx; }, fine, "The tolerance, pixels."},
    {"Triangles", 1.2f, [](const SweepPoint& p) { return p.figures.meanTriangles; }, countText,
     "Drawn, mean over the moments."},
    {"Measured", 1.2f, [](const SweepPoint& p) { return p.figures.worstMeasuredPx; }, fine,
     "The largest true error of any finest sample in any moment, pixels as if the view faced it."},
    {"99 %", 0.8f, [](const SweepPoint& p) { return p.figures.p99MeasuredPx; }, fine,
     "99 of 100 chunks of all moments have no larger true error, pixels."},
    {"Predicted", 1.2f, [](const SweepPoint& p) { return p.figures.worstPredictedPx; }, predicted,
     "The largest error that was predicted of what was drawn, pixels. Over the tolerance where the data has "
     "no finer level. None: an eye stood within the bounds of a chunk, where nothing can be promised."},
    {"MiB", 0.8f, [](const SweepPoint& p) { return p.figures.mostResidentMiB; }, fine,
     "The most that resident chunks took, CPU and GPU together."},
    {"Frame", 0.9f, [](const SweepPoint& p) { return p.figures.medianFrameMs; },
     [](double ms) { return fmt::format("{:.3g} ms", ms); },
     "Choosing and drawing, waited for, median. Measured while the window draws too, so longer than alone."},
    {"Violations", 1.2f, [](const SweepPoint& p) { return static_cast<double>(p.figures.violations); }, whole,
     "Chunks whose true error is over what was predicted. Must be 0."},
}};

void headers() {
    ImGui::TableSetupScrollFreeze(1, 1);
    for (const SweepColumn& column : sweepColumns) ImGui::TableSetupColumn(column.title, 0, column.share);
    ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
    for (const SweepColumn& column : sweepColumns) {
        ImGui::TableNextColumn();
        ImGui::TableHeader(column.title);
        noteItem(fmt::format("Sort by {}", column.title));
        tooltip(column.explanation);
    }
}

// As they came where no column is chosen to sort by.
std::vector<std::size_t> orderOf(std::span<const SweepPoint> points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const ImGuiTableSortSpecs* specs = ImGui::TableGetSortSpecs();
    if (!specs || specs->SpecsCount == 0) return order;
    const auto value = sweepColumns[static_cast<std::size_t>(specs->Specs->ColumnIndex)].value;
    const bool descending = specs->Specs->SortDirection == ImGuiSortDirection_Descending;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return descending ? value(points[a]) > value(points[b]) : value(points[a]) < value(points[b]);
    });
    return order;
}

void pointRow(const SweepPoint& point, std::size_t index, const ImVec4& colour,
              std::optional<std::size_t>& selected) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushID(static_cast<int>(index));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable("##row", selected == index, ImGuiSelectableFlags_SpanAllColumns)) selected = index;
    noteItem(fmt::format("Row {}", index));
    ImGui::PopID();
    const float line = ImGui::GetTextLineHeight();
    sweepMark({at.x + line * 0.5f, at.y + line * 0.5f}, colour, point.onFront);
    ImGui::SameLine(line * 1.2f);
    for (const SweepColumn& column : sweepColumns) {
        if (&column != &sweepColumns.front()) ImGui::TableNextColumn();
        const bool violation = &column == &sweepColumns.back() && point.figures.violations > 0;
        ImGui::PushStyleColor(ImGuiCol_Text, violation ? palette().bad : palette().text);
        ImGui::TextUnformatted(column.text(column.value(point)).c_str());
        ImGui::PopStyleColor();
    }
}

}  // namespace

void sweepTable(std::span<const SweepPoint> points, std::optional<std::size_t>& selected) {
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                      ImGuiTableFlags_RowBg | ImGuiTableFlags_Resizable |
                                      ImGuiTableFlags_BordersInnerV | ImGuiTableFlags_SizingStretchProp |
                                      ImGuiTableFlags_Sortable | ImGuiTableFlags_SortTristate;
    const float width = std::max(ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize,
                                 48 * ImGui::GetFontSize());
    const float height =
        std::max(ImGui::GetContentRegionAvail().y, 5 * ImGui::GetTextLineHeightWithSpacing());
    if (!ImGui::BeginTable("points", static_cast<int>(sweepColumns.size()), flags, {0, height}, width))
        return;
    headers();
    const std::vector<SweepSeries> series = seriesOf(points);
    std::vector<std::size_t> seriesIndex(points.size());
    for (std::size_t s = 0; s < series.size(); ++s) {
        for (const std::size_t i : series[s].points) seriesIndex[i] = s;
    }
    for (const std::size_t i : orderOf(points)) pointRow(points[i], i, sweepColour(seriesIndex[i]), selected);
    ImGui::EndTable();
}

}  // namespace ui
