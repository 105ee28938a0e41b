#include "ui/shell/message_box.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

void messageBox(Message& message, Commands& commands) {
    constexpr const char* popup = "###message";
    if (message.title.empty()) return;
    if (std::exchange(message.opening, false)) ImGui::OpenPopup(popup);
    ImGui::SetNextWindowPos(ImGui::GetMainViewport()->GetCenter(), ImGuiCond_Always, {0.5f, 0.5f});
    const std::string title = message.title + popup;
    if (!ImGui::BeginPopupModal(title.c_str(), nullptr,
                                ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
        if (!ImGui::IsPopupOpen(popup)) message = {};  // closed by Esc
        return;
    }
    setItemScope("message");
    ImGui::PushTextWrapPos(32 * ImGui::GetFontSize());
    ImGui::TextColored(palette().bad, "%s", message.text.c_str());
    noteItem("Text");
    if (!message.advice.empty()) {
        ImGui::Spacing();
        ImGui::TextUnformatted(message.advice.c_str());
    }
    ImGui::PopTextWrapPos();
    ImGui::Spacing();
    const bool opens = message.offersOpen &&
                       button("Open another file...", withKey("Shows the open dialog.", "open").c_str());
    if (message.offersOpen) ImGui::SameLine();
    bool closed = button("Close", "The Log panel keeps the message (Esc).") || opens;
    // An Enter that opened the box does not close it.
    if (!ImGui::IsWindowAppearing()) closed |= ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
    if (opens) commands.push_back(AskForFile{});
    if (closed) {
        message = {};
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void confirmationLine(Confirmation& confirmation, double timeS, const Rect& viewport) {
    if (confirmation.text.empty()) return;
    if (timeS > confirmation.untilS) {
        confirmation = {};
        return;
    }
    const float line = ImGui::GetFontSize();
    const ImVec2 padding{0.6f * line, 0.3f * line};
    const float wrap = std::max(viewport.width - 2 * (padding.x + 0.7f * line), 4 * line);
    const ImVec2 text = ImGui::CalcTextSize(confirmation.text.c_str(), nullptr, false, wrap);
    ImGui::SetNextWindowPos({viewport.x + viewport.width / 2, viewport.y + 0.7f * line}, ImGuiCond_Always,
                            {0.5f, 0});
    // ImGui's own size lags one frame behind a changing text.
    ImGui::SetNextWindowSize({std::ceil(text.x + 2 * padding.x) + 1, std::ceil(text.y + 2 * padding.y)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImVec4 background = palette().box;
    background.w = 1;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, background);
    ImGui::Begin("confirmation", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoNav |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    setItemScope("confirmation");
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
    ImGui::PushStyleColor(ImGuiCol_Text, palette().good);
    ImGui::TextUnformatted(confirmation.text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    noteItem("Text");
    const ImVec2 at = ImGui::GetWindowPos();
    noteRect("Box", {at.x, at.y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

}  // namespace worldy::ui
