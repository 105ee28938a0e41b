#include "app/editor/shortcuts.h"

#include <GLFW/glfw3.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>

#include "ui/shell/text_scale.h"

namespace worldy {

namespace {

using Targets = ShortcutTargets;

constexpr int noModifier = 0;
constexpr int ctrl = GLFW_MOD_CONTROL;
constexpr int shift = GLFW_MOD_SHIFT;

struct Shortcut {
    int key;
    int modifiers;
    void (*act)(const Targets&);
};

template <class Enum>
void advance(Enum& value, int count) {
    value = static_cast<Enum>((static_cast<int>(value) + 1) % count);
}

void ask(const Targets& targets, ui::Command command) {
    targets.commands.push_back(std::move(command));
}

void zoomText(const Targets& targets, double factor) {
    ui::zoomText(factor, targets.workspace);
}

// Hides all panels, or shows the default panels if none is shown.
void toggleAllPanels(const Targets& targets) {
    auto& panels = targets.workspace.panels;
    const bool anyShown = std::any_of(panels.begin(), panels.end(), [](const auto& p) { return p.shown; });
    const auto first = firstPlaces();
    for (std::size_t i = 0; i < panels.size(); ++i) panels[i].shown = !anyShown && first[i].shown;
}

// Closes the topmost popup or dialog; if none is open, restores a maximised dock; otherwise clears the selection.
void leave(const Targets& targets) {
    if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;  // Esc only cancels the drag
    const bool popupOpen = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    if (popupOpen)
        ImGui::ClosePopupsOverWindow(nullptr, true);
    else if (targets.menu.showAbout || targets.menu.showKeys)
        (targets.menu.showAbout ? targets.menu.showAbout : targets.menu.showKeys) = false;
    else if (ui::maximisedDock(targets.workspace))
        targets.workspace.maximised = MaximisedDock::None;
    else
        ask(targets, ui::SelectChunk{});
}

// Flips between A's and B's picture, in every compare mode.
void flipCompared(const Targets& targets) {
    if (!targets.view.compare.on) return;
    CompareSettings& compare = targets.settings.compare;
    compare.showB = compare.mode != CompareMode::Flip || !compare.showB;
    compare.mode = CompareMode::Flip;
}

constexpr std::array shortcuts = {
    Shortcut{GLFW_KEY_F1, noModifier,
             [](const Targets& t) { t.settings.overlay.wireframe = !t.settings.overlay.wireframe; }},
    Shortcut{GLFW_KEY_F2, noModifier,
             [](const Targets& t) { ask(t, ui::FreezeLod{!t.view.camera.lodFrozen}); }},
    Shortcut{GLFW_KEY_F3, noModifier, [](const Targets& t) { ask(t, ui::ResetCamera{}); }},
    Shortcut{GLFW_KEY_F4, noModifier,
             [](const Targets& t) { t.settings.overlay.cube = !t.settings.overlay.cube; }},
    Shortcut{GLFW_KEY_F5, noModifier,
             [](const Targets& t) { ask(t, ui::PauseFrames{!t.view.frames.paused}); }},
    Shortcut{GLFW_KEY_F6, noModifier, [](const Targets& t) { ask(t, ui::StepFrame{}); }},
    Shortcut{GLFW_KEY_F7, noModifier, [](const Targets& t) { advance(t.settings.camera.observer, 3); }},
    Shortcut{GLFW_KEY_F8, noModifier, [](const Targets& t) { advance(t.settings.overlay.colourBy, 8); }},
    Shortcut{GLFW_KEY_F9, noModifier, flipCompared},
    Shortcut{GLFW_KEY_F10, noModifier, [](const Targets& t) { t.menu.showKeys = !t.menu.showKeys; }},
    Shortcut{GLFW_KEY_F11, noModifier, toggleAllPanels},
    Shortcut{GLFW_KEY_F12, noModifier, [](const Targets& t) { ask(t, ui::TakeScreenshot{false}); }},
    Shortcut{GLFW_KEY_F12, shift, [](const Targets& t) { ask(t, ui::TakeScreenshot{true}); }},
    Shortcut{GLFW_KEY_Z, ctrl, [](const Targets& t) { ask(t, ui::Undo{}); }},
    Shortcut{GLFW_KEY_Z, ctrl | shift, [](const Targets& t) { ask(t, ui::Redo{}); }},
    Shortcut{GLFW_KEY_Y, ctrl, [](const Targets& t) { ask(t, ui::Redo{}); }},
    Shortcut{GLFW_KEY_O, ctrl, [](const Targets& t) { ask(t, ui::AskForFile{}); }},
    Shortcut{GLFW_KEY_C, ctrl | shift, [](const Targets& t) { ask(t, ui::CopyCommandLine{}); }},
    Shortcut{GLFW_KEY_EQUAL, ctrl, [](const Targets& t) { zoomText(t, 1.1); }},
    Shortcut{GLFW_KEY_EQUAL, ctrl | shift, [](const Targets& t) { zoomText(t, 1.1); }},
    Shortcut{GLFW_KEY_KP_ADD, ctrl, [](const Targets& t) { zoomText(t, 1.1); }},
    Shortcut{GLFW_KEY_MINUS, ctrl, [](const Targets& t) { zoomText(t, 1 / 1.1); }},
    Shortcut{GLFW_KEY_KP_SUBTRACT, ctrl, [](const Targets& t) { zoomText(t, 1 / 1.1); }},
    Shortcut{GLFW_KEY_L, ctrl | shift, [](const Targets& t) { ask(t, ui::NextLayout{}); }},
    Shortcut{GLFW_KEY_Q, ctrl, [](const Targets& t) { ask(t, ui::Quit{}); }},
    Shortcut{GLFW_KEY_ESCAPE, noModifier, leave},
};

// GLFW's key code in a panel's "Ctrl+X" or "Ctrl+Shift+X" is the letter or digit itself.
void togglePanel(const KeyPress& press, bool shifted, const Targets& targets) {
    for (const PanelInfo& info : panelInfos) {
        const std::string_view shortcut = info.shortcut;
        if (press.key != shortcut.back() || shifted != shortcut.starts_with("Ctrl+Shift+")) continue;
        ui::togglePanel(info.id, targets.workspace);
    }
}

}  // namespace

std::vector<std::string> shortcutNames() {
    const auto keyName = [](int key) -> std::string {
        if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return "F" + std::to_string(key - GLFW_KEY_F1 + 1);
        if (key == GLFW_KEY_ESCAPE) return "Esc";
        if (key == GLFW_KEY_KP_ADD || key == GLFW_KEY_EQUAL) return "+";
        if (key == GLFW_KEY_KP_SUBTRACT) return "-";
        return std::string(1, static_cast<char>(key));  // GLFW's code of a letter is its ASCII code
    };
    std::vector<std::string> names;
    for (const Shortcut& one : shortcuts) {
        // Shift is needed only to type the plus on some keyboards.
        const bool shifted = (one.modifiers & shift) != 0 && one.key != GLFW_KEY_EQUAL;
        names.push_back(std::string((one.modifiers & ctrl) != 0 ? "Ctrl+" : "") + (shifted ? "Shift+" : "") +
                        keyName(one.key));
    }
    return names;
}

void obeyShortcuts(std::span<const KeyPress> pressed, const ShortcutTargets& targets) {
    if (ImGui::GetIO().WantTextInput) return;
    for (const KeyPress& press : pressed) {
        const int modifiers = press.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_SHIFT | GLFW_MOD_ALT);
        const auto found = std::find_if(shortcuts.begin(), shortcuts.end(), [&](const Shortcut& s) {
            return s.key == press.key && s.modifiers == modifiers;
        });
        if (found != shortcuts.end())
            found->act(targets);
        else if (modifiers == ctrl || modifiers == (ctrl | shift))
            togglePanel(press, modifiers != ctrl, targets);
    }
}

}  // namespace worldy
