#include "ui/viewport_overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

#include "ui/theme.h"
#include "ui/widgets.h"

namespace ui {

namespace {

constexpr const char* mouseHelp = "Left drag: move   Right drag: look   Wheel: nearer";
constexpr const char* keyHelp = "W A S D E Q: fly   I J K L: turn   + -: speed   F3: reset";

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

ImU32 colourOf(const glm::vec3& colour) {
    return ImGui::GetColorU32(ImVec4(colour.x, colour.y, colour.z, 1));
}

struct Swatch {
    ImU32 colour = 0;
    std::string label;
};

std::vector<Swatch> legendOf(const ViewportOverlayInput& input) {
    std::vector<Swatch> swatches;
    if (input.settings.colourBy == planet::gl::ColourBy::Level) {
        for (std::uint32_t level = 0; level <= input.deepestLevel; ++level) {
            swatches.push_back(
                {colourOf(planet::gl::levelColour(static_cast<int>(level))), fmt::format("{}", level)});
        }
    }
    if (input.settings.colourBy == planet::gl::ColourBy::Error) {
        for (const double share : {0.0, 0.5, 1.0, 1.5, 2.0}) {
            swatches.push_back({colourOf(planet::gl::errorColour(share)),
                                fmt::format("{:.2g} px", share * input.settings.tauPx)});
        }
    }
    return swatches;
}

// In the top right corner, one row a colour.
void drawLegend(ImDrawList& drawList, const std::vector<Swatch>& swatches, const char* title,
                const Rect& viewport, float margin) {
    if (swatches.empty()) return;
    const float row = std::round(ImGui::GetFontSize() * 1.25f);
    const float pad = std::round(ImGui::GetFontSize() * 0.5f);
    float width = ImGui::CalcTextSize(title).x;
    for (const Swatch& swatch : swatches) {
        width = std::max(width, 1.6f * row + ImGui::CalcTextSize(swatch.label.c_str()).x);
    }
    const ImVec2 end(viewport.x + viewport.width - margin,
                     viewport.y + margin + 2 * pad + row * static_cast<float>(swatches.size() + 1));
    const ImVec2 start(end.x - width - 2 * pad, viewport.y + margin);
    drawList.AddRectFilled(start, end, boxColour(), pad * 0.6f);
    ImVec2 at(start.x + pad, start.y + pad);
    drawList.AddText(at, ImGui::GetColorU32(palette().dim), title);
    for (const Swatch& swatch : swatches) {
        at.y += row;
        drawList.AddRectFilled({at.x, at.y + 2}, {at.x + 1.2f * row, at.y + row - 3}, swatch.colour, 2);
        drawList.AddText({at.x + 1.6f * row, at.y}, ImGui::GetColorU32(palette().text), swatch.label.c_str());
    }
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
    const float widthPx = viewport.width - 4 * margin;
    float y = viewport.y + margin;
    const auto add = [&](const char* text, const ImVec4& colour) {
        badge(drawList, {viewport.x + margin, y}, text, colour);
        y += line;
    };
    // The legend stands on the right.
    add(endThatFits(input.title, 0.7f * widthPx).c_str(), palette().text);
    if (input.lodFrozen) add("LOD frozen (F2)", palette().warning);
    if (input.settings.wireframe) add("Wireframe (F1)", palette().accent);
    if (input.settings.cube) add("Cube (F4)", palette().accent);
    if (!input.settled) add("Loading", palette().good);
    const bool byLevel = input.settings.colourBy == planet::gl::ColourBy::Level;
    drawLegend(drawList, legendOf(input), byLevel ? "Level" : "Error", viewport, margin);
    y = viewport.y + viewport.height - margin - 2 * line;
    add(mouseHelp, palette().dim);
    add(keyHelp, palette().dim);
}

}  // namespace ui
