#include "ui/shell/compare_overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/base/percent_text.h"
#include "app/base/text.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/model/key_names.h"

namespace worldy::ui {

namespace {

float dividerX(const CompareSettings& shown, const Rect& viewport) {
    const float share = shown.mode == CompareMode::Wipe ? static_cast<float>(shown.wipe) : 0.5f;
    return viewport.x + std::round(viewport.width * share);
}

bool isDivided(CompareMode mode) {
    return mode == CompareMode::SideBySide || mode == CompareMode::Wipe;
}

ImVec2 badgeSize(const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = std::round(ImGui::GetFontSize() * 0.45f);
    return {size.x + 2 * pad, size.y + pad};
}

// Draws a light line between two dark ones, visible on any background.
void drawDivider(ImDrawList& drawList, float x, const Rect& viewport) {
    const float half = std::max(1.0f, std::round(ImGui::GetFontSize() / 12));
    drawList.AddRectFilled({x - 2 * half, viewport.y}, {x + 2 * half, viewport.y + viewport.height},
                           IM_COL32(0, 0, 0, 160));
    drawList.AddRectFilled({x - half, viewport.y}, {x + half, viewport.y + viewport.height},
                           IM_COL32(255, 255, 255, 230));
}

void drawGrip(ImDrawList& drawList, float x, float y) {
    const float radius = std::round(ImGui::GetFontSize() * 0.6f);
    drawList.AddCircleFilled({x, y}, radius + 2, IM_COL32(0, 0, 0, 160));
    drawList.AddCircleFilled({x, y}, radius, IM_COL32(255, 255, 255, 230));
    const float tip = radius * 0.6f, base = radius * 0.2f, high = radius * 0.45f;
    drawList.AddTriangleFilled({x - tip, y}, {x - base, y - high}, {x - base, y + high},
                               IM_COL32(40, 40, 40, 255));
    drawList.AddTriangleFilled({x + tip, y}, {x + base, y + high}, {x + base, y - high},
                               IM_COL32(40, 40, 40, 255));
}

// Returns the y position of labels, above the line of mouse and key hints.
float labelY(const Rect& viewport) {
    return viewport.y + viewport.height - 4.5f * ImGui::GetFontSize();
}

void drawSideLabels(ImDrawList& drawList, const CompareView& compare, const CompareSettings& shown,
                    const Rect& viewport) {
    std::array<std::string, 2> names = sideNames(compare);
    const float x = dividerX(shown, viewport);
    const float gap = std::round(ImGui::GetFontSize() * 0.9f);
    const float y = labelY(viewport);
    // If a name does not fit, only its letter is drawn.
    const float roomA = x - viewport.x - gap;
    const float roomB = viewport.x + viewport.width - x - gap;
    if (badgeSize(names[0]).x > roomA) names[0] = "A";
    if (badgeSize(names[1]).x > roomB) names[1] = "B";
    if (badgeSize(names[0]).x <= roomA)
        badge(drawList, {x - gap - badgeSize(names[0]).x, y}, names[0].c_str(), palette().accent);
    if (badgeSize(names[1]).x <= roomB) badge(drawList, {x + gap, y}, names[1].c_str(), palette().warning);
}

// Returns the longest text that fits.
std::string differenceText(const CompareView& compare, const CompareSettings& shown, float widthPx) {
    const std::string what = fmt::format("|A - B| x {:.3g}", shown.gain);
    std::vector<std::string> texts = {what};
    if (compare.difference) {
        const PictureDifferenceNow& now = *compare.difference;
        const std::string many = percentText(now.pixels, now.of) + " differ";
        if (now.pixels == 0)
            texts = {what + "   no pixel differs", "no pixel differs"};
        else
            texts = {fmt::format("{}   {} pixels, {}, by at most {} of 255", what, now.pixels, many,
                                 now.largestSteps),
                     fmt::format("{}   {}, by at most {}", what, many, now.largestSteps), many};
    }
    for (const std::string& text : texts) {
        if (badgeSize(text).x <= widthPx) return text;
    }
    return {};
}

void drawMiddleLabel(ImDrawList& drawList, const std::string& text, const ImVec4& colour,
                     const Rect& viewport) {
    if (text.empty()) return;
    const float x = viewport.x + std::max((viewport.width - badgeSize(text).x) / 2, 0.0f);
    badge(drawList, {std::round(x), labelY(viewport)}, text.c_str(), colour);
}

// Draws a pointer at the same place in the other half.
void drawTwinPointer(ImDrawList& drawList, const Rect& viewport) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (!ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) return;
    const float half = viewport.width / 2;
    const ImVec2 at(mouse.x + (mouse.x < viewport.x + half ? half : -half), mouse.y);
    const float arm = std::round(ImGui::GetFontSize() * 0.6f);
    for (const auto& [width, colour] :
         {std::pair{3.0f, IM_COL32(0, 0, 0, 200)}, std::pair{1.0f, IM_COL32(255, 255, 255, 255)}}) {
        drawList.AddLine({at.x - arm, at.y}, {at.x + arm, at.y}, colour, width);
        drawList.AddLine({at.x, at.y - arm}, {at.x, at.y + arm}, colour, width);
    }
}

}  // namespace

