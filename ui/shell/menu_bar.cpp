#include "ui/shell/menu_bar.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

// Begins a menu. Its place is noted first, because an open menu's name is no longer ImGui's last item.
// whyNot: why it is grey; null: it is not.
bool beginMenu(const char* label, const char* whyNot = nullptr) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    setItemScope("menu");
    noteRect(label, {at.x, at.y, ImGui::CalcTextSize(label).x, ImGui::GetFontSize()});
    const bool open = ImGui::BeginMenu(label, !whyNot);
    if (whyNot) tooltip(whyNot);
    return open;
}

bool menuItem(const char* label, const char* shortcut = nullptr, bool selected = false,
              const char* whyNot = nullptr) {
    const bool pressed = ImGui::MenuItem(label, shortcut, selected, !whyNot);
    setItemScope("menu item");
    noteItem(label);
    if (whyNot) tooltip(whyNot);
    return pressed;
}

// Returns why an item is greyed, or null if unless, the condition that enables it, holds.
const char* greyUnless(bool unless, const char* why) {
    return unless ? nullptr : why;
}

constexpr const char* noPlanet = "No planet is open.";

void fileMenu(const EditorView& view, Workspace& workspace, Commands& commands) {
    if (!beginMenu("File")) return;
    if (menuItem("Open...", "Ctrl+O")) commands.push_back(AskForFile{});
    if (beginMenu("Open recent", greyUnless(!view.data.recent.empty(), "No recent files."))) {
        for (const std::filesystem::path& file : view.data.recent) {
            if (menuItem(file.string().c_str())) commands.push_back(OpenFile{file});
        }
        ImGui::EndMenu();
    }
    if (menuItem("Attach to an engine...")) showPanel(PanelId::Trace, workspace);
    ImGui::Separator();
    if (menuItem("Screenshot", "F12", false, greyUnless(view.planet, noPlanet)))
        commands.push_back(TakeScreenshot{false});
    if (menuItem("Screenshot with panels", "Shift+F12")) commands.push_back(TakeScreenshot{true});
    if (menuItem("Save session report...", nullptr, false, greyUnless(view.planet, noPlanet)))
        commands.push_back(SaveReport{});
    if (menuItem("Copy as command line", "Ctrl+Shift+C", false, greyUnless(view.planet, noPlanet)))
        commands.push_back(CopyCommandLine{});
    ImGui::Separator();
    if (menuItem("Quit", "Ctrl+Q")) commands.push_back(Quit{});
    ImGui::EndMenu();
}

void editMenu(const EditorView& view, ViewSettings& settings, Commands& commands) {
    if (!beginMenu("Edit")) return;
    const auto named = [](const char* verb, const std::string& name) {
        return name.empty() ? std::string(verb) : verb + (" " + inFont(name));
    };
    if (menuItem(named("Undo", view.settings.undoName).c_str(), "Ctrl+Z", false,
                 greyUnless(!view.settings.undoName.empty(), "Nothing to undo.")))
        commands.push_back(Undo{});
    if (menuItem(named("Redo", view.settings.redoName).c_str(), "Ctrl+Shift+Z", false,
                 greyUnless(!view.settings.redoName.empty(), "Nothing to redo.")))
        commands.push_back(Redo{});
    ImGui::Separator();
    if (menuItem("Reset all settings", nullptr, false,
                 greyUnless(settings != ViewSettings(), "All settings have their defaults.")))
        settings = {};
    if (beginMenu("Load preset", greyUnless(!view.settings.presets.empty(), "No presets."))) {
        for (const PresetView& preset : view.settings.presets) {
            if (menuItem(preset.name.c_str(), nullptr, false,
                         greyUnless(preset.problem.empty(), preset.problem.c_str())))
                commands.push_back(LoadPreset{preset.name});
        }
        ImGui::EndMenu();
    }
    ImGui::EndMenu();
}

