#include "ui/shell/focus.h"

#include <imgui_internal.h>

#include <algorithm>
#include <string_view>
#include <tuple>
#include <utility>

#include "ui/kit/filter_box.h"
#include "ui/kit/theme.h"

namespace worldy::ui {

namespace {

constexpr const char* viewportName = "viewport";
constexpr const char* menuBarName = "##MainMenuBar";

// Returns the windows between which the focus moves: the menu bar, then from left to right.
std::vector<ImGuiWindow*> panes() {
    constexpr ImGuiWindowFlags without = ImGuiWindowFlags_NoNavFocus | ImGuiWindowFlags_NoMouseInputs |
                                         ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_Popup;
    std::vector<ImGuiWindow*> found;
    for (ImGuiWindow* const window : ImGui::GetCurrentContext()->Windows) {
        const bool isShown = window->Active && !window->Hidden && !window->IsFallbackWindow;
        if (isShown && window == window->RootWindow && (window->Flags & without) == 0)
            found.push_back(window);
    }
    const auto place = [](const ImGuiWindow* window) {
        return std::tuple(std::string_view(window->Name) != menuBarName, window->Pos.x, window->Pos.y);
    };
    std::stable_sort(found.begin(), found.end(),
                     [&](const ImGuiWindow* a, const ImGuiWindow* b) { return place(a) < place(b); });
    return found;
}

// Returns the panel's window in a dock, or the window itself.
ImGuiWindow* innerWindow(ImGuiWindow* pane) {
    for (ImGuiWindow* const window : ImGui::GetCurrentContext()->Windows) {
        const bool isChild =
            (window->Flags & ImGuiWindowFlags_ChildWindow) != 0 && window->ParentWindow == pane;
        if (isChild && window->Active) return window;
    }
    return pane;
}

void focusWindow(ImGuiWindow* window) {
    ImGuiContext& g = *ImGui::GetCurrentContext();
    ImGui::ClearActiveID();
    ImGui::FocusWindow(window);
    // A menu bar has no other layer.
    if (window->DC.NavLayersActiveMaskNext == 1 << ImGuiNavLayer_Menu) g.NavLayer = ImGuiNavLayer_Menu;
    ImGui::NavInitWindow(window, true);
    g.NavDisableHighlight = false;
    g.NavDisableMouseHover = true;
}

void stepPane(int step) {
    const std::vector<ImGuiWindow*> all = panes();
    if (all.empty()) return;
    const ImGuiWindow* const focused = ImGui::GetCurrentContext()->NavWindow;
    const auto at = std::find(all.begin(), all.end(), focused ? focused->RootWindow : nullptr);
    const auto count = static_cast<int>(all.size());
    const int from = at == all.end() ? (step > 0 ? -1 : 0) : static_cast<int>(at - all.begin());
    focusWindow(innerWindow(all[static_cast<std::size_t>((from + step + count) % count)]));
}

// Returns the last part of a child window's name, without ImGui's hexadecimal id: "LOD".
std::string_view titleOf(const ImGuiWindow& window) {
    std::string_view name = window.Name;
    name = name.substr(name.rfind('/') + 1);
    return name.substr(0, name.rfind('_'));
}

std::optional<PanelId> panelWithFocus(const Workspace& workspace) {
    for (const ImGuiWindow* window = ImGui::GetCurrentContext()->NavWindow; window;
         window = window->ParentWindow) {
        if ((window->Flags & ImGuiWindowFlags_ChildWindow) == 0) break;
        const std::string_view title = titleOf(*window);
        for (const PanelInfo& info : panelInfos)
            if (title == info.title && isShown(workspace, info.id)) return info.id;
    }
    return std::nullopt;
}

// A floating panel has a window of its own.
std::optional<PanelId> floatingPanelWithFocus(const Workspace& workspace) {
    const ImGuiWindow* const window = ImGui::GetCurrentContext()->NavWindow;
    if (!window) return std::nullopt;
    const std::string_view name = window->RootWindow->Name;
    constexpr std::string_view mark = "###floating ";
    const std::size_t at = name.find(mark);
    if (at == std::string_view::npos) return std::nullopt;
    for (const PanelInfo& info : panelInfos)
        if (name.substr(at + mark.size()) == info.key && isShown(workspace, info.id)) return info.id;
    return std::nullopt;
}

void focusPanel(PanelId panel) {
    for (ImGuiWindow* const window : ImGui::GetCurrentContext()->Windows) {
        const bool isChild = (window->Flags & ImGuiWindowFlags_ChildWindow) != 0;
        if (isChild && window->Active &&
            titleOf(*window) == panelInfos[static_cast<std::size_t>(panel)].title)
            return focusWindow(window);
    }
}

std::optional<MousePress> contextClick() {
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    if (!g.NavWindow || g.NavId == 0) return std::nullopt;
    const ImVec2 middle = g.NavWindow->NavRectRel[g.NavLayer].GetCenter();
    return MousePress{g.NavWindow->Pos.x + middle.x, g.NavWindow->Pos.y + middle.y, 1};
}

std::optional<MousePress> middleClick() {
    const ImGuiWindow* const window = ImGui::FindWindowByName(viewportName);
    if (!window || !window->Active) return std::nullopt;
    const ImVec2 middle = window->Rect().GetCenter();
    return MousePress{middle.x, middle.y, 0};
}

// Lets Enter press buttons and choose from menus, as Space does; ImGui 1.86 lets it only type into fields. An
// Enter that began or ended typing is used up.
void pressByEnter() {
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    const bool isUsed = g.ActiveId != 0 || g.ActiveIdPreviousFrame != 0;
    if (g.NavId == 0 || g.NavDisableHighlight || isUsed) return;
    if (g.NavActivateInputId == g.NavId) ImGui::ActivateItem(g.NavId);
}

// The frame of an item with the focus may be small or scrolled out of view.
void framePane() {
    const ImGuiContext& g = *ImGui::GetCurrentContext();
    if (g.NavDisableHighlight || !g.NavWindow) return;
    const ImGuiWindow& root = *g.NavWindow->RootWindow;
    if (!root.Active || (root.Flags & ImGuiWindowFlags_Popup) != 0) return;
    const ImRect rect = root.Rect();
    ImGui::GetForegroundDrawList()->AddRect({rect.Min.x + 0.5f, rect.Min.y + 0.5f},
                                            {rect.Max.x - 0.5f, rect.Max.y - 0.5f},
                                            packed(palette().accent, 0.8f));
}

}  // namespace

void followFocus(const Workspace& workspace, MenuState& state) {
    // Otherwise the window that was drawn last has the focus at first.
    constexpr int firstFrames = 2;
    if (ImGui::GetFrameCount() == firstFrames && !isDialogOpen()) ImGui::SetWindowFocus(viewportName);
    if (const int step = std::exchange(state.panes, 0); step != 0) stepPane(step);
    if (std::exchange(state.focusesPanel, false) && state.usedPanel) focusPanel(*state.usedPanel);
    if (std::exchange(state.findsInList, false)) focusFilter();
    const MenuState::Press press = std::exchange(state.press, MenuState::Press::None);
    if (press == MenuState::Press::ContextMenu) state.mouse = contextClick();
    if (press == MenuState::Press::MiddleOfViewport) state.mouse = middleClick();
    pressByEnter();
    if (const auto panel = panelWithFocus(workspace)) state.usedPanel = panel;
    if (const auto panel = floatingPanelWithFocus(workspace)) state.usedPanel = panel;
    const bool isAway =
        isViewportMaximised(workspace) || (state.usedPanel && !isShown(workspace, *state.usedPanel));
    if (isAway) state.usedPanel.reset();
    framePane();
}

bool closePopups() {
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) return false;
    ImGui::ClosePopupsOverWindow(nullptr, true);
    return true;
}

bool isDialogOpen() {
    return ImGui::GetTopMostPopupModal() != nullptr;
}

}  // namespace worldy::ui
