// Tells which part of the window the keys + and - belong to: a plot with the keyboard's focus zooms by them, and the camera's
// speed then stays. The state is global, like Dear ImGui's own. One thread.
#pragma once

namespace worldy::ui {

// Call in each frame in which a plot has the focus and reads keys itself. Dear ImGui does not move its focus by the arrows then.
void takePlotKeys();
// Returns whether a plot took the keys in this frame or in the last one.
bool plotTakesKeys();

}  // namespace worldy::ui
