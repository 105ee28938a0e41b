// Normals finer than the mesh: their knobs, and what they hold.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// A section's inside.
void normalKnobs(const EditorView& view, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
