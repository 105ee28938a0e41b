// The list of all commands that menus, keys and the palette offer. The menu bar, the Keys window, the
// shortcuts, the file of changed keys and the palette (Ctrl+K) are made from it, so a command is described
// once.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/settings/key_file.h"
#include "app/settings/panel_list.h"
#include "app/settings/workspace.h"
#include "ui/model/editor_view.h"
#include "ui/model/palette_search.h"
#include "ui/shell/menu_state.h"

namespace worldy::ui {

// The keys of each action, in the order of actions().
using ActionKeys = std::vector<KeyChords>;

// The state that actions read and change directly. Everything else is done by commands.
struct ActionContext {
    const EditorView& view;
    ViewSettings& settings;
    Workspace& workspace;
    MenuState& menu;
    const ActionKeys& keys;
    Commands& commands;
};

// One of several things that an action can be applied to: a bookmark to go to.
struct ActionChoice {
    std::string name;
    std::string whyNot;  // empty: it can be chosen
    std::function<void(Commands&)> send;
};

enum class Menu : std::uint8_t { None, File, Edit, View, Camera, Help };
// Returns the title in the menu bar.
const char* menuName(Menu menu);

struct Action {
    std::string id;    // in keys.toml: "freeze_lod"
    std::string name;  // "Freeze LOD"
    std::string help;  // a sentence
    Menu menu = Menu::None;
    int group = 0;                    // within the menu; a line separates groups
    std::string submenu{};            // empty: it is in the menu itself
    std::vector<const char*> keys{};  // by default: "Ctrl+Shift+Z"
    std::string setting{};            // the name of the setting that it changes
    bool inTextFields = false;        // its keys work while a text field has the focus too
    std::optional<PanelId> panel{};   // the panel that it shows

    // Empty for an action that has choices.
    std::function<void(const ActionContext&)> act{};
    // Returns true if a check mark is drawn. Empty: it has none.
    std::function<bool(const ActionContext&)> isOn{};
    // Returns why it is not possible now; an empty text: it is. Empty: it is always possible.
    std::function<std::string(const ActionContext&)> whyNot{};
    // Returns a name with more detail: "Undo Tolerance τ 2 -> 3 px". Empty: name.
    std::function<std::string(const ActionContext&)> nameNow{};
    // Its choices, and their kind in the palette. Empty: it has none.
    std::function<std::vector<ActionChoice>(const ActionContext&)> choices{};
    PaletteKind choiceKind = PaletteKind::Command;
};

// Returns the list, in the order of the menus. It never changes.
std::span<const Action> actions();
// Returns the action with this id, which must exist.
const Action& actionNamed(std::string_view id);

// Returns why an action is not possible; empty: it is.
std::string whyNot(const Action& action, const ActionContext& context);

// Returns the actions that can have keys, as commands of the key file.
std::vector<KeyedCommand> keyedCommands();
// Returns the keys of all actions, given those of keyedCommands().
ActionKeys actionKeys(std::span<const KeyChords> ofCommands);
ActionKeys defaultKeys();
// Returns "Ctrl+Shift+Z, Ctrl+Y".
std::string keysText(const KeyChords& keys);
// Gives the names of the first keys to ui/model/key_names.h.
void publishKeyNames(const ActionKeys& keys);

}  // namespace worldy::ui
