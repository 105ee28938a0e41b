// The Cracks panel: crack pixels, uncovered pixels and edge gaps.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

void cracksPanel(const EditorView& view, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
