// The controls of the sun's position.
#pragma once

#include "ui/kit/setting_controls.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the inside of a section.
void sunControls(const EditorView& view, const SettingControls& control, SurfaceSettings& surface);

}  // namespace worldy::ui
