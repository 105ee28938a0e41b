#include "ui/panels/sweep/suggest_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/flight/flight_record.h"
#include "app/measure/sweep_points.h"
#include "app/suggest/suggest_budget.h"
#include "app/suggest/suggest_report.h"
#include "app/suggest/suggest_search.h"
#include "planet/bake/bake_settings.h"
#include "planet/base/result.h"
#include "planet/planet.h"
#include "ui/kit/columns.h"
#include "ui/kit/front_chart.h"
#include "ui/kit/item_map.h"
#include "ui/kit/plots.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

constexpr double bytesOfMiB = 1 << 20;

double figureOf(const SuggestTrial& trial, SuggestLimit limit) {
    return trial.figures.values[static_cast<std::size_t>(limit)];
}

const SuggestView& suggestOf(const EditorView& view) {
    return view.instruments.suggest;
}

// The request.

struct BudgetField {
    const char* label;
    const char* explanation;
};
constexpr std::array<BudgetField, suggestLimitCount> budgetFields = {{
    {"Frame time",
     "Time of a frame on this machine, selecting and drawing. It is measured by drawing in the background; "
     "the window draws meanwhile, which disturbs it. worldy suggest measures it undisturbed, or takes the "
     "cost of another machine."},
    {"Triangles", "Drawn triangles of a frame, skirts included. \"20 k\" and \"1.5 M\" are read too."},
    {"Memory",
     "Memory of the chunks that are resident or that a frame needs. The budget of the paging follows it."},
    {"Drawn error",
     "Bound of the distance between the drawn surface and the finest data on screen, morphs included."},
}};

// Returns a value without the word "triangles", which the label beside it says.
std::string suggestCellText(SuggestLimit limit, double value) {
    constexpr std::string_view counted = " triangles";
    std::string text = limitText(limit, value);
    if (text.ends_with(counted)) text.resize(text.size() - counted.size());
    return text;
}

// Edits a budget as text with its unit. A text that cannot be read stays, and the budget stays as it was.
void budgetEdit(std::size_t i, SuggestPanelState& state) {
    const SuggestLimit limit = suggestLimits[i];
    const double scale = limit == SuggestLimit::ResidentBytes ? bytesOfMiB : 1;
    SuggestBudgetEdit& edit = state.edits[i];
    if (!edit.isOpen) {
        edit.text.fill('\0');
        suggestCellText(limit, state.limits[i] * scale).copy(edit.text.data(), edit.text.size() - 1);
    }
    if (ImGui::InputText("##limit", edit.text.data(), edit.text.size(), ImGuiInputTextFlags_AutoSelectAll)) {
        edit.isOpen = true;
        const planet::Result<double> value = limitFromText(limit, edit.text.data());
        edit.problem = value ? std::string() : value.error().message;
        if (value) state.limits[i] = *value / scale;
    }
    if (!ImGui::IsItemActive() && edit.problem.empty()) edit.isOpen = false;
}

bool isUnreadable(const SuggestPanelState& state, std::size_t i) {
    return state.on[i] && !state.edits[i].problem.empty();
}

void budgetControls(SuggestPanelState& state) {
    float labelWidth = 0;
    for (const BudgetField& field : budgetFields)
        labelWidth = std::max(labelWidth, ImGui::CalcTextSize(field.label).x);
    for (std::size_t i = 0; i < suggestLimitCount; ++i) {
        const BudgetField& field = budgetFields[i];
        ImGui::PushID(field.label);
        ImGui::Checkbox("##on", &state.on[i]);
        noteItem(fmt::format("Limit {}", field.label));
        tooltip(field.explanation);
        ImGui::SameLine();
        const float labelX = ImGui::GetCursorPosX();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(field.label);
        tooltip(field.explanation);
        ImGui::SameLine(labelX + labelWidth + ImGui::GetStyle().ItemInnerSpacing.x);
        ImGui::SetNextItemWidth(-1);
        beginGrey(!state.on[i], "This budget is off.");
        budgetEdit(i, state);
        noteItem(field.label);
        tooltip(field.explanation);
        endGrey();
        if (isUnreadable(state, i)) wrappedText(state.edits[i].problem, palette().warning);
        ImGui::PopID();
    }
}

