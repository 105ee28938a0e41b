// A text in a box with a coloured edge, such as the reason for a state beside the state's colour.
#pragma once

#include <imgui.h>

#include <string>

namespace worldy::ui {

// Fills the panel's width; the text wraps.
void markedBox(const std::string& text, ImU32 edgeColour);

}  // namespace worldy::ui
