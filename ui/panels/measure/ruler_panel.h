// The Ruler panel: distances, heights and slopes between two places of the ground.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

void rulerPanel(const EditorView& view, Commands& commands);

}  // namespace worldy::ui
