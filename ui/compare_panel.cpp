#include "ui/compare_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <vector>

#include "ui/text.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

using With = StartCompare::With;

// A combo that asks: its first item is what it asks for. The item chosen, from 0, or -1.
int asked(const char* name, const char* question, const std::vector<std::string>& items,
          const char* explanation) {
    std::string list = question + std::string(1, '\0');
    for (const std::string& item : items) list += item + std::string(1, '\0');
    list += '\0';
    int index = 0;
    ImGui::BeginDisabled(items.empty());
    ImGui::SetNextItemWidth(-1);
    const bool chosen = combo(name, index, list.c_str());
    ImGui::EndDisabled();
    tooltip(explanation);
    return chosen ? index - 1 : -1;
}

void chooseB(const EditorView& view, Commands& commands) {
    if (button(view.compare.on ? "Keep settings as B again" : "Keep settings as B",
               "B is a second planet from the same file with the settings as they are now. What you change "
               "from then on changes A. Takes as much memory again."))
        commands.push_back(StartCompare{});
    if (view.data.hasPreviousBake) {
        sameLineIfRoom(ImGui::CalcTextSize("Other bake as B").x + ImGui::GetFontSize());
        if (button("Other bake as B", "The bake that is not shown now, with the settings as they are."))
            commands.push_back(StartCompare{With::PreviousBake, {}, {}});
    }
    std::vector<std::string> presets, files;
    for (const PresetView& preset : view.presets) presets.push_back(preset.name);
    for (const std::filesystem::path& file : view.data.recent) files.push_back(file.filename().string());
    const int preset = asked("Preset as B", "A preset as B...", presets,
                             "B has the settings as they are, but for those that the preset holds.");
    if (preset >= 0)
        commands.push_back(
            StartCompare{With::Preset, view.presets[static_cast<std::size_t>(preset)].name, {}});
    const int file = asked("File as B", "A file as B...", files,
                           "Files opened last: a chunk file, or a source that is baked already. Of the same "
                           "radius, since one camera looks at both.");
    if (file >= 0)
        commands.push_back(StartCompare{With::File, {}, view.data.recent[static_cast<std::size_t>(file)]});
}

void comparedCell(const std::string& text, const char* explanation = nullptr) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
    if (explanation)
        tooltip(explanation);
    else if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x)
        tooltip(text.c_str());
}

void differencesTable(const CompareView& compare) {
    const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                  ImGuiTableFlags_Resizable | ImGuiTableFlags_SizingStretchProp;
    if (!ImGui::BeginTable("sides", 3, flags)) return;
    ImGui::TableSetupColumn("Setting", 0, 2);
    ImGui::TableSetupColumn("A", 0, 1);
    ImGui::TableSetupColumn("B", 0, 1);
    ImGui::TableHeadersRow();
    if (compare.fileA != compare.fileB) {
        ImGui::TableNextRow();
        comparedCell("chunk file");
        comparedCell(compare.fileA.filename().string(), compare.fileA.c_str());
        comparedCell(compare.fileB.filename().string(), compare.fileB.c_str());
    }
    for (const SettingDifference& one : compare.different) {
        ImGui::TableNextRow();
        comparedCell(one.setting);
        comparedCell(one.here);
        comparedCell(one.there);
    }
    ImGui::EndTable();
}

void sides(const CompareView& compare, Commands& commands) {
    wrappedText(fmt::format("A is live. B: {}.", compare.origin), palette().dim);
    if (compare.different.empty() && compare.fileA == compare.fileB)
        wrappedText("Nothing differs yet. Change a setting: it changes A.", palette().warning);
    else
        differencesTable(compare);
    if (button("Swap A and B",
               "Exchanges settings and, where they differ, files. Undo takes back the settings alone."))
        commands.push_back(SwapCompare{});
    sameLineIfRoom(ImGui::CalcTextSize("End comparing").x + ImGui::GetFontSize());
    if (button("End comparing", "Closes B, and gives back its memory.")) commands.push_back(StopCompare{});
}

void pictureControls(const CompareView& compare, CompareKnobs& knobs) {
    const CompareKnobs defaults;
    choice("Show", knobs.mode, defaults.mode, "side by side\0wipe\0difference\0flip\0",
           "Side by side: the middle half of each picture, its pixels as large as in the others, so that no "
           "chunk is chosen otherwise. Wipe: a divider to drag. Difference: of the colours. Flip: one of "
           "them, F9 changes.");
    if (knobs.mode == CompareMode::Difference) {
        slider("Gain", knobs.gain, defaults.gain, 1.0, 255.0, "x %.0f",
               "The difference of each channel times this. 255: any difference is full light.",
               ImGuiSliderFlags_Logarithmic);
    }
    if (knobs.mode == CompareMode::Wipe) {
        slider("Divider", knobs.wipe, defaults.wipe, 0.0, 1.0, "%.2f",
               "A on its left, B on its right; share of the width. It can be dragged in the viewport too.");
    }
    if (knobs.mode == CompareMode::Flip)
        checkbox("Show B (F9)", knobs.showB, defaults.showB, "Else A is shown.");
    if (!compare.difference || !beginValues("difference")) return;
    const PictureDifferenceNow& now = *compare.difference;
    const double share =
        100.0 * static_cast<double>(now.pixels) / static_cast<double>(std::max<std::uint64_t>(now.of, 1));
    valueRow("Pixels that differ", fmt::format("{} ({:.2g}%)", now.pixels, share),
             "By more than one 8-bit step in some channel, lines and tints included.");
    valueRow("Largest difference", fmt::format("{} of 255", now.largestSteps), "Of any pixel and channel.");
    endValues();
}

