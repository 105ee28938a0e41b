// Actions on the editor's state that several of its parts share. Main thread.
#pragma once

#include <string>

#include "app/base/log.h"
#include "app/editor/editor_state.h"
#include "app/editor/session.h"
#include "app/scene/scene.h"
#include "ui/shell/message_box.h"

namespace worldy {

// Forgets the LOD changes measured so far. To be called when the planet starts again or a replay goes back:
// the difference from the frame before is then no change of level.
void forgetChanges(Editor& editor);

// Moves the camera and freezes LOD at lodView; pauses a replay instead of freezing. Needs a rig.
void inspect(Editor& editor, const Camera& camera, const planet::View& lodView);
// Restores the camera and LOD from before the first inspect(); does nothing if there was none.
void endInspection(Editor& editor);
// Freezes or unfreezes LOD by hand, which ends the inspection where the camera is.
void freezeLod(Editor& editor, bool frozen);

inline constexpr double confirmationS = 5;  // how long one is shown
// Reports in the log, and for some seconds in the viewport, that a request is done.
void confirm(Editor& editor, const Log& log, const std::string& text);
// The same with a longer text for the log: whole paths are too long for the viewport.
void confirm(Editor& editor, const Log& log, const std::string& text, const std::string& logged);
// Reports in the log and in a message box why a request failed, and what to do about it.
void tellError(Editor& editor, const Log& log, ui::Message message);

// Once a file that was asked for is open, maybe baked first: makes it the first of the recent ones and returns
// true. If its bake has failed: says so in a message box, unless it was cancelled or the viewport, having no
// planet, says so itself.
bool followOpening(const Session& session, Editor& editor);

// Ends the replay, if one runs, and restores the settings and the camera from before it. scene: null if its
// planet is gone.
void endReplay(Editor& editor, Scene* scene);

}  // namespace worldy
