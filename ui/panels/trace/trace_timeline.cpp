#include "ui/panels/trace/trace_timeline.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "ui/kit/exports.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plot_keys.h"
#include "ui/kit/plots.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/panels/trace/trace_compared.h"

namespace worldy::ui {

namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

// A quantity over time.
struct StripSeries {
    std::string name;
    ImVec4 colour;
    std::function<float(std::size_t)> value;  // of a sample; NaN: unknown
};
struct Strip {
    const char* unit = "";
    std::vector<StripSeries> series;
};

std::vector<Strip> stripsOf(const EditorView& view, const TraceTimelineState& state) {
    const TraceHistory& history = *view.trace.history;
    std::vector<Strip> strips;
    const auto found = history.views.find(view.trace.view);
    if (found != history.views.end()) {
        const std::vector<TracedViewSample>* const samples = &found->second;
        const auto of = [samples](float TracedViewSample::*member) {
            return [samples, member](std::size_t i) {
                return i < samples->size() ? (*samples)[i].*member : unknown;
            };
        };
        strips.push_back(
            {"px",
             {{std::string("largest error"), seriesColour(1), of(&TracedViewSample::worstErrorPx)},
              {std::string(tauSymbol()), palette().dim, of(&TracedViewSample::tauPx)}}});
        strips.push_back({"nodes",
                          {{"drawn", seriesColour(0), of(&TracedViewSample::drawn)},
                           {"waiting for data", palette().bad, of(&TracedViewSample::starved)}}});
        // 0 stands for not told.
        const auto triangles = [of](std::size_t i) {
            const float count = of(&TracedViewSample::triangles)(i);
            return count > 0 ? count : unknown;
        };
        strips.push_back({"triangles", {{std::string("drawn"), seriesColour(7), triangles}}});
        strips.push_back({"nodes",
                          {{"splits", palette().accent, of(&TracedViewSample::splits)},
                           {"merges", palette().warning, of(&TracedViewSample::merges)}}});
    }
    const std::vector<TracedSample>* const samples = &history.samples;
    const auto of = [samples](float TracedSample::*member) {
        return [samples, member](std::size_t i) { return (*samples)[i].*member; };
    };
    strips.push_back({"requests",
                      {{"queue", seriesColour(2), of(&TracedSample::queued)},
                       {"arrived", seriesColour(3), of(&TracedSample::arrived)}}});
    strips.push_back({"ms",
                      {{"CPU", seriesColour(4), of(&TracedSample::cpuMs)},
                       {"GPU", seriesColour(5), of(&TracedSample::gpuMs)}}});
    if (const auto counter = history.counters.find(state.counter); counter != history.counters.end()) {
        const std::vector<float>* const values = &counter->second;
        strips.push_back({"", {{counter->first, seriesColour(6), [values](std::size_t i) {
                                    return i < values->size() ? (*values)[i] : unknown;
                                }}}});
    }
    // A quantity that the engine never told has no line.
    for (Strip& strip : strips) {
        std::erase_if(strip.series, [&](const StripSeries& series) {
            for (std::size_t i = 0; i < samples->size(); ++i)
                if (!std::isnan(series.value(i))) return false;
            return true;
        });
    }
    std::erase_if(strips, [](const Strip& strip) { return strip.series.empty(); });
    return strips;
}

// The times of the samples, and the part of them in view.
struct Axis {
    const std::vector<TracedSample>& samples;
    double fromS, toS;
    float x, width;

