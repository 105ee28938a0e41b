// The controls of the sun's position.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the inside of a section.
void sunKnobs(const EditorView& view, SurfaceSettings& surface);

}  // namespace worldy::ui
