#include "ui/kit/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ui/kit/exports.h"
#include "ui/kit/item_map.h"
#include "ui/kit/theme.h"
#include "ui/model/font_symbols.h"

namespace worldy::ui {

namespace {

// The labels' share of the panel's width.
constexpr float labelShare = 0.40f;
// The values' largest share of a table's width.
constexpr float valueShare = 0.65f;

// The reason of each open beginGrey(); empty if it does not grey. Global like ImGui's own stack.
std::vector<std::string> greyReasons;

// The names and values of the open list. Global like ImGui's own state of the frame.
struct {
    std::string id;
    std::vector<std::pair<std::string, std::string>> rows;
} shownValues;

// Call after the control. Returns true if the user asks for the default.
bool offerDefault(const char* label, bool isDefault, const std::string& defaultText) {
    bool reset = false;
    if (ImGui::BeginPopupContextItem(label)) {
        reset = ImGui::MenuItem(("Reset to " + defaultText).c_str(), nullptr, false, !isDefault);
        noteItem("reset");
        if (isDefault) tooltip("It already has its default.");
        ImGui::EndPopup();
    }
    return reset;
}

template <class T>
std::string formatted(const char* format, T value) {
    std::array<char, 64> text{};
    ImGui::DataTypeFormatString(text.data(), text.size(),
                                std::is_same_v<T, double> ? ImGuiDataType_Double : ImGuiDataType_S32, &value,
                                format);
    return text.data();
}

// A number that is being typed into a slider. It is applied when the edit ends, because "60000" begins with "6".
struct TypedNumber {
    ImGuiID id = 0;  // of the slider; 0: none
    double value = 0;
};
TypedNumber typedNumber;

// Draws ImGui's slider, which would apply a typed number with each key. Returns true if the value has changed.
template <class T>
bool scalarSlider(T& value, T min, T max, const char* format, ImGuiSliderFlags flags) {
    const ImGuiID id = ImGui::GetID("##value");
    const bool wasTyped = ImGui::TempInputIsActive(id);
    const T before = value;
    ImGui::SliderScalar("##value", std::is_same_v<T, double> ? ImGuiDataType_Double : ImGuiDataType_S32,
                        &value, &min, &max, format, flags | ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::TempInputIsActive(id)) {
        typedNumber = {id, static_cast<double>(value)};
        value = before;
    } else if (typedNumber.id == id) {
        // Another control may have taken the keys before this one saw the end of its edit.
        if (!wasTyped) value = static_cast<T>(typedNumber.value);
        typedNumber = {};
    }
    return value != before;
}

template <class T>
bool sliderOf(const char* label, T& value, T defaultValue, T min, T max, const char* format, Tip tip,
              ImGuiSliderFlags flags) {
    ImGui::PushID(label);
    litLabel(label, value != defaultValue, tip);
    bool changed = scalarSlider(value, min, max, format, flags);
    noteItem(label);
    tooltip(tip);
    if (offerDefault("default", value == defaultValue, formatted(format, defaultValue))) {
        value = defaultValue;
        changed = true;
    }
    ImGui::PopID();
    return changed;
}

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
    // Headings do not use the colours of selected rows.
    ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_FrameBg));
    ImGui::PushStyleColor(ImGuiCol_HeaderHovered, ImGui::GetStyleColorVec4(ImGuiCol_FrameBgHovered));
    ImGui::PushStyleColor(ImGuiCol_HeaderActive, ImGui::GetStyleColorVec4(ImGuiCol_FrameBgActive));
    const bool open = ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen);
    ImGui::PopStyleColor(3);
    return open;
}

