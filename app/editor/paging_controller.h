// Pauses and controls the paging of the shown planet. Main thread.
#pragma once

#include "app/flight/recorder.h"
#include "app/scene/scene.h"
#include "app/session/notices.h"
#include "ui/model/commands.h"

namespace worldy {

struct PagingController {
    bool paused = false;
};

// Refused during a replay. scene: null if no planet is open. recorder: null, or records the change.
void execute(PagingController& paging, const ui::PagingCommand& command, Scene* scene, Recorder* recorder,
             bool replaying, const Log& log);

}  // namespace worldy
