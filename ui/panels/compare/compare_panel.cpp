#include "ui/panels/compare/compare_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "app/base/percent_text.h"
#include "app/base/text.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/compare_order.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

using With = StartCompare::With;

// Draws a combo whose first item is its question. Returns the index of the item chosen, from 0, or -1.
int asked(const char* name, const char* question, const std::vector<std::string>& items, const char* noneText,
          const char* explanation) {
    std::string list = question + std::string(1, '\0');
    for (const std::string& item : items) list += item + std::string(1, '\0');
    list += '\0';
    int index = 0;
    beginGrey(items.empty(), noneText);
    ImGui::SetNextItemWidth(-1);
    const bool chosen = combo(name, index, list.c_str());
    tooltip(explanation);
    endGrey();
    return chosen ? index - 1 : -1;
}

void chooseB(const EditorView& view, Commands& commands) {
    if (button(view.compare.on ? "Replace B by snapshot" : "Snapshot as B",
               "Takes a snapshot of the current settings as B, a second planet from the same file. Later "
               "changes affect A. Doubles the memory."))
        commands.push_back(StartCompare{});
    if (view.data.hasPreviousBake) {
        sameLineIfRoom(ImGui::CalcTextSize("Other bake as B").x + ImGui::GetFontSize());
        if (button("Other bake as B", "Uses the bake that is not shown, with the current settings."))
            commands.push_back(StartCompare{With::PreviousBake, {}, {}});
    }
    std::vector<std::string> presets, files;
    for (const PresetView& preset : view.settings.presets) presets.push_back(preset.name);
    for (const std::filesystem::path& file : view.data.recent) files.push_back(file.filename().string());
    const int preset = asked("Preset as B", "A preset as B...", presets, "No presets.",
                             "B uses the current settings with the preset applied.");
    if (preset >= 0)
        commands.push_back(
            StartCompare{With::Preset, view.settings.presets[static_cast<std::size_t>(preset)].name, {}});
    const int file = asked("File as B", "A file as B...", files, "No recent files.",
                           "Recently opened chunk files or baked sources. The radius must match, because one "
                           "camera shows both.");
    if (file >= 0)
        commands.push_back(StartCompare{With::File, {}, view.data.recent[static_cast<std::size_t>(file)]});
    if (button("Choose a file as B...", "Shows a dialog. The radius must match that of A."))
        commands.push_back(AskForFile{FilePurpose::SideB});
}

// Returns the text, or its beginning and dots if it is wider than the room.
std::string fittingText(const std::string& text, float room) {
    const auto width = [](const std::string& part) { return ImGui::CalcTextSize(part.c_str()).x; };
    if (width(text) <= room) return text;
    std::string part = text;
    while (!part.empty() && width(part + "...") > room) {
        // Removes a whole character of UTF-8.
        while (!part.empty() && (static_cast<unsigned char>(part.back()) & 0xC0u) == 0x80u) part.pop_back();
        if (!part.empty()) part.pop_back();
    }
    return part + "...";
}

void comparedCell(const std::string& text, const char* explanation = nullptr) {
    ImGui::TableNextColumn();
    const std::string shown = fittingText(text, ImGui::GetContentRegionAvail().x);
    ImGui::TextUnformatted(shown.c_str());
    if (explanation)
        tooltip(explanation);
    else if (shown != text)
        tooltip(text.c_str());
}

std::string widestWord(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) words.push_back(word);
    return widestText(words);
}

// Returns the number of lines that the names take, wrapped in the first column of a list table.
std::size_t wrappedLines(std::span<const std::string> names, std::span<const TableColumn> columns) {
    const float room = ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ScrollbarSize;
    const float width = columnWidths(columns, std::max(room, tableWidth(columns))).front();
    float lines = 0;
    for (const std::string& name : names)
        lines += ImGui::CalcTextSize(name.c_str(), nullptr, false, width).y / ImGui::GetFontSize();
    return static_cast<std::size_t>(std::ceil(lines));
}

