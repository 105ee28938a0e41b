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
    std::optional<glm::dvec3>
        pointedM;  // the drawn ground under the pointer, metres from the planet's centre
};

// scene: null if no planet is open.
void execute(ChunkController& chunks, const ui::ChunkCommand& command, const Scene* scene,
             CameraController& camera, const CameraContext& context);

struct PickSettings {
    std::size_t selection = 0;     // index of the selection that the picture shows
    bool placesRulerEnds = false;  // clicks on the ground place an end of the ruler
};
// Keeps the place under the pointer, and requests highlighting of its chunk. A click selects the chunk; a click on the sky
// clears the selection.
void pick(const PlanetPicture& picture, const Scene& scene, const PickSettings& settings,
          ChunkController& chunks, ui::Commands& commands);

}  // namespace worldy
