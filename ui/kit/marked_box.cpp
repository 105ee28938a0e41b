#include "ui/kit/marked_box.h"

#include <cmath>

namespace worldy::ui {

void markedBox(const std::string& text, ImU32 edgeColour) {
    const float pad = std::round(ImGui::GetFontSize() * 0.5f);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float textWidth = width - 3 * pad;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, textWidth);
    const ImVec2 end(corner.x + width, corner.y + size.y + 2 * pad);
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    drawList.AddRectFilled(corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg), pad * 0.5f);
    drawList.AddRectFilled(corner, {corner.x + pad * 0.6f, end.y}, edgeColour, pad * 0.5f);
    ImGui::SetCursorScreenPos({corner.x + 2 * pad, corner.y + pad});
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + textWidth);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::SetCursorScreenPos({corner.x, end.y});
    ImGui::Dummy({width, pad * 0.4f});
}

}  // namespace worldy::ui
