#include "ui/shell/help_windows.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "ui/kit/item_map.h"
#include "ui/kit/tables.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/shell/gamepad_actions.h"

namespace worldy::ui {

namespace {

void keyRow(const KeyHelp& help) {
    ImGui::TableNextColumn();
    ImGui::TextColored(palette().accent, "%s", help.keys.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(inFont(help.meaning).c_str());
}

void keyTable(const char* id, const char* title, std::span<const KeyHelp> keys) {
    ImGui::BeginGroup();
    ImGui::TextColored(palette().dim, "%s", title);
    if (beginPlainTable(id, 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_NoHostExtendX)) {
        for (std::size_t row = 0; row < keys.size(); ++row) tableRow(row, [&] { keyRow(keys[row]); });
        const auto keyOf = [&](std::size_t row) -> const KeyHelp& { return keys[row]; };
        endTable(exportTable<KeyHelp>(fmt::format("{} keys", id), keys.size(), keyOf,
                                      {{"key", [](const KeyHelp& help) { return help.keys; }, true},
                                       {"meaning", [](const KeyHelp& help) { return help.meaning; }, true}}));
    }
    ImGui::EndGroup();
}

float keyTableWidth(std::span<const KeyHelp> keys) {
    float names = 0;
    float meanings = 0;
    for (const KeyHelp& help : keys) {
        names = std::max(names, ImGui::CalcTextSize(help.keys.c_str()).x);
        meanings = std::max(meanings, ImGui::CalcTextSize(help.meaning.c_str()).x);
    }
    return names + meanings + 6 * ImGui::GetStyle().CellPadding.x;
}

bool beginHelpWindow(const char* title, bool& shown) {
    if (!shown) return false;
    const ImGuiViewport& viewport = *ImGui::GetMainViewport();
    ImGui::SetNextWindowPos(viewport.GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
    // The window scrolls if the text is too long for it.
    ImGui::SetNextWindowSizeConstraints({0, 0}, viewport.WorkSize);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::Begin(
        title, &shown,
        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse);
    return true;
}

void endHelpWindow() {
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
}

// A list of keys under a title.
struct KeyList {
    const char* id;
    const char* title;
    std::vector<KeyHelp> keys;
};
using KeyColumn = std::vector<KeyList>;  // lists one below the other

std::vector<KeyColumn> keyColumns(const ActionKeys& keys) {
    std::vector<KeyHelp> commands = commandKeys(keys);
    const auto firstPanel = std::ranges::find(commands, panelInfos[0].title, &KeyHelp::meaning);
    std::vector<KeyHelp> panels(firstPanel, commands.end());
    commands.erase(firstPanel, commands.end());
    return {{{"fixed", "Mouse and fixed keys", fixedKeys()},
             {"steering", "Gamepad and 3-D mouse", steeringHelp()}},
            {{"commands", "Commands", std::move(commands)}},
            {{"panels", "Panels: bring to the front, or hide", std::move(panels)}}};
}

void keysWindow(const ActionContext& context) {
    const ImVec2 at = ImGui::GetWindowPos();
    noteRect("Keys and mouse", {at.x, at.y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
    // The lists may be longer than the window.
    wrappedText("The keys of commands and panels can be changed in the file " + keyFilePath().string() + ".",
                palette().dim);
    if (button("Write key file", actionNamed("write_key_file").help.c_str()))
        context.commands.push_back(WriteKeyFile{});
    ImGui::SameLine();
    if (button("Reload keys", actionNamed("reload_keys").help.c_str()))
        context.commands.push_back(ReloadKeys{});
    ImGui::Separator();
    const float gap = 2 * ImGui::GetFontSize();
    const float room = ImGui::GetMainViewport()->WorkSize.x - 2 * gap;
    float used = 0;
    for (const KeyColumn& column : keyColumns(context.keys)) {
        float width = 0;
        for (const KeyList& list : column) width = std::max(width, keyTableWidth(list.keys));
        if (used > 0 && used + gap + width < room) {
            ImGui::SameLine(0, gap);
            used += gap + width;
        } else {
            used = width;
        }
        ImGui::BeginGroup();
        for (const KeyList& list : column) keyTable(list.id, list.title, list.keys);
        ImGui::EndGroup();
    }
}

}  // namespace

std::vector<KeyHelp> fixedKeys() {
    return {
        {"Left drag", "move across the planet"},
        {"Right drag", "look around"},
        {"Wheel", "zoom"},
        {"Wheel while a button is held", "change the speed"},
        {"Ctrl+wheel", "change the field of view"},
        {"Alt+left drag", "orbit the point under the pointer"},
        {"Alt+right drag", "move to the point under the pointer, or away"},
        {"Click", "select the chunk under the pointer"},
        {"W A S D, E Q", "fly; up and down"},
        {"I J K L", "turn"},
        {"+ -", "change the speed"},
        {"Tab, Shift+Tab", "next, previous field, slider or plot of a panel"},
        {"Arrows", "move through the controls of a panel"},
        {"Arrows, PageUp, PageDown in a plot", "move its cursor or view"},
        {"Space", "press a button, open a list, drag a slider with the arrows"},
        {"Enter", "press a button, choose from a list, type a number into a slider"},
        {"Ctrl+click on a slider", "type a number"},
        {"Right click on a setting", "reset to its default"},
        {"Double click on a tab", "maximise its dock, or restore it"},
        {"Drag a tab", "move the panel; with Ctrl it floats"},
        {"Double click on a chunk's name", "look at the chunk"},
        {"Ctrl+C over a table or plot", "copy its selected rows, or all"},
        {"Ctrl+click, Shift+click on a row", "select it; up to it"},
        {"Right click on a table or plot", "copy, save as CSV, TSV or PNG"},
    };
}

std::vector<KeyHelp> commandKeys(const ActionKeys& keys) {
    std::vector<KeyHelp> commands;
    std::vector<KeyHelp> panels;
    for (std::size_t i = 0; i < actions().size(); ++i) {
        const Action& action = actions()[i];
        if (!keys[i].empty()) (action.panel ? panels : commands).push_back({keysText(keys[i]), action.name});
    }
    commands.insert(commands.end(), panels.begin(), panels.end());
    return commands;
}

std::vector<KeyHelp> steeringHelp() {
    std::vector<KeyHelp> help = {
        {"Left stick", "fly"},
        {"Right stick", "look around"},
        {"Left, right trigger", "down, up"},
        {"3-D mouse, shifted", "fly; up and down"},
        {"3-D mouse, tilted or twisted", "look around"},
    };
    for (const ButtonAction& button : buttonActions())
        help.push_back({button.name, actionNamed(button.id).name});
    return help;
}

void helpWindows(const ActionContext& context) {
    MenuState& state = context.menu;
    setItemScope("help");
    if (beginHelpWindow("Keys and mouse", state.showKeys)) {
        keysWindow(context);
        endHelpWindow();
    }
    if (beginHelpWindow("About", state.showAbout)) {
        ImGui::TextUnformatted("Worldy, an editor and debugger for planet level of detail.");
        ImGui::TextColored(palette().dim, "Chunked LOD after Ulrich (2002). MIT licence.");
        endHelpWindow();
    }
}

}  // namespace worldy::ui
