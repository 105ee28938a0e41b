// Where the sun stands: the settings of it, and their knobs.
#pragma once

#include "planet/cube_sphere.h"
#include "ui/editor_view.h"

namespace ui {

// Of a sun that does not follow the camera.
planet::Geographic sunOverheadOf(const SurfaceSettings& surface);

// A section's inside.
void sunKnobs(const EditorView& view, SurfaceSettings& surface);

}  // namespace ui
