// The Precision panel: float and depth buffer errors at a point.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct ProbePanelState {};

void probePanel(const EditorView& view, ProbePanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
