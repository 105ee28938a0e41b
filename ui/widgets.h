// Small pieces that the panels are made of.
#pragma once

#include <imgui.h>

#include <string>

#include "ui/layout.h"

namespace ui {

// A window without frame that fills a rectangle; end with ImGui::End().
void beginFixedWindow(const char* name, const Rect& rect, ImGuiWindowFlags flags = 0);

// A heading that opens and closes what follows.
bool section(const char* title);

// Explains the last item when the pointer rests on it.
void tooltip(const char* text);

// Two columns: names on the left, numbers right-aligned. Rows between begin and end.
bool beginValues(const char* id);
void valueRow(const char* name, const std::string& value, const char* explanation,
              const ImVec4* colour = nullptr);
void endValues();

// A label in the left column and room for a control in the right one; call the control right after.
void labelledControl(const char* label, const char* explanation);

// A bar that a mouse drags to change a panel's size. Adds the move, in pixels, to where it is dragged.
// True while it moves.
bool splitter(const char* id, const Rect& rect, bool upright, double& movedPx);

// A share of a whole with a text in it: "120 of 256 MiB". Red when over.
void usageBar(double share, const std::string& text);

// The background of what is written over a picture.
ImU32 boxColour();

// Text in a rounded box over a picture; position is its top left.
void badge(ImDrawList& drawList, ImVec2 position, const char* text, const ImVec4& colour);

}  // namespace ui
