// A plot of cost against error for several settings, with the Pareto front ringed: cost on the vertical axis, error on the
// horizontal, both logarithmic.
#pragma once

#include <imgui.h>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace worldy::ui {

struct FrontPoint {
    double errorPx = 1;  // > 0
    double cost = 1;     // > 0
    ImVec4 colour{1, 1, 1, 1};
    std::string label{};  // beside the point
    bool onFront = false;
};

// The points that a line joins.
struct FrontSeries {
    std::string name{};  // empty: not in the legend
    ImVec4 colour{1, 1, 1, 1};
    std::vector<std::size_t> points{};  // indices, in the order of the line
};

struct FrontChart {
    const char* name = "chart";  // part of the names of exported files
    const char* costName = "cost";
    std::span<const FrontPoint> points;
    std::span<const FrontSeries> series;  // each point belongs to one
    const char* errorName = "";           // of the horizontal axis, with its unit
    const char* shortErrorName = "";      // for a narrow plot
    const char* costTitle = "";           // of the vertical axis; empty if a control above the plot names it
    const char* explanation = "";         // the tooltip beside points
    std::function<void(std::size_t)> tell{};  // draws the content of a point's tooltip
};

// Draws the plot in the remaining room, with a minimum height. Returns the point that is clicked, or chosen by
// the keyboard.
std::optional<std::size_t> frontChart(const FrontChart& chart, std::optional<std::size_t> selected);

// Draws the names of series in their colours, in as many lines as they need, starting beside the last item.
void frontLegend(std::span<const FrontSeries> series);
// Draws a point's mark: a dot, ringed if it is on the Pareto front.
void frontMark(ImVec2 middle, const ImVec4& colour, bool onFront);

}  // namespace worldy::ui
