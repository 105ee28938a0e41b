// The size of the text, relative to the monitor's: the user's, or less in a window that is too small for it. One per
// process, like ImGui's style. Main thread.
#pragma once

#include "app/settings/workspace.h"

namespace worldy::ui {

// Sets the scale that is shown, > 0; it is at most the user's.
void setShownTextScale(double scale);

// Returns true if the window is too small for the user's scale, so that larger text would change nothing.
bool isTextLimited(const Workspace& workspace);

// Multiplies the scale by a factor, within [0.5, 3]. A scale that is not shown in full grows no further, and shrinks
// from what is shown.
void zoomText(double factor, Workspace& workspace);

}  // namespace worldy::ui