void panelItems(Workspace& workspace) {
    for (const PanelInfo& info : panelInfos) {
        PanelPlace& place = workspace.panels[static_cast<std::size_t>(info.id)];
        if (!menuItem(info.title, info.shortcut, place.shown)) continue;
        if (place.shown)
            place.shown = false;
        else
            showPanel(info.id, workspace);
    }
}

void viewMenu(Workspace& workspace) {
    if (!beginMenu("View")) return;
    panelItems(workspace);
    ImGui::Separator();
    if (beginMenu("Theme")) {
        if (menuItem("Dark theme", nullptr, workspace.theme == Theme::Dark)) workspace.theme = Theme::Dark;
        if (menuItem("Light theme", nullptr, workspace.theme == Theme::Light)) workspace.theme = Theme::Light;
        ImGui::EndMenu();
    }
    if (menuItem("Larger text", "Ctrl++")) workspace.scale = std::min(workspace.scale * 1.1, 3.0);
    if (menuItem("Smaller text", "Ctrl+-")) workspace.scale = std::max(workspace.scale / 1.1, 0.5);
    if (menuItem("Match monitor scale", nullptr, false,
                 greyUnless(workspace.scale != 1, "The text already matches the monitor scale.")))
        workspace.scale = 1;
    ImGui::Separator();
    if (menuItem("Reset layout")) {
        const Theme theme = workspace.theme;
        workspace = {};
        workspace.theme = theme;
    }
    ImGui::EndMenu();
}

void cameraMenu(const EditorView& view, ViewSettings& settings, Commands& commands) {
    if (!beginMenu("Camera")) return;
    CameraSettings& camera = settings.camera;
    const auto mode = [&](const char* name, CameraMode value) {
        if (menuItem(name, nullptr, camera.mode == value)) camera.mode = value;
    };
    mode("Fly", CameraMode::Fly);
    mode("Orbit", CameraMode::Orbit);
    mode("Follow a flight", CameraMode::FollowFlight);
    ImGui::Separator();
    if (beginMenu("Go to")) {
        for (const Bookmark& bookmark : view.camera.bookmarks) {
            if (menuItem(bookmark.name.c_str())) commands.push_back(MoveCamera{bookmark.pose});
        }
        ImGui::EndMenu();
    }
    if (menuItem("Reset", "F3")) commands.push_back(ResetCamera{});
    ImGui::Separator();
    if (menuItem("Freeze LOD", "F2", view.camera.lodFrozen))
        commands.push_back(FreezeLod{!view.camera.lodFrozen});
    if (menuItem("Pause frames", "F5", view.frames.paused))
        commands.push_back(PauseFrames{!view.frames.paused});
    if (menuItem("Step one frame", "F6")) commands.push_back(StepFrame{});
    ImGui::Separator();
    const auto observer = [&](const char* name, ObserverMode value) {
        if (menuItem(name, "F7", camera.observer == value)) camera.observer = value;
    };
    observer("Observer off", ObserverMode::Off);
    observer("Observer split", ObserverMode::Split);
    observer("Observer alone", ObserverMode::Alone);
    ImGui::EndMenu();
}

void helpMenu(MenuState& state) {
    if (!beginMenu("Help")) return;
    if (menuItem("Keys and mouse", "F10")) state.showKeys = true;
    if (menuItem("About")) state.showAbout = true;
    ImGui::EndMenu();
}

