#include "ui/sweep_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ui/columns.h"
#include "ui/item_map.h"
#include "ui/sweep_chart.h"
#include "ui/sweep_table.h"
#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

constexpr float runApartFrom = 68;  // heights of the font

// "1 flight", "2 flights"
std::string countOf(std::size_t count, const char* of) {
    return fmt::format("{} {}{}", count, of, count == 1 ? "" : "s");
}

// What is asked for.

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
        "What is flown: keys of a shipped flight, or the way of a recorded one. Files of both kinds lie in "
        "the folder \"flights\" beside the settings.";
    labelledControl("Flight", explanation);
    combo("Flight", index, names.c_str());
    tooltip(explanation);
    state.flight = flights[static_cast<std::size_t>(index)].string();
}

TauList tausControl(SweepPanelState& state) {
    const std::string explanation = fmt::format(
        "Tolerances to fly with, pixels, {} to {}, with spaces or commas between them. Each is flown for "
        "each metric and chunk size.",
        smallestTauPx, largestTauPx);
    labelledControl(fmt::format("{}, px", tauSymbol()).c_str(), explanation.c_str());
    ImGui::InputText("##taus", state.taus.data(), state.taus.size());
    noteItem("Tolerances");
    tooltip(explanation.c_str());
    TauList taus = tausFromText(state.taus.data());
    if (!taus.problem.empty()) wrappedText(taus.problem, palette().bad);
    return taus;
}

// Why a size cannot be swept; empty: it can.
std::string sizeProblem(const EditorView& view, int size) {
    const planet::PlanetShape& shape = view.planet->shape();
    if (size == planet::chunkSize(shape)) return {};
    if (!view.bake.canBake)
        return "What this file was baked from is not known or not there, so only its own chunks can be "
               "swept. Open the source itself to sweep others.";
    if (size - 1 > planet::faceCells(shape))
        return fmt::format("A face of this planet has only {} samples a side.", planet::faceCells(shape) + 1);
    return {};
}

// A name and boxes after it, as close as all may fit into one line; ends with a PopStyleVar.
void beginBoxes(const char* label, const char* explanation) {
    const ImVec2 spacing = ImGui::GetStyle().ItemSpacing;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ImGui::GetFontSize() * 0.4f, spacing.y));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    tooltip(explanation);
}

std::vector<int> chunksControl(const EditorView& view, SweepPanelState& state) {
    const int own = planet::chunkSize(view.planet->shape());
    if (!state.chunks) {
        state.chunks.emplace();
        for (std::size_t i = 0; i < planet::chunkSizes.size(); ++i)
            (*state.chunks)[i] = planet::chunkSizes[i] == own;
    }
    beginBoxes("Chunks", "Vertices a side of a chunk.");
    std::vector<int> wanted;
    bool anyBarred = false;
    for (std::size_t i = 0; i < planet::chunkSizes.size(); ++i) {
        const int size = planet::chunkSizes[i];
        const std::string label = fmt::format("{}", size);
        const std::string problem = sizeProblem(view, size);
        anyBarred |= !problem.empty() && !view.bake.canBake;
        sameLineIfRoom(checkboxWidth(label.c_str()));
        bool on = (*state.chunks)[i] && problem.empty();
        ImGui::BeginDisabled(!problem.empty());
        if (ImGui::Checkbox(label.c_str(), &on)) (*state.chunks)[i] = on;
        noteItem(fmt::format("Chunk {}", size));
        ImGui::EndDisabled();
        tooltip(problem.empty()
                    ? fmt::format("Chunks of {} vertices a side{}", size,
                                  size == own
                                      ? ": the planet's own."
                                      : ". Baked into the cache first, without colours, where they are "
                                        "not there yet.")
                          .c_str()
                    : problem.c_str());
        if (on) wanted.push_back(size);
    }
    ImGui::PopStyleVar();
    if (anyBarred) wrappedText("Its source is not known: its own chunk size only.", palette().dim);
    return wanted;
}

std::vector<planet::ErrorMetric> metricsControl(SweepPanelState& state) {
    beginBoxes("Metrics", "What chunks are chosen by: how large a chunk's error is taken to be.");
    sameLineIfRoom(checkboxWidth("additive"));
    checkbox("additive", state.additive, true,
             "Choose by the additive bound of a chunk's error, which adds up what each level may add.");
    sameLineIfRoom(checkboxWidth("tight"));
    checkbox(
        "tight", state.tight, true,
        "Choose by the error measured against the finest data when it was baked: fewer triangles for the "
        "same tolerance.");
    ImGui::PopStyleVar();
    std::vector<planet::ErrorMetric> metrics;
    if (state.additive) metrics.push_back(planet::ErrorMetric::Additive);
    if (state.tight) metrics.push_back(planet::ErrorMetric::Tight);
    return metrics;
}

