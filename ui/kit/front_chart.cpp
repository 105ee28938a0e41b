#include "ui/kit/front_chart.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

#include "app/base/plot_scale.h"
#include "ui/kit/exports.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

constexpr float leastChartLines = 6;

// The mapping of figures to pixels.
struct ChartScale {
    ImVec2 start;
    ImVec2 end;
    LogAxis errors;
    LogAxis costs;

    float x(double errorPx) const {
        return start.x + static_cast<float>(errors.position(errorPx)) * (end.x - start.x);
    }
    float y(double amount) const {
        return end.y - static_cast<float>(costs.position(amount)) * (end.y - start.y);
    }
    ImVec2 at(const FrontPoint& point) const { return {x(point.errorPx), y(point.cost)}; }
};

float tickWidth(const LogAxis& axis) {
    float width = 0;
    for (const double tick : axis.ticks)
        width = std::max(width, ImGui::CalcTextSize(axisText(tick).c_str()).x);
    return width;
}

ChartScale scaleOver(std::span<const FrontPoint> points, ImVec2 start, ImVec2 end) {
    std::vector<double> errors, costs;
    for (const FrontPoint& point : points) {
        errors.push_back(point.errorPx);
        costs.push_back(point.cost);
    }
    ChartScale scale{start, end, logAxisOver(errors), logAxisOver(costs)};
    const float gap = ImGui::GetFontSize() * 0.4f;
    scale.start.x += tickWidth(scale.costs) + 2 * gap;
    scale.start.y += ImGui::GetTextLineHeight();  // for the label of a point at the top
    // The last tick's text reaches half its width beyond the axis; a point's label stands right of it.
    scale.end.x -= std::max(tickWidth(scale.errors) / 2, ImGui::GetFontSize());
    scale.end.y -= ImGui::GetTextLineHeight() + gap;
    return scale;
}

void drawAxes(const ChartScale& scale, const FrontChart& chart) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImU32 line = packed(palette().dim, 0.25f);
    const ImU32 dim = packed(palette().dim);
    const float gap = ImGui::GetFontSize() * 0.4f;
    const float half = ImGui::GetTextLineHeight() / 2;
    float freeFrom = 0;
    for (const double tick : scale.errors.ticks) {
        const float x = scale.x(tick);
        list.AddLine({x, scale.start.y}, {x, scale.end.y}, line);
        const std::string text = axisText(tick);
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        if (x - width / 2 < freeFrom) continue;
        list.AddText({x - width / 2, scale.end.y + gap / 2}, dim, text.c_str());
        freeFrom = x + width / 2 + gap;
    }
    float freeTo = scale.end.y + 2 * half;
    for (const double tick : scale.costs.ticks) {
        const float y = scale.y(tick);
        list.AddLine({scale.start.x, y}, {scale.end.x, y}, line);
        if (y + half > freeTo) continue;
        const std::string text = axisText(tick);
        list.AddText({scale.start.x - gap - ImGui::CalcTextSize(text.c_str()).x, y - half}, dim,
                     text.c_str());
        freeTo = y - half;
    }
    const char* name = chart.errorName;
    if (ImGui::CalcTextSize(name).x + 2 * gap > scale.end.x - scale.start.x) name = chart.shortErrorName;
    const float nameX = scale.end.x - ImGui::CalcTextSize(name).x - gap;
    if (*chart.costTitle == '\0') {
        // The lines fall to the right, which leaves room at the top.
        list.AddText({nameX, scale.start.y + gap / 2}, dim, name);
    } else {
        list.AddText({scale.start.x + gap, scale.start.y + gap / 2}, dim, chart.costTitle);
        list.AddText({nameX, scale.end.y - 2 * half - gap / 2}, dim, name);
    }
}

void drawSeries(const ChartScale& scale, std::span<const FrontPoint> points, const FrontSeries& series) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    std::vector<ImVec2> way;
    for (const std::size_t i : series.points) way.push_back(scale.at(points[i]));
    list.AddPolyline(way.data(), static_cast<int>(way.size()), packed(series.colour, 0.7f), ImDrawFlags_None,
                     std::max(ImGui::GetFontSize() / 10, 1.0f));
    for (std::size_t i = 0; i < way.size(); ++i) {
        const FrontPoint& point = points[series.points[i]];
        frontMark(way[i], point.colour, point.onFront);
    }
}

// Labels points, except where labels would overlap; hovering shows every value.
void drawLabels(const ChartScale& scale, const FrontChart& chart) {
    struct Box {
        ImVec2 start, end;
    };
    std::vector<Box> taken;
    const float away = ImGui::GetFontSize() * 0.35f;
    for (const FrontSeries& series : chart.series) {
        for (const std::size_t i : series.points) {
            const FrontPoint& point = chart.points[i];
            const ImVec2 size = ImGui::CalcTextSize(point.label.c_str());
            const ImVec2 at = scale.at(point);
            const Box box{{at.x + away, at.y - size.y - away / 2}, {at.x + away + size.x, at.y - away / 2}};
            const bool covered = std::any_of(taken.begin(), taken.end(), [&](const Box& other) {
                return box.start.x < other.end.x && other.start.x < box.end.x && box.start.y < other.end.y &&
                       other.start.y < box.end.y;
            });
            if (covered) continue;
            taken.push_back(box);
            ImGui::GetWindowDrawList()->AddText(box.start, packed(point.colour), point.label.c_str());
        }
    }
}

