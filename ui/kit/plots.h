// Small plots, drawn as ImGui items that fill the width they get. Heights are in lines of text. A tooltip()
// after one belongs to the whole of it.
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
    std::vector<float> values;  // oldest first; with times of the plot's own
};

// Colours that are told apart side by side, in both themes; after eight they begin again.
ImVec4 seriesColour(std::size_t index);

// Values over time, newest at the right, the last 10 s or as long as the times reach. Above it the series'
// names, with their newest values where they are not stacked; in it the top of the axis with its unit and a
// line at mark, such as tau, where that is over 0; the pointer shows the values under it. top 0: as high as
// the largest value, rounded up. Empty series say that there is nothing yet. Stacked: each series stands on
// the ones before it.
void linePlot(const char* id, std::span<const float> timesS, std::span<const Series> series, const char* unit,
              double top = 0, float lines = 4, bool stacked = false, double mark = 0);

// Returns the width at which a plot of the default height is twice as wide as it is high, pixels.
float leastPlotWidth();

struct Bar {
    std::string label;
    double value = 0;
    ImVec4 colour{1, 1, 1, 1};
    std::string text;  // right of it
};
// One below the other, as long as their share of the largest.
void barList(const char* id, std::span<const Bar> bars);

// Lines of text for each of so many plots that fill the height that is left under each other, when all else
// takes up so many lines: as many as fit, but at least one and a half and no more than a limit.
float linesThatFit(std::size_t plots, float otherLines, float most);

// Counts by bucket, buckets side by side; marks draws a line at a value, as tau. bucketOf(v) gives positions
// on the axis in [0, 1].
struct HistogramMark {
    double position = 0;  // [0, 1]
    std::string label;
};
// Says what a position on the axis means, as "1.5 px"; the pointer then shows the bucket's range.
using PositionText = std::function<std::string(double position)>;
void histogram(const char* id, std::span<const float> counts, const std::string& leftLabel,
               const std::string& rightLabel, std::span<const HistogramMark> marks, float lines = 4,
               const PositionText& positionText = {});

}  // namespace worldy::ui
