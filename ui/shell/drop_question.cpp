#include "ui/shell/drop_question.h"

#include <fmt/format.h>
#include <imgui.h>

#include "ui/kit/item_map.h"
#include "ui/kit/widgets.h"

namespace worldy::ui {

namespace {

std::string questionOf(const SourcesView& sources) {
    const std::string first = sources.dropped.front().filename().string();
    const std::size_t others = sources.dropped.size() - 1;
    return others == 0 ? fmt::format("How should {} be opened?", first)
                       : fmt::format("How should {} and {} more be opened?", first, others);
}

}  // namespace

void dropQuestion(const SourcesView& sources, Commands& commands) {
    constexpr const char* popup = "Open rasters###drop question";
    if (sources.dropped.empty()) return;
    if (!ImGui::IsPopupOpen(popup)) ImGui::OpenPopup(popup);
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(popup, nullptr,
                                ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
        return;
    setItemScope("drop");
    ImGui::TextUnformatted(questionOf(sources).c_str());
    noteItem("Question");
    ImGui::Spacing();
    const bool add =
        button("Add as a layer of this planet",
               "Adds the rasters on top of the layers in the Sources panel. Bake there to see them.");
    noteItem("Add as a layer");
    const bool open =
        button("Open as a planet alone", "Bakes the rasters as a planet and shows it instead of this one.");
    noteItem("Open as a planet");
    const bool cancel = button("Cancel", "Does nothing (Esc).") ||
                        ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    noteItem("Cancel");
    if (add) commands.emplace_back(AddDroppedFiles{});
    if (open) commands.emplace_back(OpenDroppedFiles{});
    if (cancel) commands.emplace_back(DismissDrop{});
    if (add || open || cancel) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

}  // namespace worldy::ui
