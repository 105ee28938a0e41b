// The window's cameras: the LOD camera, the observer, freezing of LOD, inspection of places, bookmarks, and the devices that
// steer. Main thread.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/editor/camera_rig.h"
#include "app/editor/viewport.h"
#include "app/flight/recorder.h"
#include "app/measure/pop_side.h"
#include "app/session/bookmarks.h"
#include "app/session/notices.h"
#include "app/settings/settings.h"
#include "app/window/window.h"
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
    CameraMode mode = CameraMode::Fly;
};

struct CameraController {
    std::optional<CameraRig> rig;       // none until a planet is open
    std::optional<CameraRig> observer;  // none until the observer is used
    CameraSettings observerControls;
    double radiusM = 0;    // of the planet below the cameras
    planet::View lodView;  // follows the camera unless frozen
    bool lodFrozen = false;
    bool lodViewPlaced = false;  // by an inspection, since followCamera()
    bool jumped = false;         // in the last frame; for measuring pops
    std::optional<BeforeInspection> beforeInspection;
    Bookmarks bookmarks;
    std::vector<std::filesystem::path> flights;  // the flights that can be followed
    std::vector<SteeringState> devices;          // as read in this frame
    bool isSteered = false;                      // false: the devices belong to another window
};

// Parts of other features that camera commands use and change.
struct CameraContext {
    const Scene* scene;  // null while no planet is open
    Settings& settings;
    PopSide& popSide;
    bool& stepOnce;  // FrameController::stepOnce
    bool framesPaused;
    ui::ReplayControls* replay;            // null if no replay is running
    std::filesystem::path settingsFile{};  // empty: the settings are not saved
};

void execute(CameraController& camera, const ui::CameraCommand& command, const CameraContext& context,
             Notices& notices);

// Moves the camera and freezes LOD at lodView; pauses a replay instead of freezing. Needs a rig.
void inspect(CameraController& camera, const Camera& place, const planet::View& lodView,
             const CameraContext& context);
// Restores camera and LOD from before the first inspect(). Does nothing if there was none.
void endInspection(CameraController& camera, const CameraContext& context);
// Freezes or unfreezes LOD by hand. This ends the inspection and leaves the camera where it is.
void freezeLod(CameraController& camera, bool frozen, PopSide& popSide);
// Moves the camera without a transition. Does nothing without a rig.
void moveCamera(CameraController& camera, const Camera& place, CameraSettings& settings);
// Lets the camera glide to a place, or moves it there without a transition if the user prefers that, while frames are paused
// and during a replay. Does nothing without a rig.
void glideCamera(CameraController& camera, const Camera& place, const CameraContext& context);

// Call when another planet is shown. The cameras stay if its radius is the same.
void meetPlanet(CameraController& camera, double radiusM);
// Creates the cameras that are needed, also while frames are paused.
void placeCameras(CameraController& camera, const Scene& scene, const Viewport& viewport,
                  const Settings& settings);
// Moves the cameras by keys, pointer, devices and flight; during a replay only the observer.
void moveCameras(CameraController& camera, Scene& scene, const Viewport& viewport, Settings& all,
                 bool replaying, double seconds, Notices& notices);

// Reads the devices that steer. Returns the buttons that went down. Call once a frame.
std::vector<GamepadButton> readDevices(CameraController& camera, const Window& window);
// Returns true if a device that steers is in use, or if one has come or gone since the last frame.
bool hasDeviceInput(const CameraController& camera, const Window& window);
// Sets the LOD view from the camera unless it is frozen. passedS: time since pops were last measured,
// seconds.
void followCamera(CameraController& camera, const Viewport& viewport, const CameraSettings& settings,
                  double passedS);

// Announces to the planet where the camera will be, if that is known and the settings prefetch it. recorder: null unless
// the flight is recorded.
void announceCamera(CameraController& camera, Scene& scene, const ViewSettings& settings, Recorder* recorder);

// Return the views of the main and the observer's picture; the latter needs an observer.
planet::View mainView(const CameraController& camera, const Viewport& viewport,
                      const CameraSettings& settings);
planet::View observerView(const CameraController& camera, const Viewport& viewport,
                          const CameraSettings& settings);

// Returns true if the observer's picture draws its own selection.
bool observerChooses(const Viewport& viewport, const CameraSettings& settings);
// Returns the index of the selection in the observer's picture. The second selection exists only after a
// frame has computed it, which is delayed while frames are paused.
std::size_t observerSelection(const Scene& scene, const Viewport& viewport, const CameraSettings& settings);

// scene: null if no planet is open. renderView: of the main picture. Valid until bookmarks, flights or devices
// change.
ui::CameraView cameraViewOf(const CameraController& camera, const Scene* scene,
                            const planet::View& renderView, const WindowPreferences& preferences);

}  // namespace worldy
