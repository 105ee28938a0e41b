// Runs the editor: opens its state, and runs the frames of the window. Main thread.
#pragma once

#include "app/base/log.h"
#include "app/editor/editor_state.h"
#include "app/editor/session.h"
#include "app/editor/window.h"
#include "app/settings/settings.h"

namespace worldy {

Editor openEditor(const Settings& settings, const Log& log);

// Saves the recording and ends the replay. To be called before the window closes.
void endFlights(Session& session, Editor& editor, const Log& log);

// Runs one frame: input, planet, panels, and the commands that they gave. secondsSinceLast: >= 0.
void runFrame(Window& window, Session& session, Editor& editor, Log& log, double secondsSinceLast);

}  // namespace worldy
