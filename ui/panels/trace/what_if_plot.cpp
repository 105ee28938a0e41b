#include "ui/panels/trace/what_if_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/base/plot_scale.h"
#include "ui/kit/exports.h"
#include "ui/kit/front_chart.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/theme.h"

namespace worldy::ui {

namespace {

constexpr float leastPlotLines = 5;
// The range of a logarithmic axis. Errors reach beyond it where the eye is inside a node's bounds.
constexpr float lowestLogarithmic = 0.01f;
constexpr float highestLogarithmic = 1e4f;

struct PlotScale {
    ImVec2 start;
    ImVec2 end;
    std::span<const float> timesS;
    double top = 1;  // of a linear axis
    std::optional<LogAxis> logarithmic;

    float width() const { return std::max(end.x - start.x, 1.0f); }
    bool hasTimes() const { return timesS.back() > 0; }
    float x(std::size_t point) const {
        const auto last = static_cast<float>(std::max<std::size_t>(timesS.size() - 1, 1));
        const float share = hasTimes() ? timesS[point] / timesS.back() : static_cast<float>(point) / last;
        return start.x + share * width();
    }
    float y(double value) const {
        const double share =
            logarithmic ? logarithmic->position(std::max(value, static_cast<double>(lowestLogarithmic)))
                        : linearPosition(value, 0, top);
        return end.y - 1 - static_cast<float>(share) * (end.y - start.y - 2);
    }
    std::size_t pointAt(float atX) const {
        std::size_t low = 0, high = timesS.size() - 1;
        while (low < high) {
            const std::size_t middle = (low + high + 1) / 2;
            if (x(middle) <= atX)
                low = middle;
            else
                high = middle - 1;
        }
        return low;
    }
};

PlotScale scaleOver(const WhatIfPlot& plot, ImVec2 start, ImVec2 end) {
    PlotScale scale{start, end, plot.timesS, 1, std::nullopt};
    float largest = 0;
    std::vector<double> plotted;
    for (const WhatIfLine& line : plot.lines) {
        for (const float value : line.values) {
            if (!std::isfinite(value)) continue;
            largest = std::max(largest, value);
            if (plot.isLogarithmic)
                plotted.push_back(
                    static_cast<double>(std::clamp(value, lowestLogarithmic, highestLogarithmic)));
        }
    }
    scale.top = roundedTop(static_cast<double>(largest));
    if (plot.isLogarithmic) scale.logarithmic = logAxisOver(plotted);
    return scale;
}

// Returns the values that the axis marks, ascending, as far apart as their texts need.
std::vector<double> levelsOf(const PlotScale& scale) {
    const float line = ImGui::GetTextLineHeight();
    if (!scale.logarithmic)
        return scale.end.y - scale.start.y > 4 * line ? std::vector{scale.top / 2, scale.top}
                                                      : std::vector{scale.top};
    std::vector<double> levels;
    float freeTo = scale.end.y + line;
    for (const double tick : scale.logarithmic->ticks) {
        if (scale.y(tick) > freeTo) continue;
        levels.push_back(tick);
        freeTo = scale.y(tick) - 1.2f * line;
    }
    return levels;
}

void drawLevels(const PlotScale& scale, std::span<const double> levels) {
    for (const double level : levels) {
        const float y = std::round(scale.y(level));
        ImGui::GetWindowDrawList()->AddLine({scale.start.x, y}, {scale.end.x, y},
                                            packed(palette().dim, 0.25f));
    }
}

// Draws the texts above the lines of the plot, each on a ground of its own.
void drawLevelTexts(const PlotScale& scale, const WhatIfPlot& plot, std::span<const double> levels) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float gap = ImGui::GetFontSize() * 0.25f;
    for (const double level : levels) {
        const std::string text = plot.axisText(level);
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const float y = std::round(scale.y(level));
        const ImVec2 at{scale.start.x + gap, y - size.y < scale.start.y ? y : y - size.y};
        list.AddRectFilled(at, {at.x + size.x, at.y + size.y},
                           packed(ImGui::GetStyleColorVec4(ImGuiCol_FrameBg), 0.8f));
        list.AddText(at, packed(palette().dim), text.c_str());
    }
}

// Draws the largest value in each column of pixels.
void drawLine(const PlotScale& scale, const WhatIfLine& line) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float thickness = std::max(ImGui::GetFontSize() / (line.isThick ? 6 : 11), 1.0f);
    std::vector<ImVec2> way;
    const auto finish = [&] {
        if (way.size() == 1)
            list.AddCircleFilled(way.front(), thickness, packed(line.colour));
        else
            list.AddPolyline(way.data(), static_cast<int>(way.size()), packed(line.colour), ImDrawFlags_None,
                             thickness);
        way.clear();
    };
    for (std::size_t i = 0; i < line.values.size(); ++i) {
        if (!std::isfinite(line.values[i])) {
            finish();
            continue;
        }
        const float x = std::round(scale.x(i));
        const float y = scale.y(static_cast<double>(line.values[i]));
        if (!way.empty() && way.back().x == x)
            way.back().y = std::min(way.back().y, y);
        else
            way.emplace_back(x, y);
    }
    finish();
}

