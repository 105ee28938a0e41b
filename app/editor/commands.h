// Carries out what panels, menus and keys have asked for.
#pragma once

#include "app/base/log.h"
#include "app/editor/editor_state.h"
#include "app/editor/session.h"
#include "app/editor/window.h"
#include "ui/model/commands.h"

namespace worldy {

void obey(const ui::Commands& commands, Window& window, Session& session, Editor& editor, Log& log);

// Writes the screenshot that was asked for, if any, into a new file, with the settings that made it. To be
// called with the frame drawn but not yet shown; waits for a frame that shows what the settings say.
void keepScreenshot(const Window& window, const Session& session, Editor& editor, const Log& log);

}  // namespace worldy
