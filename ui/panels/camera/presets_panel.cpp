#include "ui/panels/camera/presets_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>

#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

namespace {

const PresetView* presetNamed(const EditorView& view, const std::string& name) {
    const auto found = std::find_if(view.settings.presets.begin(), view.settings.presets.end(),
                                    [&](const PresetView& preset) { return preset.name == name; });
    return found == view.settings.presets.end() ? nullptr : &*found;
}

std::string explanationOf(const PresetView& preset) {
    if (!preset.problem.empty()) return preset.problem;
    return fmt::format("{}\n{}\nDouble-click to load it. Undo reverts that.",
                       preset.shipped ? "Built-in." : "User preset.", preset.file.string());
}

// Returns the cell of the column "Changes".
std::string noteOf(const PresetView& preset) {
    if (!preset.problem.empty()) return "unreadable";
    if (preset.differences.empty()) return "current";
    return fmt::format("{}", preset.differences.size());
}

void presetRow(const PresetView& preset, PresetsPanelState& state, Commands& commands) {
    ImGui::TableNextColumn();
    ImGui::PushID(preset.file.c_str());
    const ImGuiSelectableFlags flags =
        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick;
    if (ImGui::Selectable(preset.name.c_str(), preset.name == state.selected, flags)) {
        state.selected = preset.name;
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && preset.problem.empty())
            commands.push_back(LoadPreset{preset.name});
    }
    noteItem(preset.name);
    tooltip(explanationOf(preset).c_str());
    ImGui::TableNextColumn();
    ImGui::TextColored(preset.problem.empty() ? palette().dim : palette().bad, "%s", noteOf(preset).c_str());
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", preset.shipped ? "built-in" : "user");
    ImGui::PopID();
}

void presetList(const EditorView& view, PresetsPanelState& state, Commands& commands) {
    if (view.settings.presets.empty()) {
        wrappedText("There are no presets.", palette().dim);
        return;
    }
    constexpr std::array columns = {
        TableColumn{"Name", 6, nullptr, "crack hunting"},
        TableColumn{"Changes", 1, "Number of current settings that it would change.", "unreadable"},
        TableColumn{"Origin", 0.5f, nullptr, "built-in"}};
    if (!beginListTable("presets", columns, view.settings.presets.size(), 16)) return;
    const auto key = [&](std::size_t row, std::size_t column) -> SortKey {
        const PresetView& preset = view.settings.presets[row];
        if (column == 0) return preset.name;
        if (column == 2) return preset.shipped ? 0.0 : 1.0;
        return preset.problem.empty() ? static_cast<double>(preset.differences.size()) : -1;
    };
    tableRows(view.settings.presets.size(), key,
              [&](std::size_t row) { presetRow(view.settings.presets[row], state, commands); });
    endTable(exportTable<PresetView>(
        "presets", view.settings.presets.size(), [&](std::size_t row) { return view.settings.presets[row]; },
        {{"name", [](const PresetView& preset) { return preset.name; }, true},
         {"changes", [](const PresetView& preset) { return preset.differences.size(); }},
         {"origin", [](const PresetView& preset) { return preset.shipped ? "built-in" : "user"; }},
         {"problem", [](const PresetView& preset) { return preset.problem; }}}));
}

// Returns why the name cannot be used, or null if it can. same: the preset that already has the name.
const char* saveRefusal(const PresetsPanelState& state, const PresetView* same) {
    if (state.name[0] == 0) return "Type a name first.";
    if (same && same->shipped) return "A built-in preset has this name and cannot be replaced.";
    if (same && !same->problem.empty()) return "A file with this name is not a preset; choose another name.";
    return nullptr;
}

void saveControl(const EditorView& view, PresetsPanelState& state, Commands& commands) {
    const PresetView* same = presetNamed(view, state.name.data());
    const char* label = same ? "Replace" : "Save";
    const float room = ImGui::CalcTextSize("Replace").x + 2 * ImGui::GetStyle().FramePadding.x +
                       ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - room, ImGui::GetFontSize() * 4));
    const bool entered = ImGui::InputTextWithHint("##name", "Preset name", state.name.data(),
                                                  state.name.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    noteItem("Name");
    tooltip("Used as the file name: letters, digits, spaces, dots and dashes, up to 60 bytes.");
    ImGui::SameLine();
    const char* const refused = saveRefusal(state, same);
    beginGrey(refused != nullptr, refused);
    const bool pressed =
        button(label, refused ? refused : "Saves all current view settings under this name.");
    endGrey();
    // Enter does not replace a preset; only the button does.
    if (!pressed && !(entered && !same)) return;
    if (refused) return;
    commands.push_back(SavePreset{state.name.data()});
    state.selected = state.name.data();
    state.name.fill(0);
}

