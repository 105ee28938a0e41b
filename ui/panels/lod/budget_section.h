// The section "Budget" of the LOD panel: the budgets that τ follows, what binds, and τ and use over the last seconds.
#pragma once

#include "ui/kit/setting_controls.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Why τ cannot be set by hand, if it cannot: a sentence, or null.
const char* whyTauIsGoverned(const ViewSettings& settings);

void budgetSection(const EditorView& view, const SettingControls& control, ViewSettings& settings);

}  // namespace worldy::ui
