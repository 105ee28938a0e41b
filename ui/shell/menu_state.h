// The state of menus, keys and the palette between frames, and their requests to the window. Plain data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/settings/panel_list.h"
#include "ui/shell/layout_menu.h"

namespace worldy::ui {

struct PaletteState {
    bool isOpen = false;
    bool takesFocus = false;            // its field takes the focus in this frame
    std::array<char, 256> query{};      // what is typed
    std::size_t chosen = 0;             // row
    bool scrollsToChosen = false;       // in this frame
    std::string edited{};               // the setting that is edited, "lod.tau_px"; empty: none
    std::vector<std::string> recent{};  // names of entries, newest first
};

// Opens the palette with an empty query, or closes it.
void togglePalette(PaletteState& palette);
// Goes back from a setting to the list, or closes the palette.
void leavePalette(PaletteState& palette);

// A click that a key makes.
struct MousePress {
    float x = 0;  // in the window, ImGui's units
    float y = 0;
    int button = 0;  // 0: left, 1: right
};

struct MenuState {
    bool showKeys = false;  // the window of keys and mouse
    bool showAbout = false;
    bool popupWasOpen = false;  // when the last frame ended
    PaletteState palette{};
    LayoutMenuState layout{};
    std::optional<PanelId> usedPanel{};  // the last panel that had the focus; none if it is hidden since
    std::string refused{};               // why the last key did nothing; empty: it did

    // Requests that followFocus() carries out in the next frame.
    int panes = 0;              // moves the focus by so many panes
    bool focusesPanel = false;  // moves it to usedPanel
    bool findsInList = false;   // moves it to a filter
    enum class Press : std::uint8_t { None, ContextMenu, MiddleOfViewport };
    Press press = Press::None;
    std::optional<MousePress> mouse{};  // the click to make
};

}  // namespace worldy::ui
