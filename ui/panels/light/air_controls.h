// The controls of the physical atmosphere, and the cost of its tables.
#pragma once

#include "ui/kit/setting_controls.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the inside of a section.
void airControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface,
                 Commands& commands);

}  // namespace worldy::ui
