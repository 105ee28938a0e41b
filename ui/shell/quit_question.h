// Asks what to do with regions that are not saved when the user wants to quit.
#pragma once

#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy::ui {

// Call every frame. Shows a modal window while the question waits for an answer.
void quitQuestion(const SettingsView& settings, Commands& commands);

}  // namespace worldy::ui
