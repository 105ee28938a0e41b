// The status bar: the open file, warnings, the camera, and performance.
#pragma once

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

float statusBarHeight();

void statusBar(const EditorView& view, const ViewSettings& settings, const Rect& rect);

}  // namespace worldy::ui