constexpr std::array<std::pair<int, int>, 4> pictureSizes = {{{0, 0}, {640, 400}, {1280, 720}, {1920, 1080}}};

void pictureControl(const EditorView& view, SweepPanelState& state, SweepRequest& request) {
    slider("Moments", state.frames, 12, 1, 100, "%d",
           "Of the flight, evenly spread. In each one all that it wants is loaded before it is drawn and "
           "measured. More: surer figures, and as much longer.");
    choiceIndex("Picture", state.pictureSize, 0,
                "as the viewport\000640 x 400\0001280 x 720\0001920 x 1080\0",
                "Its size, pixels. A tolerance is in pixels of it, so a larger one takes more triangles.");
    const auto [width, height] = pictureSizes[static_cast<std::size_t>(state.pictureSize)];
    request.frames = state.frames;
    request.widthPx = width > 0 ? width : std::max(view.renderView.widthPx, 1);
    request.heightPx = height > 0 ? height : std::max(view.renderView.heightPx, 1);
}

// What runs.

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
        now = fmt::format("{}, moment {} of {}", settingText(p.chunkSize, p.metric, p.tauPx, tauSymbol()),
                          p.frame + 1, p.frames);
    }
    if (view.sweep.cancelling)
        now = "Ending";
    else if (p.leftS)
        now +=
            fmt::format("; {}{} left", view.sweep.suggesting ? "at most " : "about ", durationText(*p.leftS));
    // Over the text, whose lines come and go.
    ImGui::BeginDisabled(view.sweep.cancelling);
    if (button("Cancel",
               "Ends it within a moment. Points flown by then stay to be looked at, but are not "
               "saved."))
        commands.push_back(CancelSweep{});
    ImGui::EndDisabled();
    wrappedText(now, palette().dim);
}

// Why nothing can be run; empty: it can.
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
    ImGui::BeginDisabled(!problem.empty() || view.sweep.running);
    if (button("Run",
               "Flies each setting in the background, without a bad disk and without overlays, and "
               "measures it at each moment. While it runs the window draws no more than 20 frames a "
               "second unless there is input, since drawing disturbs the frame times that are measured. "
               "For times to be reported use worldy sweep, without a window."))
        commands.push_back(StartSweep{request});
    ImGui::EndDisabled();
    ImGui::SameLine();
    const std::size_t flights = request.tausPx.size() * request.chunkSizes.size() * request.metrics.size();
    wrappedText(problem.empty() ? fmt::format("{} of {}", countOf(flights, "flight"),
                                              countOf(static_cast<std::size_t>(request.frames), "moment"))
                                : problem,
                palette().dim);
}

// Suggest.

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
                "Error: the largest tolerance whose worst measured error over the flight stays under the "
                "limit. Else the smallest whose mean triangles, median frame time or memory of resident "
                "chunks do.");
    const auto goal = static_cast<std::size_t>(state.goal);
    const char* explanation =
        "The limit, over 0. Worst measured error, pixels as if the view faced it; or mean triangles a "
        "frame; or milliseconds of a frame, choosing and drawing; or MiB of resident chunks.";
    labelledControl("under", explanation);
    double limit = state.limits[goal];
    ImGui::InputDouble("##limit", &limit, 0, 0, goalKinds[goal].unit);
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
    ImGui::BeginDisabled(view.recording.replay.has_value());
    if (ImGui::Button("Use it")) {
        settings.lod.tauPx = suggestion.found.tauPx;
        settings.lod.metric = suggestion.metric;
    }
    noteItem(tight ? "Use it: tight" : "Use it: additive");
    ImGui::EndDisabled();
    tooltip("Sets tolerance and metric, as in the LOD panel. Undo takes it back.");
    ImGui::PopID();
}

