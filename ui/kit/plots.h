// Small plots, drawn as ImGui items that fill the available width. Heights are in lines of text. A tooltip()
// after a plot belongs to the whole plot. Each has a menu that copies and saves it (ui/kit/exports.h); its id is part of
// the names of files.
#pragma once

#include <imgui.h>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace worldy::ui {

struct Series {
    const char* name = "";
    ImVec4 colour{1, 1, 1, 1};
    std::vector<float> values;  // oldest first; one per time of the plot
};

// Returns one of eight colours that are distinct in both themes; larger indices repeat them.
ImVec4 seriesColour(std::size_t index);

// Draws values over time, newest at the right, over the last 10 s or the whole range of times if that is
// longer. The names of the series are above the plot, with their newest values if the series are not stacked.
// The plot shows the top of its axis with the unit, and a line at mark if mark > 0, for example at tau.
// Hovering shows the values under the pointer. top 0: the largest value, rounded up. stacked: each series
// starts at the top of the one before it. Without samples it says that there is no data yet.
void linePlot(const char* id, std::span<const float> timesS, std::span<const Series> series, const char* unit,
              double top = 0, float lines = 4, bool stacked = false, double mark = 0);

// Returns the width of a plot of the default height at an aspect ratio of 2:1, pixels.
float leastPlotWidth();

struct Bar {
    std::string label;
    double value = 0;
    ImVec4 colour{1, 1, 1, 1};
    std::string text;  // right of the bar
};
// Draws bars below each other, scaled to the largest value. unit: of the values, for their export.
void barList(const char* id, std::span<const Bar> bars, const char* unit = "");

// Returns the height for each of several plots stacked in the remaining height, in lines of text, if the
// other content needs otherLines. The result is in [1.5, most].
float linesThatFit(std::size_t plots, float otherLines, float most);

// A labelled line in a histogram, for example at tau.
struct HistogramMark {
    double position = 0;  // on the axis, [0, 1]
    std::string label;
};
// Returns the value at a position of the axis as text, for example "1.5 px". With it, hovering shows the
// range of a bucket.
using PositionText = std::function<std::string(double position)>;
// Draws one bar per bucket and the marks. The labels stand below the ends of the axis.
void histogram(const char* id, std::span<const float> counts, const std::string& leftLabel,
               const std::string& rightLabel, std::span<const HistogramMark> marks, float lines = 4,
               const PositionText& positionText = {});

}  // namespace worldy::ui
