// Small widgets that panels share.
#pragma once

#include <imgui.h>

#include <span>
#include <string>
#include <type_traits>

#include "ui/model/layout.h"

namespace worldy::ui {

// Begins a window without frame that fills a rectangle; end it with ImGui::End().
void beginFixedWindow(const char* name, const Rect& rect, ImGuiWindowFlags flags = 0);

// Draws a heading that expands and collapses. Returns true if it is expanded.
bool section(const char* title);

// The text of a tooltip, or a function that makes it. The function is called only while the tooltip is shown;
// it must live as long as the call that takes the Tip.
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

// Shows the text while the last item is hovered.
void tooltip(Tip tip);
// Shows the text when the pointer has rested on the last item for a while with no button down. For items whose use is
// mostly known, such as tabs.
void lateTooltip(const char* text);

// If grey, greys and disables the items until endGrey(). Their tooltips then begin with why, a sentence.
// Calls may be nested: the outermost that greys shows its reason.
void beginGrey(bool grey, const char* why);
void endGrey();

// Begins two columns: names on the left, values right-aligned. Call valueRow() between begin and end. The list can be
// copied and saved with the texts as shown.
bool beginValues(const char* id);
void valueRow(const char* name, const std::string& value, const char* explanation,
              const ImVec4* colour = nullptr);
void noteValue(const char* name, const std::string& value);  // of a row that the caller draws itself
void endValues();
struct ValueRow {
    std::string name;
    std::string value;
    const char* explanation = "";
};
void valueRows(const char* id, std::span<const ValueRow> rows);
// Returns the width at which no row wraps if no value is wider than widestValue, pixels.
float valuesWidth(std::span<const ValueRow> rows, const char* widestValue);

// Returns the pointer's motion in this frame while the button is down, pixels. Returns {0, 0} in the frame in
// which the button goes down, because that motion came before the press.
ImVec2 dragDelta(ImGuiMouseButton button);

// Draws a label in the left column. The next item drawn is its control, in the right column.
void labelledControl(const char* label, Tip tip);
// Does the same; the label is lit if changed: the value differs from its default or from the open file's.
void litLabel(const char* label, bool changed, Tip tip);

// Draw a label, a control and a tooltip. The label is lit if the value is not its default; a right click on
// the control offers the default. Ctrl+click types a number, which is applied when the edit ends. They return true if the
// value has changed.
// Settings have their own controls (ui/kit/setting_controls.h).
bool slider(const char* label, double& value, double defaultValue, double min, double max, const char* format,
            Tip tip, ImGuiSliderFlags flags = 0);
bool slider(const char* label, int& value, int defaultValue, int min, int max, const char* format, Tip tip,
            ImGuiSliderFlags flags = 0);
bool checkbox(const char* label, bool& value, bool defaultValue, Tip tip);
// Draws a field for a number. Entering it with a click, or double-clicking it, selects the whole text.
bool numberField(const char* id, double& value, const char* format);
// Draws a combo like ImGui::Combo, items: "one\0two\0". While it is open, its items are in the item map:
// "name: one".
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

// Continues on the same line if an item of this width fits.
void sameLineIfRoom(float width);
// Does the same for a button.
void sameLineForButton(const char* label);
float checkboxWidth(const char* label);

// Returns the text with line breaks at spaces, so that no line is wider. A word that is wider alone stays whole. Dear ImGui
// would also break lines after a decimal point.
std::string brokenAtSpaces(const std::string& text, float width);
// Draws text wrapped at the panel's width, between words.
void wrappedText(const std::string& text, const ImVec4& colour);

// Draws a text. If it is wider than its room, the longest beginning that fits is followed by an ellipsis.
void shortenedText(const std::string& text, const ImVec4& colour, float roomPx);

// Draws a centred line that says why the panel is empty.
void emptyState(const char* text);

// Draws a bar that resizes a panel. Adds the drag, in pixels, to movedPx. Returns true while it is dragged.
bool splitter(const char* id, const Rect& rect, bool upright, double& movedPx);

// Draws a bar filled to a share, with a text in it: "120 of 256 MiB". Red if the share is over 1.
void usageBar(double share, const std::string& text);

// Returns the background colour of text over a picture.
ImU32 boxColour();

// Draws text in a rounded box over a picture; position is the top left.
void badge(ImDrawList& drawList, ImVec2 position, const char* text, const ImVec4& colour);

}  // namespace worldy::ui
