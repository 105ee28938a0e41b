#include "ui/viewport_overlay.h"

#include <cmath>

#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

constexpr const char* help =
    "Left drag: move   Right drag: look   Wheel: nearer   W A S D E Q: fly   I J K L: turn   + -: speed   F3: reset";

// As much of a text's end as fits, after an ellipsis.
std::string endThatFits(const std::string& text, float widthPx) {
    std::string shown = text;
    std::size_t start = 0;
    while (start < text.size() && ImGui::CalcTextSize(shown.c_str()).x > widthPx) {
        ++start;
        while (start < text.size() && (static_cast<unsigned char>(text[start]) & 0xC0u) == 0x80u) ++start;
        shown = "..." + text.substr(start);
    }
    return shown;
}

void shadowedText(ImDrawList& drawList, ImVec2 position, const char* text) {
    drawList.AddText({position.x + 1, position.y + 1}, IM_COL32(0, 0, 0, 200), text);
    drawList.AddText(position, ImGui::GetColorU32(ImVec4(0.85f, 0.88f, 0.92f, 0.8f)), text);
}

}  // namespace

void viewportPicture(ImTextureID picture, const Rect& viewport) {
    ImGui::InvisibleButton("picture", {viewport.width, viewport.height},
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    const ImVec2 end(viewport.x + viewport.width, viewport.y + viewport.height);
    ImGui::GetWindowDrawList()->AddImage(picture, {viewport.x, viewport.y}, end, {0, 1}, {1, 0});
}

void viewportOverlay(const ViewportOverlayInput& input, const Rect& viewport) {
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    const float margin = std::round(ImGui::GetFontSize() * 0.7f);
    const float line = std::round(ImGui::GetFontSize() * 1.9f);
    const float widthPx = viewport.width - 2 * margin;
    shadowedText(drawList, {viewport.x + margin, viewport.y + margin},
                 endThatFits(input.title, widthPx).c_str());
    float y = viewport.y + margin + line;
    const auto add = [&](const char* text, const ImVec4& colour) {
        badge(drawList, {viewport.x + margin, y}, text, colour);
        y += line;
    };
    if (input.lodFrozen) add("LOD frozen (F2)", palette().warning);
    if (input.settings.wireframe) add("Wireframe (F1)", palette().accent);
    if (input.settings.cube) add("Cube (F4)", palette().accent);
    if (!input.settled) add("Loading", palette().good);
    if (ImGui::CalcTextSize(help).x < widthPx) {
        shadowedText(drawList,
                     {viewport.x + margin, viewport.y + viewport.height - margin - ImGui::GetFontSize()},
                     help);
    }
}

}  // namespace ui
