#include "ui/kit/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

Palette currentPalette;  // one per process, like ImGui's style

Palette paletteOf(Theme theme) {
    Palette colours;
    if (theme == Theme::Dark) return colours;
    colours.text = {0.10f, 0.12f, 0.14f, 1};
    colours.dim = {0.38f, 0.42f, 0.46f, 1};
    colours.accent = {0.04f, 0.40f, 0.78f, 1};
    colours.good = {0.10f, 0.50f, 0.16f, 1};
    colours.warning = {0.66f, 0.40f, 0.00f, 1};
    colours.bad = {0.78f, 0.14f, 0.12f, 1};
    colours.box = {0.97f, 0.98f, 0.99f, 0.82f};
    return colours;
}

ImFont* loadFont(float sizePx) {
    constexpr const char* file = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
    std::error_code status;
    if (!std::filesystem::exists(file, status)) return nullptr;
    // The ranges are Latin, Greek, punctuation with dashes, arrows, and the signs of bounds.
    static constexpr std::array<ImWchar, 11> ranges = {0x20,   0x17F,  0x370,  0x3FF,  0x2010, 0x2027,
                                                       0x2190, 0x21FF, 0x2264, 0x2265, 0};
    return ImGui::GetIO().Fonts->AddFontFromFileTTF(file, sizePx, nullptr, ranges.data());
}

// Greys are given for the dark theme; the light theme inverts them.
void setColours(ImGuiStyle& style, Theme theme) {
    const auto grey = [theme](float level, float alpha = 1) {
        if (theme == Theme::Dark) return ImVec4(level, level * 1.04f, level * 1.10f, alpha);
        const float light = 1.04f - 1.05f * level;
        return ImVec4(light * 0.985f, light * 0.99f, std::min(light, 1.0f), alpha);
    };
    const ImVec4 accent = palette().accent;
    const auto tinted = [&](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = palette().text;
    c[ImGuiCol_TextDisabled] = palette().dim;
    c[ImGuiCol_WindowBg] = grey(0.105f);
    c[ImGuiCol_ChildBg] = grey(0, 0);
    c[ImGuiCol_PopupBg] = grey(0.14f);
    c[ImGuiCol_Border] = grey(0.24f);
    c[ImGuiCol_FrameBg] = grey(0.17f);
    c[ImGuiCol_FrameBgHovered] = grey(0.22f);
    c[ImGuiCol_FrameBgActive] = grey(0.26f);
    c[ImGuiCol_Button] = grey(0.21f);
    c[ImGuiCol_ButtonHovered] = grey(0.28f);
    c[ImGuiCol_ButtonActive] = tinted(0.65f);
    c[ImGuiCol_Header] = tinted(theme == Theme::Dark ? 0.40f : 0.28f);
    c[ImGuiCol_HeaderHovered] = tinted(theme == Theme::Dark ? 0.50f : 0.38f);
    c[ImGuiCol_HeaderActive] = tinted(theme == Theme::Dark ? 0.60f : 0.48f);
    c[ImGuiCol_CheckMark] = accent;
    c[ImGuiCol_SliderGrab] = tinted(0.55f);
    c[ImGuiCol_SliderGrabActive] = tinted(0.80f);
    c[ImGuiCol_PlotHistogram] = tinted(0.75f);
    c[ImGuiCol_ScrollbarBg] = grey(0, 0);
    c[ImGuiCol_ScrollbarGrab] = grey(0.26f);
    c[ImGuiCol_ScrollbarGrabHovered] = grey(0.32f);
    c[ImGuiCol_ScrollbarGrabActive] = grey(0.38f);
    c[ImGuiCol_Separator] = grey(0.20f);
    c[ImGuiCol_MenuBarBg] = grey(0.135f);
    c[ImGuiCol_Tab] = grey(0.135f);
    c[ImGuiCol_TabHovered] = tinted(0.35f);
    c[ImGuiCol_TabActive] = grey(0.21f);
    c[ImGuiCol_TabUnfocused] = grey(0.135f);
    c[ImGuiCol_TabUnfocusedActive] = grey(0.21f);
    c[ImGuiCol_TableHeaderBg] = grey(0.155f);
    c[ImGuiCol_TableBorderStrong] = grey(0.24f);
    c[ImGuiCol_TableBorderLight] = grey(0.19f);
    c[ImGuiCol_TableRowBg] = grey(0, 0);
    c[ImGuiCol_TableRowBgAlt] = theme == Theme::Dark ? ImVec4(1, 1, 1, 0.025f) : ImVec4(0, 0, 0, 0.03f);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = grey(0.16f);
    c[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.35f);
    c[ImGuiCol_PlotLines] = palette().dim;
    c[ImGuiCol_TextSelectedBg] = tinted(0.35f);
}

void setSizes(ImGuiStyle& style, float scale) {
    style.WindowRounding = 0;
    style.WindowBorderSize = 0;
    style.WindowPadding = ImVec2(10, 8);
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.PopupRounding = 4;
    style.ScrollbarRounding = 6;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 7;
    style.FramePadding = ImVec2(7, 3);
    style.ItemSpacing = ImVec2(8, 5);
    style.ItemInnerSpacing = ImVec2(6, 4);
    style.CellPadding = ImVec2(4, 1);
    style.ScaleAllSizes(scale);
}

}  // namespace

const Palette& palette() {
    return currentPalette;
}

ImU32 packed(const ImVec4& colour, float alpha) {
    return ImGui::GetColorU32(ImVec4(colour.x, colour.y, colour.z, alpha));
}

ImU32 packed(const ImVec4& colour) {
    return packed(colour, 1);
}

ImU32 packed(const glm::vec3& colour) {
    return packed(ImVec4(colour.x, colour.y, colour.z, 1), 1);
}

void applyTheme(Theme theme, float contentScale) {
    currentPalette = paletteOf(theme);
    const float sizePx = std::round(baseFontPx * contentScale);
    ImGui::GetIO().Fonts->Clear();
    const bool hasGreek = loadFont(sizePx) != nullptr;
    setFontHasGreek(hasGreek);
    if (!hasGreek) {
        ImFontConfig config;
        config.SizePixels = std::round(13 * contentScale);
        ImGui::GetIO().Fonts->AddFontDefault(&config);
    }
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    theme == Theme::Dark ? ImGui::StyleColorsDark(&style) : ImGui::StyleColorsLight(&style);
    setColours(style, theme);
    setSizes(style, contentScale);
}

float unitPx() {
    return ImGui::GetFontSize() / 13;
}

}  // namespace worldy::ui
