#include "ui/kit/plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "app/base/plot_scale.h"
#include "ui/kit/exports.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/theme.h"

namespace worldy::ui {

namespace {

// The minimum time range of a plot, seconds.
constexpr float plotSpanS = 10;

// A plot's frame on the screen.
struct Area {
    ImVec2 start;
    ImVec2 end;

    float width() const { return end.x - start.x; }
    float height() const { return end.y - start.y; }
};

ImU32 faded(const ImVec4& colour, float alpha) {
    return ImGui::GetColorU32(ImVec4(colour.x, colour.y, colour.z, colour.w * alpha));
}

// Returns "queued" or, with a unit, "read_mb_per_s".
std::string columnName(std::string_view name, std::string_view unit) {
    std::string column(name);
    if (!unit.empty()) column += fmt::format(" ({})", unit);
    return column;
}

// Reserves the plot's area as an item that can be hovered.
Area beginArea(const char* id, float lines) {
    const float width = std::max(ImGui::GetContentRegionAvail().x, ImGui::GetFontSize());
    const ImVec2 start = ImGui::GetCursorScreenPos();
    const ImVec2 size(width, std::round(lines * ImGui::GetTextLineHeightWithSpacing()));
    plotItem(id, size);
    const Area area{start, {start.x + size.x, start.y + size.y}};
    ImGui::GetWindowDrawList()->AddRectFilled(area.start, area.end, ImGui::GetColorU32(ImGuiCol_FrameBg),
                                              ImGui::GetStyle().FrameRounding);
    return area;
}

void textAt(const ImVec2& position, const ImVec4& colour, const std::string& text) {
    ImGui::GetWindowDrawList()->AddText(position, ImGui::GetColorU32(colour), text.c_str());
}

// Draws a small square in a series' colour, in the line of text.
void swatch(const ImVec4& colour) {
    const float side = std::round(ImGui::GetFontSize() * 0.6f);
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float down = std::round((ImGui::GetTextLineHeight() - side) / 2);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + down}, {at.x + side, at.y + down + side},
                                              ImGui::GetColorU32(colour), side * 0.2f);
    ImGui::Dummy({side, ImGui::GetTextLineHeight()});
    ImGui::SameLine(0, ImGui::GetFontSize() * 0.3f);
}

std::string valueText(double value, const char* unit) {
    return *unit ? fmt::format("{} {}", axisText(value), unit) : axisText(value);
}

// Draws names and newest values, in as many lines as they need.
void legend(std::span<const Series> series, const char* unit, bool withValues) {
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    const float gap = ImGui::GetFontSize() * 0.9f;
    const float swatchWidth = ImGui::GetFontSize();
    for (std::size_t i = 0; i < series.size(); ++i) {
        const std::string newest = series[i].values.empty() || !withValues
                                       ? std::string()
                                       : valueText(static_cast<double>(series[i].values.back()), unit);
        const float width = swatchWidth + ImGui::CalcTextSize(series[i].name).x +
                            ImGui::CalcTextSize(newest.c_str()).x + ImGui::GetFontSize() * 0.3f;
        if (i > 0 && ImGui::GetItemRectMax().x + gap + width < right) ImGui::SameLine(0, gap);
        swatch(series[i].colour);
        ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted(series[i].name);
        ImGui::PopTextWrapPos();
        ImGui::PopStyleColor();
        if (newest.empty()) continue;
        // In a narrow dock the value stands below its name.
        const float space = ImGui::GetFontSize() * 0.3f;
        if (ImGui::GetItemRectMax().x + space + ImGui::CalcTextSize(newest.c_str()).x <= right)
            ImGui::SameLine(0, space);
        ImGui::TextUnformatted(newest.c_str());
    }
}

// The mapping of times and values to pixels.
struct Scale {
    Area area;
    float firstS = 0;
    float spanS = plotSpanS;
    double top = 1;

    float x(float timeS) const { return area.start.x + (timeS - firstS) / spanS * area.width(); }
    float y(float value) const {
        const auto share = static_cast<float>(std::clamp(static_cast<double>(value) / top, 0.0, 1.0));
        return area.end.y - share * (area.height() - 1);
    }
};

