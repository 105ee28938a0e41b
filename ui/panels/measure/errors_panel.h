// True error: the measured error of what is drawn, beside the bound of what is drawn.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

struct ErrorsPanelState {
    bool logarithmic = true;  // the scatter's axes
};

void errorsPanel(const EditorView& view, ErrorsPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
