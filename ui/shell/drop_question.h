// Asks what to do with rasters that were dropped onto the window or chosen in the open dialog.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/sources_view.h"

namespace worldy::ui {

// Call every frame. Shows a modal window while rasters wait for an answer.
void dropQuestion(const SourcesView& sources, Commands& commands);

}  // namespace worldy::ui