void differencesTable(const CompareView& compare) {
    struct Row {
        std::array<std::string, 3> texts;
        std::array<const char*, 3> explanations{};
        std::string setting;  // its name in the settings file
        std::array<std::string, 2> values;
    };
    std::vector<Row> rows;
    if (compare.fileA != compare.fileB)
        rows.push_back({{"planet", compare.names[0], compare.names[1]},
                        {nullptr, compare.fileA.c_str(), compare.fileB.c_str()},
                        "file",
                        {compare.fileA.string(), compare.fileB.string()}});
    // File names are left out of the column widths: they may have any length, and their tooltips show the
    // paths.
    std::array<std::vector<std::string>, 2> values;
    std::vector<std::string> names, words;
    for (const SettingDifference& one : compare.different) {
        const auto [a, b] = shortNumberTexts(one.here, one.there);
        rows.push_back({{inFont(one.label), a, b}, {}, one.setting, {one.here, one.there}});
        values[0].push_back(a);
        values[1].push_back(b);
    }
    for (const Row& row : rows) {
        names.push_back(row.texts[0]);
        words.push_back(widestWord(row.texts[0]));
    }
    const std::string widestName = widestText(words);
    const std::string widestA = widestText(values[0]);
    const std::string widestB = widestText(values[1]);
    const std::array columns = {TableColumn{"Setting", 2, nullptr, widestName.c_str()},
                                TableColumn{"A", 1, nullptr, widestA.c_str()},
                                TableColumn{"B", 1, nullptr, widestB.c_str()}};
    if (!beginListTable("sides", columns, wrappedLines(names, columns))) return;
    const auto key = [&](std::size_t row, std::size_t column) {
        return textSortKey(rows[row].texts[column]);
    };
    tableRows(rows.size(), key, [&](std::size_t row) {
        ImGui::TableNextColumn();
        wrappedText(rows[row].texts[0], palette().text);
        for (std::size_t column = 1; column < columns.size(); ++column)
            comparedCell(rows[row].texts[column], rows[row].explanations[column]);
    });
    endTable(exportTable<Row>("compared settings", rows.size(), [&](std::size_t row) { return rows[row]; },
                              {{"setting", [](const Row& row) { return row.setting; }, true},
                               {"a", [](const Row& row) { return row.values[0]; }},
                               {"b", [](const Row& row) { return row.values[1]; }}}));
}

void sides(const CompareView& compare, Commands& commands) {
    wrappedText(fmt::format("A: live. B: {}.", compare.origin), palette().dim);
    if (compare.different.empty() && compare.fileA == compare.fileB)
        wrappedText("A and B are equal. Change a setting to change A.", palette().warning);
    else
        differencesTable(compare);
    if (button(
            "Swap A and B",
            "Swaps the settings and, if they differ, the files of A and B. Undo reverts only the settings."))
        commands.push_back(SwapCompare{});
    sameLineIfRoom(ImGui::CalcTextSize("End comparison").x + ImGui::GetFontSize());
    if (button("End comparison", "Closes B and frees its memory.")) commands.push_back(StopCompare{});
}

void pictureControls(const CompareView& compare, ViewSettings& settings) {
    const SettingControls control(settings);
    CompareSettings& shown = settings.compare;
    control(shown.mode);
    if (shown.mode == CompareMode::Difference) control(shown.gain);
    if (shown.mode == CompareMode::Wipe) control(shown.wipe);
    if (shown.mode == CompareMode::Flip) control(shown.showB);
    // The rows stay if nothing is counted, so that the controls below do not move.
    if (!compare.on || !beginValues("difference")) return;
    std::string pixels = "not counted";
    std::string largest = pixels;
    if (compare.difference) {
        const PictureDifferenceNow& now = *compare.difference;
        pixels = fmt::format("{} ({})", now.pixels, percentText(now.pixels, now.of));
        largest = fmt::format("{} of 255", now.largestSteps);
    }
    valueRow("Pixels that differ", pixels,
             "Pixels that differ by more than one 8-bit step in any channel, including lines and tints. They "
             "are not counted while a picture waits for its shaders or is not shown.");
    valueRow("Max difference", largest, "Largest difference of any pixel and channel.");
    endValues();
}

bool isMeasured(const CompareRow& row) {
    return row.value == &ComparedFigures::worstErrorPx || row.value == &ComparedFigures::p99ErrorPx ||
           row.value == &ComparedFigures::violations || row.value == &ComparedFigures::crackPx ||
           row.value == &ComparedFigures::leakingPx;
}

// live: the figures of the current view; otherwise those of a flight.
void figuresTable(const char* id, const std::array<ComparedFigures, 2>& figures, bool live, bool stale) {
    std::vector<CompareRow> rows;
    std::copy_if(compareRows().begin(), compareRows().end(), std::back_inserter(rows),
                 [&](const CompareRow& row) { return live ? row.live : row.flight; });
    std::array<std::vector<std::string>, 4> texts;
    std::vector<std::string> names;
    for (const CompareRow& row : rows) {
        names.push_back(inFont(row.name));
        const auto& a = figures[0].*row.value;
        const auto& b = figures[1].*row.value;
        texts[0].push_back(widestWord(names.back()));
        texts[1].push_back(changeText(row, a, b));
        texts[2].push_back(figureText(row, a));
        texts[3].push_back(figureText(row, b));
    }
    std::array<std::string, 4> widest;
    std::transform(texts.begin(), texts.end(), widest.begin(),
                   [](const std::vector<std::string>& all) { return widestText(all); });
    // The ratio stands before A and B: a very narrow panel scrolls the last columns out of sight. Names are wrapped.
    const std::array columns = {
        TableColumn{"Figure", 1.5f, nullptr, widest[0].c_str()},
        TableColumn{"B / A", 1, "Ratio B / A, or the difference B - A if one of them is 0.",
                    widest[1].c_str()},
        TableColumn{"A", 1, "The planet shown in the window.", widest[2].c_str()},
        TableColumn{"B", 1, "The second planet.", widest[3].c_str()}};
    const std::size_t lines = wrappedLines(names, columns);
    if (!beginListTable(id, columns, lines, lines + 1, 1)) return;
    const auto key = [&](std::size_t row, std::size_t column) {
        return figureSortKey(rows[row], static_cast<FigureColumn>(column), figures);
    };
    tableRows(rows.size(), key, [&](std::size_t i) {
        const CompareRow& row = rows[i];
        const auto& a = figures[0].*row.value;
        const auto& b = figures[1].*row.value;
        const ImVec4 colour = live && stale && isMeasured(row) ? palette().dim : palette().text;
        ImGui::TableNextColumn();
        wrappedText(row.name, palette().dim);
        tooltip(row.explanation);
        for (const std::string& text : {changeText(row, a, b), figureText(row, a), figureText(row, b)}) {
            rightCell(text, colour);
            tooltip(row.explanation);
        }
    });
    // The names are those of worldy compare --json.
    const auto of = [&](std::size_t side) {
        return [&figures, side](const CompareRow& row) { return figures[side].*row.value; };
    };
    endTable(exportTable<CompareRow>(
        fmt::format("compare {}", id), rows.size(), [&](std::size_t row) { return rows[row]; },
        {{"figure", [](const CompareRow& row) { return row.key; }, true}, {"a", of(0)}, {"b", of(1)}}));
}

