// The Light panel: sun, atmosphere, sea, shadows and normals.
#pragma once

#include "ui/model/editor_view.h"

namespace worldy::ui {

void lightPanel(const EditorView& view, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