    float at(double timeS) const { return x + width * static_cast<float>((timeS - fromS) / (toS - fromS)); }
    double timeAt(float px) const { return fromS + (toS - fromS) * static_cast<double>((px - x) / width); }
    // Returns the sample of a time: the last one that begins at or before it.
    std::size_t sampleAt(double timeS) const {
        const auto after = std::ranges::upper_bound(samples, timeS, {}, &TracedSample::timeS);
        return after == samples.begin() ? 0 : static_cast<std::size_t>(after - samples.begin()) - 1;
    }
};

// Draws a series with the largest value of each column of pixels, so that no peak is lost.
void drawSeries(ImDrawList& list, const Axis& axis, const StripSeries& series, double top, float y,
                float height) {
    const std::size_t first = axis.sampleAt(axis.fromS);
    const std::size_t last = std::min(axis.sampleAt(axis.toS) + 2, axis.samples.size());
    const float unit = ImGui::GetFontSize() / 13;
    ImVec2 before{0, 0};
    bool hasBefore = false;
    const auto columnOf = [&](std::size_t i) { return std::floor(axis.at(axis.samples[i].timeS)); };
    for (std::size_t i = first; i < last;) {
        const float column = columnOf(i);
        float value = series.value(i++);
        for (; i < last && columnOf(i) <= column; ++i) value = std::fmax(value, series.value(i));
        if (std::isnan(value) || !std::isfinite(column)) {
            hasBefore = false;
            continue;
        }
        const float share = static_cast<float>(std::clamp(static_cast<double>(value) / top, 0.0, 1.0));
        const ImVec2 at(column, y + height * (1 - share));
        if (hasBefore) list.AddLine(before, at, packed(series.colour), 1.2f * unit);
        before = at;
        hasBefore = true;
    }
}

double topOf(const Axis& axis, const Strip& strip) {
    double top = 0;
    const std::size_t last = std::min(axis.sampleAt(axis.toS) + 1, axis.samples.size());
    for (const StripSeries& series : strip.series) {
        for (std::size_t i = axis.sampleAt(axis.fromS); i < last; ++i) {
            const auto value = static_cast<double>(series.value(i));
            if (std::isfinite(value)) top = std::max(top, value);
        }
    }
    return top > 0 ? roundedTop(top) : 1;
}

// Draws the names of the series with their values at a sample, and the top of the scale.
void drawLabels(ImDrawList& list, const Axis& axis, const Strip& strip, double top, float y,
                std::size_t sample) {
    const float gap = ImGui::GetFontSize() * 0.4f;
    float x = axis.x + gap;
    for (const StripSeries& series : strip.series) {
        const float value = sample < axis.samples.size() ? series.value(sample) : unknown;
        const std::string text = inFont(
            fmt::format("{} {}", series.name,
                        std::isnan(value) ? std::string("-") : shortNumberText(fmt::format("{}", value))));
        list.AddText({x, y + 1}, packed(series.colour), text.c_str());
        x += ImGui::CalcTextSize(text.c_str()).x + 2 * gap;
    }
    const std::string scale = fmt::format("{} {}", axisText(top), strip.unit);
    const float width = ImGui::CalcTextSize(scale.c_str()).x;
    if (x + width < axis.x + axis.width)
        list.AddText({axis.x + axis.width - width - gap, y + 1}, packed(palette().dim), scale.c_str());
}

// Marks the times in which data was missing.
void drawStarvations(ImDrawList& list, const EditorView& view, const Axis& axis, float y, float height) {
    for (const TracedStarvation& starvation : view.trace.history->starvations) {
        if (starvation.view != view.trace.view || starvation.untilS < axis.fromS ||
            starvation.fromS > axis.toS)
            continue;
        const float from = std::max(axis.at(starvation.fromS), axis.x);
        const float to = std::min(std::max(axis.at(starvation.untilS), from + 1), axis.x + axis.width);
        list.AddRectFilled({from, y}, {to, y + height}, packed(palette().bad, 0.1f));
    }
}

// Marks the frames in which the open trace draws other nodes than the one that it is compared with.
void drawDifferences(ImDrawList& list, const EditorView& view, const Axis& axis, float y, float height) {
    const TraceCompared* const compared = traceComparedOf(view);
    if (!compared) return;
    for (const planet::TraceFrameDifference& each : compared->found.differences) {
        const bool isInView = each.timeS >= axis.fromS && each.timeS <= axis.toS;  // false if it is no number
        if (each.view != view.trace.view || !isInView) continue;
        const std::size_t next = axis.sampleAt(each.timeS) + 1;
        const double untilS = next < axis.samples.size() ? axis.samples[next].timeS : each.timeS;
        const float from = axis.at(each.timeS);
        const float to = std::min(std::max(axis.at(untilS), from + 1), axis.x + axis.width);
        list.AddRectFilled({from, y}, {to, y + height}, packed(palette().warning));
    }
}

// held: the share of the trace that stays where it is. At least two samples stay in view.
void zoomAbout(double held, double steps, std::size_t samples, TraceTimelineState& state) {
    const double factor = std::pow(1 / 1.35, steps);
    state.from = std::max(held - (held - state.from) * factor, 0.0);
    state.to = std::min(held + (state.to - held) * factor, 1.0);
    const double least = 2 / std::max(static_cast<double>(samples), 2.0);
    if (state.to - state.from < least) state.to = std::min(state.from + least, 1.0);
    if (state.to - state.from < least) state.from = std::max(state.to - least, 0.0);
}

// Shows other frames and zooms by the keys. at: the sample of the frame that is shown.
void keyboard(const Axis& axis, std::size_t at, TraceTimelineState& state, Commands& commands) {
    const PlotKeys keys = takePlotKeys(PlotReads::View);
    const std::size_t to = movedCursor(at, axis.samples.size(), keys);
    if (to != at) commands.push_back(ShowTraceFrame{axis.samples[to].frame});
    const double firstS = axis.samples.front().timeS;
    const double durationS = std::max(axis.samples.back().timeS - firstS, 1e-9);
    const double shown = (axis.samples[to].timeS - firstS) / durationS;
    if (const int in = keys.up + keys.zoomIn; in != 0) zoomAbout(shown, in, axis.samples.size(), state);
    if (to == at || (shown >= state.from && shown <= state.to)) return;
    const double half = (state.to - state.from) / 2;
    state.from = std::clamp(shown - half, 0.0, 1 - 2 * half);
    state.to = state.from + 2 * half;
}

void mouse(const Axis& axis, double beginS, double endS, bool isCompared, TraceTimelineState& state,
           Commands& commands) {
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsItemActive() && !ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        const std::size_t sample =
            axis.sampleAt(axis.timeAt(std::clamp(io.MousePos.x, axis.x, axis.x + axis.width)));
        commands.push_back(ShowTraceFrame{axis.samples[sample].frame});
    }
    if (!plotIsHovered()) return;
    ImGui::SetItemUsingMouseWheel();
    const double durationS = std::max(endS - beginS, 1e-9);
    if (io.MouseWheel != 0) {
        const double held = (axis.timeAt(io.MousePos.x) - beginS) / durationS;
        zoomAbout(held, static_cast<double>(io.MouseWheel), axis.samples.size(), state);
    }
    if (ImGui::IsMouseDragging(ImGuiMouseButton_Right)) {
        const double by = -static_cast<double>(io.MouseDelta.x / axis.width) * (state.to - state.from);
        const double shift = std::clamp(by, -state.from, 1 - state.to);
        state.from += shift;
        state.to += shift;
    }
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Right)) state.from = 0, state.to = 1;
    const std::size_t sample = axis.sampleAt(axis.timeAt(io.MousePos.x));
    tooltip(fmt::format("frame {}, {:.3f} s\nDrag to move through the trace. The wheel zooms, the right "
                        "button moves; double-clicking it shows everything.\nWith the focus: Left, Right, "
                        "PageUp, PageDown, Home, End show other frames; Up, Down, + and - zoom.{}",
                        axis.samples[sample].frame, axis.samples[sample].timeS,
                        isCompared ? "\nThe marks along the upper edge are frames in which the other trace "
                                     "draws other nodes."
                                   : "")
                .c_str());
}