void tooltip(Tip tip) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    // The tooltip of a greyed item is not greyed.
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1);
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    const auto why = std::find_if(greyReasons.begin(), greyReasons.end(),
                                  [](const std::string& reason) { return !reason.empty(); });
    const bool grey = why != greyReasons.end();
    if (grey) {
        ImGui::TextColored(palette().warning, "%s", why->c_str());
        noteItem("Why grey");
    }
    const std::string text = tip.text();
    if (!grey || *why != text) ImGui::TextUnformatted(inFont(text).c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

void lateTooltip(const char* text) {
    constexpr float restS = 1.2f;
    float& restedS = *ImGui::GetStateStorage()->GetFloatRef(ImHashStr("rested", 0, ImGui::GetItemID()), 0);
    const bool rests = ImGui::IsItemHovered() && !ImGui::IsAnyMouseDown();
    restedS = rests ? restedS + ImGui::GetIO().DeltaTime : 0;
    if (restedS > restS) tooltip(text);
}

void beginGrey(bool grey, const char* why) {
    ImGui::BeginDisabled(grey);
    greyReasons.emplace_back(grey ? why : "");
}

void endGrey() {
    greyReasons.pop_back();
    ImGui::EndDisabled();
}

bool beginValues(const char* id) {
    if (!ImGui::BeginTable(id, 2)) return false;
    shownValues.id = id;
    shownValues.rows.clear();
    detail::beginRows();
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthFixed);
    return true;
}

