// The menu bar, made from the list of actions (ui/shell/actions.h).
#pragma once

#include "ui/shell/actions.h"

namespace worldy::ui {

float menuBarHeight();

void menuBar(const ActionContext& context);

}  // namespace worldy::ui