std::vector<std::filesystem::path> flightsToChoose(const EditorView& view) {
    std::vector<std::filesystem::path> all(view.camera.flights.begin(), view.camera.flights.end());
    for (const RecordedFlight& recorded : view.recording.flights) {
        if (std::ranges::find(all, recorded.file) == all.end()) all.push_back(recorded.file);
    }
    return all;
}

void flightControls(const std::vector<std::filesystem::path>& flights, SuggestPanelState& state) {
    for (const std::filesystem::path& file : flights) {
        bool isChosen = state.flights.contains(file.string());
        const std::string name = flightName(file);
        if (ImGui::Checkbox(fmt::format("{}##{}", name, file.string()).c_str(), &isChosen)) {
            if (isChosen)
                state.flights.insert(file.string());
            else
                state.flights.erase(file.string());
        }
        noteItem(fmt::format("Flight {}", name));
        tooltip(
            isFlightRecord(file)
                ? "Measures the very views of this recording if it is of the open chunk file, and otherwise "
                  "30 frames in a second along its path."
                : "Measures every frame of this flight, 30 in a second.");
    }
    ImGui::Checkbox("whole planet", &state.surveys);
    noteItem("whole planet");
    tooltip("Measures 300 viewpoints of the whole planet, 200 m, 5 km and 50 km up, where it differs most.");
}

// Returns the next smaller and the next larger chunk size, as far as the faces allow.
std::vector<int> otherChunkSizes(const planet::PlanetShape& shape) {
    const auto own = std::ranges::find(planet::chunkSizes, planet::chunkSize(shape));
    std::vector<int> others;
    if (own != planet::chunkSizes.begin()) others.push_back(*std::prev(own));
    if (std::next(own) != planet::chunkSizes.end() && *std::next(own) - 1 <= planet::faceCells(shape))
        others.push_back(*std::next(own));
    return others;
}

void chunkSizeControl(const EditorView& view, SuggestPanelState& state) {
    const char* const label = "chunk size";
    sameLineIfRoom(checkboxWidth(label));
    const bool canBake = view.planet && view.bake.canBake;
    const char* const problem =
        "The source of this file is unknown or missing, so its chunk size cannot vary. Open the source "
        "itself.";
    bool on = state.variesChunkSize && canBake;
    beginGrey(!canBake, problem);
    if (ImGui::Checkbox(label, &on)) state.variesChunkSize = on;
    noteItem(fmt::format("Vary {}", label));
    endGrey();
    if (!canBake) return tooltip(problem);
    tooltip(fmt::format("Also measures chunks of {} vertices per side. They are baked into the cache first, "
                        "without colours, unless they are there.",
                        fmt::join(otherChunkSizes(view.planet->tree().shape), " and "))
                .c_str());
}

void varyControls(const EditorView& view, SuggestPanelState& state) {
    const auto box = [](const char* label, bool& value, const char* explanation) {
        ImGui::Checkbox(label, &value);
        noteItem(fmt::format("Vary {}", label));
        tooltip(explanation);
    };
    box("metric", state.vary.metric, "The metric of errors may change.");
    sameLineIfRoom(checkboxWidth("morph range"));
    box("morph range", state.vary.morph, "The range of the morph may change.");
    sameLineIfRoom(checkboxWidth("regions"));
    box("regions", state.vary.regions,
        "Regions may give the places, or the band of ground heights, that cost most a larger tolerance of "
        "their own.");
    chunkSizeControl(view, state);
}

