// The Cracks panel: crack pixels, uncovered pixels and edge gaps.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct CracksPanelState {};

void cracksPanel(const EditorView& view, CracksPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
