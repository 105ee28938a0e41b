#include "ui/panels/sweep/sweep_chart.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

constexpr float leastChartLines = 6;

// The mapping of figures to pixels.
struct ChartScale {
    ImVec2 start;
    ImVec2 end;
    LogAxis errors;
    LogAxis costs;
    SweepCost cost = SweepCost::Triangles;

    float x(double errorPx) const {
        return start.x + static_cast<float>(errors.position(errorPx)) * (end.x - start.x);
    }
    float y(double amount) const {
        return end.y - static_cast<float>(costs.position(amount)) * (end.y - start.y);
    }
    ImVec2 at(const SweepPoint& point) const {
        return {x(plottedErrorPx(point.figures)), y(plottedCost(point.figures, cost))};
    }
};

float tickWidth(const LogAxis& axis) {
    float width = 0;
    for (const double tick : axis.ticks)
        width = std::max(width, ImGui::CalcTextSize(axisText(tick).c_str()).x);
    return width;
}

ChartScale scaleOver(std::span<const SweepPoint> points, SweepCost cost, ImVec2 start, ImVec2 end) {
    std::vector<double> errors, costs;
    for (const SweepPoint& point : points) {
        errors.push_back(plottedErrorPx(point.figures));
        costs.push_back(plottedCost(point.figures, cost));
    }
    ChartScale scale{start, end, logAxisOver(errors), logAxisOver(costs), cost};
    const float gap = ImGui::GetFontSize() * 0.4f;
    scale.start.x += tickWidth(scale.costs) + 2 * gap;
    scale.start.y += ImGui::GetTextLineHeight();  // for the tau of a point at the top
    // The last tick's text reaches half its width beyond the axis; a point's tau stands right of it.
    scale.end.x -= std::max(tickWidth(scale.errors) / 2, ImGui::GetFontSize());
    scale.end.y -= ImGui::GetTextLineHeight() + gap;
    return scale;
}

void drawAxes(const ChartScale& scale) {
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
    // The lines fall to the right, which leaves room there.
    const char* name = "max measured error, px";
    if (ImGui::CalcTextSize(name).x + 2 * gap > scale.end.x - scale.start.x) name = "error, px";
    list.AddText({scale.end.x - ImGui::CalcTextSize(name).x - gap, scale.start.y + gap / 2}, dim, name);
}

// Draws the legend above the plot, starting beside the last item.
void legend(std::span<const SweepSeries> series) {
    const float line = ImGui::GetTextLineHeight();
    for (std::size_t i = 0; i < series.size(); ++i) {
        const std::string name = series[i].name();
        sameLineIfRoom(line + ImGui::CalcTextSize(name.c_str()).x);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float down = (ImGui::GetItemRectSize().y - line) / 2;
        const bool besideFrame = i == 0 && down > 0 && at.y < ImGui::GetItemRectMax().y;
        if (besideFrame) ImGui::AlignTextToFramePadding();
        sweepMark({at.x + line / 2, at.y + line / 2 + (besideFrame ? down : 0)}, sweepColour(i), false);
        ImGui::Dummy({line * 0.7f, line});
        ImGui::SameLine(0, line * 0.25f);
        ImGui::TextColored(palette().dim, "%s", name.c_str());
    }
}

void drawSeries(const ChartScale& scale, std::span<const SweepPoint> points, const SweepSeries& series,
                const ImVec4& colour) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    std::vector<ImVec2> way;
    for (const std::size_t i : series.points) way.push_back(scale.at(points[i]));
    list.AddPolyline(way.data(), static_cast<int>(way.size()), packed(colour, 0.7f), ImDrawFlags_None,
                     std::max(ImGui::GetFontSize() / 10, 1.0f));
    for (std::size_t i = 0; i < way.size(); ++i) sweepMark(way[i], colour, points[series.points[i]].onFront);
}

