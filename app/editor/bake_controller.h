// Executes the Bake panel's commands; the session keeps bakes, estimates and previews.
#pragma once

#include "app/base/log.h"
#include "app/editor/session.h"
#include "ui/model/commands.h"
#include "ui/panels/bake/bake_panel.h"

namespace worldy {

void execute(Session& session, const ui::BakeCommand& command, ui::BakePanelState& panel, const Log& log);

}  // namespace worldy
