// The controls of normals finer than the mesh, and the figures of their tiles.
#pragma once

#include "ui/kit/setting_controls.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Fills the inside of a section.
void normalControls(const EditorView& view, const SettingControls& control, ViewSettings& settings,
                    Commands& commands);

}  // namespace worldy::ui
