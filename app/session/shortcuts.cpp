#include "app/session/shortcuts.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "ui/shell/gamepad_actions.h"

namespace worldy {

namespace {

// app/settings/key_chord.cpp knows no window.
static_assert(GLFW_KEY_ESCAPE == 256 && GLFW_KEY_ENTER == 257 && GLFW_KEY_TAB == 258 &&
              GLFW_KEY_BACKSPACE == 259 && GLFW_KEY_INSERT == 260 && GLFW_KEY_DELETE == 261 &&
              GLFW_KEY_RIGHT == 262 && GLFW_KEY_LEFT == 263 && GLFW_KEY_DOWN == 264 && GLFW_KEY_UP == 265 &&
              GLFW_KEY_PAGE_UP == 266 && GLFW_KEY_PAGE_DOWN == 267 && GLFW_KEY_HOME == 268 &&
              GLFW_KEY_END == 269 && GLFW_KEY_PAUSE == 284 && GLFW_KEY_F1 == 290 && GLFW_KEY_F12 == 301 &&
              GLFW_KEY_KP_SUBTRACT == 333 && GLFW_KEY_KP_ADD == 334 && GLFW_KEY_MENU == 348);
static_assert(GLFW_MOD_SHIFT == 1 && GLFW_MOD_CONTROL == 2 && GLFW_MOD_ALT == 4);

bool worksNow(const ui::Action& action, const ui::MenuState& menu) {
    // Letters typed right after the palette has opened are meant for its field, which gets the focus some frames later.
    const bool isTyping =
        ImGui::GetIO().WantTextInput || (menu.palette.isOpen && menu.palette.edited.empty());
    if (!isTyping || action.inTextFields) return true;
    return menu.palette.isOpen && action.id == "close";
}

void carryOut(const ui::Action& action, const ui::ActionContext& context) {
    const std::string why = ui::whyNot(action, context);
    if (why.empty())
        action.act(context);
    else
        context.menu.refused = fmt::format("{}: {}", action.name, why);
}

void obey(const KeyPress& press, const ui::ActionContext& context) {
    const KeyChord chord = pressedChord(press.key, press.modifiers);
    const std::span<const ui::Action> all = ui::actions();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const KeyChords& keys = context.keys[i];
        if (std::ranges::find(keys, chord) == keys.end() || !worksNow(all[i], context.menu)) continue;
        return carryOut(all[i], context);
    }
}

}  // namespace

void obeyShortcuts(std::span<const KeyPress> pressed, const ui::ActionContext& context) {
    for (const KeyPress& press : pressed) obey(press, context);
    context.menu.popupWasOpen =
        ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

void obeyButtons(std::span<const GamepadButton> pressed, const ui::ActionContext& context) {
    for (const GamepadButton button : pressed) {
        const ui::Action* const action = ui::actionOf(button);
        if (action && worksNow(*action, context.menu)) carryOut(*action, context);
    }
}

}  // namespace worldy
