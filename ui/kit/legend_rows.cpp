#include "ui/kit/legend_rows.h"

#include <imgui.h>

#include <cmath>

#include "ui/kit/theme.h"

namespace worldy::ui {

void legendRows(const Legend& legend) {
    const float font = ImGui::GetFontSize();
    const float swatch = std::round(font * 0.75f);
    const float right = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {std::round(font * 0.8f), std::round(font * 0.1f)});
    bool first = true;
    for (const LegendEntry& entry : legend.entries) {
        const float width = swatch * 1.5f + ImGui::CalcTextSize(entry.label.c_str()).x;
        if (!first && ImGui::GetItemRectMax().x + font * 0.8f + width <= right) ImGui::SameLine();
        first = false;
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float top = std::round(at.y + (font - swatch) / 2);
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + swatch, top + swatch},
                                                  packed(entry.colour), 2);
        ImGui::Dummy({width, font});
        ImGui::GetWindowDrawList()->AddText({at.x + swatch * 1.5f, at.y}, packed(palette().dim),
                                            entry.label.c_str());
    }
    ImGui::PopStyleVar();
}

}  // namespace worldy::ui