SuggestBudget budgetOf(const SuggestPanelState& state) {
    SuggestBudget budget;
    for (const SuggestLimit limit : suggestLimits) {
        const auto i = static_cast<std::size_t>(limit);
        if (state.on[i])
            budget[limit] = state.limits[i] * (limit == SuggestLimit::ResidentBytes ? bytesOfMiB : 1);
    }
    return budget;
}

const char* suggestStageText(SuggestStage stage) {
    switch (stage) {
        case SuggestStage::Surveying:
            return "Surveying the planet";
        case SuggestStage::Baking:
            return "Baking other chunk sizes";
        case SuggestStage::Timing:
            return "Timing frames";
        case SuggestStage::Searching:
            return "Searching";
        case SuggestStage::Verifying:
            return "Measuring the result again";
        case SuggestStage::Drawing:
            return "Drawing the worst places";
    }
    return "";
}

void suggestProgress(const SuggestView& suggest, Commands& commands) {
    beginGrey(suggest.cancelling, "The search is ending.");
    if (button("Cancel", "Ends the search without a result.")) commands.push_back(CancelSuggest{});
    endGrey();
    const SuggestProgress& p = suggest.progress;
    const bool searches = p.stage == SuggestStage::Searching;
    const double share = searches ? (static_cast<double>(p.measured) + p.share) /
                                        static_cast<double>(std::max<std::size_t>(p.measured + p.ahead, 1))
                                  : p.share;
    usageBar(std::min(share, 1.0), suggestStageText(p.stage));
    if (!suggest.planet.empty()) wrappedText(fmt::format("For {}.", suggest.planet), palette().dim);
    if (p.stage == SuggestStage::Baking)
        wrappedText(fmt::format("Chunks of {} are baked into the cache.", p.candidate.chunkSize),
                    palette().dim);
    if (!searches) return;
    std::string text = fmt::format("{} measured, at most {} more: {}", p.measured, p.ahead,
                                   candidateText(p.candidate, tauSymbol()));
    if (p.leftS) text += fmt::format("; at most {} left", durationText(*p.leftS));
    wrappedText(text, palette().dim);
}

void startControl(const EditorView& view, const SuggestPanelState& state,
                  const std::vector<std::filesystem::path>& all, Commands& commands) {
    StartSuggest start{.budget = budgetOf(state)};
    start.size = {std::max(view.camera.renderView.widthPx, 16),
                  std::max(view.camera.renderView.heightPx, 16)};
    for (const std::filesystem::path& file : all) {
        if (state.flights.contains(file.string())) start.flights.push_back(file);
    }
    bool isRead = true;
    for (std::size_t i = 0; i < suggestLimitCount; ++i) isRead = isRead && !isUnreadable(state, i);
    const char* problem = !view.planet             ? "No planet is open."
                          : !isRead                ? "Correct the budget that cannot be read."
                          : start.budget.isEmpty() ? "Turn a budget on."
                          : start.flights.empty() && !state.surveys ? "Choose a flight or the whole planet."
                                                                    : "";
    beginGrey(*problem != '\0', problem);
    if (button("Suggest",
               "Searches settings that meet the budgets, in the background, from the current settings.")) {
        start.surveys = state.surveys;
        start.vary = state.vary;
        if (state.variesChunkSize && view.bake.canBake)
            start.chunkSizes = otherChunkSizes(view.planet->tree().shape);
        commands.push_back(start);
    }
    endGrey();
    if (*problem != '\0') wrappedText(problem, palette().dim);
    if (view.planet)
        wrappedText(
            fmt::format("Measured at the viewport's size and field of view: {}x{} pixels, {:.4g}\u00b0. "
                        "Recordings of this file keep their own.",
                        start.size.widthPx, start.size.heightPx,
                        glm::degrees(view.camera.renderView.horizontalFovRad)),
            palette().dim);
}