ExportTable samplesOf(const std::vector<TracedSample>& samples, const std::vector<Strip>& strips) {
    ExportTable table{.name = "trace timeline", .columns = {{"frame"}, {"time_s"}}, .rows = samples.size()};
    std::vector<const StripSeries*> all;
    for (const Strip& strip : strips) {
        for (const StripSeries& series : strip.series) {
            table.columns.push_back({fmt::format("{} ({})", series.name, strip.unit)});
            all.push_back(&series);
        }
    }
    table.cell = [&samples, all = std::move(all)](std::size_t row, std::size_t column) -> ExportCell {
        if (column == 0) return samples[row].frame;
        return column == 1 ? ExportCell(samples[row].timeS) : ExportCell(all[column - 2]->value(row));
    };
    return table;
}

}  // namespace

void traceTimeline(const EditorView& view, TraceTimelineState& state, Commands& commands) {
    const TraceHistory* const history = view.trace.history;
    if (!history || history->samples.empty()) {
        emptyState(view.trace.problem.empty() ? "No frame is read yet."
                                              : "The trace has no frame that can be read.");
        return;
    }
    const double beginS = history->samples.front().timeS;
    const double endS = std::max(history->samples.back().timeS, beginS + 1e-6);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const std::vector<Strip> strips = stripsOf(view, state);
    const float font = ImGui::GetFontSize();
    const float gap = std::round(font * 0.2f);
    const float least = 2.2f * font;
    const float height =
        std::max(std::floor((room.y - gap) / static_cast<float>(strips.size())) - gap, least);
    const ImVec2 size(std::max(room.x, 20.0f), (height + gap) * static_cast<float>(strips.size()));
    plotItem("timeline", size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    noteItem("Timeline");
    // The right button moves the timeline, so its menu is behind the button in its corner.
    exportPlot("timeline", samplesOf(history->samples, strips), false);
    const Axis axis{history->samples, beginS + state.from * (endS - beginS),
                    beginS + state.to * (endS - beginS), corner.x, size.x};
    mouse(axis, beginS, endS, traceComparedOf(view) != nullptr, state, commands);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::uint64_t number = view.trace.frame ? view.trace.frame->frame.number : 0;
    const auto after = std::ranges::upper_bound(history->samples, number, {}, &TracedSample::frame);
    const std::size_t sample = after == history->samples.begin()
                                   ? 0
                                   : static_cast<std::size_t>(after - history->samples.begin()) - 1;
    keyboard(axis, sample, state, commands);
    // The frame's own time may lie outside its sample, as if the engine's clock went back.
    const double sampleS = history->samples[sample].timeS;
    const double nextS = sample + 1 < history->samples.size() ? history->samples[sample + 1].timeS : endS;
    const double frameS = view.trace.frame ? view.trace.frame->frame.timeS : beginS;
    const double shownS = frameS >= sampleS && frameS <= nextS ? frameS : sampleS;
    float y = corner.y;
    for (const Strip& strip : strips) {
        list.AddRectFilled({corner.x, y}, {corner.x + size.x, y + height},
                           ImGui::GetColorU32(ImGuiCol_FrameBg, 0.6f));
        ImGui::PushClipRect({corner.x, y}, {corner.x + size.x, y + height}, true);
        drawStarvations(list, view, axis, y, height);
        const double top = topOf(axis, strip);
        const float label = font + 2;
        for (const StripSeries& series : strip.series)
            drawSeries(list, axis, series, top, y + label, height - label - 1);
        drawLabels(list, axis, strip, top, y, sample);
        ImGui::PopClipRect();
        y += height + gap;
    }
    drawDifferences(list, view, axis, corner.y, std::round(0.2f * font));
    const float x = axis.at(shownS);
    if (x >= corner.x && x <= corner.x + size.x)
        list.AddLine({x, corner.y}, {x, y - gap}, packed(palette().warning), 1.4f * font / 13);
}

}  // namespace worldy::ui
