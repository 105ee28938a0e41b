// Measures the planet in the window: allocations, LOD changes, pops, probed vertices, cracks, costs and true
// errors. Needs the window's GL context current. Main thread.
#pragma once

#include "app/editor/atlas_controller.h"
#include "app/editor/camera_controller.h"
#include "app/editor/suggest_controller.h"
#include "app/editor/viewport.h"
#include "app/measure/cracks.h"
#include "app/measure/error_job.h"
#include "app/measure/pops.h"
#include "app/measure/ruler.h"
#include "app/measure/surface_costs.h"
#include "app/scene/overlay_lines.h"
#include "app/session/notices.h"
#include "app/settings/settings.h"
#include "planet/measure/lod_changes.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"

namespace worldy {

struct InstrumentsController {
    ui::AllocationsView allocations;
    bool markAllocations = false;  // with the next count, at the end of this frame
    planet::LodChanges changes;
    Pops pops;
    ui::ProbeView probe;
    CrackInstrument cracks;
    CostInstrument costs;
    ErrorMeter errors;
    Ruler ruler;
    AtlasController atlas;
    SuggestController suggest;
};

// Parts of other features that instrument commands use and change.
struct InstrumentContext {
    Scene* scene;  // null if no planet is open
    ViewSettings& settings;
    const planet::View& view;  // of the main picture
    ChunkFocus& focus;
    CameraController& camera;
    const CameraContext& cameraContext;
};
void execute(InstrumentsController& instruments, const ui::InstrumentCommand& command,
             const InstrumentContext& context, Notices& notices);

// Call when another planet is shown; discards all measurements.
void forgetPlanet(InstrumentsController& instruments);

// Call after the frame's pictures are drawn. Continues measurements that take several frames, and turns off
// features that are too slow.
struct DrawnFrame {
    Scene& scene;
    const PlanetPicture& picture;  // the main one
    const Settings& settings;
    const ChunkFocus& focus;
    std::uint64_t frame = 0;
    double timeS = 0;
};
void advanceInstruments(InstrumentsController& instruments, const DrawnFrame& drawn, const Log& log,
                        ui::Commands& commands);

// scene: null if no planet is shown. view: of the main picture. Valid until the instruments change.
ui::InstrumentsView instrumentsViewOf(const InstrumentsController& instruments, const Scene* scene,
                                      const planet::View& view, const ViewSettings& settings,
                                      std::uint64_t frame);

}  // namespace worldy
