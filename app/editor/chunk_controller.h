// The hovered and the selected chunk. Main thread.
#pragma once

#include "app/editor/camera_controller.h"
#include "app/editor/viewport.h"
#include "app/scene/overlay_lines.h"
#include "app/scene/scene.h"
#include "ui/model/commands.h"

namespace worldy {

struct ChunkController {
    ChunkFocus focus;
};

// scene: null if no planet is open.
void execute(ChunkController& chunks, const ui::ChunkCommand& command, const Scene* scene,
             CameraController& camera, CameraSettings& settings);

// Requests highlighting of the chunk under the pointer. A click selects it; a click on the sky clears the
// selection. selection: the index of the selection that the picture shows.
void pick(const PlanetPicture& picture, const Scene& scene, std::size_t selection, ui::Commands& commands);

}  // namespace worldy
