#include "ui/panels/trace/what_if_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "app/base/plot_scale.h"
#include "app/base/text.h"
#include "ui/kit/columns.h"
#include "ui/kit/front_chart.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tau_list.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/panels/trace/what_if_plot.h"
#include "ui/panels/trace/what_if_tables.h"

namespace worldy::ui {

namespace {

using planet::TraceMetric;
using planet::TraceResidency;

constexpr float chartApartFrom = 90;  // heights of the font
constexpr double bytesOfMb = 1e6;
constexpr int mostLoaders = 16;

// ---- the request ----

// Draws a field for a number; a number that is not in [least, most] is not taken.
void field(const char* name, double& value, const char* format, double least, double most, Tip tip) {
    double edited = value;
    numberField(fmt::format("##{}", name).c_str(), edited, format);
    noteItem(name);
    tooltip(tip);
    if (edited >= least && edited <= most) value = edited;
}

void labelledField(const char* label, double& value, const char* format, double least, double most, Tip tip) {
    labelledControl(label, tip);
    field(label, value, format, least, most, tip);
}

void hysteresisControl(WhatIfPanelState& state) {
    int choice = state.changesHysteresis ? 1 : 0;
    choiceIndex("Hysteresis", choice, 0, "as told\0other\0",
                "A split node stays split until its error is at most the tolerance times (1 - hysteresis). "
                "As told: the "
                "setting \"hysteresis\" of the engine, or 0.");
    state.changesHysteresis = choice == 1;
    if (state.changesHysteresis)
        slider("Share", state.hysteresis, 0.1, 0, 0.9, "%.2f", "Hysteresis, a share of the tolerance.");
}

void metricControl(WhatIfPanelState& state) {
    choice("Metric", state.metric, TraceMetric::Bounds, "bounds\0sphere\0centre\0",
           "What the distance of an error is measured to: the bounds that the engine told, the sphere around "
           "them, or their centre. Errors in the results are always by the bounds.");
}

void budgetControl(WhatIfPanelState& state) {
    int choice = state.hasBudget ? 1 : 0;
    choiceIndex("Budget", choice, 0, "none\0limited\0",
                "Limits the bytes that a view needs in a frame. Nodes with the largest error are split "
                "first, until the "
                "budget is spent.");
    state.hasBudget = choice == 1;
    if (state.hasBudget)
        labelledField("Limit", state.budgetMb, "%.4g MB", 0.001, 1e7,
                      "Bytes that a view may need; a MB is 10^6.");
}

void dataControl(WhatIfPanelState& state) {
    choice("Data", state.residency, TraceResidency::AllThere, "all there\0as traced\0disk model\0",
           "All there: all data that the trace ever describes. As traced: what the engine had in each frame. "
           "Disk model: "
           "what loaders deliver, from nothing in the first frame on.");
    if (state.residency != TraceResidency::Disk) return;
    labelledField("Latency", state.latencyMs, "%.4g ms", 0, 1e6, "Time of a request without its transfer.");
    labelledField("Rate", state.mbPerS, "%.4g MB/s", 1e-3, 1e9,
                  "Transfer rate of each loader; a MB is 10^6 bytes.");
    slider("Loaders", state.loaders, 1, 1, mostLoaders, "%d",
           "Requests that are served at the same time. The one with the largest error comes first.");
}

planet::TraceSelectorSettings settingsOf(const WhatIfPanelState& state) {
    planet::TraceSelectorSettings settings;
    if (state.changesHysteresis) settings.hysteresis = state.hysteresis;
    if (state.hasBudget) settings.budgetBytes = static_cast<std::uint64_t>(state.budgetMb * bytesOfMb);
    settings.metric = state.metric;
    settings.residency = state.residency;
    settings.disk = {state.latencyMs / 1e3, state.mbPerS * bytesOfMb, state.loaders};
    return settings;
}

TraceWhatIfRequest requestOf(const WhatIfPanelState& state, const TauList& taus) {
    TraceWhatIfRequest request;
    for (const double tauPx : taus.tausPx) {
        request.settings.push_back(settingsOf(state));
        request.settings.back().tauPx = tauPx;
    }
    return request;
}

// ---- running ----

void progressLines(const TraceWhatIfView& whatIf, Commands& commands) {
    usageBar(whatIf.progress,
             whatIf.cancelling ? std::string("cancelling") : fmt::format("{:.0f} %", 100 * whatIf.progress));
    beginGrey(whatIf.cancelling, "Cancelling.");
    if (button("Cancel", "Ends the selection. The last result stays."))
        commands.push_back(CancelTraceWhatIf{});
    endGrey();
}

void goalField(const char* name, bool& isOn, double& value, const char* format, double least,
               const char* what) {
    const float gap = ImGui::GetFontSize() * 0.3f;
    ImGui::Checkbox(fmt::format("##limit {}", name).c_str(), &isOn);
    noteItem(fmt::format("Limit {}", name));
    tooltip(what);
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(5.5f * ImGui::GetFontSize());
    beginGrey(!isOn, "This limit is off.");
    field(fmt::format("{} to keep", name).c_str(), value, format, least, 1e7, what);
    endGrey();
}

planet::TraceTauGoal goalOf(const WhatIfPanelState& state) {
    planet::TraceTauGoal goal;
    if (state.limitsBytes) goal.bytes = state.goalMb * bytesOfMb;
    if (state.limitsError) goal.errorPx = state.goalPx;
    return goal;
}

void suggestControls(const TraceWhatIfView& whatIf, WhatIfPanelState& state, const TauList& taus,
                     Commands& commands) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted("Keep");
    const float wide = 8 * ImGui::GetFontSize();
    sameLineIfRoom(wide);
    goalField("Bytes", state.limitsBytes, state.goalMb, "%.4g MB", 0.001,
              "Most bytes that a view may need in a frame; a MB is 10^6.");
    sameLineIfRoom(wide);
    goalField("Error", state.limitsError, state.goalPx, "%.4g px", 0.001,
              "Largest error on screen of a drawn node in any frame.");
    const bool hasGoal = state.limitsBytes || state.limitsError;
    const std::string label = fmt::format("Suggest {}###Suggest", tauSymbol());
    sameLineIfRoom(ImGui::CalcTextSize("Suggest tau").x + ImGui::GetFontSize());
    beginGrey(whatIf.running || !hasGoal || !taus.problem.empty(), whatIf.running ? "A selection is running."
                                                                   : hasGoal ? "Correct the tolerances first."
                                                                             : "Set a limit first.");
    const bool isAsked = ImGui::Button(label.c_str());
    noteItem("Suggest");
    tooltip(
        "Finds the smallest tolerance that keeps the bytes, or without that limit the largest one that keeps "
        "the error, "
        "with the hysteresis, budget and data above. Selects with the listed tolerances too.");
    endGrey();
    if (!isAsked) return;
    TraceWhatIfRequest request = requestOf(state, taus);
    request.goal = goalOf(state);
    commands.push_back(StartTraceWhatIf{std::move(request)});
}

std::string limitsText(const planet::TraceTauGoal& goal) {
    const std::string bytes = goal.bytes ? fmt::format("{:g} MB", *goal.bytes / bytesOfMb) : std::string();
    const std::string error = goal.errorPx ? fmt::format("{:g} px", *goal.errorPx) : std::string();
    return bytes.empty() || error.empty() ? bytes + error : bytes + " and " + error;
}

// Appends a τ to the list, unless it is there or does not fit.
void addTau(double tauPx, WhatIfPanelState& state) {
    const std::string longer = fmt::format("{} {:.3g}", state.taus.data(), tauPx);
    if (longer.size() < state.taus.size() && tausFromText(longer).problem.empty())
        std::copy(longer.c_str(), longer.c_str() + longer.size() + 1, state.taus.begin());
}

void suggestion(const TraceWhatIfResult& result, WhatIfPanelState& state) {
    if (!result.suggestion || !result.request.goal) return;
    const planet::TraceTauSuggestion& found = *result.suggestion;
    const char* least = found.isBound ? "at least " : "";
    const char* most = found.isBound ? "at most " : "";
    const std::string needs =
        fmt::format("{}{} and {}{} triangles, with a largest error of {}{}", least,
                    megabytesText(static_cast<double>(found.bytes)), least,
                    countText(static_cast<double>(found.triangles)), most, whatIfPxText(found.errorPx));
    const std::string text = found.isMet
                                 ? fmt::format("{} = {:.3g} px keeps {}: a frame needs {}.", tauSymbol(),
                                               found.tauPx, limitsText(*result.request.goal), needs)
                                 : fmt::format("No {} keeps {}. At {:.3g} px a frame needs {}.", tauSymbol(),
                                               limitsText(*result.request.goal), found.tauPx, needs);
    wrappedText(text, found.isMet ? palette().text : palette().warning);
    if (found.isBound)
        tooltip("The trace does not describe some nodes that would be split, so the cost can be larger.");
    if (found.isMet && button("Add to the list", "Appends this tolerance to the list, for the next run."))
        addTau(found.tauPx, state);
}

void runControls(const EditorView& view, WhatIfPanelState& state, const TauList& taus,
                 const TraceWhatIfResult* result, Commands& commands) {
    const TraceWhatIfView& whatIf = view.trace.whatIf;
    if (!whatIf.problem.empty()) wrappedText(whatIf.problem, palette().warning);
    if (whatIf.running) {
        progressLines(whatIf, commands);
    } else {
        beginGrey(!taus.problem.empty(), "Correct the tolerances first.");
        if (button("Run",
                   "Selects again in each frame of the trace with each tolerance, in the background. What an "
                   "engine that "
                   "is attached traces meanwhile is not read; run again for that."))
            commands.push_back(StartTraceWhatIf{requestOf(state, taus)});
        endGrey();
    }
    suggestControls(whatIf, state, taus, commands);
    if (result) suggestion(*result, state);
}

// ---- results ----

std::string settingsText(const planet::TraceSelectorSettings& settings) {
    std::string text = settings.hysteresis ? fmt::format("hysteresis {:g}", *settings.hysteresis)
                                           : std::string("hysteresis as told");
    if (settings.metric != TraceMetric::Bounds)
        text +=
            settings.metric == TraceMetric::Sphere ? ", distance to the sphere" : ", distance to the centre";
    text += settings.budgetBytes
                ? fmt::format(", budget {}", megabytesText(static_cast<double>(*settings.budgetBytes)))
                : std::string(", no budget");
    switch (settings.residency) {
        case TraceResidency::AllThere:
            return text + ", all data there";
        case TraceResidency::AsTraced:
            return text + ", data as traced";
        case TraceResidency::Disk:
            break;
    }
    return text + fmt::format(", disk of {:g} ms, {:g} MB/s, {} loader{}", 1e3 * settings.disk.latencyS,
                              settings.disk.bytesPerS / bytesOfMb, settings.disk.loaders,
                              settings.disk.loaders == 1 ? "" : "s");
}

void caption(const TraceWhatIfResult& result) {
    std::string text = fmt::format("{} frames", result.report.frames);
    if (result.report.skippedFrames > 0)
        text += fmt::format(", {} without all events left out", result.report.skippedFrames);
    if (!result.request.settings.empty()) text += "; " + settingsText(result.request.settings.front());
    wrappedText(text, palette().dim);
    if (result.report.problem) wrappedText(*result.report.problem, palette().warning);
}

// Draws which view is shown, if there are several. Returns its index, or none if the result lacks it.
std::optional<std::size_t> viewControl(const TraceWhatIfResult& result, int shown, Commands& commands) {
    const std::vector<planet::TraceWhatIfView>& views = result.report.views;
    const auto found = std::ranges::find(views, shown, &planet::TraceWhatIfView::view);
    const bool isThere = found != views.end();
    if (views.size() > 1 || (!isThere && !views.empty())) {
        int index = isThere ? static_cast<int>(found - views.begin()) + 1 : 0;
        std::string names = "choose a view" + std::string(1, '\0');
        for (const planet::TraceWhatIfView& view : views)
            names += fmt::format("view {}", view.view) + std::string(1, '\0');
        names += '\0';
        ImGui::SetNextItemWidth(std::min(ImGui::GetContentRegionAvail().x, 9 * ImGui::GetFontSize()));
        if (combo("View", index, names.c_str()) && index > 0)
            commands.push_back(SelectTraceView{views[static_cast<std::size_t>(index) - 1].view});
        tooltip("View of the engine, for all trace panels.");
    }
    if (!isThere) return std::nullopt;
    return static_cast<std::size_t>(found - views.begin());
}

TracedQuantity quantityOf(WhatIfPicture picture) {
    switch (picture) {
        case WhatIfPicture::Triangles:
            return TracedQuantity::Triangles;
        case WhatIfPicture::Bytes:
            return TracedQuantity::Bytes;
        case WhatIfPicture::Drawn:
            return TracedQuantity::Drawn;
        case WhatIfPicture::Switches:
            return TracedQuantity::Switches;
        case WhatIfPicture::Unknown:
            return TracedQuantity::Unknown;
        case WhatIfPicture::ErrorPx:
        case WhatIfPicture::BytesAgainstError:
        case WhatIfPicture::TrianglesAgainstError:
            break;
    }
    return TracedQuantity::ErrorPx;
}

std::string quantityText(TracedQuantity quantity, double value) {
    if (quantity == TracedQuantity::ErrorPx) return whatIfPxText(value);
    if (quantity == TracedQuantity::Bytes) return value > 0 ? megabytesText(value) : "0 MB";
    return axisText(value);
}

std::string levelText(TracedQuantity quantity, double value) {
    if (quantity == TracedQuantity::ErrorPx) return axisText(value) + " px";
    if (quantity == TracedQuantity::Bytes) return axisText(value / bytesOfMb) + " MB";
    return axisText(value);
}

void flightPlot(const TraceWhatIfResult& result, std::size_t view, std::span<const WhatIfEntry> entries,
                const EditorView& editor, const WhatIfPanelState& state, Commands& commands) {
    const TraceWhatIfSeries& series = result.series[view];
    const TracedQuantity quantity = quantityOf(state.picture);
    std::vector<WhatIfLine> lines;
    for (std::size_t i = 0; i < entries.size(); ++i)
        lines.push_back({entries[i].name, entries[i].colour,
                         (*entries[i].values)[static_cast<std::size_t>(quantity)],
                         i == 0 || state.selected == i});
    const auto clicked = whatIfPlot({.frames = series.frames,
                                     .timesS = series.timesS,
                                     .framesInPoint = series.framesInPoint,
                                     .lines = lines,
                                     .isLogarithmic = quantity == TracedQuantity::ErrorPx,
                                     .text = [=](double value) { return quantityText(quantity, value); },
                                     .axisText = [=](double value) { return levelText(quantity, value); },
                                     .shownFrame = editor.trace.wanted});
    if (clicked) commands.push_back(ShowTraceFrame{*clicked});
}

void tellEntry(const WhatIfEntry& entry) {
    ImGui::TextUnformatted(entry.name.c_str());
    ImGui::Text("error %s, %s triangles, %s", whatIfErrorText(entry).c_str(),
                whatIfTrianglesText(entry).c_str(), whatIfBytesText(entry).c_str());
    if (entry.onFront) ImGui::TextColored(palette().good, "on the Pareto front");
    if (!whatIfBoundReason(entry).empty()) ImGui::TextDisabled("bounds: some nodes are not known");
    ImGui::TextDisabled("click: select");
}

// An error or a cost of 0 is plotted at a small value, because the axes are logarithmic.
FrontPoint pointOf(const WhatIfEntry& entry, planet::TraceCost cost) {
    const std::uint64_t amount =
        cost == planet::TraceCost::Bytes ? entry.totals->mostBytes : entry.totals->mostTriangles;
    const double megabytes = static_cast<double>(amount) / bytesOfMb;
    const bool isRow = entry.row && entry.row->settings.tauPx;
    return {std::clamp(entry.totals->worstErrorPx, 0.01, 1e4),
            cost == planet::TraceCost::Bytes ? std::max(megabytes, 1e-3)
                                             : std::max(static_cast<double>(amount), 1.0),
            entry.colour, isRow ? fmt::format("{:g}", *entry.row->settings.tauPx) : std::string(),
            entry.onFront};
}

void costChart(std::span<const WhatIfEntry> entries, planet::TraceCost cost, WhatIfPanelState& state) {
    std::vector<FrontPoint> points;
    std::vector<std::size_t> entryOf;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (std::isnan(entries[i].totals->worstErrorPx)) continue;
        points.push_back(pointOf(entries[i], cost));
        entryOf.push_back(i);
    }
    if (points.empty()) return emptyState("The trace tells no errors.");
    std::vector<FrontSeries> series = {{"", palette().dim, {}}};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const WhatIfEntry& entry = entries[entryOf[i]];
        if (entry.row && entry.row->settings.tauPx)
            series.front().points.push_back(i);
        else
            series.push_back({entry.name, entry.colour, {i}});
    }
    if (series.front().points.empty()) series.erase(series.begin());
    const auto selected = std::ranges::find(entryOf, state.selected.value_or(entries.size()));
    const auto clicked = frontChart(
        {.points = points,
         .series = series,
         .errorName = "max error, px",
         .shortErrorName = "error, px",
         .explanation =
             "One point per selection: largest error on the horizontal axis, most bytes or triangles of a "
             "frame on the vertical axis, both logarithmic, labelled with the tolerance. Ringed: on the "
             "Pareto front, no other tolerance is both cheaper and more accurate.",
         .tell = [&](std::size_t i) { tellEntry(entries[entryOf[i]]); }},
        selected == entryOf.end() ? std::nullopt
                                  : std::optional(static_cast<std::size_t>(selected - entryOf.begin())));
    if (clicked) state.selected = entryOf[*clicked];
}