void nowSection(const CompareView& compare, Commands& commands) {
    if (!section("Now")) return;
    figuresTable("now", compare.now, true, compare.stale);
    beginGrey(compare.measuring, "The measurement is running.");
    if (button("Measure this view",
               "Measures the true error (in the background) and cracks of both for the current view."))
        commands.push_back(MeasureCompare{});
    endGrey();
    if (compare.measuring)
        usageBar(compare.measured, "measuring the true error");
    else if (compare.stale)
        wrappedText(
            "Out of date: the view or the settings have changed since true error and cracks were measured.",
            palette().dim);
}

void flightControls(const EditorView& view, ComparePanelState& state, Commands& commands) {
    const auto& flights = view.camera.flights;
    int chosen = 0;
    std::string names;
    for (std::size_t i = 0; i < flights.size(); ++i) {
        names += flightName(flights[i]) + std::string(1, '\0');
        if (flights[i] == state.flight) chosen = static_cast<int>(i);
    }
    names += '\0';
    ImGui::SetNextItemWidth(-1);
    if (combo("Flight", chosen, names.c_str())) state.flight = flights[static_cast<std::size_t>(chosen)];
    tooltip("Flight used for both.");
    slider("Sample frames", state.moments, 12, 2, 100, "%d",
           "Number of frames measured, evenly spread over the flight, with all chunks loaded; pops are "
           "measured over the whole flight. More: more reliable and slower.");
    beginGrey(!view.compare.on, "Choose a B first.");
    if (button("Measure over the flight",
               "Flies twice with the settings of A and twice with those of B in the background: once to "
               "measure frames, once with all loads on time to measure pops. worldy compare does the same "
               "without a window."))
        commands.push_back(CompareOverFlight{flights[static_cast<std::size_t>(chosen)], state.moments});
    endGrey();
}

void flightSection(const EditorView& view, ComparePanelState& state, Commands& commands) {
    if (!section("Over a flight")) return;
    const FlightComparisonView& flight = view.compare.flight;
    if (flight.running) {
        usageBar(flight.progress,
                 flight.stopping ? "cancelling" : fmt::format("{:.0f} %", 100 * flight.progress));
        beginGrey(flight.stopping, "Cancelling.");
        if (button("Cancel", "Cancels the measurement and discards its results."))
            commands.push_back(CancelCompareFlight{});
        endGrey();
    } else if (view.camera.flights.empty()) {
        wrappedText(
            "There are no flights. Record one in the Flight panel, or put TOML files into a folder "
            "\"flights\".",
            palette().dim);
    } else {
        flightControls(view, state, commands);
    }
    if (!flight.problem.empty()) wrappedText(flight.problem, palette().bad);
    if (flight.running || flight.last) wrappedText(flight.lastName, palette().dim);
    if (flight.last) figuresTable("flight", *flight.last, false, false);
}

}  // namespace

void comparePanel(const EditorView& view, ComparePanelState& state, ViewSettings& settings,
                  Commands& commands) {
    if (!view.planet) return emptyState("No planet is open. Open one to compare settings or bakes.");
    const CompareView& compare = view.compare;
    if (!compare.problem.empty()) wrappedText(compare.problem, palette().bad);
    if (!compare.on) {
        wrappedText(
            "Compare the shown planet (A) with a second one (B): take a snapshot as B and change A, or "
            "choose a preset or file as B.",
            palette().dim);
        chooseB(view, commands);
        const FlightComparisonView& flight = compare.flight;
        if (flight.running || flight.last || !flight.problem.empty()) flightSection(view, state, commands);
        return;
    }
    sides(compare, commands);
    pictureControls(compare, settings);
    nowSection(compare, commands);
    flightSection(view, state, commands);
    if (section("Change B")) chooseB(view, commands);
}

}  // namespace worldy::ui