void valueRow(const char* name, const std::string& value, const char* explanation, const ImVec4* colour) {
    ImGui::TableNextRow();
    noteValue(name, value);
    ImGui::TableNextColumn();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(inFont(name).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    tooltip(explanation);
    ImGui::TableNextColumn();
    // The column is as wide as its widest value, but leaves room for the names: longer values are wrapped.
    const float most = valueShare * ImGui::GetCurrentTable()->WorkRect.GetWidth();
    const float width = std::min(ImGui::CalcTextSize(value.c_str()).x, most);
    const float slack = ImGui::GetContentRegionAvail().x - width;
    if (slack > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + slack);
    ImGui::PushStyleColor(ImGuiCol_Text, colour ? *colour : palette().text);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width + 1);
    ImGui::TextUnformatted(value.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    tooltip(explanation);
}

void noteValue(const char* name, const std::string& value) {
    shownValues.rows.emplace_back(name, value);
}

void endValues() {
    ExportTable table{
        .name = shownValues.id, .columns = {{"name"}, {"value"}}, .rows = shownValues.rows.size()};
    table.cell = [](std::size_t row, std::size_t column) -> ExportCell {
        return column == 0 ? shownValues.rows[row].first : shownValues.rows[row].second;
    };
    endTable(table);
}

void valueRows(const char* id, std::span<const ValueRow> rows) {
    if (!beginValues(id)) return;
    for (const ValueRow& row : rows) valueRow(row.name.c_str(), row.value, row.explanation);
    endValues();
}

float valuesWidth(std::span<const ValueRow> rows, const char* widestValue) {
    float name = 0;
    for (const ValueRow& row : rows) name = std::max(name, ImGui::CalcTextSize(inFont(row.name).c_str()).x);
    // Values wider than their share of the width are wrapped.
    const float value = ImGui::CalcTextSize(widestValue).x;
    return std::max(name + value + 2 * ImGui::GetStyle().CellPadding.x, value / valueShare) + 1;
}

ImVec2 dragDelta(ImGuiMouseButton button) {
    if (!ImGui::IsMouseDown(button) || ImGui::IsMouseClicked(button)) return {0, 0};
    return ImGui::GetIO().MouseDelta;
}

void labelledControl(const char* label, Tip tip) {
    const float start = ImGui::GetCursorPosX();
    const float width = ImGui::GetContentRegionAvail().x;
    const std::string text = inFont(label);
    const float labelWidth = ImGui::CalcTextSize(text.c_str()).x + ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(text.c_str());
    tooltip(tip);
    // A label that does not fit takes room from its control, or stands above it.
    if (labelWidth < 0.6f * width)
        ImGui::SameLine(start + std::round(std::max(width * labelShare, labelWidth)));
    ImGui::SetNextItemWidth(-1);
}

void litLabel(const char* label, bool changed, Tip tip) {
    if (changed) ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    labelledControl(label, tip);
    if (changed) ImGui::PopStyleColor();
}

bool slider(const char* label, double& value, double defaultValue, double min, double max, const char* format,
            Tip tip, ImGuiSliderFlags flags) {
    return sliderOf(label, value, defaultValue, min, max, format, tip, flags);
}

bool slider(const char* label, int& value, int defaultValue, int min, int max, const char* format, Tip tip,
            ImGuiSliderFlags flags) {
    return sliderOf(label, value, defaultValue, min, max, format, tip, flags);
}

bool checkbox(const char* label, bool& value, bool defaultValue, Tip tip) {
    const bool isDefault = value == defaultValue;
    if (!isDefault) ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    bool changed = ImGui::Checkbox(label, &value);
    noteItem(label);
    if (!isDefault) ImGui::PopStyleColor();
    tooltip(tip);
    if (offerDefault(label, value == defaultValue, defaultValue ? "on" : "off")) {
        value = defaultValue;
        changed = true;
    }
    return changed;
}

bool numberField(const char* id, double& value, const char* format) {
    const bool changed = ImGui::InputDouble(id, &value, 0, 0, format, ImGuiInputTextFlags_AutoSelectAll);
    // Dear ImGui would select only the word under the pointer, which may be the unit.
    ImGuiInputTextState* const text = ImGui::GetInputTextState(ImGui::GetItemID());
    if (text && ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        text->SelectAll();
        text->SelectedAllMouseLock = true;
    }
    return changed;
}

bool combo(const char* name, int& index, const char* items) {
    const auto next = [](const char* item) { return item + std::char_traits<char>::length(item) + 1; };
    const char* shown = items;
    for (int i = 0; i < index && *shown; ++i) shown = next(shown);
    bool changed = false;
    ImGui::PushID(name);
    if (ImGui::BeginCombo("##value", inFont(shown).c_str(), ImGuiComboFlags_HeightLarge)) {
        int i = 0;
        for (const char* item = items; *item; item = next(item), ++i) {
            if (ImGui::Selectable(inFont(item).c_str(), i == index)) {
                changed = i != index;
                index = i;
            }
            noteItem(std::string(name) + ": " + item);
            if (i == index) ImGui::SetItemDefaultFocus();
        }
        ImGui::EndCombo();
    }
    noteItem(name);
    ImGui::PopID();
    return changed;
}

bool choiceIndex(const char* label, int& index, int defaultIndex, const char* items, Tip tip) {
    ImGui::PushID(label);
    litLabel(label, index != defaultIndex, tip);
    bool changed = combo(label, index, items);
    tooltip(tip);
    const char* defaultItem = items;
    for (int i = 0; i < defaultIndex; ++i) defaultItem += std::char_traits<char>::length(defaultItem) + 1;
    if (offerDefault("default", index == defaultIndex, defaultItem)) {
        index = defaultIndex;
        changed = true;
    }
    ImGui::PopID();
    return changed;
}

bool button(const char* label, const char* explanation) {
    const bool pressed = ImGui::Button(label);
    noteItem(label);
    tooltip(explanation);
    return pressed;
}

void secondColumn(const char* label) {
    const float left = ImGui::GetWindowContentRegionMin().x;
    const float right = ImGui::GetWindowContentRegionMax().x;
    const float column = left + right * 0.5f;
    const float last = ImGui::GetItemRectMax().x - ImGui::GetWindowPos().x + ImGui::GetScrollX();
    if (last + ImGui::GetStyle().ItemSpacing.x <= column && column + checkboxWidth(label) <= right)
        ImGui::SameLine(column);
}

void sameLineIfRoom(float width) {
    const float right = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
    if (ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width < right) ImGui::SameLine();
}

void sameLineForButton(const char* label) {
    sameLineIfRoom(ImGui::CalcTextSize(label, nullptr, true).x + 2 * ImGui::GetStyle().FramePadding.x);
}

float checkboxWidth(const char* label) {
    return ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x + ImGui::CalcTextSize(label).x;
}

std::string brokenAtSpaces(const std::string& text, float width) {
    const auto widthOf = [](const std::string& line) { return ImGui::CalcTextSize(line.c_str()).x; };
    std::string broken, line;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(" \n", begin + 1), text.size());
        const std::string word = text.substr(begin, end - begin);  // with the space before it
        begin = end;
        if (word[0] != '\n' && (line.empty() || word[0] != ' ' || widthOf(line + word) <= width)) {
            line += word;
            continue;
        }
        broken += line + '\n';
        line = word.substr(1);
    }
    return broken + line;
}

