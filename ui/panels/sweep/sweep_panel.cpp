#include "ui/panels/sweep/sweep_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "ui/kit/columns.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tau_list.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/panels/sweep/sweep_chart.h"
#include "ui/panels/sweep/sweep_table.h"

namespace worldy::ui {

namespace {

constexpr float runApartFrom = 68;  // heights of the font

// The request.

using Flights = std::vector<std::filesystem::path>;

Flights flightsOf(const EditorView& view) {
    Flights flights(view.camera.flights.begin(), view.camera.flights.end());
    for (const RecordedFlight& recorded : view.recording.flights) {
        if (std::find(flights.begin(), flights.end(), recorded.file) == flights.end())
            flights.push_back(recorded.file);
    }
    return flights;
}

void flightControl(const Flights& flights, SweepPanelState& state) {
    int index = 0;
    std::string names;
    for (std::size_t i = 0; i < flights.size(); ++i) {
        std::string name = flights[i].stem().string();
        std::replace(name.begin(), name.end(), '_', ' ');
        names += name + '\0';
        if (flights[i] == state.flight) index = static_cast<int>(i);
    }
    const char* explanation =
        "Flight to measure: a flight of keys or a recorded flight, from the folders \"flights\".";
    labelledControl("Flight", explanation);
    // In a narrow dock the control stands below its label, because flight names are long.
    if (ImGui::GetContentRegionAvail().x < 14 * ImGui::GetFontSize()) ImGui::NewLine();
    ImGui::SetNextItemWidth(-1);
    combo("Flight", index, names.c_str());
    tooltip(explanation);
    state.flight = flights[static_cast<std::size_t>(index)].string();
}

// Returns why a size cannot be swept; empty if it can.
std::string sizeProblem(const EditorView& view, int size) {
    const planet::PlanetShape& shape = view.planet->tree().shape;
    if (size == planet::chunkSize(shape)) return {};
    if (!view.bake.canBake)
        return "The source of this file is unknown or missing, so only its own chunk size can be swept. Open "
               "the source itself to sweep other sizes.";
    if (size - 1 > planet::faceCells(shape))
        return fmt::format("A face of this planet has only {} samples per side.",
                           planet::faceCells(shape) + 1);
    return {};
}

// Draws a label for check boxes, spaced closely so that all may fit on one line. Pushes a style variable; end
// with ImGui::PopStyleVar().
void beginBoxes(const char* label, const char* explanation) {
    const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ImGui::GetFontSize() * 0.4f, spacing.y));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    tooltip(explanation);
}

std::vector<int> chunksControl(const EditorView& view, SweepPanelState& state) {
    const int own = planet::chunkSize(view.planet->tree().shape);
    if (!state.chunks) {
        state.chunks.emplace();
        for (std::size_t i = 0; i < planet::chunkSizes.size(); ++i)
            (*state.chunks)[i] = planet::chunkSizes[i] == own;
    }
    beginBoxes("Chunks", "Vertices along a side of a chunk.");
    std::vector<int> wanted;
    bool anyBarred = false;
    for (std::size_t i = 0; i < planet::chunkSizes.size(); ++i) {
        const int size = planet::chunkSizes[i];
        const std::string label = fmt::format("{}", size);
        const std::string problem = sizeProblem(view, size);
        anyBarred |= !problem.empty() && !view.bake.canBake;
        sameLineIfRoom(checkboxWidth(label.c_str()));
        bool on = (*state.chunks)[i] && problem.empty();
        beginGrey(!problem.empty(), problem.c_str());
        if (ImGui::Checkbox(label.c_str(), &on)) (*state.chunks)[i] = on;
        noteItem(fmt::format("Chunk {}", size));
        endGrey();
        tooltip(
            problem.empty()
                ? fmt::format("Chunks of {0} x {0} vertices{1}", size,
                              size == own
                                  ? ", as in the open file."
                                  : ". Baked into the cache first, without colours, unless already there.")
                      .c_str()
                : problem.c_str());
        if (on) wanted.push_back(size);
    }
    ImGui::PopStyleVar();
    if (anyBarred)
        wrappedText("The source is unknown: only the file's own chunk size is available.", palette().dim);
    return wanted;
}

std::vector<planet::ErrorMetric> metricsControl(SweepPanelState& state) {
    beginBoxes("Metrics", "Geometric error metrics used for selection.");
    sameLineIfRoom(checkboxWidth("additive"));
    checkbox("additive", state.additive, true,
             "Selects by the additive error bound, the sum of the errors of all levels.");
    sameLineIfRoom(checkboxWidth("tight"));
    checkbox("tight", state.tight, true,
             "Selects by the error measured against the finest data during the bake: fewer triangles for the "
             "same tolerance.");
    ImGui::PopStyleVar();
    std::vector<planet::ErrorMetric> metrics;
    if (state.additive) metrics.push_back(planet::ErrorMetric::Additive);
    if (state.tight) metrics.push_back(planet::ErrorMetric::Tight);
    return metrics;
}

