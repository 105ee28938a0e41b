// Draws the planet's pictures of a frame: the main one and the observer's. Needs the window's GL context
// current.
#pragma once

#include <optional>

#include "app/editor/camera_controller.h"
#include "app/editor/instruments_controller.h"
#include "app/editor/trace_controller.h"
#include "app/editor/viewport.h"
#include "app/scene/overlay_colours.h"
#include "planet/source/source_layers.h"
#include "planet/tree/region.h"

namespace worldy {

struct PictureInput {
    Scene& scene;
    const ViewSettings& settings;
    const CameraController& camera;
    const ChunkFocus& focus;
    TintData tints;                                // without the measurement
    const planet::SourceLayers* layers = nullptr;  // of the source; null: not known
    const TraceController& trace;
    std::optional<planet::Region> draft{};  // what the brush would add to a region at the pointer
};
// Draws the main picture, or the frame before or after a pop if the user has requested it. comparing: draws
// without the fill light, like B.
void drawMainPicture(Viewport& viewport, const PictureInput& input, InstrumentsController& instruments,
                     bool comparing, const Log& log);
void drawObserverPicture(Viewport& viewport, const PictureInput& input,
                         const InstrumentsController& instruments, const Log& log);

}  // namespace worldy
