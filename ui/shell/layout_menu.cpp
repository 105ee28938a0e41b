#include "ui/shell/layout_menu.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

namespace {

constexpr const char* namePopup = "Save the layout###layout name";
constexpr const char* deletePopup = "Delete the layout###layout delete";

// whyNot: why it is grey; null: it is not.
bool item(const char* label, const char* shortcut, bool selected, const char* whyNot) {
    const bool pressed = ImGui::MenuItem(label, shortcut, selected, !whyNot);
    setItemScope("layout");
    noteItem(label);
    if (whyNot) tooltip(whyNot);
    return pressed;
}

const NamedLayout* layoutNamed(const EditorView& view, std::string_view name) {
    const auto found =
        std::find_if(view.settings.layouts.begin(), view.settings.layouts.end(),
                     [&](const NamedLayout& layout) { return areSameName(layout.named.name, name); });
    return found == view.settings.layouts.end() ? nullptr : &*found;
}

void namedItems(const EditorView& view, const Workspace& workspace, Commands& commands) {
    bool wasShipped = true;
    for (const NamedLayout& layout : view.settings.layouts) {
        if (wasShipped && !layout.named.shipped) ImGui::Separator();
        wasShipped = layout.named.shipped;
        const bool current = layout.workspace && areSameLayout(workspace, *layout.workspace);
        const char* const problem = layout.workspace ? nullptr : layout.workspace.error().message.c_str();
        if (item(layout.named.name.c_str(), nullptr, current, problem))
            commands.push_back(LoadLayout{layout.named.name});
    }
}

void deleteItems(const EditorView& view, LayoutMenuState& state) {
    for (const NamedLayout& layout : view.settings.layouts) {
        if (layout.named.shipped) continue;
        if (item(fmt::format("Delete {}...", layout.named.name).c_str(), nullptr, false, nullptr))
            state = {.asksDelete = true, .deleted = layout.named.name};
    }
}

// Returns why the name cannot be used; empty if it can.
std::string refusalOf(const EditorView& view, const LayoutMenuState& state) {
    const std::string name = state.name.data();
    if (name.empty()) return "Type a name first.";
    if (const planet::Result<void> good = checkFileName(name); !good) return good.error().message;
    const NamedLayout* same = layoutNamed(view, name);
    if (same && same->named.shipped) return "A built-in layout has this name and cannot be replaced.";
    if (same && !same->workspace) return "A file with this name is not a layout; choose another name.";
    return {};
}

// Asks before a layout is replaced.
void replaceQuestion(LayoutMenuState& state, Commands& commands) {
    ImGui::TextUnformatted(fmt::format("A layout named \"{}\" exists. Replace it?", state.replaced).c_str());
    noteItem("Question");
    ImGui::Spacing();
    if (button("Replace", "Replaces the file of that layout.")) {
        commands.push_back(SaveLayout{state.replaced, true});
        ImGui::CloseCurrentPopup();
    }
    ImGui::SameLine();
    if (button("Back", "Keeps the existing layout, and asks for another name.")) state.replaced.clear();
}

void nameQuestion(const EditorView& view, LayoutMenuState& state, Commands& commands) {
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(18 * ImGui::GetFontSize());
    const bool entered = ImGui::InputTextWithHint("##name", "Layout name", state.name.data(),
                                                  state.name.size(), ImGuiInputTextFlags_EnterReturnsTrue);
    noteItem("Name");
    const std::string refused = refusalOf(view, state);
    const bool isTyped = state.name[0] != 0;
    if (!refused.empty() && isTyped) wrappedText(refused, palette().bad);
    ImGui::Spacing();
    beginGrey(!refused.empty(), refused.c_str());
    const bool saved =
        button("Save", "Saves which panels are shown, where they lie, and the sizes of the docks.") ||
        entered;
    endGrey();
    ImGui::SameLine();
    const bool left =
        ImGui::GetIO().WantTextInput && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    if (button("Cancel", "Saves nothing (Esc).") || left) return ImGui::CloseCurrentPopup();
    if (!saved || !refused.empty()) return;
    if (const NamedLayout* same = layoutNamed(view, state.name.data())) {
        state.replaced = same->named.name;
        return;
    }
    commands.push_back(SaveLayout{state.name.data(), false});
    ImGui::CloseCurrentPopup();
}

bool beginPopup(const char* title) {
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
    return ImGui::BeginPopupModal(title, nullptr,
                                  ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
}

void namingWindow(const EditorView& view, LayoutMenuState& state, Commands& commands) {
    if (std::exchange(state.asksName, false)) ImGui::OpenPopup(namePopup);
    if (!beginPopup(namePopup)) return;
    setItemScope("layout");
    if (state.replaced.empty())
        nameQuestion(view, state, commands);
    else
        replaceQuestion(state, commands);
    ImGui::EndPopup();
}

void deletingWindow(LayoutMenuState& state, Commands& commands) {
    if (std::exchange(state.asksDelete, false)) ImGui::OpenPopup(deletePopup);
    if (!beginPopup(deletePopup)) return;
    setItemScope("layout");
    ImGui::TextUnformatted(fmt::format("Delete the layout \"{}\" permanently?", state.deleted).c_str());
    ImGui::Spacing();
    const bool deletes = button("Delete", "Deletes the file of the layout.");
    ImGui::SameLine();
    const bool cancelled = button("Cancel", "Keeps the layout (Esc).");
    if (deletes) commands.push_back(DeleteLayout{state.deleted});
    if (deletes || cancelled) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace

void layoutItems(const EditorView& view, LayoutMenuState& state, const Workspace& workspace,
                 Commands& commands) {
    if (item("Next layout", keyOf("next_layout").c_str(), false, nullptr)) commands.push_back(NextLayout{});
    ImGui::Separator();
    if (item("Default", nullptr, areSameLayout(workspace, {}), nullptr)) commands.push_back(ResetLayout{});
    namedItems(view, workspace, commands);
    ImGui::Separator();
    if (item("Back to unsaved layout", nullptr, false,
             view.settings.hasUnsavedLayout
                 ? nullptr
                 : "No layout has replaced panels that were not saved as a layout."))
        commands.push_back(RestoreLayout{});
    if (item("Save as...", nullptr, false, nullptr)) state = {.asksName = true};
    deleteItems(view, state);
}

void layoutWindows(const EditorView& view, LayoutMenuState& state, Commands& commands) {
    namingWindow(view, state, commands);
    deletingWindow(state, commands);
}

}  // namespace worldy::ui
