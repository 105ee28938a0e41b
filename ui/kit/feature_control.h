// The control of a rendering feature that costs frame time.
#pragma once

#include "app/scene/costly_parts.h"
#include "ui/kit/setting_controls.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Draws the list "automatic, on, off". If Automatic has turned the feature off, the reason is shown below.
void featureControl(const SettingControls& control, CostlyPart part, const EditorView& view,
                    SurfaceSettings& surface, Commands& commands);

}  // namespace worldy::ui