void suggestRequest(const EditorView& view, SuggestPanelState& state, Commands& commands) {
    const SuggestView& suggest = suggestOf(view);
    const std::vector<std::filesystem::path> flights = flightsToChoose(view);
    if (!state.hasChosen && !flights.empty()) {
        state.flights = {flights.front().string()};
        state.hasChosen = true;
    }
    // The button comes first, so that it stays in view in a low dock.
    if (suggest.running)
        suggestProgress(suggest, commands);
    else
        startControl(view, state, flights, commands);
    if (!suggest.problem.empty()) wrappedText(suggest.problem, palette().warning);
    budgetControls(state);
    wrappedText("Measured over:", palette().dim);
    flightControls(flights, state);
    wrappedText(fmt::format("May vary besides {}:", tauSymbol()), palette().dim);
    varyControls(view, state);
}

// The candidates.

double plottedCostShare(const SuggestView& suggest, const SuggestTrial& trial) {
    const double cost = suggest.budget.limitsCosts() ? mostCostUse(suggest.budget, trial.figures.values)
                                                     : figureOf(trial, SuggestLimit::Triangles);
    return std::clamp(cost, 1e-3, 1e12);
}

void suggestPlot(const SuggestView& suggest, SuggestPanelState& state) {
    if (suggest.trials.empty())
        return emptyState(suggest.running
                              ? "Measuring the first candidate."
                              : "Press Suggest to plot the cost of each candidate against its error.");
    // Candidates whose error is not known, because a view was not loaded in time, have no place in the plot.
    std::vector<std::size_t> plotted;
    for (std::size_t i = 0; i < suggest.trials.size(); ++i)
        if (!std::isnan(figureOf(suggest.trials[i], SuggestLimit::ErrorPx))) plotted.push_back(i);
    if (plotted.empty())
        return emptyState("No candidate had all its views loaded in time, so their costs are not known.");
    std::vector<FrontPoint> points;
    // A series of each point, because a line through candidates would say nothing. The first of each kind is in the legend.
    std::vector<FrontSeries> series;
    std::array<bool, 2> isNamed{};
    for (const std::size_t index : plotted) {
        const SuggestTrial& trial = suggest.trials[index];
        const bool isWhole = trial.scope == SuggestScope::Whole;
        const bool isBest =
            suggest.outcome && trial.candidate == suggest.outcome->found.best.candidate && isWhole;
        const ImVec4 colour = isWhole ? seriesColour(0) : palette().dim;
        points.push_back({std::clamp(figureOf(trial, SuggestLimit::ErrorPx), 0.01, 1e6),
                          plottedCostShare(suggest, trial), isBest ? palette().good : colour,
                          isBest ? fmt::format("{:.3g}", trial.candidate.tauPx) : std::string(), isBest});
        const bool isFirst = !std::exchange(isNamed[isWhole ? 1 : 0], true);
        const char* const name = !isFirst ? "" : isWhole ? "all frames" : "samples";
        series.push_back({name, colour, {points.size() - 1}});
    }
    const auto tell = [&](std::size_t point) {
        const SuggestTrial& trial = suggest.trials[plotted[point]];
        ImGui::TextUnformatted(candidateText(trial.candidate, tauSymbol()).c_str());
        for (const SuggestLimit limit : suggestLimits) {
            if (std::isnan(figureOf(trial, limit))) continue;
            ImGui::TextUnformatted(
                fmt::format("{}: {}", textOf(limit).name, limitText(limit, figureOf(trial, limit))).c_str());
        }
        ImGui::TextDisabled("%s",
                            trial.scope == SuggestScope::Whole ? "all frames" : "a sample of the frames");
    };
    const auto chosen = std::ranges::find(plotted, state.selected);
    const auto chosenPoint = chosen == plotted.end()
                                 ? std::nullopt
                                 : std::optional(static_cast<std::size_t>(chosen - plotted.begin()));
    const auto clicked = frontChart(
        {.name = "suggest plot",
         .costName = suggest.budget.limitsCosts() ? "share_of_budget" : "triangles",
         .points = points,
         .series = series,
         .errorName = "drawn error, px",
         .shortErrorName = "error, px",
         .costTitle = suggest.budget.limitsCosts() ? "share of the budget" : "triangles",
         .explanation =
             "One point per candidate: the drawn error on the horizontal axis and the largest share of "
             "a budget of costs on the vertical axis, both logarithmic. 1 is the budget. Ringed: the "
             "suggestion, labelled with its tolerance.",
         .tell = tell},
        chosenPoint);
    if (clicked) state.selected = plotted[*clicked];
}

