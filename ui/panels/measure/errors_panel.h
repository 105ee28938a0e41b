// The True error panel: the measured error of the drawn surface beside its bound.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/text_filter.h"

namespace worldy::ui {

struct ErrorsPanelState {
    bool logarithmic = true;  // the scatter's axes
    TextFilter filter{};      // of the list of chunks
};

void errorsPanel(const EditorView& view, ErrorsPanelState& state, ViewSettings& settings, Commands& commands);

}  // namespace worldy::ui
