// The pins of notes over the viewport's picture.
#pragma once

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

// Lets the user click pins. Call before the picture's own item, which lies below them.
void notePinItems(const EditorView& view, const ViewSettings& settings, const Rect& viewport,
                  Commands& commands);

// Draws the pins into the current window, over the picture: those behind the ground faintly and without words.
void drawNotePins(const EditorView& view, const ViewSettings& settings, const Rect& viewport);

}  // namespace worldy::ui