constexpr std::array suggestColumns = {
    TableColumn{"\u03c4", 0.6f, "Tolerance, pixels.", "0.123"},
    TableColumn{"Metric", 0.8f, "Metric of errors.", "additive"},
    TableColumn{"Morph", 0.6f, "Morph range, a share of \u03c4.", "0.15"},
    TableColumn{"Chunks", 0.6f, "Vertices along a side of a chunk.", "129"},
    TableColumn{"Regions", 0.8f, "Regions with a larger \u03c4, and its factor.", "heights x 1.7"},
    TableColumn{"Frames", 0.7f, "All frames, or a sample of them.", "sample"},
    TableColumn{"Triangles", 0.9f, "99.9th percentile of the frames.", "99.9 M"},
    TableColumn{"Error", 0.9f, "Drawn error, 99.9th percentile of the frames.", "1.23e+05 px"},
    TableColumn{"Use", 0.7f, "Largest share of a budget; at most 1 if all are met.", "1.23e+03"},
};

void suggestTable(const SuggestView& suggest, SuggestPanelState& state) {
    if (suggest.trials.empty()) return emptyState("No candidates measured yet.");
    if (!beginWideTable("candidates", suggestColumns, 1)) return;
    const auto trialOf = [&](std::size_t row) -> const SuggestTrial& { return suggest.trials[row]; };
    const auto use = [&](const SuggestTrial& trial) { return mostUse(suggest.budget, trial.figures.values); };
    const auto chunkSizeOf = [&](const SuggestTrial& trial) {
        return trial.candidate.chunkSize > 0 ? trial.candidate.chunkSize : suggest.chunkSize;
    };
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const SuggestTrial& trial = trialOf(row);
        switch (column) {
            case 0:
                return trial.candidate.tauPx;
            case 1:
                return trial.candidate.metric == planet::ErrorMetric::Tight ? 1.0 : 0.0;
            case 2:
                return trial.candidate.morphRange;
            case 3:
                return static_cast<double>(chunkSizeOf(trial));
            case 4:
                return trial.candidate.plan;
            case 5:
                return trial.scope == SuggestScope::Whole ? 1.0 : 0.0;
            case 6:
                return figureOf(trial, SuggestLimit::Triangles);
            case 7:
                return figureOf(trial, SuggestLimit::ErrorPx);
            default:
                return use(trial);
        }
    };
    tableRows(suggest.trials.size(), key, [&](std::size_t row) {
        const SuggestTrial& trial = trialOf(row);
        const bool isMet = use(trial) <= 1;
        ImGui::TableNextColumn();
        if (ImGui::Selectable(fmt::format("{:.3g}##row", trial.candidate.tauPx).c_str(),
                              state.selected == row, ImGuiSelectableFlags_SpanAllColumns))
            state.selected = row;
        noteItem(fmt::format("Row {}", row));
        cell(std::string(metricName(trial.candidate.metric)));
        cell(fmt::format("{:g}", trial.candidate.morphRange));
        cell(fmt::format("{}", chunkSizeOf(trial)));
        cell(trial.candidate.regions.empty()
                 ? std::string("-")
                 : fmt::format("{} x {:g}", trial.candidate.plan,
                               trial.candidate.regions.front().tauFactor.value_or(1)));
        cell(trial.scope == SuggestScope::Whole ? "all" : "sample");
        cell(countText(figureOf(trial, SuggestLimit::Triangles)));
        cell(limitText(SuggestLimit::ErrorPx, figureOf(trial, SuggestLimit::ErrorPx)));
        cell(fmt::format("{:.3g}", use(trial)), isMet ? palette().good : palette().text);
    });
    using T = SuggestTrial;
    const std::vector<ExportField<T>> fields = {
        {"tau_px", [](const T& t) { return t.candidate.tauPx; }},
        {"metric", [](const T& t) { return metricName(t.candidate.metric); }},
        {"morph_range", [](const T& t) { return t.candidate.morphRange; }},
        {"chunk_size", [&chunkSizeOf](const T& t) { return chunkSizeOf(t); }},
        {"regions", [](const T& t) { return std::string_view(t.candidate.plan); }},
        {"all_frames", [](const T& t) { return t.scope == SuggestScope::Whole; }},
        {"triangles", [](const T& t) { return figureOf(t, SuggestLimit::Triangles); }},
        {"resident_bytes", [](const T& t) { return figureOf(t, SuggestLimit::ResidentBytes); }},
        {"error_px", [](const T& t) { return figureOf(t, SuggestLimit::ErrorPx); }},
        {"use", [&use](const T& t) { return use(t); }}};
    endTable(exportTable<T>("suggest", suggest.trials.size(), trialOf, fields));
}