constexpr std::array keyHelp = {
    KeyHelp{"Left drag", "move across the planet"},
    KeyHelp{"Right drag", "look around"},
    KeyHelp{"Wheel", "zoom"},
    KeyHelp{"Click", "select the chunk under the pointer"},
    KeyHelp{"W A S D, E Q", "fly; up and down"},
    KeyHelp{"I J K L", "turn"},
    KeyHelp{"+ -", "change the speed"},
    KeyHelp{"F1", "wireframe"},
    KeyHelp{"F2", "freeze LOD: keep the selection while the camera moves"},
    KeyHelp{"F3", "move the camera to the start"},
    KeyHelp{"F4", "unprojected cube"},
    KeyHelp{"F5, F6", "pause frames; step one frame"},
    KeyHelp{"F7", "observer: off, split, alone"},
    KeyHelp{"F8", "next chunk tint"},
    KeyHelp{"F9", "while comparing: switch between A and B"},
    KeyHelp{"F10", "show or hide this list"},
    KeyHelp{"F11", "show or hide all panels"},
    KeyHelp{"F12, Shift+F12", "screenshot; with panels"},
    KeyHelp{"Ctrl+Z", "undo"},
    KeyHelp{"Ctrl+Shift+Z, Ctrl+Y", "redo"},
    KeyHelp{"Ctrl+O", "open a file (or drop it onto the window)"},
    KeyHelp{"Ctrl+Shift+C", "copy as command line"},
    KeyHelp{"Ctrl++, Ctrl+-", "larger, smaller text"},
    KeyHelp{"Ctrl+click on a slider", "type a number"},
    KeyHelp{"Ctrl+C over a table or plot", "copy its selected rows, or all"},
    KeyHelp{"Ctrl+click, Shift+click on a row", "select it; up to it"},
    KeyHelp{"Right click on a table or plot", "copy, save as CSV, TSV or PNG"},
    KeyHelp{"Right click on a setting", "reset to its default"},
    KeyHelp{"Double click on a chunk's name", "look at the chunk"},
    KeyHelp{"Esc", "close a menu or window, or clear selection"},
    KeyHelp{"Ctrl+Q", "quit"},
};

std::vector<KeyHelp> panelKeys() {
    std::vector<KeyHelp> keys;
    for (const PanelInfo& info : panelInfos) keys.push_back({info.shortcut, info.title});
    return keys;
}

void keyTable(const char* id, std::span<const KeyHelp> keys) {
    if (!ImGui::BeginTable(
            id, 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoHostExtendX))
        return;
    for (const KeyHelp& help : keys) {
        ImGui::TableNextColumn();
        ImGui::TextColored(palette().accent, "%s", help.keys);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(help.meaning);
    }
    ImGui::EndTable();
}

float keyTableWidth(std::span<const KeyHelp> keys) {
    float names = 0;
    float meanings = 0;
    for (const KeyHelp& help : keys) {
        names = std::max(names, ImGui::CalcTextSize(help.keys).x);
        meanings = std::max(meanings, ImGui::CalcTextSize(help.meaning).x);
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

}  // namespace

float menuBarHeight() {
    return ImGui::GetFrameHeight();
}

void menuBar(const EditorView& view, MenuState& state, Workspace& workspace, ViewSettings& settings,
             Commands& commands) {
    if (!ImGui::BeginMainMenuBar()) return;
    fileMenu(view, workspace, commands);
    editMenu(view, settings, commands);
    viewMenu(workspace);
    cameraMenu(view, settings, commands);
    helpMenu(state);
    ImGui::EndMainMenuBar();
}

std::vector<KeyHelp> listedKeys() {
    std::vector<KeyHelp> keys = panelKeys();
    keys.insert(keys.begin(), keyHelp.begin(), keyHelp.end());
    return keys;
}

void helpWindows(MenuState& state) {
    setItemScope("help");
    if (beginHelpWindow("Keys and mouse", state.showKeys)) {
        const ImVec2 at = ImGui::GetWindowPos();
        noteRect("Keys and mouse", {at.x, at.y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
        keyTable("keys", keyHelp);
        const std::vector<KeyHelp> panels = panelKeys();
        const float gap = 2 * ImGui::GetFontSize();
        const float both = keyTableWidth(keyHelp) + gap + keyTableWidth(panels);
        if (both + 2 * gap < ImGui::GetMainViewport()->WorkSize.x) ImGui::SameLine(0, gap);
        keyTable("panels", panels);
        endHelpWindow();
    }
    if (beginHelpWindow("About", state.showAbout)) {
        ImGui::TextUnformatted("Worldy, an editor and debugger for planet level of detail.");
        ImGui::TextColored(palette().dim, "Chunked LOD after Ulrich (2002). MIT licence.");
        endHelpWindow();
    }
}

}  // namespace worldy::ui