void drawUpright(const PlotScale& scale, float x, const ImVec4& colour) {
    ImGui::GetWindowDrawList()->AddLine({x, scale.start.y}, {x, scale.end.y}, packed(colour, 0.7f));
}

void tell(const WhatIfPlot& plot, const PlotCursor& cursor, std::size_t point, float x) {
    const std::uint64_t last = point + 1 < plot.frames.size() ? plot.frames[point + 1] - 1
                                                              : plot.frames[point] + plot.framesInPoint - 1;
    beginSampleTooltip(cursor, x);
    const std::string frames = last > plot.frames[point] && plot.framesInPoint > 1
                                   ? fmt::format("frames {} to {}, largest values", plot.frames[point], last)
                                   : fmt::format("frame {}", plot.frames[point]);
    ImGui::TextDisabled("%s, %.2f s", frames.c_str(), static_cast<double>(plot.timesS[point]));
    for (const WhatIfLine& line : plot.lines) {
        const auto value = static_cast<double>(line.values[point]);
        ImGui::TextColored(line.colour, "%s", line.name.c_str());
        ImGui::SameLine();
        ImGui::TextUnformatted(std::isfinite(value) ? plot.text(value).c_str() : "not known");
    }
    ImGui::TextDisabled("click or Enter: show this frame");
    ImGui::EndTooltip();
}

ExportTable samplesOf(const WhatIfPlot& plot) {
    ExportTable table{
        .name = "what if over the flight", .columns = {{"frame"}, {"time_s"}}, .rows = plot.frames.size()};
    for (const WhatIfLine& line : plot.lines) table.columns.push_back({line.name});
    table.cell = [&](std::size_t row, std::size_t column) -> ExportCell {
        if (column == 0) return plot.frames[row];
        return column == 1 ? plot.timesS[row] : plot.lines[column - 2].values[row];
    };
    return table;
}

}  // namespace

std::optional<std::uint64_t> whatIfPlot(const WhatIfPlot& plot) {
    std::vector<FrontSeries> names;
    for (const WhatIfLine& line : plot.lines) names.push_back({line.name, line.colour, {}});
    frontLegend(names);
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 size{std::max(room.x, ImGui::GetFontSize()),
                      std::max(room.y, leastPlotLines * ImGui::GetTextLineHeightWithSpacing())};
    const ImVec2 start = ImGui::GetCursorScreenPos();
    plotItem("flight", size);
    noteItem("flight");
    const ImVec2 end{start.x + size.x, start.y + size.y};
    ImGui::GetWindowDrawList()->AddRectFilled(start, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
    if (plot.frames.empty()) return std::nullopt;
    const PlotScale scale = scaleOver(plot, start, end);
    ImGui::PushClipRect(start, end, true);
    const std::vector<double> levels = levelsOf(scale);
    drawLevels(scale, levels);
    const auto shown = std::ranges::upper_bound(plot.frames, plot.shownFrame);
    if (shown != plot.frames.begin())
        drawUpright(scale, scale.x(static_cast<std::size_t>(shown - plot.frames.begin()) - 1),
                    palette().warning);
    for (std::size_t i = plot.lines.size(); i-- > 0;) drawLine(scale, plot.lines[i]);
    drawLevelTexts(scale, plot, levels);
    std::optional<std::uint64_t> clicked;
    const PlotCursor cursor = plotCursor(plot.frames.size());
    if (cursor.at || plotIsHovered()) {
        const std::size_t point = cursor.at ? *cursor.at : scale.pointAt(ImGui::GetIO().MousePos.x);
        drawUpright(scale, scale.x(point), palette().text);
        tell(plot, cursor, point, scale.x(point));
        if (cursor.acts || (!cursor.at && ImGui::IsMouseClicked(ImGuiMouseButton_Left)))
            clicked = plot.frames[point];
    }
    ImGui::PopClipRect();
    exportPlot("flight", samplesOf(plot));
    return clicked;
}

}  // namespace worldy::ui