// The result.

constexpr std::array suggestBudgetColumns = {TableColumn{"Budget", 1, nullptr, "Memory of chunks", false},
                                             TableColumn{"Limit", 1, nullptr, "1234 MiB", false},
                                             TableColumn{"Before", 1, nullptr, "1.234 MiB", false},
                                             TableColumn{"Suggested", 1, nullptr, "1.234 MiB", false},
                                             TableColumn{"Verdict", 1, nullptr, "exceeded by 123 %", false}};

void suggestBudgetTable(const SuggestOutcome& outcome) {
    const std::vector<SuggestRow> rows = rowsOf(outcome);
    if (!beginListTable("suggest budgets", suggestBudgetColumns, rows.size())) return;
    tableRows(rows.size(), [&](std::size_t i) {
        const SuggestRow& row = rows[i];
        const bool isMet = !row.budget || row.after <= *row.budget;
        cell(std::string(textOf(row.limit).name));
        cell(row.budget ? suggestCellText(row.limit, *row.budget) : "-");
        cell(suggestCellText(row.limit, row.before));
        cell(suggestCellText(row.limit, row.after));
        cell(row.verdict, isMet ? palette().text : palette().warning);
    });
    const auto rowOf = [&](std::size_t i) -> const SuggestRow& { return rows[i]; };
    const std::vector<ExportField<SuggestRow>> fields = {
        {"budget", [](const SuggestRow& row) { return textOf(row.limit).key; }},
        {"limit", [](const SuggestRow& row) { return row.budget.value_or(std::nan("")); }},
        {"before", [](const SuggestRow& row) { return row.before; }},
        {"suggested", [](const SuggestRow& row) { return row.after; }},
        {"verdict", [](const SuggestRow& row) { return std::string_view(row.verdict); }}};
    endTable(exportTable<SuggestRow>("suggest budgets", rows.size(), rowOf, fields));
}