void drawLine(const Scale& scale, std::span<const float> timesS, const Series& series) {
    const float columnS = scale.spanS / std::max(scale.area.width(), 1.0f);
    const std::vector<std::size_t> peaks = peakOfColumns(timesS, series.values, columnS);
    std::vector<ImVec2> points;
    points.reserve(peaks.size());
    for (const std::size_t i : peaks) points.emplace_back(scale.x(timesS[i]), scale.y(series.values[i]));
    ImGui::GetWindowDrawList()->AddPolyline(points.data(), static_cast<int>(points.size()),
                                            ImGui::GetColorU32(series.colour), ImDrawFlags_None,
                                            std::max(ImGui::GetFontSize() / 11, 1.0f));
}

// Fills the area between two curves over the same times with two triangles per step, without antialiasing.
void fillBetween(std::span<const float> xs, std::span<const float> lower, std::span<const float> upper,
                 ImU32 colour) {
    if (xs.size() < 2) return;
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const auto steps = static_cast<int>(xs.size()) - 1;
    drawList.PrimReserve(6 * steps, 2 * (steps + 1));
    const auto first = drawList._VtxCurrentIdx;
    const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
    for (std::size_t i = 0; i < xs.size(); ++i) {
        drawList.PrimWriteVtx({xs[i], upper[i]}, white, colour);
        drawList.PrimWriteVtx({xs[i], lower[i]}, white, colour);
    }
    for (int i = 0; i < steps; ++i) {
        for (const unsigned corner : {0u, 1u, 2u, 2u, 1u, 3u})
            drawList.PrimWriteIdx(static_cast<ImDrawIdx>(first + 2 * static_cast<unsigned>(i) + corner));
    }
}

void drawStack(const Scale& scale, std::span<const float> timesS, std::span<const Series> series,
               std::span<const float> sums) {
    const float columnS = scale.spanS / std::max(scale.area.width(), 1.0f);
    // Each column shows the whole slowest frame, so that its parts still add up.
    const std::vector<std::size_t> peaks = peakOfColumns(timesS, sums, columnS);
    std::vector<float> xs(peaks.size());
    for (std::size_t p = 0; p < peaks.size(); ++p) xs[p] = scale.x(timesS[peaks[p]]);
    std::vector<float> height(peaks.size(), 0.0f);
    std::vector<float> lower(peaks.size(), scale.area.end.y);
    std::vector<float> upper(peaks.size());
    for (const Series& one : series) {
        for (std::size_t p = 0; p < peaks.size(); ++p) {
            height[p] += one.values[peaks[p]];
            upper[p] = scale.y(height[p]);
        }
        fillBetween(xs, lower, upper, faded(one.colour, 0.85f));
        std::swap(lower, upper);
    }
}

double largestOf(std::span<const Series> series, std::span<const float> sums, bool stacked) {
    float largest = 0;
    if (stacked && !sums.empty()) largest = *std::max_element(sums.begin(), sums.end());
    if (!stacked) {
        for (const Series& one : series) {
            if (!one.values.empty())
                largest = std::max(largest, *std::max_element(one.values.begin(), one.values.end()));
        }
    }
    return static_cast<double>(largest);
}

void drawMark(const Scale& scale, double mark, const char* unit) {
    if (mark <= 0 || mark > scale.top) return;
    const float y = scale.y(static_cast<float>(mark));
    ImGui::GetWindowDrawList()->AddLine({scale.area.start.x, y}, {scale.area.end.x, y},
                                        faded(palette().warning, 0.7f));
    const std::string text = valueText(mark, unit);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    // The text is below the line, unless it would leave the plot.
    const float textY = y + size.y < scale.area.end.y ? y : y - size.y;
    textAt({scale.area.end.x - size.x - ImGui::GetFontSize() * 0.3f, textY}, palette().warning, text);
}