void wrappedText(const std::string& text, const ImVec4& colour) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    const std::string shown = brokenAtSpaces(inFont(text), ImGui::GetContentRegionAvail().x);
    ImGui::TextWrapped("%s", shown.c_str());
    ImGui::PopStyleColor();
}

void shortenedText(const std::string& text, const ImVec4& colour, float roomPx) {
    std::string shown = text;
    for (std::size_t end = text.size(); end > 0 && ImGui::CalcTextSize(shown.c_str()).x > roomPx;
         shown = text.substr(0, end) + "...") {
        --end;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u)
            --end;  // of a UTF-8 sequence
    }
    ImGui::TextColored(colour, "%s", shown.c_str());
}

void emptyState(const char* text) {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float wrap = std::min(room.x * 0.9f, ImGui::GetFontSize() * 22);
    const ImVec2 size = ImGui::CalcTextSize(text, nullptr, false, wrap);
    const ImVec2 start = ImGui::GetCursorPos();
    ImGui::SetCursorPos({start.x + std::max((room.x - size.x) / 2, 0.0f),
                         start.y + std::max((room.y - size.y) * 0.4f, 0.0f)});
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + wrap);
    ImGui::PushStyleColor(ImGuiCol_Text, palette().dim);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
}

bool splitter(const char* id, const Rect& rect, bool upright, double& movedPx) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
    // Commands move the edges of docks by keys.
    beginFixedWindow(id, rect,
                     ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav);
    ImGui::InvisibleButton("bar", {rect.width, rect.height});
    const bool active = ImGui::IsItemActive();
    const bool lit = active || ImGui::IsItemHovered();
    if (lit) ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
    const ImGuiCol colour = active ? ImGuiCol_SliderGrabActive
                            : lit  ? ImGuiCol_ScrollbarGrabHovered
                                   : ImGuiCol_Separator;
    ImGui::GetWindowDrawList()->AddRectFilled({rect.x, rect.y}, {rect.x + rect.width, rect.y + rect.height},
                                              ImGui::GetColorU32(colour));
    const ImVec2 moved = dragDelta(ImGuiMouseButton_Left);
    if (active) movedPx += static_cast<double>(upright ? moved.x : moved.y);
    ImGui::End();
    ImGui::PopStyleVar(2);
    return active;
}

void usageBar(double share, const std::string& text) {
    if (share > 1) ImGui::PushStyleColor(ImGuiCol_PlotHistogram, palette().bad);
    ImGui::ProgressBar(static_cast<float>(std::clamp(share, 0.0, 1.0)), {-1, 0}, "");
    if (share > 1) ImGui::PopStyleColor();
    // The text is centred; if it does not fit, it begins at the left edge.
    const ImVec2 from = ImGui::GetItemRectMin();
    const ImVec2 to = ImGui::GetItemRectMax();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float pad = ImGui::GetStyle().FramePadding.x;
    const float left = std::max(from.x + pad, (from.x + to.x - size.x) / 2);
    ImGui::PushClipRect(from, to, true);
    ImGui::GetWindowDrawList()->AddText({left, (from.y + to.y - size.y) / 2},
                                        ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    ImGui::PopClipRect();
}

ImU32 boxColour() {
    return ImGui::GetColorU32(palette().box);
}

void badge(ImDrawList& drawList, ImVec2 position, const char* text, const ImVec4& colour) {
    const float pad = std::round(ImGui::GetFontSize() * 0.45f);
    const ImVec2 size = ImGui::CalcTextSize(text);
    const ImVec2 end(position.x + size.x + 2 * pad, position.y + size.y + pad);
    drawList.AddRectFilled(position, end, boxColour(), pad * 0.6f);
    drawList.AddText({position.x + pad, position.y + pad / 2}, ImGui::GetColorU32(colour), text);
}

}  // namespace worldy::ui