void suggestControls(const EditorView& view, SweepPanelState& state, SweepRequest request,
                     ViewSettings& settings, Commands& commands) {
    goalControl(state);
    if (view.sweep.running && view.sweep.suggesting) {
        progressLines(view, commands);
    } else {
        ImGui::BeginDisabled(view.sweep.running || request.metrics.empty());
        const bool asked =
            button("Suggest",
                   "Halves the range of tolerances, flying each, until the one wanted is known to 2 %: "
                   "about ten flights a metric, over the planet's own chunks. Flight, metrics, moments "
                   "and picture are those above.");
        ImGui::EndDisabled();
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
// What the controls ask for; nothing where there is no flight.
std::optional<Asked> requestControls(const EditorView& view, SweepPanelState& state) {
    const Flights flights = flightsOf(view);
    if (flights.empty()) {
        wrappedText("There is no flight to sweep over. Record one in the Flight panel.", palette().dim);
        return std::nullopt;
    }
    flightControl(flights, state);
    TauList taus = tausControl(state);
    SweepRequest request;
    request.flight = state.flight;
    request.tausPx = taus.tausPx;
    request.chunkSizes = chunksControl(view, state);
    request.metrics = metricsControl(state);
    pictureControl(view, state, request);
    return Asked{std::move(request), std::move(taus)};
}

// What came of it.

void tableCaption(const SweepTable& table, const EditorView& view) {
    const std::string state = table.whole ? "" : view.sweep.running ? ", so far" : ", not whole";
    wrappedText(fmt::format("{}, {}, {} x {} px, {}: {}{}", table.flight, table.source.filename().string(),
                            table.request.widthPx, table.request.heightPx,
                            countOf(static_cast<std::size_t>(table.request.frames), "moment"),
                            countOf(table.points.size(), "point"), state),
                table.whole || view.sweep.running ? palette().dim : palette().warning);
}

void useButton(const SweepTable& table, const EditorView& view, const SweepPanelState& state,
               ViewSettings& settings, Commands& commands) {
    const SweepPoint* point = state.selected ? &table.points[*state.selected] : nullptr;
    const bool samePlanet = table.source == view.data.source;
    const bool otherSize = point && point->chunkSize != planet::chunkSize(view.planet->shape());
    ImGui::BeginDisabled(!point || view.recording.replay);
    const bool pressed = ImGui::Button("Use these settings");
    noteItem("Use these settings");
    ImGui::EndDisabled();
    std::string meaning = "Select a point or a row first.";
    if (point) {
        meaning =
            fmt::format("Sets {} {:.3g} px and the metric, as in the LOD panel", tauSymbol(), point->tauPx);
        if (otherSize)
            meaning += samePlanet ? fmt::format(", and shows the chunks of {} that were baked for the sweep",
                                                point->chunkSize)
                                  : ". The chunk size stays, since another planet is shown";
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
    ImGui::BeginDisabled(!table.whole);
    if (button(label, table.whole
                          ? "As .csv and .json, and the plot as .png, beside the screenshots. The log "
                            "says where."
                          : "Only a sweep that has come to its end is saved."))
        commands.push_back(SaveSweep{state.cost});
    ImGui::EndDisabled();
}

// The name of the plot's upright axis too.
void costControl(SweepPanelState& state) {
    int cost = static_cast<int>(state.cost);
    ImGui::SetNextItemWidth(std::min(ImGui::GetContentRegionAvail().x, 11 * ImGui::GetFontSize()));
    combo("Paid", cost, "mean triangles\0median frame, ms\0most resident, MiB\0");
    tooltip("What is paid: the plot shows it upwards, and the Pareto front is about it.");
    state.cost = static_cast<SweepCost>(cost);
}

void emptyPlot(const EditorView& view) {
    const bool sweeps = view.sweep.running && !view.sweep.suggesting;
    emptyState(sweeps ? "The first point is on its way."
                      : "Run flies each setting, and shows here what it costs against its true error.");
}

}  // namespace

void sweepPanel(const EditorView& view, SweepPanelState& state, ViewSettings& settings, Commands& commands) {
    if (!view.planet) return emptyState("Tolerances are swept over a flight here once a planet is open.");
    std::vector<SweepPoint> points = view.sweep.table ? view.sweep.table->points : std::vector<SweepPoint>();
    markFront(points, state.cost);
    if (state.selected && *state.selected >= points.size()) state.selected.reset();
    const auto plot = [&] {
        costControl(state);
        if (points.empty()) return emptyPlot(view);
        if (const auto clicked = sweepChart(points, state.cost, state.selected)) state.selected = clicked;
    };
    const auto table = [&] {
        if (points.empty()) return emptyState("Each setting is a row here.");
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
    // In a very wide dock beside the settings, of which it takes some; else under them.
    const bool apart = ImGui::GetContentRegionAvail().x > runApartFrom * ImGui::GetFontSize();
    const auto controls = [&] {
        asked = requestControls(view, state);
        if (!apart) run();
    };
    constexpr float plotLines = 14, tableLines = 14;
    std::vector<Column> columns = {{"Settings", 1.15f, 0, controls},
                                   {"Cost against error", 1.2f, points.empty() ? 4.0f : plotLines, plot},
                                   {"Points", 1.6f, points.empty() ? 3.0f : tableLines, table}};
    if (apart) columns.insert(columns.begin() + 1, Column{"Run", 0.9f, 0, run});
    drawColumns("sweep", columns);
}

}  // namespace ui