void deleteControl(const PresetView& preset, Commands& commands) {
    beginGrey(preset.shipped, "Built-in presets cannot be deleted.");
    if (button("Delete...", preset.shipped ? "Built-in presets cannot be deleted."
                                           : "Deletes the file after confirmation."))
        ImGui::OpenPopup("delete");
    endGrey();
    if (!ImGui::BeginPopup("delete")) return;
    ImGui::Text("Delete \"%s\" permanently?", preset.name.c_str());
    if (ImGui::Button("Delete")) {
        commands.push_back(DeletePreset{preset.name});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void textCell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
    // Texts that are too long for the column get a tooltip.
    if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x) tooltip(text.c_str());
}

void differencesTable(const PresetView& preset) {
    std::vector<std::array<std::string, 3>> rows;
    std::array<std::vector<std::string>, 2> values;
    for (const SettingDifference& difference : preset.differences) {
        const auto [now, then] = shortNumberTexts(difference.here, difference.there);
        rows.push_back({inFont(difference.label), now, then});
        values[0].push_back(now);
        values[1].push_back(then);
    }
    const std::string widestNow = widestText(values[0]);
    const std::string widestThen = widestText(values[1]);
    const std::array columns = {TableColumn{"Setting", 2},
                                TableColumn{"Current", 1, nullptr, widestNow.c_str()},
                                TableColumn{"Preset", 1, nullptr, widestThen.c_str()}};
    if (!beginListTable("differences", columns, rows.size())) return;
    const auto key = [&](std::size_t row, std::size_t column) { return textSortKey(rows[row][column]); };
    tableRows(rows.size(), key, [&](std::size_t row) {
        for (const std::string& text : rows[row]) textCell(text);
    });
    using Difference = SettingDifference;
    endTable(exportTable<Difference>("preset changes", rows.size(),
                                     [&](std::size_t row) { return preset.differences[row]; },
                                     {{"setting", [](const Difference& d) { return d.setting; }, true},
                                      {"current", [](const Difference& d) { return d.here; }},
                                      {"preset", [](const Difference& d) { return d.there; }}}));
}

void selectedSection(const EditorView& view, const PresetsPanelState& state, Commands& commands) {
    const PresetView* preset = presetNamed(view, state.selected);
    if (!preset) {
        wrappedText("Select a preset to compare it with the current settings.", palette().dim);
        return;
    }
    const bool readable = preset->problem.empty();
    beginGrey(!readable || preset->differences.empty(),
              readable ? "The preset equals the current settings." : "The preset cannot be read.");
    if (button("Load", "Applies the settings listed below. Undo reverts this."))
        commands.push_back(LoadPreset{preset->name});
    endGrey();
    ImGui::SameLine();
    deleteControl(*preset, commands);
    if (!readable) {
        wrappedText(preset->problem, palette().bad);
    } else if (preset->differences.empty()) {
        wrappedText("The preset equals the current settings.", palette().dim);
    } else {
        differencesTable(*preset);
    }
}

}  // namespace

void presetsPanel(const EditorView& view, PresetsPanelState& state, Commands& commands) {
    beginGrey(!view.planet, "Open a planet first.");
    if (button("Copy as command line",
               withKey("Copies a worldy shot command that draws this view with these settings.",
                       "copy_command_line")
                   .c_str()))
        commands.push_back(CopyCommandLine{});
    endGrey();
    sameLineForButton("Reset all settings");
    if (button("Reset all settings", "Resets all view settings to their defaults. Undo reverts this."))
        commands.push_back(LoadPreset{"default"});
    ImGui::Spacing();
    presetList(view, state, commands);
    saveControl(view, state, commands);
    if (section("Changes")) selectedSection(view, state, commands);
}

}  // namespace worldy::ui