constexpr std::array<std::pair<int, int>, 4> pictureSizes = {{{0, 0}, {640, 400}, {1280, 720}, {1920, 1080}}};

void pictureControl(const EditorView& view, SweepPanelState& state, SweepRequest& request) {
    slider("Sample frames", state.frames, 12, 1, 100, "%d",
           "Number of frames measured, evenly spread over the flight. All chunks a frame needs are loaded "
           "before it is measured. More: more reliable values, but proportionally longer.");
    choiceIndex("Picture", state.pictureSize, 0, "viewport size\000640 x 400\0001280 x 720\0001920 x 1080\0",
                "Picture size in pixels. Tolerances are in pixels of this picture, so a larger one needs "
                "more triangles.");
    const auto [width, height] = pictureSizes[static_cast<std::size_t>(state.pictureSize)];
    request.frames = state.frames;
    request.widthPx = width > 0 ? width : std::max(view.camera.renderView.widthPx, 1);
    request.heightPx = height > 0 ? height : std::max(view.camera.renderView.heightPx, 1);
}

// Running.

void progressLines(const EditorView& view, Commands& commands) {
    const SweepProgress& p = view.sweep.progress;
    const double flown = static_cast<double>(p.flown) + static_cast<double>(p.frame) / std::max(p.frames, 1);
    usageBar(flown / static_cast<double>(std::max<std::size_t>(p.flights, 1)),
             fmt::format("{} of {}{} flights", p.flown, view.sweep.suggesting ? "at most " : "", p.flights));
    std::string now = "Opening the planet";
    if (p.bake) {
        const double share = static_cast<double>(p.bake->samplesDone) /
                             static_cast<double>(std::max<std::uint64_t>(p.bake->samplesTotal, 1));
        now = fmt::format("Baking chunks of {}: {:.0f} %", p.chunkSize, 100 * share);
    } else if (p.tauPx > 0) {
        now = fmt::format("{}, frame {} of {}", settingText(p.chunkSize, p.metric, p.tauPx, tauSymbol()),
                          p.frame + 1, p.frames);
    }
    if (view.sweep.cancelling)
        now = "Cancelling";
    else if (p.leftS)
        now +=
            fmt::format("; {}{} left", view.sweep.suggesting ? "at most " : "about ", durationText(*p.leftS));
    // The button stands above the text, whose number of lines varies.
    beginGrey(view.sweep.cancelling, "Cancelling.");
    if (button("Cancel", "Cancels the sweep. Points measured so far stay visible, but are not saved."))
        commands.push_back(CancelSweep{});
    endGrey();
    wrappedText(now, palette().dim);
}

// Returns why nothing can be run; empty if it can.
std::string requestProblem(const SweepRequest& request, const TauList& taus) {
    if (!taus.problem.empty()) return "Correct the tolerances first.";
    if (request.chunkSizes.empty()) return "Choose a chunk size.";
    if (request.metrics.empty()) return "Choose a metric.";
    return {};
}

void runControl(const EditorView& view, const SweepRequest& request, const TauList& taus,
                Commands& commands) {
    if (view.sweep.running && !view.sweep.suggesting) return progressLines(view, commands);
    const std::string problem = requestProblem(request, taus);
    beginGrey(!problem.empty() || view.sweep.running,
              view.sweep.running ? "A search for a tolerance is running." : problem.c_str());
    if (button(
            "Run",
            "Measures each setting in the background, without I/O fault injection and overlays. Meanwhile "
            "the window draws at most 20 frames per second unless there is input, because drawing disturbs "
            "the measured frame times. For frame times to publish use worldy sweep, without a window."))
        commands.push_back(StartSweep{request});
    endGrey();
    ImGui::SameLine();
    const std::size_t flights = request.tausPx.size() * request.chunkSizes.size() * request.metrics.size();
    wrappedText(problem.empty() ? fmt::format("{} of {}", countedText(flights, "flight"),
                                              countedText(static_cast<std::size_t>(request.frames), "frame"))
                                : problem,
                palette().dim);
}

// Suggestions.

struct GoalKind {
    TauGoal goal;
    const char* unit;
};
constexpr std::array<GoalKind, 4> goalKinds = {{{{true, SweepCost::Triangles, 0}, "%.3g px"},
                                                {{false, SweepCost::Triangles, 0}, "%.0f triangles"},
                                                {{false, SweepCost::FrameMs, 0}, "%.3g ms"},
                                                {{false, SweepCost::MemoryMiB, 0}, "%.4g MiB"}}};

