// Small pieces that the panels are made of.
#pragma once

#include <imgui.h>

#include <span>
#include <string>
#include <type_traits>

#include "ui/model/layout.h"

namespace worldy::ui {

// A window without frame that fills a rectangle; end with ImGui::End().
void beginFixedWindow(const char* name, const Rect& rect, ImGuiWindowFlags flags = 0);

// A heading that opens and closes what follows.
bool section(const char* title);

// The text of a tooltip, or a function that makes it. The function is called only while the tooltip is shown; it must
// live as long as the call that takes the Tip.
class Tip {
public:
    Tip(const char* text)
        : context_(text),
          make_([](const void* context) { return std::string(static_cast<const char*>(context)); }) {}
    template <class Make>
    requires std::is_invocable_r_v<std::string, const Make&> Tip(const Make& make)
        : context_(&make),
          make_([](const void* context) { return (*static_cast<const Make*>(context))(); }) {}

    std::string text() const { return make_(context_); }

private:
    const void* context_;
    std::string (*make_)(const void*);
};

// Explains the last item when the pointer rests on it.
void tooltip(Tip tip);

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

// Draws a label in the left column and makes room for a control in the right one; draw the control right after.
void labelledControl(const char* label, Tip tip);
// Does the same; the label is lit if the value is not its default, or not that of the open file.
void litLabel(const char* label, bool changed, Tip tip);

// Draw a label, a control and a tooltip. The label of a value that is not its default is lit; a right click on the
// control offers the default. Ctrl+click types a number. They return true if the value has changed. Settings have
// controls of their own (ui/kit/setting_controls.h).
bool slider(const char* label, double& value, double defaultValue, double min, double max, const char* format,
            Tip tip, ImGuiSliderFlags flags = 0);
bool slider(const char* label, int& value, int defaultValue, int min, int max, const char* format, Tip tip,
            ImGuiSliderFlags flags = 0);
bool checkbox(const char* label, bool& value, bool defaultValue, Tip tip);
// A field for a number; its text is selected whole by a click that enters it and by a double click.
bool numberField(const char* id, double& value, const char* format);
// As ImGui::Combo, items: "one\0two\0". The item map has the items too while it is open: "name: one".
bool combo(const char* name, int& index, const char* items);
// Draws a list of choices; items as for combo.
bool choiceIndex(const char* label, int& index, int defaultIndex, const char* items, Tip tip);
template <class Enum>
bool choice(const char* label, Enum& value, Enum defaultValue, const char* items, Tip tip) {
    int index = static_cast<int>(value);
    const bool changed = choiceIndex(label, index, static_cast<int>(defaultValue), items, tip);
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
