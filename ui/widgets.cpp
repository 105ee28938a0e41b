#include "ui/widgets.h"

#include <algorithm>
#include <cmath>

#include "ui/theme.h"

namespace ui {

namespace {

// Share of the panel's width that labels take.
constexpr float labelShare = 0.40f;

}  // namespace

void beginFixedWindow(const char* name, const Rect& rect, ImGuiWindowFlags flags) {
    ImGui::SetNextWindowPos({rect.x, rect.y});
    ImGui::SetNextWindowSize({rect.width, rect.height});
    ImGui::Begin(name, nullptr,
                 flags | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
}

bool section(const char* title) {
    ImGui::Spacing();
    return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
}

void tooltip(const char* text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool beginValues(const char* id) {
    return ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp);
}

void valueRow(const char* name, const std::string& value, const char* explanation, const ImVec4* colour) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
    ImGui::TextUnformatted(name);
    ImGui::PopStyleColor();
    tooltip(explanation);
    ImGui::TableNextColumn();
    const float slack = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(value.c_str()).x;
    if (slack > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + slack);
    ImGui::PushStyleColor(ImGuiCol_Text, colour ? *colour : palette().text);
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopStyleColor();
    tooltip(explanation);
}

void endValues() {
    ImGui::EndTable();
}

void labelledControl(const char* label) {
    const float start = ImGui::GetCursorPosX();
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(label);
    ImGui::SameLine(start + std::round(width * labelShare));
    ImGui::SetNextItemWidth(-1);
}

bool splitter(const char* id, const Rect& rect, bool upright, double& movedPx) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    beginFixedWindow(id, rect, ImGuiWindowFlags_NoScrollbar);
    ImGui::InvisibleButton("bar", {rect.width, rect.height});
    const bool active = ImGui::IsItemActive();
    const bool lit = active || ImGui::IsItemHovered();
    if (lit) ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    const ImGuiCol colour = active ? ImGuiCol_SliderGrabActive
                            : lit  ? ImGuiCol_ScrollbarGrabHovered
                                   : ImGuiCol_Separator;
    ImGui::GetWindowDrawList()->AddRectFilled({rect.x, rect.y}, {rect.x + rect.width, rect.y + rect.height},
                                              ImGui::GetColorU32(colour));
    if (active)
        movedPx += static_cast<double>(upright ? ImGui::GetIO().MouseDelta.x : ImGui::GetIO().MouseDelta.y);
    ImGui::End();
    ImGui::PopStyleVar(2);
    return active;
}

void usageBar(double share, const std::string& text) {
    if (share > 1) ImGui::PushStyleColor(ImGuiCol_PlotHistogram, palette().bad);
    ImGui::ProgressBar(static_cast<float>(std::clamp(share, 0.0, 1.0)), {-1, 0}, text.c_str());
    if (share > 1) ImGui::PopStyleColor();
}

ImU32 boxColour() {
    return ImGui::GetColorU32(ImVec4(0.07f, 0.08f, 0.10f, 0.78f));
}

void badge(ImDrawList& drawList, ImVec2 position, const char* text, const ImVec4& colour) {
    const float pad = std::round(ImGui::GetFontSize() * 0.45f);
    const ImVec2 size = ImGui::CalcTextSize(text);
    const ImVec2 end(position.x + size.x + 2 * pad, position.y + size.y + pad);
    drawList.AddRectFilled(position, end, boxColour(), pad * 0.6f);
    drawList.AddText({position.x + pad, position.y + pad / 2}, ImGui::GetColorU32(colour), text);
}

}  // namespace ui