void goalControl(SweepPanelState& state) {
    choiceIndex("Keep", state.goal, 0, "error\0triangles\0frame time\0memory\0",
                "Error: finds the largest tolerance whose max measured error over the flight stays below the "
                "limit. Otherwise: the smallest tolerance whose mean triangles, median frame time or "
                "resident chunk memory does.");
    const auto goal = static_cast<std::size_t>(state.goal);
    const char* explanation =
        "Limit greater than 0: max measured error in facing pixels, mean triangles per frame, milliseconds "
        "per frame for selection and drawing, or MiB of resident chunks.";
    labelledControl("below", explanation);
    double limit = state.limits[goal];
    numberField("##limit", limit, goalKinds[goal].unit);
    noteItem("Limit");
    tooltip(explanation);
    if (limit > 0 && std::isfinite(limit)) state.limits[goal] = limit;
}

void answer(const SweepSuggestion& suggestion, const EditorView& view, ViewSettings& settings) {
    const bool tight = suggestion.metric == planet::ErrorMetric::Tight;
    const std::string text = suggestionText(suggestion.goal, suggestion.found, tauSymbol());
    wrappedText(
        fmt::format("{} metric, chunks of {}: {}", tight ? "Tight" : "Additive", suggestion.chunkSize, text),
        suggestion.found.met ? palette().text : palette().warning);
    if (!suggestion.found.met) return;
    ImGui::PushID(tight ? 1 : 0);
    beginGrey(view.recording.replay.has_value(), "Settings are locked during a replay; end it first.");
    if (ImGui::Button("Apply")) {
        settings.lod.tauPx = suggestion.found.tauPx;
        settings.lod.metric = suggestion.metric;
    }
    noteItem(tight ? "Apply: tight" : "Apply: additive");
    endGrey();
    tooltip("Sets the tolerance and the metric of the LOD panel. Undo reverts this.");
    ImGui::PopID();
}

void suggestControls(const EditorView& view, SweepPanelState& state, SweepRequest request,
                     ViewSettings& settings, Commands& commands) {
    goalControl(state);
    if (view.sweep.running && view.sweep.suggesting) {
        progressLines(view, commands);
    } else {
        beginGrey(view.sweep.running || request.metrics.empty(),
                  view.sweep.running ? "A sweep is running." : "Choose a metric first.");
        const bool asked =
            button("Suggest",
                   "Bisects the tolerance range to 2 %: about ten flights per metric, with the open file's "
                   "chunks. Uses the flight, metrics, sample frames and picture above.");
        endGrey();
        if (asked) {
            const auto goal = static_cast<std::size_t>(state.goal);
            request.goal = goalKinds[goal].goal;
            request.goal->limit = state.limits[goal];
            request.chunkSizes.clear();
            commands.push_back(StartSweep{request});
        }
        if (request.metrics.empty()) {
            ImGui::SameLine();
            wrappedText("Choose a metric.", palette().dim);
        }
    }
    for (const SweepSuggestion& suggestion : view.sweep.suggestions) answer(suggestion, view, settings);
}

struct Asked {
    SweepRequest request;
    TauList taus;
};
// Draws the controls and returns the request; none if there is no flight.
std::optional<Asked> requestControls(const EditorView& view, SweepPanelState& state) {
    const Flights flights = flightsOf(view);
    if (flights.empty()) {
        wrappedText("There are no flights. Record one in the Flight panel.", palette().dim);
        return std::nullopt;
    }
    flightControl(flights, state);
    TauList taus = tauListControl(state.taus, "Each is combined with each metric and chunk size.");
    SweepRequest request;
    request.flight = state.flight;
    request.tausPx = taus.tausPx;
    request.chunkSizes = chunksControl(view, state);
    request.metrics = metricsControl(state);
    pictureControl(view, state, request);
    return Asked{std::move(request), std::move(taus)};
}

// Results.

void tableCaption(const SweepTable& table, const EditorView& view) {
    const std::string state = table.whole ? "" : view.sweep.running ? ", so far" : ", incomplete";
    wrappedText(fmt::format("{}, {}, {} x {} px, {}: {}{}", table.flight, table.source.filename().string(),
                            table.request.widthPx, table.request.heightPx,
                            countedText(static_cast<std::size_t>(table.request.frames), "frame"),
                            countedText(table.points.size(), "point"), state),
                table.whole || view.sweep.running ? palette().dim : palette().warning);
}

