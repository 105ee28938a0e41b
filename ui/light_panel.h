// The sun, the air, the sea, shadows and normals.
#pragma once

#include "ui/editor_view.h"

namespace ui {

void lightPanel(const EditorView& view, ViewSettings& settings, Commands& commands);

}  // namespace ui