void rightAligned(const std::string& text, const ImVec4& colour, const char* explanation) {
    ImGui::TableNextColumn();
    const float slack = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (slack > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + slack);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    tooltip(explanation);
}

bool isMeasured(const CompareRow& row) {
    return row.value == &ComparedFigures::worstErrorPx || row.value == &ComparedFigures::p99ErrorPx ||
           row.value == &ComparedFigures::violations || row.value == &ComparedFigures::crackPx ||
           row.value == &ComparedFigures::leakingPx;
}

// live: the table of the view as it is, else that of a flight.
void figuresTable(const char* id, const std::array<ComparedFigures, 2>& figures, bool live, bool stale) {
    if (!ImGui::BeginTable(id, 4, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) return;
    ImGui::TableSetupColumn("", 0, 1.6f);
    for (const char* title : {"A", "B"}) ImGui::TableSetupColumn(title, 0, 1);
    ImGui::TableSetupColumn("B to A", 0, 1.15f);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    rightAligned("A", palette().accent, "What the window shows.");
    rightAligned("B", palette().warning, "What it is compared with.");
    rightAligned("B to A", palette().dim,
                 "How many times A's it is, or the difference where one of them is 0.");
    for (const CompareRow& row : compareRows()) {
        if (!(live ? row.live : row.flight)) continue;
        const auto& a = figures[0].*row.value;
        const auto& b = figures[1].*row.value;
        const ImVec4 colour = live && stale && isMeasured(row) ? palette().dim : palette().text;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(palette().dim, "%s", row.name);
        tooltip(row.explanation);
        rightAligned(figureText(row, a), colour, row.explanation);
        rightAligned(figureText(row, b), colour, row.explanation);
        rightAligned(changeText(row, a, b), colour, row.explanation);
    }
    ImGui::EndTable();
}

void nowSection(const CompareView& compare, Commands& commands) {
    if (!section("Now")) return;
    figuresTable("now", compare.now, true, compare.stale);
    ImGui::BeginDisabled(compare.measuring);
    if (button("Measure this view",
               "True error, in the background, and cracks of both, of the view as it is. Takes moments."))
        commands.push_back(MeasureCompare{});
    ImGui::EndDisabled();
    if (compare.measuring)
        usageBar(compare.measured, "measuring the true error");
    else if (compare.stale)
        wrappedText("True error and cracks are of another view or other settings.", palette().dim);
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
    tooltip("The flight that both fly.");
    slider("Moments", state.moments, 12, 2, 100, "%d",
           "Of the flight, evenly spread, at which all but pops is measured, each settled. More: surer and "
           "slower.");
    ImGui::BeginDisabled(!view.compare.on);
    if (button("Measure over the flight",
               "Flies it twice with A's settings and twice with B's, in the background and without a window: "
               "once for what is drawn and once, with all loads on time, for pops. worldy compare does the "
               "same from a shell."))
        commands.push_back(CompareOverFlight{flights[static_cast<std::size_t>(chosen)], state.moments});
    ImGui::EndDisabled();
}

void flightSection(const EditorView& view, ComparePanelState& state, Commands& commands) {
    if (!section("Over a flight")) return;
    const FlightComparisonView& flight = view.compare.flight;
    if (flight.running) {
        usageBar(flight.progress,
                 flight.stopping ? "stopping" : fmt::format("{:.0f}%", 100 * flight.progress));
        ImGui::BeginDisabled(flight.stopping);
        if (button("Cancel", "Ends it; nothing of it is kept.")) commands.push_back(CancelCompareFlight{});
        ImGui::EndDisabled();
    } else if (view.camera.flights.empty()) {
        wrappedText("There is no flight: TOML files in a folder \"flights\", or one recorded.",
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
    if (!view.planet) return emptyState("No planet is open to be compared.");
    const CompareView& compare = view.compare;
    if (!compare.problem.empty()) wrappedText(compare.problem, palette().bad);
    if (!compare.on) {
        wrappedText(
            "What is shown, A, beside something else, B: keep the settings, then change some; or choose "
            "a preset or a file.",
            palette().dim);
        chooseB(view, commands);
        if (compare.flight.running || compare.flight.last) flightSection(view, state, commands);
        return;
    }
    sides(compare, commands);
    pictureControls(compare, settings.compare);
    nowSection(compare, commands);
    flightSection(view, state, commands);
    if (section("Another B")) chooseB(view, commands);
}

}  // namespace ui
