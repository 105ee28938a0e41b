// Carries out what panels, menus and keys have asked for.
#pragma once

#include "app/editor.h"

namespace worldy {

void obey(const ui::Commands& commands, Window& window, Session& session, Editor& editor, Log& log);

// Writes what a picture shows into a new file, with the settings that made it.
void keepScreenshot(const Picture& picture, const Session& session, Editor& editor, const Log& log);

}  // namespace worldy
