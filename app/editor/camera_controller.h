// The window's cameras: the one that chooses LOD, the observer, freezing of LOD, inspection of places, and
// bookmarks. Main thread.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/editor/bookmarks.h"
#include "app/editor/camera_rig.h"
#include "app/editor/notices.h"
#include "app/editor/viewport.h"
#include "app/measure/pop_side.h"
#include "app/settings/settings.h"
#include "ui/model/commands.h"
#include "ui/model/editor_view.h"
#include "ui/model/replay_controls.h"

namespace worldy {

// The camera and the freezing of LOD before a place was inspected.
struct BeforeInspection {
    Camera camera;
    planet::View lodView;
    bool lodFrozen = false;
    bool replayPlaying = false;
};

struct CameraController {
    std::optional<CameraRig> rig;       // once a planet is open
    std::optional<CameraRig> observer;  // once it was looked through
    CameraSettings observerControls;
    double radiusM = 0;    // of the planet that the cameras are over
    planet::View lodView;  // follows the camera unless frozen
    bool lodFrozen = false;
    bool jumped = false;  // in the last frame, for measuring pops
    std::optional<BeforeInspection> beforeInspection;
    Bookmarks bookmarks;
    std::vector<std::filesystem::path> flights;  // that can be followed
};

// The parts of other features that commands to the camera use and change.
struct CameraContext {
    const Scene* scene;  // null while no planet is open
    Settings& settings;
    PopSide& popSide;
    bool& stepOnce;              // as of FrameController
    ui::ReplayControls* replay;  // null while none runs
};

void execute(CameraController& camera, const ui::CameraCommand& command, const CameraContext& context,
             Notices& notices);

// Moves the camera and freezes LOD at lodView; pauses a replay instead of freezing. Needs a rig.
void inspect(CameraController& camera, const Camera& place, const planet::View& lodView,
             const CameraContext& context);
// Restores the camera and LOD from before the first inspect(); does nothing if there was none.
void endInspection(CameraController& camera, const CameraContext& context);
// Freezes or unfreezes LOD by hand, which ends the inspection where the camera is.
void freezeLod(CameraController& camera, bool frozen, PopSide& popSide);
// Puts the camera somewhere at once. Does nothing without a rig.
void moveCamera(CameraController& camera, const Camera& place, CameraSettings& settings);

// Another planet is shown: the cameras stay over one of the same radius.
void meetPlanet(CameraController& camera, double radiusM);
// Makes the cameras that are needed, also while frames are paused.
void placeCameras(CameraController& camera, const Scene& scene, const Viewport& viewport,
                  const Settings& settings);
// Moves the cameras by keys, pointer and flight; while a flight is replayed, the observer alone.
void moveCameras(CameraController& camera, Scene& scene, const Viewport& viewport, CameraSettings& settings,
                 bool replaying, double seconds, const Log& log);
// Lets the LOD view follow the camera unless frozen. passedS: since pops were measured last.
void followCamera(CameraController& camera, const Viewport& viewport, const CameraSettings& settings,
                  double passedS);

// Returns what the main and the observer's picture show; the observer's needs an observer.
planet::View mainView(const CameraController& camera, const Viewport& viewport,
                      const CameraSettings& settings);
planet::View observerView(const CameraController& camera, const Viewport& viewport,
                          const CameraSettings& settings);

// Returns true if the observer's picture draws a selection of its own.
bool observerChooses(const Viewport& viewport, const CameraSettings& settings);
// Returns the number of the selection in the observer's picture. The second one is there once a frame has
// chosen it, which it has not at once while frames are paused.
std::size_t observerSelection(const Scene& scene, const Viewport& viewport, const CameraSettings& settings);

// scene: null while no planet is open. Holds until bookmarks or flights change.
void fillView(const CameraController& camera, const Scene* scene, ui::EditorView& view);

}  // namespace worldy