std::string seriesName(const FrontChart& chart, std::size_t point) {
    for (const FrontSeries& series : chart.series) {
        if (std::find(series.points.begin(), series.points.end(), point) != series.points.end())
            return series.name;
    }
    return {};
}

ExportTable samplesOf(const FrontChart& chart) {
    ExportTable table{.name = chart.name,
                      .columns = {{"series"}, {"label"}, {"error_px"}, {chart.costName}, {"on_front"}},
                      .rows = chart.points.size()};
    table.cell = [&](std::size_t row, std::size_t column) -> ExportCell {
        const FrontPoint& point = chart.points[row];
        switch (column) {
            case 0:
                return seriesName(chart, row);
            case 1:
                return point.label;
            case 2:
                return point.errorPx;
            case 3:
                return point.cost;
            default:
                return point.onFront;
        }
    };
    return table;
}

std::optional<std::size_t> nearestToPointer(const ChartScale& scale, std::span<const FrontPoint> points) {
    if (!plotIsHovered()) return std::nullopt;
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float reach = ImGui::GetFontSize();
    float best = reach * reach;
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ImVec2 at = scale.at(points[i]);
        const float squared = (at.x - mouse.x) * (at.x - mouse.x) + (at.y - mouse.y) * (at.y - mouse.y);
        if (squared >= best) continue;
        best = squared;
        nearest = i;
    }
    return nearest;
}

}  // namespace

void frontLegend(std::span<const FrontSeries> series) {
    const float line = ImGui::GetTextLineHeight();
    // Beside a control, texts stand lower than the top of their line.
    float lineY = -1, down = 0;
    for (const FrontSeries& each : series) {
        if (each.name.empty()) continue;
        sameLineIfRoom(line + ImGui::CalcTextSize(each.name.c_str()).x);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        if (at.y != lineY) {
            const float besideDown = (ImGui::GetItemRectSize().y - line) / 2;
            down = at.y < ImGui::GetItemRectMax().y ? std::max(besideDown, 0.0f) : 0;
            lineY = at.y;
        }
        if (down > 0) ImGui::AlignTextToFramePadding();
        frontMark({at.x + line / 2, at.y + line / 2 + down}, each.colour, false);
        ImGui::Dummy({line * 0.7f, line});
        ImGui::SameLine(0, line * 0.25f);
        ImGui::TextColored(palette().dim, "%s", each.name.c_str());
    }
}

void frontMark(ImVec2 middle, const ImVec4& colour, bool onFront) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float radius = ImGui::GetFontSize() * 0.22f;
    if (onFront)
        list.AddCircle(middle, radius * 1.9f, packed(palette().text), 0,
                       std::max(ImGui::GetFontSize() / 12, 1.0f));
    list.AddCircleFilled(middle, radius, packed(colour));
}

std::optional<std::size_t> frontChart(const FrontChart& chart, std::optional<std::size_t> selected) {
    frontLegend(chart.series);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 size{std::max(room.x, ImGui::GetFontSize()),
                      std::max(room.y, leastChartLines * ImGui::GetTextLineHeightWithSpacing())};
    const ImVec2 start = ImGui::GetCursorScreenPos();
    plotItem("chart", size);
    noteItem("chart");
    const ImVec2 end{start.x + size.x, start.y + size.y};
    const ChartScale scale = scaleOver(chart.points, start, end);
    ImGui::PushClipRect(start, end, true);
    ImGui::GetWindowDrawList()->AddRectFilled(scale.start, scale.end, ImGui::GetColorU32(ImGuiCol_FrameBg));
    drawAxes(scale, chart);
    for (const FrontSeries& series : chart.series) drawSeries(scale, chart.points, series);
    drawLabels(scale, chart);
    if (selected) {
        ImGui::GetWindowDrawList()->AddCircle(scale.at(chart.points[*selected]), ImGui::GetFontSize() * 0.6f,
                                              packed(palette().warning), 0, 2);
    }
    ImGui::PopClipRect();
    for (std::size_t i = 0; i < chart.points.size() && i < 3; ++i) {
        const ImVec2 at = scale.at(chart.points[i]);
        noteRect(fmt::format("Point {}", i), {at.x - 2, at.y - 2, 4, 4});
    }
    exportPlot("chart", samplesOf(chart));
    const PlotCursor cursor = plotCursor(chart.points.size());
    const std::optional<std::size_t> told = cursor.at ? cursor.at : nearestToPointer(scale, chart.points);
    if (told) {
        const ImVec2 at = scale.at(chart.points[*told]);
        if (cursor.at)
            ImGui::GetWindowDrawList()->AddCircle(at, ImGui::GetFontSize() * 0.6f, packed(palette().text), 0,
                                                  2);
        beginSampleTooltip(cursor, at.x);
        chart.tell(*told);
        ImGui::EndTooltip();
        const bool isClicked = !cursor.at && ImGui::IsMouseClicked(ImGuiMouseButton_Left);
        return cursor.acts || isClicked ? told : std::nullopt;
    }
    tooltip(chart.explanation);
    return std::nullopt;
}

}  // namespace worldy::ui