bool isAgainstError(WhatIfPicture picture) {
    return picture == WhatIfPicture::BytesAgainstError || picture == WhatIfPicture::TrianglesAgainstError;
}

// Draws what the plot shows. withCosts: also costs against errors, which have a column of their own in a wide dock.
void pictureControl(WhatIfPanelState& state, bool withCosts) {
    if (!withCosts && isAgainstError(state.picture)) state.picture = WhatIfPicture::ErrorPx;
    std::string names = std::string("max error, px") + '\0' + "triangles" + '\0' + "MB that the view needs" +
                        '\0' + "drawn nodes" + '\0' + "switches" + '\0' + "unknown nodes" + '\0';
    if (withCosts)
        names += std::string("most MB against error") + '\0' + "most triangles against error" + '\0';
    int picture = static_cast<int>(state.picture);
    ImGui::SetNextItemWidth(std::min(ImGui::GetContentRegionAvail().x, 15 * ImGui::GetFontSize()));
    combo("Plot", picture, names.c_str());
    tooltip(
        "What the plot shows over the flight. Where the flight has more frames than points, a point is the "
        "largest value "
        "of its frames. Unknown nodes: where they are not 0, the other values are bounds.");
    state.picture = static_cast<WhatIfPicture>(picture);
    if (isAgainstError(state.picture))
        state.cost = state.picture == WhatIfPicture::BytesAgainstError ? planet::TraceCost::Bytes
                                                                       : planet::TraceCost::Triangles;
}

