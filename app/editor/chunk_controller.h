// The chunks that the user points at and has selected. Main thread.
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

// scene: null while no planet is open.
void execute(ChunkController& chunks, const ui::ChunkCommand& command, const Scene* scene,
             CameraController& camera, CameraSettings& settings);

// Asks for the chunk under the pointer to be lit. A click selects it, or nothing where there is only sky.
// selection: the number of the one that the picture shows.
void pick(const PlanetPicture& picture, const Scene& scene, std::size_t selection, ui::Commands& commands);

}  // namespace worldy