std::array<std::string, 2> sideNames(const CompareView& compare) {
    if (compare.different.empty() && compare.fileA == compare.fileB) return {"A", "B, equal settings"};
    std::array<std::string, 2> names = {"A", "B"};
    if (compare.fileA != compare.fileB) {
        names[0] += "  " + compare.names[0];
        names[1] += "  " + compare.names[1];
    }
    if (compare.different.size() == 1) {
        const SettingDifference& one = compare.different.front();
        const std::string setting = inFont(one.label);
        const auto [a, b] = shortNumberTexts(one.here, one.there);
        names[0] += fmt::format("  {} {}", setting, a);
        names[1] += fmt::format("  {} {}", setting, b);
    } else if (!compare.different.empty()) {
        names[1] += fmt::format("  {} settings differ", compare.different.size());
    }
    return names;
}

std::vector<ShownPart> shownParts(const CompareView& compare, const CompareSettings& shown,
                                  const Rect& viewport) {
    if (!compare.on) return {{false, viewport, viewport}};
    const float x = dividerX(shown, viewport);
    const Rect left{viewport.x, viewport.y, x - viewport.x, viewport.height};
    const Rect right{x, viewport.y, viewport.x + viewport.width - x, viewport.height};
    switch (shown.mode) {
        case CompareMode::Wipe:
            return {{false, left, viewport}, {true, right, viewport}};
        case CompareMode::SideBySide: {
            Rect wholeA = viewport, wholeB = viewport;
            wholeA.x -= viewport.width / 4;
            wholeB.x += viewport.width / 4;
            return {{false, left, wholeA}, {true, right, wholeB}};
        }
        case CompareMode::Flip:
            return {{shown.showB, viewport, viewport}};
        case CompareMode::Difference:
            break;
    }
    return {{false, viewport, viewport}};
}

void wipeHandle(CompareSettings& shown, const Rect& viewport) {
    const float half = std::round(ImGui::GetFontSize() * 0.5f);
    const float x = dividerX(shown, viewport);
    const ImVec2 before = ImGui::GetCursorScreenPos();
    const float from = std::clamp(x - half, viewport.x, viewport.x + viewport.width - 2 * half);
    ImGui::SetCursorScreenPos({from, viewport.y});
    ImGui::InvisibleButton("wipe", {2 * half, viewport.height});
    noteItem("Wipe");
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive()) {
        const float share = (ImGui::GetIO().MousePos.x - viewport.x) / std::max(viewport.width, 1.0f);
        shown.wipe = static_cast<double>(std::clamp(share, 0.0f, 1.0f));
    }
    ImGui::SetCursorScreenPos(before);
}

void compareOverlay(const CompareView& compare, const CompareSettings& shown, const Rect& viewport) {
    if (!compare.on) return;
    ImDrawList& drawList = *ImGui::GetWindowDrawList();
    if (isDivided(shown.mode)) {
        const float x = dividerX(shown, viewport);
        drawDivider(drawList, x, viewport);
        if (shown.mode == CompareMode::Wipe)
            drawGrip(drawList, x, labelY(viewport) + 0.75f * ImGui::GetFontSize());
        else
            drawTwinPointer(drawList, viewport);
        return drawSideLabels(drawList, compare, shown, viewport);
    }
    if (shown.mode == CompareMode::Difference)
        return drawMiddleLabel(drawList, differenceText(compare, shown, viewport.width), palette().text,
                               viewport);
    std::string name = sideNames(compare)[shown.showB ? 1 : 0] +
                       (keyOf("flip_compared").empty() ? "" : "   " + keyOf("flip_compared") + ": flip");
    if (badgeSize(name).x > viewport.width) name = shown.showB ? "B" : "A";
    drawMiddleLabel(drawList, name, shown.showB ? palette().warning : palette().accent, viewport);
}

}  // namespace worldy::ui
