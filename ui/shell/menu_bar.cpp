#include "ui/shell/menu_bar.h"

#include <imgui.h>

#include <array>
#include <string>

#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

// Begins a menu. Its place is noted first, because an open menu's name is no longer ImGui's last item.
// whyNot: why it is grey; empty: it is not.
bool beginMenu(const char* label, const std::string& whyNot = {}) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    setItemScope("menu");
    noteRect(label, {at.x, at.y, ImGui::CalcTextSize(label).x, ImGui::GetFontSize()});
    const bool open = ImGui::BeginMenu(label, whyNot.empty());
    if (!whyNot.empty()) tooltip(whyNot.c_str());
    return open;
}

bool menuItem(const std::string& label, const std::string& keys, bool isOn, const std::string& whyNot) {
    const bool pressed = ImGui::MenuItem(label.c_str(), keys.c_str(), isOn, whyNot.empty());
    setItemScope("menu item");
    noteItem(label);
    if (!whyNot.empty()) tooltip(whyNot.c_str());
    return pressed;
}

void choiceItems(const Action& action, const ActionContext& context) {
    if (!beginMenu(action.name.c_str(), whyNot(action, context))) return;
    for (const ActionChoice& choice : action.choices(context)) {
        if (menuItem(choice.name, "", false, choice.whyNot)) choice.send(context.commands);
    }
    ImGui::EndMenu();
}

void actionItem(const Action& action, const KeyChords& keys, const ActionContext& context) {
    if (action.choices) return choiceItems(action, context);
    const std::string name = action.nameNow ? action.nameNow(context) : action.name;
    const std::string key = keys.empty() ? std::string() : nameOf(keys.front());
    const bool isOn = action.isOn && action.isOn(context);
    if (!menuItem(name, key, isOn, whyNot(action, context))) return;
    // The check mark goes, also for a panel behind another; the key would bring it to the front.
    if (action.panel && isOn)
        context.workspace.panels[static_cast<std::size_t>(*action.panel)].shown = false;
    else
        action.act(context);
}

// Draws the actions from first on that are in the same submenu. Returns how many.
std::size_t submenu(std::size_t first, const ActionContext& context) {
    const auto list = actions();
    const Action& begin = list[first];
    std::size_t end = first + 1;
    while (end < list.size() && list[end].menu == begin.menu && list[end].submenu == begin.submenu) ++end;
    if (beginMenu(begin.submenu.c_str())) {
        for (std::size_t i = first; i < end; ++i) actionItem(list[i], context.keys[i], context);
        ImGui::EndMenu();
    }
    return end - first;
}

void menuItems(Menu menu, const ActionContext& context) {
    const auto list = actions();
    const Action* last = nullptr;
    for (std::size_t i = 0; i < list.size();) {
        const Action& action = list[i];
        if (action.menu != menu) {
            ++i;
            continue;
        }
        if (last && last->group != action.group) ImGui::Separator();
        last = &action;
        if (!action.submenu.empty()) {
            i += submenu(i, context);
        } else {
            actionItem(action, context.keys[i], context);
            ++i;
        }
    }
}

void layoutMenu(const ActionContext& context) {
    ImGui::Separator();
    if (!beginMenu("Layout")) return;
    layoutItems(context.view, context.menu.layout, context.workspace, context.commands);
    ImGui::EndMenu();
}

}  // namespace

float menuBarHeight() {
    return ImGui::GetFrameHeight();
}

void menuBar(const ActionContext& context) {
    if (!ImGui::BeginMainMenuBar()) return;
    for (const Menu menu : {Menu::File, Menu::Edit, Menu::View, Menu::Camera, Menu::Help}) {
        if (!beginMenu(menuName(menu))) continue;
        menuItems(menu, context);
        if (menu == Menu::View) layoutMenu(context);
        ImGui::EndMenu();
    }
    ImGui::EndMainMenuBar();
}

}  // namespace worldy::ui
