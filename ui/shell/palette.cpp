#include "ui/shell/palette.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string>

#include "app/settings/settings_schema.h"
#include "ui/kit/item_map.h"
#include "ui/kit/setting_controls.h"
#include "ui/kit/theme.h"
#include "ui/kit/widgets.h"
#include "ui/model/font_symbols.h"
#include "ui/shell/focus.h"
#include "ui/shell/palette_items.h"

namespace worldy::ui {

namespace {

constexpr const char* windowName = "palette";
constexpr int mostLines = 14;

bool isPressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

// ---- The list ----

void moveChosen(PaletteState& state, std::size_t rows, int page) {
    if (rows == 0) return;
    auto chosen = static_cast<int>(std::min(state.chosen, rows - 1));
    const int last = static_cast<int>(rows) - 1;
    int step = 0;
    if (isPressed(ImGuiKey_DownArrow)) step = chosen == last ? -last : 1;
    if (isPressed(ImGuiKey_UpArrow)) step = chosen == 0 ? last : -1;
    if (isPressed(ImGuiKey_PageDown)) step = page;
    if (isPressed(ImGuiKey_PageUp)) step = -page;
    chosen = std::clamp(chosen + step, 0, last);
    state.chosen = static_cast<std::size_t>(chosen);
    state.scrollsToChosen |= step != 0;
}

// Draws a text in one line that ends before right. Returns where it ends.
float textTo(float x, float y, float right, const std::string& text, const ImVec4& colour) {
    const float width = ImGui::CalcTextSize(text.c_str()).x;
    ImGui::PushClipRect({x, y}, {std::max(right, x), y + ImGui::GetTextLineHeight()}, true);
    ImGui::GetWindowDrawList()->AddText({x, y}, packed(colour), text.c_str());
    ImGui::PopClipRect();
    return x + width;
}

// Draws a title with its matched letters in another colour.
float titleTo(float x, float y, float right, const std::string& title, const std::vector<TextPart>& matched,
              bool isGrey) {
    const ImVec4& plain = isGrey ? palette().dim : palette().text;
    std::size_t at = 0;
    for (const TextPart& part : matched) {
        x = textTo(x, y, right, inFont(title.substr(at, part.first - at)), plain);
        const std::string letters = inFont(title.substr(part.first, part.size));
        const float from = x;
        x = textTo(x, y, right, letters, isGrey ? palette().dim : palette().accent);
        const float line = y + ImGui::GetTextLineHeight() - 1;
        if (from < right)
            ImGui::GetWindowDrawList()->AddLine({from, line}, {std::min(x, right), line},
                                                packed(isGrey ? palette().dim : palette().accent));
        at = part.first + part.size;
    }
    return textTo(x, y, right, inFont(title.substr(at)), plain);
}

void drawRow(const PaletteEntry& entry, const PaletteRow& row, ImVec2 at, float right) {
    const float gap = ImGui::GetFontSize() * 0.8f;
    const bool isGrey = !entry.whyNot.empty();
    const float titleX = at.x + ImGui::CalcTextSize("bookmark").x + gap;
    textTo(at.x, at.y, titleX, paletteKindName(entry.kind), palette().dim);
    const float keyWidth = entry.key.empty() ? 0 : ImGui::CalcTextSize(entry.key.c_str()).x + gap;
    const float end = right - keyWidth;
    const float titleEnd = titleTo(titleX, at.y, end, entry.title, row.matched, isGrey);
    const std::string& detail = isGrey ? entry.whyNot : entry.detail;
    textTo(titleEnd + gap, at.y, end, inFont(detail), isGrey ? palette().warning : palette().dim);
    if (!entry.key.empty()) textTo(right - keyWidth + gap, at.y, right, entry.key, palette().accent);
}

// Chooses an entry. The palette stays open for a setting, and for an entry that cannot be chosen.
void choose(const PaletteEntry& entry, const PaletteChoice& choice, bool looksAt,
            const ActionContext& context) {
    PaletteState& state = context.menu.palette;
    if (!entry.whyNot.empty()) return;
    if (!entry.isTyped) remember(state.recent, nameOf(entry));
    if (!choice.setting.empty()) {
        state.edited = choice.setting;
        state.takesFocus = true;
        return;
    }
    state.isOpen = false;
    looksAt&& choice.lookAt ? choice.lookAt(context) : choice.choose(context);
}

void listRows(const PaletteItems& items, const std::vector<PaletteRow>& rows, const ActionContext& context) {
    PaletteState& state = context.menu.palette;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(rows.size()), ImGui::GetTextLineHeightWithSpacing());
    if (state.scrollsToChosen)
        clipper.ForceDisplayRangeByIndices(static_cast<int>(state.chosen),
                                           static_cast<int>(state.chosen) + 1);
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const auto row = static_cast<std::size_t>(i);
            const PaletteEntry& entry = items.entries[rows[row].entry];
            ImGui::PushID(i);
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float right = at.x + ImGui::GetContentRegionAvail().x;
            const bool isChosen = row == state.chosen;
            if (ImGui::Selectable("##row", isChosen)) {
                state.chosen = row;
                choose(entry, items.choices[rows[row].entry], ImGui::GetIO().KeyCtrl, context);
            }
            noteItem(entry.title);
            if (isChosen) {
                noteItem("Chosen");
                if (state.scrollsToChosen) ImGui::SetScrollHereY();
            }
            drawRow(entry, rows[row], at, right);
            ImGui::PopID();
        }
    }
    clipper.End();
    state.scrollsToChosen = false;
}

