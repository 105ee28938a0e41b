#include "ui/panels/sweep/sweep_chart.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "ui/kit/front_chart.h"
#include "ui/kit/plots.h"
#include "ui/kit/theme.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

void tell(const SweepPoint& point) {
    const FlightFigures& f = point.figures;
    ImGui::TextUnformatted(settingText(point.chunkSize, point.metric, point.tauPx, tauSymbol()).c_str());
    ImGui::Text("measured %.3g px, 99 %%: %.3g px", f.worstMeasuredPx, f.p99MeasuredPx);
    ImGui::Text("%s triangles, %.1f MiB, %s", countText(f.meanTriangles).c_str(), f.mostResidentMiB,
                millisecondsText(f.medianFrameMs).c_str());
    if (point.onFront) ImGui::TextColored(palette().good, "on the Pareto front");
    ImGui::TextDisabled("click: select");
}

}  // namespace

std::optional<std::size_t> sweepChart(std::span<const SweepPoint> points, SweepCost cost,
                                      std::optional<std::size_t> selected) {
    std::vector<FrontPoint> plotted(points.size());
    std::vector<FrontSeries> lines;
    for (SweepSeries& series : seriesOf(points)) {
        const ImVec4 colour = seriesColour(lines.size());
        for (const std::size_t i : series.points) {
            const FlightFigures& figures = points[i].figures;
            plotted[i] = {plottedErrorPx(figures), plottedCost(figures, cost), colour,
                          fmt::format("{:g}", points[i].tauPx), points[i].onFront};
        }
        lines.push_back({series.name(), colour, std::move(series.points)});
    }
    constexpr std::array costNames = {"mean_triangles", "median_frame_ms", "most_resident_mib"};
    const char* const costName = costNames[static_cast<std::size_t>(cost)];
    return frontChart(
        {.name = "sweep plot",
         .costName = costName,
         .points = plotted,
         .series = lines,
         .errorName = "max measured error, px",
         .shortErrorName = "error, px",
         .explanation = "One point per setting: max measured error on the horizontal axis, cost on the "
                        "vertical axis, both logarithmic, labelled with the tolerance. Ringed: no other "
                        "point is both cheaper and more accurate.",
         .tell = [&](std::size_t i) { tell(points[i]); }},
        selected);
}

}  // namespace worldy::ui
