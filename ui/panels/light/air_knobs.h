// The physical atmosphere: its settings' knobs, and what its tables cost.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

// A section's inside.
void airKnobs(const EditorView& view, SurfaceSettings& surface, Commands& commands);

}  // namespace worldy::ui