// Returns the sample nearest to the pointer, if the plot is hovered.
std::optional<std::size_t> sampleUnderPointer(const Scale& scale, std::span<const float> timesS) {
    if (!plotIsHovered() || timesS.empty()) return std::nullopt;
    const float share = (ImGui::GetIO().MousePos.x - scale.area.start.x) / std::max(scale.area.width(), 1.0f);
    const float timeS = scale.firstS + share * scale.spanS;
    if (timeS < timesS.front()) return std::nullopt;
    const auto found = std::lower_bound(timesS.begin(), timesS.end(), timeS);
    return std::min(static_cast<std::size_t>(found - timesS.begin()), timesS.size() - 1);
}

void pointerValues(const Scale& scale, std::span<const float> timesS, std::span<const Series> series,
                   const char* unit, bool stacked) {
    const PlotCursor cursor = plotCursor(timesS.size());
    const std::optional<std::size_t> at = cursor.at ? cursor.at : sampleUnderPointer(scale, timesS);
    if (!at) return;
    const float x = scale.x(timesS[*at]);
    ImGui::GetWindowDrawList()->AddLine({x, scale.area.start.y}, {x, scale.area.end.y},
                                        faded(palette().text, 0.5f));
    beginSampleTooltip(cursor, x);
    ImGui::TextDisabled("%.1f s ago", static_cast<double>(timesS.back() - timesS[*at]));
    double sum = 0;
    for (const Series& one : series) {
        const auto value = static_cast<double>(one.values[*at]);
        swatch(one.colour);
        ImGui::Text("%s: %s", one.name, valueText(value, unit).c_str());
        sum += value;
    }
    if (stacked) ImGui::Text("total: %s", valueText(sum, unit).c_str());
    ImGui::EndTooltip();
}

// Returns one row per time, with the time before the newest sample in the first column.
ExportTable lineSamples(const char* id, std::span<const float> timesS, std::span<const Series> series,
                        const char* unit) {
    ExportTable table{.name = id, .columns = {{"time_s"}}, .rows = timesS.size()};
    for (const Series& one : series) table.columns.push_back({columnName(one.name, unit)});
    table.cell = [=](std::size_t row, std::size_t column) -> ExportCell {
        if (column == 0) return static_cast<double>(timesS[row]) - static_cast<double>(timesS.back());
        return series[column - 1].values[row];
    };
    return table;
}

void nothingYet(const Area& area) {
    const char* text = "no data yet";
    const ImVec2 size = ImGui::CalcTextSize(text);
    textAt({area.start.x + (area.width() - size.x) / 2, area.start.y + (area.height() - size.y) / 2},
           palette().dim, text);
}

}  // namespace

ImVec4 seriesColour(std::size_t index) {
    // The colours have medium lightness, so that they stand out on dark and on light backgrounds.
    static const std::array<ImVec4, 8> colours = {{{0.26f, 0.59f, 0.90f, 1},
                                                   {0.92f, 0.56f, 0.20f, 1},
                                                   {0.30f, 0.68f, 0.38f, 1},
                                                   {0.85f, 0.33f, 0.36f, 1},
                                                   {0.60f, 0.45f, 0.83f, 1},
                                                   {0.80f, 0.68f, 0.20f, 1},
                                                   {0.18f, 0.68f, 0.70f, 1},
                                                   {0.83f, 0.43f, 0.66f, 1}}};
    return colours[index % colours.size()];
}

void linePlot(const char* id, std::span<const float> timesS, std::span<const Series> series, const char* unit,
              double top, float lines, bool stacked, double mark) {
    ImGui::BeginGroup();
    legend(series, unit, !stacked);
    Scale scale{beginArea(id, lines)};
    const bool empty = timesS.size() < 2 || series.empty() ||
                       std::any_of(series.begin(), series.end(),
                                   [&](const Series& one) { return one.values.size() != timesS.size(); });
    if (empty) {
        nothingYet(scale.area);
        ImGui::EndGroup();
        return;
    }
    std::vector<float> sums;
    if (stacked) {
        std::vector<std::span<const float>> rows;
        for (const Series& one : series) rows.emplace_back(one.values);
        sums = summed(rows);
    }
    scale.spanS = std::max(timesS.back() - timesS.front(), plotSpanS);
    scale.firstS = timesS.back() - scale.spanS;
    scale.top = top > 0 ? top : roundedTop(largestOf(series, sums, stacked));
    ImGui::PushClipRect(scale.area.start, scale.area.end, true);
    if (stacked) drawStack(scale, timesS, series, sums);
    if (!stacked) {
        for (const Series& one : series) drawLine(scale, timesS, one);
    }
    drawMark(scale, mark, unit);
    textAt({scale.area.start.x + ImGui::GetFontSize() * 0.3f, scale.area.start.y}, palette().dim,
           valueText(scale.top, unit));
    pointerValues(scale, timesS, series, unit, stacked);
    ImGui::PopClipRect();
    ImGui::EndGroup();
    exportPlot(id, lineSamples(id, timesS, series, unit));
}

