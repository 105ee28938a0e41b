// The knob of a part of the picture that costs time.
#pragma once

#include "ui/model/costly_parts.h"
#include "ui/model/editor_view.h"

namespace ui {

// Automatic, on or off; below it, when Automatic has turned it down, why. costs: "layers cost", as the
// beginning of that sentence.
void featureKnob(const char* label, CostlyPart part, const EditorView& view, SurfaceSettings& surface,
                 Commands& commands, const char* explanation, const char* costs);

}  // namespace ui
