// The control of a part of the picture that costs time.
#pragma once

#include "app/scene/costly_parts.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Automatic, on or off. Shows the reason below the control if Automatic has turned the part off.
void featureKnob(const char* label, CostlyPart part, const EditorView& view, SurfaceSettings& surface,
                 Commands& commands, const char* explanation);

}  // namespace worldy::ui
