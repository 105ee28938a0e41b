// The bar at the window's foot: what is open, where the camera is, and how it fares.
#pragma once

#include "ui/model/editor_view.h"
#include "ui/model/layout.h"

namespace worldy::ui {

float statusBarHeight();

void statusBar(const EditorView& view, const ViewSettings& settings, const Rect& rect);

}  // namespace worldy::ui