void suggestResult(const EditorView& view, Commands& commands) {
    const SuggestView& suggest = suggestOf(view);
    if (!suggest.outcome)
        return emptyState(suggest.running ? "The search is running."
                                          : "The suggested settings will be here.");
    const SuggestOutcome& outcome = *suggest.outcome;
    const bool isLocked = view.recording.replay.has_value();
    const int otherChunks = outcome.found.best.candidate.chunkSize;
    if (!suggest.fitsPlanet)
        wrappedText(suggest.openPlanet.empty()
                        ? fmt::format("It is for {}, which is not open.", suggest.planet)
                        : fmt::format("It is for {}; {} is open.", suggest.planet, suggest.openPlanet),
                    palette().warning);
    beginGrey(isLocked || !suggest.fitsPlanet || keepsSettings(outcome),
              isLocked              ? "Settings are locked during a replay; end it first."
              : !suggest.fitsPlanet ? "Another planet is open."
              : outcome.isMet       ? "The settings of now already meet the budget."
                                    : "Nothing that was found is better than the settings of now.");
    if (button("Apply",
               otherChunks > 0
                   ? fmt::format("Sets the tolerance, the metric, the morph range, the memory budget and the "
                                 "suggested regions, turns the governor off, and opens the chunks of {} that "
                                 "were baked for the search. Undo reverts the settings.",
                                 otherChunks)
                         .c_str()
                   : "Sets the tolerance, the metric, the morph range, the memory budget and the suggested "
                     "regions, and turns the governor off. Undo reverts this."))
        commands.push_back(ApplySuggest{});
    endGrey();
    sameLineForButton("Save report");
    if (button(
            "Save report",
            "Saves the report as .md and as a page in .png, with the preset and the regions as .toml, beside "
            "the screenshots."))
        commands.push_back(SaveSuggest{});
    wrappedText(verdictText(outcome), outcome.isMet ? palette().good : palette().warning);
    suggestBudgetTable(outcome);
    for (const SettingDifference& change : outcome.changes)
        wrappedText(inFont(fmt::format("{}: {} \u2192 {}", change.setting, shortNumberText(change.here),
                                       shortNumberText(change.there))),
                    palette().text);
    std::vector<ValueRow> effects;
    for (const SuggestEffect& effect : effectsOf(outcome))
        effects.push_back({effect.name, inFont(fmt::format("{} \u2192 {}", effect.before, effect.after)),
                           "Before and with the suggestion."});
    valueRows("suggest effects", effects);
    for (std::size_t i = 0; i < outcome.places.size(); ++i) {
        const SuggestPlace& place = outcome.places[i];
        ImGui::PushID(static_cast<int>(i));
        beginGrey(!suggest.fitsPlanet, "Another planet is open.");
        if (ImGui::SmallButton("Go")) commands.push_back(MoveCamera{place.pose});
        noteItem(fmt::format("Go {}", i));
        tooltip("Flies to this place.");
        endGrey();
        ImGui::SameLine();
        wrappedText(placeCaption(place), palette().text);
        ImGui::PopID();
    }
    wrappedText(methodText(outcome), palette().dim);
}

}  // namespace

void suggestPanel(const EditorView& view, SuggestPanelState& state, Commands& commands) {
    const SuggestView& suggest = suggestOf(view);
    if (!view.planet && !suggest.outcome)
        return emptyState("No planet is open. Open one to search settings for a budget.");
    if (state.selected && *state.selected >= suggest.trials.size()) state.selected.reset();
    constexpr float plotLines = 12, tableLines = 12;
    const float font = ImGui::GetFontSize();
    const bool isEmpty = suggest.trials.empty();
    const std::array columns = {Column{.title = "Budget",
                                       .share = 1,
                                       .draw = [&] { suggestRequest(view, state, commands); },
                                       .wanted = 17 * font},
                                Column{.title = "Result",
                                       .share = 1.8f,
                                       .draw = [&] { suggestResult(view, commands); },
                                       .wanted = listTableWidth(suggestBudgetColumns) + font},
                                Column{.title = "Cost and error",
                                       .share = 1,
                                       .stackedLines = isEmpty ? 3.0f : plotLines,
                                       .draw = [&] { suggestPlot(suggest, state); },
                                       .wanted = 15 * font},
                                Column{.title = "Candidates",
                                       .share = 1.2f,
                                       .stackedLines = isEmpty ? 3.0f : tableLines,
                                       .draw = [&] { suggestTable(suggest, state); },
                                       .wanted = isEmpty ? 0 : listTableWidth(suggestColumns)}};
    drawColumns("suggest", columns);
}

}  // namespace worldy::ui
