// The Precision panel: float and depth buffer errors at a point.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

void probePanel(const EditorView& view, Commands& commands);

}  // namespace worldy::ui
