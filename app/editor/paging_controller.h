// Pausing the shown planet's paging, and changing it by hand. Main thread.
#pragma once

#include "app/editor/notices.h"
#include "app/flight/recorder.h"
#include "app/scene/scene.h"
#include "ui/model/commands.h"

namespace worldy {

struct PagingController {
    bool paused = false;
};

// Refused while a replay runs. scene: null while no planet is open. recorder: null, or what notes the change.
void execute(PagingController& paging, const ui::PagingCommand& command, Scene* scene, Recorder* recorder,
             bool replaying, const Log& log);

}  // namespace worldy