bool queryField(PaletteState& state) {
    ImGui::SetNextItemWidth(-1);
    // The field keeps the focus while the list is used.
    if (state.takesFocus || !ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();
    state.takesFocus = false;
    // With the history's callback the field leaves the arrows to the list.
    const bool entered = ImGui::InputTextWithHint(
        "##query", "Command, panel, setting, bookmark, flight, preset, chunk or place", state.query.data(),
        state.query.size(), ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackHistory,
        [](ImGuiInputTextCallbackData*) { return 0; });
    noteItem("Query");
    return entered;
}

void footer(const std::string& text) {
    ImGui::Separator();
    const float height = 2 * ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float right = at.x + ImGui::GetContentRegionAvail().x;
    ImGui::PushClipRect(at, {right, at.y + height}, true);
    wrappedText(text, palette().dim);
    ImGui::PopClipRect();
    noteItem("Help");
}

void list(const ActionContext& context, float linesRoom) {
    PaletteState& state = context.menu.palette;
    const std::string before = state.query.data();
    const bool entered = queryField(state);
    if (before != state.query.data()) {
        state.chosen = 0;
        state.scrollsToChosen = true;
    }
    const PaletteItems items = paletteItems(state.query.data(), context);
    const std::vector<PaletteRow> rows = paletteRows(state.query.data(), items.entries, state.recent);
    const int lines = std::clamp(static_cast<int>(linesRoom), 3, mostLines);
    moveChosen(state, rows.size(), lines - 1);
    state.chosen = rows.empty() ? 0 : std::min(state.chosen, rows.size() - 1);
    ImGui::BeginChild("rows", {0, static_cast<float>(lines) * ImGui::GetTextLineHeightWithSpacing()}, false,
                      ImGuiWindowFlags_NoNavInputs);
    if (rows.empty()) emptyState("Nothing is called so.");
    const bool wasOpen = state.isOpen;
    listRows(items, rows, context);
    ImGui::EndChild();
    if (rows.empty()) return footer("");
    const PaletteEntry& chosen = items.entries[rows[state.chosen].entry];
    footer(chosen.whyNot.empty() ? chosen.help : "Not possible now: " + chosen.whyNot);
    const bool stillListed = wasOpen == state.isOpen && state.edited.empty();
    if (entered && stillListed)
        choose(chosen, items.choices[rows[state.chosen].entry], ImGui::GetIO().KeyCtrl, context);
}

// ---- A setting ----

// Lists and check boxes take no typed number, so the focus alone moves to them.
bool isTyped(const Field& field) {
    return !std::holds_alternative<Choice>(field.value) && !std::holds_alternative<Flag>(field.value);
}

void settingEditor(const Field& field, PaletteState& state) {
    if (button("<", "Goes back to the list (Esc).")) return leavePalette(state);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(inFont(std::string(titleOf(field))).c_str());
    ImGui::SameLine();
    ImGui::TextColored(palette().dim, "%s", field.name().c_str());
    // The help is written below, so the focus alone shows no tooltip over it.
    ImGui::GetCurrentContext()->NavDisableMouseHover = false;
    const bool takesFocus = std::exchange(state.takesFocus, false);
    if (takesFocus && isTyped(field)) ImGui::SetKeyboardFocusHere();
    settingControl(field);
    if (takesFocus) {
        if (!isTyped(field)) ImGui::SetFocusID(ImGui::GetItemID(), ImGui::GetCurrentWindow());
        ImGui::GetCurrentContext()->NavDisableHighlight = false;
    }
    ImGui::Separator();
    wrappedText(settingTip(field), palette().dim);
    wrappedText(isTyped(field)
                    ? "Type a value and press Enter. Or press Space, then Left or Right to drag the slider."
                    : "Press Space to change it; choose from a list with the arrows and Enter.",
                palette().dim);
    noteItem("Help");
}

void beginPalette(bool isList) {
    const ImGuiViewport& screen = *ImGui::GetMainViewport();
    const float font = ImGui::GetFontSize();
    const float width = std::min(46 * font, screen.WorkSize.x - 2 * font);
    ImGui::SetNextWindowPos({screen.GetCenter().x, screen.WorkPos.y + 0.06f * screen.WorkSize.y},
                            ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ImGui::GetStyle().PopupRounding);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImGui::GetStyleColorVec4(ImGuiCol_PopupBg));
    ImGui::Begin(windowName, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     (isList ? ImGuiWindowFlags_NoNavInputs : 0));
}

void endPalette() {
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

}  // namespace

void palette(const ActionContext& context) {
    PaletteState& state = context.menu.palette;
    if (!state.isOpen) return;
    const bool opens = state.takesFocus && state.edited.empty();
    if (opens) {
        closePopups();
        ImGui::SetNextWindowFocus();
    }
    const bool isList = state.edited.empty();
    beginPalette(isList);
    setItemScope(windowName);
    const ImVec2 at = ImGui::GetWindowPos();
    noteRect("Window", {at.x, at.y, ImGui::GetWindowWidth(), ImGui::GetWindowHeight()});
    const std::vector<Field> fields = isList ? std::vector<Field>() : fieldsOf(context.settings);
    const Field* const field = findField(fields, state.edited);
    if (field)
        settingEditor(*field, state);
    else
        list(context,
             0.75f * ImGui::GetMainViewport()->WorkSize.y / ImGui::GetTextLineHeightWithSpacing() - 4);
    // A click elsewhere closes it. Lists that it opens are windows of their own.
    const bool hasFocus = ImGui::IsWindowFocused(ImGuiFocusedFlags_RootAndChildWindows) ||
                          ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    if (!opens && !hasFocus) state.isOpen = false;
    endPalette();
}

}  // namespace worldy::ui