float leastPlotWidth() {
    return 2 * 4 * ImGui::GetTextLineHeightWithSpacing();
}

float linesThatFit(std::size_t plots, float otherLines, float most) {
    const float lines = ImGui::GetContentRegionAvail().y / ImGui::GetTextLineHeightWithSpacing();
    return std::clamp((lines - otherLines) / static_cast<float>(plots), 1.5f, most);
}

void barList(const char* id, std::span<const Bar> bars, const char* unit) {
    ImGui::BeginGroup();
    ImGui::PushID(id);
    double largest = 0;
    float labelWidth = 0;
    float textWidth = 0;
    for (const Bar& bar : bars) {
        largest = std::max(largest, bar.value);
        labelWidth = std::max(labelWidth, ImGui::CalcTextSize(bar.label.c_str()).x);
        textWidth = std::max(textWidth, ImGui::CalcTextSize(bar.text.c_str()).x);
    }
    const float gap = std::round(ImGui::GetFontSize() * 0.5f);
    const float line = ImGui::GetTextLineHeight();
    const float step = std::round(line * 1.15f);
    const float width = ImGui::GetContentRegionAvail().x;
    const float room = std::max(width - labelWidth - textWidth - 2 * gap, 0.0f);
    const ImVec2 start = ImGui::GetCursorScreenPos();
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const Bar& bar = bars[i];
        const float y = start.y + static_cast<float>(i) * step;
        textAt({start.x, y}, palette().dim, bar.label);
        const auto share = static_cast<float>(largest > 0 ? std::max(bar.value, 0.0) / largest : 0.0);
        const float left = start.x + labelWidth + gap;
        const float inset = std::round(line * 0.15f);
        // A value above 0 shows at least as a line.
        const float length = bar.value > 0 ? std::max(room * share, 1.0f) : 0;
        if (length > 0)
            drawList.AddRectFilled({left, y + inset}, {left + length, y + line - inset},
                                   ImGui::GetColorU32(bar.colour), line * 0.1f);
        const float textX = start.x + width - ImGui::CalcTextSize(bar.text.c_str()).x;
        textAt({textX, y}, palette().text, bar.text);
    }
    ImGui::Dummy({width, std::max(static_cast<float>(bars.size()) * step, 1.0f)});
    ImGui::PopID();
    ImGui::EndGroup();
    ExportTable table{.name = id, .columns = {{"bar"}, {columnName("value", unit)}}, .rows = bars.size()};
    table.cell = [=](std::size_t row, std::size_t column) {
        return column == 0 ? ExportCell(bars[row].label) : ExportCell(bars[row].value);
    };
    exportPlot(id, table);
}

namespace {

// Draws each mark's label right of its line, or left of it if there is no room, in a row of its own.
void drawMarks(const Area& area, std::span<const HistogramMark> marks) {
    const float gap = ImGui::GetFontSize() * 0.25f;
    float row = 0;
    for (const HistogramMark& mark : marks) {
        const float x =
            std::round(area.start.x + static_cast<float>(std::clamp(mark.position, 0.0, 1.0)) * area.width());
        ImGui::GetWindowDrawList()->AddLine({x, area.start.y}, {x, area.end.y},
                                            faded(palette().warning, 0.9f));
        const float width = ImGui::CalcTextSize(mark.label.c_str()).x;
        const bool right = x + gap + width < area.end.x;
        const float left = std::max(right ? x + gap : x - gap - width, area.start.x);
        const ImVec2 at(left, area.start.y + row);
        // Bars may be behind the label, so it gets a background.
        const ImVec4& ground = ImGui::GetStyleColorVec4(ImGuiCol_FrameBg);
        ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + ImGui::GetTextLineHeight()},
                                                  faded(ground, 0.8f));
        textAt(at, palette().warning, mark.label);
        row += ImGui::GetTextLineHeight();
    }
}