void useButton(const SweepTable& table, const EditorView& view, const SweepPanelState& state,
               ViewSettings& settings, Commands& commands) {
    const SweepPoint* point = state.selected ? &table.points[*state.selected] : nullptr;
    const bool samePlanet = table.source == view.data.source;
    const bool otherSize = point && point->chunkSize != planet::chunkSize(view.planet->tree().shape);
    beginGrey(
        !point || view.recording.replay.has_value(),
        point ? "Settings are locked during a replay; end it first." : "Select a point or a row first.");
    const bool pressed = ImGui::Button("Use these settings");
    noteItem("Use these settings");
    endGrey();
    std::string meaning = "Select a point or a row first.";
    if (point) {
        meaning =
            fmt::format("Sets {} {:.3g} px and the metric, as in the LOD panel", tauSymbol(), point->tauPx);
        if (otherSize)
            meaning += samePlanet
                           ? fmt::format(", and opens the chunks of {} baked for the sweep", point->chunkSize)
                           : ". The chunk size is kept: another planet is open";
        meaning += ".";
    }
    tooltip(meaning.c_str());
    if (!pressed || !point) return;
    settings.lod.tauPx = point->tauPx;
    settings.lod.metric = point->metric;
    if (otherSize && samePlanet) commands.push_back(OpenSweptChunks{point->chunkSize});
}

void saveButton(const SweepTable& table, const SweepPanelState& state, Commands& commands) {
    const char* label = "Save table and plot";
    sameLineIfRoom(ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x);
    beginGrey(!table.whole, "Only a completed sweep can be saved.");
    if (button(label, table.whole ? "Saves the table as .csv and .json and the plot as .png, beside the "
                                    "screenshots."
                                  : "Only a completed sweep can be saved."))
        commands.push_back(SaveSweep{state.cost});
    endGrey();
}

// The combo also serves as the title of the plot's vertical axis.
void costControl(SweepPanelState& state) {
    int cost = static_cast<int>(state.cost);
    ImGui::SetNextItemWidth(std::min(ImGui::GetContentRegionAvail().x, 11 * ImGui::GetFontSize()));
    combo("Cost", cost, "mean triangles\0median frame, ms\0max resident, MiB\0");
    tooltip("Cost on the vertical axis of the plot, used for the Pareto front.");
    state.cost = static_cast<SweepCost>(cost);
}

void emptyPlot(const EditorView& view) {
    const bool sweeps = view.sweep.running && !view.sweep.suggesting;
    emptyState(sweeps ? "Measuring the first point."
                      : "Press Run to plot the cost of each setting against its true error.");
}

}  // namespace

void sweepPanel(const EditorView& view, SweepPanelState& state, ViewSettings& settings, Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to sweep tolerances over a flight.");
    std::vector<SweepPoint> points = view.sweep.table ? view.sweep.table->points : std::vector<SweepPoint>();
    markFront(points, state.cost);
    if (state.selected && *state.selected >= points.size()) state.selected.reset();
    const auto plot = [&] {
        costControl(state);
        if (points.empty()) return emptyPlot(view);
        if (const auto clicked = sweepChart(points, state.cost, state.selected)) state.selected = clicked;
    };
    const auto table = [&] {
        if (points.empty()) return emptyState("No points measured yet.");
        tableCaption(*view.sweep.table, view);
        useButton(*view.sweep.table, view, state, settings, commands);
        saveButton(*view.sweep.table, state, commands);
        sweepTable(points, state.selected);
    };
    std::optional<Asked> asked;
    const auto run = [&] {
        if (!view.sweep.problem.empty()) wrappedText(view.sweep.problem, palette().warning);
        if (!asked) return;
        runControl(view, asked->request, asked->taus, commands);
        if (section("Suggest a tolerance")) suggestControls(view, state, asked->request, settings, commands);
    };
    // A very wide dock shows the run controls in a column of their own; otherwise they are below the
    // settings.
    const bool apart = ImGui::GetContentRegionAvail().x > runApartFrom * ImGui::GetFontSize();
    const auto controls = [&] {
        asked = requestControls(view, state);
        if (!apart) run();
    };
    constexpr float plotLines = 14, tableLines = 14;
    const float font = ImGui::GetFontSize();
    const float tableWanted = points.empty() ? 0 : sweepTableWidth();
    std::vector<Column> columns = {
        {"Settings", 1.15f, 0, controls, 0, 15 * font},
        {"Cost and error", 1.2f, points.empty() ? 4.0f : plotLines, plot, 0, 15 * font},
        {"Points", 1.6f, points.empty() ? 3.0f : tableLines, table, 0, tableWanted}};
    if (apart) columns.insert(columns.begin() + 1, Column{"Run", 0.9f, 0, run, 0, 13 * font});
    drawColumns("sweep", columns);
}

}  // namespace worldy::ui
