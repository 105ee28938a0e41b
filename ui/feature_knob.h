// The knob of a part of the picture that costs time.
#pragma once

#include "planet/gl/feature_use.h"
#include "ui/editor_view.h"

namespace ui {

// Automatic, on or off; below it, when Automatic has turned it down, why. costs: "layers cost", as the
// beginning of that sentence.
void featureKnob(const char* label, planet::gl::FeatureUse& use, const EditorView& view,
                 const char* explanation, const char* costs);

}  // namespace ui
