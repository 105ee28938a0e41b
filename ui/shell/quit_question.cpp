#include "ui/shell/quit_question.h"

#include <imgui.h>

#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

void quitQuestion(const SettingsView& settings, Commands& commands) {
    constexpr const char* popup = "Regions are not saved###quit question";
    const bool isAsked = !settings.quitQuestion.empty();
    if (isAsked && !ImGui::IsPopupOpen(popup)) ImGui::OpenPopup(popup);
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(popup, nullptr,
                                ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    setItemScope("quit");
    ImGui::PushTextWrapPos(32 * ImGui::GetFontSize());
    ImGui::TextUnformatted("Quitting now would lose the changes of the regions in:");
    noteItem("Question");
    for (const std::string& file : settings.quitQuestion) ImGui::TextUnformatted(file.c_str());
    ImGui::PopTextWrapPos();
    ImGui::Spacing();
    const bool saves =
        button("Save and quit", "Saves the regions in these files. The window stays open if that fails.");
    const bool discards = button("Quit without saving", "Loses the changes.");
    const bool stays = button("Cancel", "Keeps the window open (Esc).") ||
                       ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (saves) commands.emplace_back(Quit{Quit::Unsaved::Save});
    if (discards) commands.emplace_back(Quit{Quit::Unsaved::Discard});
    if (stays) commands.emplace_back(KeepWindow{});
    if (saves || discards || stays || !isAsked) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace worldy::ui