void costControl(WhatIfPanelState& state) {
    int cost = static_cast<int>(state.cost);
    ImGui::SetNextItemWidth(std::min(ImGui::GetContentRegionAvail().x, 11 * ImGui::GetFontSize()));
    combo("Cost", cost, "most MB\0most triangles\0");
    tooltip("Cost of a frame on the vertical axis, used for the Pareto front.");
    state.cost = static_cast<planet::TraceCost>(cost);
}

void results(const TraceWhatIfResult& result, std::size_t view, std::span<const WhatIfEntry> entries,
             const EditorView& editor, WhatIfPanelState& state, Commands& commands) {
    if (!ImGui::BeginTabBar("results")) return;
    if (ImGui::BeginTabItem("Selections")) {
        caption(result);
        whatIfTable(entries, editor, state.selected, commands);
        ImGui::EndTabItem();
    }
    const int shown = result.report.views[view].view;
    const auto real = std::ranges::count_if(
        result.report.disagreements, [&](const auto& each) { return each.view == shown && !each.isFade; });
    const bool isOpen = ImGui::BeginTabItem(fmt::format("Disagreements {}###disagreements", real).c_str());
    noteItem("Disagreements");
    tooltip("Nodes for which the engine's choice is not what its own errors, settings and data say.");
    if (isOpen) {
        disagreementTable(result.report, view, editor, state.showsFades, commands);
        ImGui::EndTabItem();
    }
    ImGui::EndTabBar();
}

