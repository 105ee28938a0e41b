#include "ui/shell/message_box.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

namespace {

struct LineContent {
    std::string id;  // of its window, and the scope of its items
    const std::string& text;
    const ImVec4& colour;
    bool takesClicks;
};

struct FloatingLine {
    float bottom;
    bool clicked;
};

// Draws wrapped text in a box, centred in the viewport below top.
FloatingLine floatingLine(const LineContent& content, const Rect& viewport, float top) {
    const float line = ImGui::GetFontSize();
    const ImVec2 padding{0.6f * line, 0.3f * line};
    const float wrap = std::max(viewport.width - 2 * (padding.x + 0.7f * line), 4 * line);
    const ImVec2 text = ImGui::CalcTextSize(content.text.c_str(), nullptr, false, wrap);
    ImGui::SetNextWindowPos({viewport.x + viewport.width / 2, top + 0.7f * line}, ImGuiCond_Always,
                            {0.5f, 0});
    // ImGui's own size lags one frame behind a changing text.
    ImGui::SetNextWindowSize({std::ceil(text.x + 2 * padding.x) + 1, std::ceil(text.y + 2 * padding.y)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, padding);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImVec4 background = palette().box;
    background.w = 1;
    ImGui::PushStyleColor(ImGuiCol_WindowBg, background);
    ImGui::Begin(content.id.c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                     (content.takesClicks ? 0 : ImGuiWindowFlags_NoInputs));
    setItemScope(content.id);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
    ImGui::PushStyleColor(ImGuiCol_Text, content.colour);
    ImGui::TextUnformatted(content.text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
    noteItem("Text");
    const ImVec2 at = ImGui::GetWindowPos();
    const ImVec2 size = ImGui::GetWindowSize();
    noteRect("Box", {at.x, at.y, size.x, size.y});
    const bool hovered = content.takesClicks && ImGui::IsWindowHovered();
    if (hovered) ImGui::SetTooltip("Click to close this.");
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    return {at.y + size.y, hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left)};
}

}  // namespace

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

float confirmationLine(Confirmation& confirmation, double timeS, const Rect& viewport) {
    if (timeS > confirmation.untilS) confirmation = {};
    if (confirmation.text.empty()) return viewport.y;
    return floatingLine({"confirmation", confirmation.text, palette().good, false}, viewport, viewport.y)
        .bottom;
}

void alertBoxes(std::vector<Alert>& alerts, double timeS, const Rect& viewport, float top) {
    std::erase_if(alerts, [&](const Alert& alert) { return timeS > alert.untilS; });
    top = std::max(top, viewport.y + 2 * ImGui::GetFontSize());  // below the planet's name
    std::optional<std::size_t> clicked;
    std::size_t drawn = 0;
    for (; drawn < alerts.size() && top < viewport.y + viewport.height / 2; ++drawn) {
        const Alert& alert = alerts[drawn];
        const std::string text =
            alert.count > 1 ? fmt::format("{} ({} times)", alert.text, alert.count) : alert.text;
        const ImVec4& colour = alert.level == LogLevel::Error ? palette().bad : palette().warning;
        const FloatingLine line =
            floatingLine({fmt::format("alert {}", drawn), text, colour, true}, viewport, top);
        if (line.clicked) clicked = drawn;
        top = line.bottom;
    }
    if (const std::size_t more = alerts.size() - drawn; more > 0) {
        const std::string text = withKey(fmt::format("{} more: see the Log panel", more), "panel_log");
        floatingLine({"more alerts", text, palette().warning, false}, viewport, top);
    }
    if (clicked) alerts.erase(alerts.begin() + static_cast<std::ptrdiff_t>(*clicked));
}

}  // namespace worldy::ui
