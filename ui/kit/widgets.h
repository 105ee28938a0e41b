// Small pieces that the panels are made of.
#pragma once

#include <imgui.h>

#include <span>
#include <string>

#include "ui/model/layout.h"

namespace worldy::ui {

// A window without frame that fills a rectangle; end with ImGui::End().
void beginFixedWindow(const char* name, const Rect& rect, ImGuiWindowFlags flags = 0);

// A heading that opens and closes what follows.
bool section(const char* title);

// Explains the last item when the pointer rests on it.
void tooltip(const char* text);

// Greys what is drawn until endGrey() and takes no input for it, if grey; its tooltips then begin with why, a
// sentence. May be nested: the outermost that greys says why.
void beginGrey(bool grey, const char* why);
void endGrey();

// Two columns: names on the left, numbers right-aligned. Rows between begin and end.
bool beginValues(const char* id);
void valueRow(const char* name, const std::string& value, const char* explanation,
              const ImVec4* colour = nullptr);
void endValues();
struct ValueRow {
    std::string name;
    std::string value;
    const char* explanation = "";
};
void valueRows(const char* id, std::span<const ValueRow> rows);
// Returns the width at which no row wraps while values are no wider than widestValue, pixels.
float valuesWidth(std::span<const ValueRow> rows, const char* widestValue);

// Returns how far the pointer has moved this frame with the button down, pixels; {0, 0} in the frame in which
// the button goes down, because that motion came before the press.
ImVec2 dragDelta(ImGuiMouseButton button);

// A label in the left column and room for a control in the right one; call the control right after.
void labelledControl(const char* label, const char* explanation);
// Lit where the value is changed: not the default, or not that of the open file.
void litLabel(const char* label, bool changed, const char* explanation);

// Knobs: a label, a control, and a tooltip that says unit, meaning, formula, and what gets worse. A value
// that is not its default has a lit label; a right click on the label or the control offers the default.
// Ctrl+click types a number. All return whether the value has changed this frame.
bool slider(const char* label, double& value, double defaultValue, double min, double max, const char* format,
            const char* explanation, ImGuiSliderFlags flags = 0);
bool slider(const char* label, int& value, int defaultValue, int min, int max, const char* format,
            const char* explanation, ImGuiSliderFlags flags = 0);
bool checkbox(const char* label, bool& value, bool defaultValue, const char* explanation);
// A field for a number; its text is selected whole by a click that enters it and by a double click.
bool numberField(const char* id, double& value, const char* format);
// As ImGui::Combo, items: "one\0two\0". The item map has the items too while it is open: "name: one".
bool combo(const char* name, int& index, const char* items);
// items as for combo.
bool choiceIndex(const char* label, int& index, int defaultIndex, const char* items, const char* explanation);
template <class Enum>
bool choice(const char* label, Enum& value, Enum defaultValue, const char* items, const char* explanation) {
    int index = static_cast<int>(value);
    const bool changed = choiceIndex(label, index, static_cast<int>(defaultValue), items, explanation);
    value = static_cast<Enum>(index);
    return changed;
}
bool button(const char* label, const char* explanation);
// Starts the right-hand column of a pair of check boxes, unless the box with this label does not fit there.
void secondColumn(const char* label);

// Goes on in the same line while there is room for an item so wide.
void sameLineIfRoom(float width);
// The same for a button.
void sameLineForButton(const char* label);
float checkboxWidth(const char* label);

// In lines as wide as the panel.
void wrappedText(const std::string& text, const ImVec4& colour);

// A line in the middle of an empty panel that says why it is empty.
void emptyState(const char* text);

// A bar that a mouse drags to change a panel's size. Adds the move, in pixels, to where it is dragged.
// True while it moves.
bool splitter(const char* id, const Rect& rect, bool upright, double& movedPx);

// A share of a whole with a text in it: "120 of 256 MiB". Red when over.
void usageBar(double share, const std::string& text);

// The background of what is written over a picture.
ImU32 boxColour();

// Text in a rounded box over a picture; position is its top left.
void badge(ImDrawList& drawList, ImVec2 position, const char* text, const ImVec4& colour);

}  // namespace worldy::ui