// Labels points with their taus, except where labels would overlap; hovering shows every value.
void drawTaus(const ChartScale& scale, std::span<const SweepPoint> points,
              std::span<const SweepSeries> series) {
    struct Box {
        ImVec2 start, end;
    };
    std::vector<Box> taken;
    const float away = ImGui::GetFontSize() * 0.35f;
    for (std::size_t s = 0; s < series.size(); ++s) {
        for (const std::size_t i : series[s].points) {
            const std::string text = fmt::format("{:g}", points[i].tauPx);
            const ImVec2 size = ImGui::CalcTextSize(text.c_str());
            const ImVec2 at = scale.at(points[i]);
            const Box box{{at.x + away, at.y - size.y - away / 2}, {at.x + away + size.x, at.y - away / 2}};
            const bool covered = std::any_of(taken.begin(), taken.end(), [&](const Box& other) {
                return box.start.x < other.end.x && other.start.x < box.end.x && box.start.y < other.end.y &&
                       other.start.y < box.end.y;
            });
            if (covered) continue;
            taken.push_back(box);
            ImGui::GetWindowDrawList()->AddText(box.start, packed(sweepColour(s)), text.c_str());
        }
    }
}

std::optional<std::size_t> nearestToPointer(const ChartScale& scale, std::span<const SweepPoint> points) {
    if (!ImGui::IsItemHovered()) return std::nullopt;
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

void tell(const SweepPoint& point) {
    const FlightFigures& f = point.figures;
    ImGui::BeginTooltip();
    ImGui::TextUnformatted(settingText(point.chunkSize, point.metric, point.tauPx, tauSymbol()).c_str());
    ImGui::Text("measured %.3g px, 99 %%: %.3g px", f.worstMeasuredPx, f.p99MeasuredPx);
    ImGui::Text("%s triangles, %.1f MiB, %s", countText(f.meanTriangles).c_str(), f.mostResidentMiB,
                millisecondsText(f.medianFrameMs).c_str());
    if (point.onFront) ImGui::TextColored(palette().good, "on the Pareto front");
    ImGui::TextDisabled("click: select");
    ImGui::EndTooltip();
}

}  // namespace

ImVec4 sweepColour(std::size_t series) {
    return seriesColour(series);
}

void sweepMark(ImVec2 middle, const ImVec4& colour, bool onFront) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float radius = ImGui::GetFontSize() * 0.22f;
    if (onFront)
        list.AddCircle(middle, radius * 1.9f, packed(palette().text), 0,
                       std::max(ImGui::GetFontSize() / 12, 1.0f));
    list.AddCircleFilled(middle, radius, packed(colour));
}

std::optional<std::size_t> sweepChart(std::span<const SweepPoint> points, SweepCost cost,
                                      std::optional<std::size_t> selected) {
    const std::vector<SweepSeries> series = seriesOf(points);
    legend(series);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 size{std::max(room.x, ImGui::GetFontSize()),
                      std::max(room.y, leastChartLines * ImGui::GetTextLineHeightWithSpacing())};
    const ImVec2 start = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("chart", size);
    noteItem("chart");
    const ImVec2 end{start.x + size.x, start.y + size.y};
    const ChartScale scale = scaleOver(points, cost, start, end);
    ImGui::PushClipRect(start, end, true);
    ImGui::GetWindowDrawList()->AddRectFilled(scale.start, scale.end, ImGui::GetColorU32(ImGuiCol_FrameBg));
    drawAxes(scale);
    for (std::size_t i = 0; i < series.size(); ++i) drawSeries(scale, points, series[i], sweepColour(i));
    drawTaus(scale, points, series);
    if (selected) {
        ImGui::GetWindowDrawList()->AddCircle(scale.at(points[*selected]), ImGui::GetFontSize() * 0.6f,
                                              packed(palette().warning), 0, 2);
    }
    ImGui::PopClipRect();
    for (std::size_t i = 0; i < points.size() && i < 3; ++i) {
        const ImVec2 at = scale.at(points[i]);
        noteRect(fmt::format("Point {}", i), {at.x - 2, at.y - 2, 4, 4});
    }
    const std::optional<std::size_t> nearest = nearestToPointer(scale, points);
    if (nearest) {
        tell(points[*nearest]);
        return ImGui::IsMouseClicked(ImGuiMouseButton_Left) ? nearest : std::nullopt;
    }
    tooltip(
        "One point per setting: max measured error on the horizontal axis, cost on the vertical axis, both "
        "logarithmic, labelled with the tolerance. Ringed: no other point is both cheaper and more "
        "accurate.");
    return std::nullopt;
}

}  // namespace worldy::ui