const char* emptyText(const TraceWhatIfView& whatIf, const TraceWhatIfResult* result) {
    if (result) return "The trace has no such view, or no complete frame.";
    return whatIf.running ? "Selecting again." : "Press Run to select again with each tolerance.";
}

}  // namespace

void whatIfPanel(const EditorView& view, WhatIfPanelState& state, Commands& commands) {
    const TraceWhatIfView& whatIf = view.trace.whatIf;
    if (view.trace.file.empty())
        return emptyState("No trace is open. The Trace panel opens a file or attaches to an engine.");
    // A result of another trace says nothing about this one.
    const TraceWhatIfResult* const result =
        whatIf.result && whatIf.result->file == view.trace.file ? whatIf.result : nullptr;
    const std::optional<std::size_t> shown =
        result ? viewControl(*result, view.trace.view, commands) : std::nullopt;
    std::vector<WhatIfEntry> entries;
    if (shown) entries = whatIfEntries(*result, *shown, state.cost);
    if (state.selected && *state.selected >= entries.size()) state.selected.reset();
    const bool isApart = ImGui::GetContentRegionAvail().x > chartApartFrom * ImGui::GetFontSize();
    const auto controls = [&] {
        const TauList taus = tauListControl(state.taus, "A row of the table each.");
        hysteresisControl(state);
        metricControl(state);
        budgetControl(state);
        dataControl(state);
        runControls(view, state, taus, result, commands);
    };
    const auto plot = [&] {
        pictureControl(state, !isApart);
        if (entries.empty()) return emptyState(emptyText(whatIf, result));
        if (isAgainstError(state.picture))
            costChart(entries, state.cost, state);
        else
            flightPlot(*result, *shown, entries, view, state, commands);
    };
    const auto chart = [&] {
        costControl(state);
        if (entries.empty()) return emptyState("No result yet.");
        costChart(entries, state.cost, state);
    };
    const auto table = [&] {
        if (entries.empty()) return emptyState("No result yet.");
        results(*result, *shown, entries, view, state, commands);
    };
    const bool isEmpty = entries.empty();
    std::vector<Column> columns = {{"Settings", 0.9f, 0, controls},
                                   {"Over the flight", 1.3f, isEmpty ? 4.0f : 14.0f, plot},
                                   {"Results", 2.2f, isEmpty ? 3.0f : 14.0f, table}};
    if (isApart) columns.insert(columns.begin() + 2, Column{"Cost and error", 0.9f, 0, chart});
    drawColumns("what if", columns);
}

}  // namespace worldy::ui
