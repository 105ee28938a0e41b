#include "ui/presets_panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "ui/item_map.h"
#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

const PresetView* presetNamed(const EditorView& view, const std::string& name) {
    const auto found = std::find_if(view.presets.begin(), view.presets.end(),
                                    [&](const PresetView& preset) { return preset.name == name; });
    return found == view.presets.end() ? nullptr : &*found;
}

std::string explanationOf(const PresetView& preset) {
    if (!preset.problem.empty()) return preset.problem;
    return fmt::format("{}\n{}\nA double click loads it. Undo takes that back.",
                       preset.shipped ? "Comes with Worldy." : "One of your own.", preset.file.string());
}

// What stands at the right of a preset's name.
std::string noteOf(const PresetView& preset) {
    if (!preset.problem.empty()) return "cannot be read";
    if (preset.differences.empty()) return "as now";
    return fmt::format("{} differ{}", preset.differences.size(), preset.differences.size() == 1 ? "s" : "");
}

void presetRow(const PresetView& preset, PresetsPanelState& state, Commands& commands) {
    ImGui::TableNextRow();
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
    ImGui::TextDisabled("%s", preset.shipped ? "shipped" : "own");
    ImGui::TableNextColumn();
    ImGui::TextColored(preset.problem.empty() ? palette().dim : palette().bad, "%s", noteOf(preset).c_str());
    ImGui::PopID();
}

void presetList(const EditorView& view, PresetsPanelState& state, Commands& commands) {
    if (view.presets.empty()) {
        wrappedText("There are no presets yet.", palette().dim);
        return;
    }
    if (!ImGui::BeginTable("presets", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("whose");
    ImGui::TableSetupColumn("note");
    for (const PresetView& preset : view.presets) presetRow(preset, state, commands);
    ImGui::EndTable();
}

void saveControl(const EditorView& view, PresetsPanelState& state, Commands& commands) {
    const PresetView* same = presetNamed(view, state.name.data());
    const char* label = same ? "Replace" : "Save";
    const float room = ImGui::CalcTextSize("Replace").x + 2 * ImGui::GetStyle().FramePadding.x +
                       ImGui::GetStyle().ItemSpacing.x;
    ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - room, ImGui::GetFontSize() * 4));
    const bool entered = ImGui::InputTextWithHint("##name", "name of a new preset", state.name.data(),
                                                  state.name.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    noteItem("Name");
    tooltip("A file's name too: letters, digits, spaces, dots and dashes, up to 60 bytes.");
    ImGui::SameLine();
    ImGui::BeginDisabled(state.name[0] == 0 || (same && same->shipped));
    const bool pressed = button(
        label, same && same->shipped ? "A preset of this name comes with Worldy and stays as it is."
                                     : "Keeps all settings of the view, as they are now, under this name.");
    ImGui::EndDisabled();
    // Enter replaces nothing: that wants the button's word for it.
    if (!pressed && !(entered && !same)) return;
    if (state.name[0] == 0) return;
    commands.push_back(SavePreset{state.name.data()});
    state.selected = state.name.data();
    state.name.fill(0);
}

void deleteControl(const PresetView& preset, Commands& commands) {
    ImGui::BeginDisabled(preset.shipped);
    if (button("Delete...", preset.shipped ? "It comes with Worldy and cannot be deleted."
                                           : "Removes the file, once you have said so again."))
        ImGui::OpenPopup("delete");
    ImGui::EndDisabled();
    if (!ImGui::BeginPopup("delete")) return;
    ImGui::Text("Delete \"%s\" for good?", preset.name.c_str());
    if (ImGui::Button("Delete")) {
        commands.push_back(DeletePreset{preset.name});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (ImGui::Button("Keep")) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

void textCell(const std::string& text) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(text.c_str());
    // What is too long for its column.
    if (ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x) tooltip(text.c_str());
}

void differencesTable(const PresetView& preset) {
    const ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV |
                                  ImGuiTableFlags_Resizable | ImGuiTableFlags_SizingStretchProp;
    if (!ImGui::BeginTable("differences", 3, flags)) return;
    ImGui::TableSetupColumn("Setting", 0, 2);
    ImGui::TableSetupColumn("Now", 0, 1);
    ImGui::TableSetupColumn("Preset", 0, 1);
    ImGui::TableHeadersRow();
    for (const SettingDifference& difference : preset.differences) {
        ImGui::TableNextRow();
        textCell(difference.setting);
        textCell(difference.here);
        textCell(difference.there);
    }
    ImGui::EndTable();
}

void selectedSection(const EditorView& view, const PresetsPanelState& state, Commands& commands) {
    const PresetView* preset = presetNamed(view, state.selected);
    if (!preset) {
        wrappedText("Choose a preset to compare it with the settings as they are.", palette().dim);
        return;
    }
    const bool readable = preset->problem.empty();
    ImGui::BeginDisabled(!readable || preset->differences.empty());
    if (button("Load", "Changes the settings listed below, and no others. Undo takes it back."))
        commands.push_back(LoadPreset{preset->name});
    ImGui::EndDisabled();
    ImGui::SameLine();
    deleteControl(*preset, commands);
    if (!readable) {
        wrappedText(preset->problem, palette().bad);
    } else if (preset->differences.empty()) {
        wrappedText("All that it holds is as it is now.", palette().dim);
    } else {
        differencesTable(*preset);
    }
}

}  // namespace

void presetsPanel(const EditorView& view, PresetsPanelState& state, ViewSettings&, Commands& commands) {
    ImGui::BeginDisabled(!view.planet);
    if (button("Copy as command line",
               "The worldy shot line that draws this view with these settings, for a shell (Ctrl+Shift+C)."))
        commands.push_back(CopyCommandLine{});
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (button("Reset everything", "All settings of the view to their defaults. Undo takes it back."))
        commands.push_back(LoadPreset{"default"});
    ImGui::Spacing();
    presetList(view, state, commands);
    saveControl(view, state, commands);
    if (section("Compared with now")) selectedSection(view, state, commands);
}

}  // namespace ui
