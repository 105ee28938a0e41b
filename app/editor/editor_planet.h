// The planet's part of a frame of the window: cameras move, chunks are chosen and loaded, pictures are drawn.
#pragma once

#include "app/base/log.h"
#include "app/editor/editor_state.h"
#include "app/scene/frame_stats.h"
#include "app/scene/scene.h"
#include "ui/model/commands.h"

namespace worldy {

// Returns what it counted and timed. Appends what the pointer does to chunks.
FrameStats runPlanet(Scene& scene, float pixelRatio, Editor& editor, Log& log, double seconds,
                     ui::Commands& commands);

}  // namespace worldy