// Returns one row per bucket: its range, as text with a unit or as share of the axis, and its count.
ExportTable buckets(const char* id, std::span<const float> counts, const PositionText& positionText) {
    ExportTable table{.name = id, .columns = {{"from"}, {"to"}, {"count"}}, .rows = counts.size()};
    table.cell = [=](std::size_t row, std::size_t column) -> ExportCell {
        if (column == 2) return counts[row];
        const double position = static_cast<double>(row + column) / static_cast<double>(counts.size());
        return positionText ? ExportCell(positionText(position)) : ExportCell(position);
    };
    return table;
}

void pointerBucket(const Area& area, std::span<const float> counts, const PositionText& positionText) {
    const PlotCursor cursor = plotCursor(counts.size());
    if (counts.empty() || !(cursor.at || plotIsHovered())) return;
    const float share = (ImGui::GetIO().MousePos.x - area.start.x) / std::max(area.width(), 1.0f);
    const auto buckets = static_cast<double>(counts.size());
    const auto bucket = cursor.at.value_or(
        static_cast<std::size_t>(std::clamp(static_cast<double>(share) * buckets, 0.0, buckets - 1)));
    const float step = area.width() / static_cast<float>(counts.size());
    const float left = area.start.x + static_cast<float>(bucket) * step;
    if (cursor.at)
        ImGui::GetWindowDrawList()->AddRectFilled(
            {left, area.start.y}, {left + std::max(step, 1.0f), area.end.y}, faded(palette().text, 0.25f));
    const std::string count = axisText(static_cast<double>(counts[bucket]));
    const auto at = static_cast<double>(bucket);
    beginSampleTooltip(cursor, left);
    ImGui::TextUnformatted(positionText ? fmt::format("{} to {}: {}", positionText(at / buckets),
                                                      positionText((at + 1) / buckets), count)
                                              .c_str()
                                        : count.c_str());
    ImGui::EndTooltip();
}

}  // namespace

void histogram(const char* id, std::span<const float> counts, const std::string& leftLabel,
               const std::string& rightLabel, std::span<const HistogramMark> marks, float lines,
               const PositionText& positionText) {
    ImGui::BeginGroup();
    const Area area = beginArea(id, lines);
    const float largest = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
    if (largest > 0) {
        ImDrawList& drawList = *ImGui::GetWindowDrawList();
        const float step = area.width() / static_cast<float>(counts.size());
        const float gap = step > 4 ? 1.0f : 0.0f;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            if (counts[i] <= 0) continue;
            const float left = area.start.x + static_cast<float>(i) * step;
            const float height = std::max(counts[i] / largest * (area.height() - 2), 1.0f);
            drawList.AddRectFilled({left, area.end.y - height},
                                   {left + std::max(step - gap, 1.0f), area.end.y},
                                   ImGui::GetColorU32(ImGuiCol_PlotHistogram));
        }
        drawMarks(area, marks);
        pointerBucket(area, counts, positionText);
    } else {
        nothingYet(area);
    }
    ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
    const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
    ImGui::TextUnformatted(leftLabel.c_str());
    ImGui::SameLine();
    ImGui::SetCursorPosX(std::max(right - ImGui::CalcTextSize(rightLabel.c_str()).x, ImGui::GetCursorPosX()));
    ImGui::TextUnformatted(rightLabel.c_str());
    ImGui::PopStyleColor();
    ImGui::EndGroup();
    exportPlot(id, buckets(id, counts, positionText));
}

}  // namespace worldy::ui
