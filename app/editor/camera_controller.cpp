#include "app/editor/camera_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/base/text.h"
#include "app/scene/observer.h"
#include "app/window/steering_devices.h"

namespace worldy {

namespace {

planet::View viewOfPicture(const Camera& camera, const PlanetPicture& picture, const PlanetPicture& other,
                           float pixelRatio, const CameraSettings& settings) {
    // A hidden picture has the other's size, because the LOD view continues while only the observer is shown.
    const PixelSize size = pixelSizeOf(picture.shown() ? picture.rect : other.rect, pixelRatio);
    return viewOf(camera, glm::radians(settings.fovDeg), size.width, size.height);
}

// Changes the speed and shows it.
void setSpeed(CameraController& camera, const Scene* scene, double factor, Notices& notices) {
    factor = std::clamp(factor, minSpeedFactor, maxSpeedFactor);
    if (!scene || !camera.rig || camera.rig->speedFactor == factor) return;
    camera.rig->speedFactor = factor;
    const Camera& now = camera.rig->camera;
    showBriefly(notices, fmt::format("Speed {:.2f} x, {}/s", factor,
                                     distanceText(speedMS(now, groundBelow(*scene, now.eyeM), factor))));
}

CameraMotion motionOfDevices(const CameraController& camera, const WindowPreferences& preferences) {
    CameraMotion motion;
    if (!camera.isSteered) return motion;
    for (const SteeringState& device : camera.devices)
        motion = motion + motionOf(device, preferences.steering, preferences.invertSteering);
    return motion;
}

struct CameraHandler {
    CameraController& camera;
    const CameraContext& context;
    Notices& notices;

    CameraSettings& settings() const { return context.settings.view.camera; }
    bool isThere() const { return context.scene && camera.rig; }
    double radiusM() const { return context.scene->planet->tree().shape.radiusM; }
    void moveTo(const planet::CameraPose& pose) const {
        if (context.scene) moveCamera(camera, cameraFromPose(pose, radiusM()), settings());
    }

    void operator()(const ui::FreezeLod& command) const {
        if (mayChange("Settings", context.replay != nullptr, notices.log))
            freezeLod(camera, command.frozen, context.popSide);
    }
    void glideTo(const planet::CameraPose& pose) const {
        if (context.scene) glideCamera(camera, cameraFromPose(pose, radiusM()), context);
    }
    void operator()(const ui::MoveCamera& command) const {
        command.glides ? glideTo(command.pose) : moveTo(command.pose);
    }
    void operator()(const ui::LookAtPoint& command) const {
        if (isThere()) glideCamera(camera, lookingAt(camera.rig->camera, command.pointM), context);
    }
    void operator()(const ui::OrbitPoint& command) const {
        if (!isThere()) return;
        glideCamera(camera, lookingAt(camera.rig->camera, command.pointM), context);
        orbitPoint(*camera.rig, command.pointM, settings());
    }
    void operator()(const ui::SetSteering& command) const {
        WindowPreferences& preferences = context.settings.workspace.preferences;
        preferences.steering = command.sensitivity;
        preferences.invertSteering = command.inverted;
    }
    void operator()(const ui::InspectPlace& command) const {
        if (isThere()) inspect(camera, cameraFromPose(command.pose, radiusM()), command.lodView, context);
    }
    void operator()(const ui::EndInspection&) const { endInspection(camera, context); }
    void operator()(const ui::ResetCamera&) const {
        if (context.scene) glideTo(startPose(context.settings.camera, radiusM()));
    }
    void operator()(const ui::KeepCameraAsStart&) const {
        if (!isThere()) return;
        context.settings.camera = poseOf(camera.rig->camera, radiusM());
        if (context.settingsFile.empty())
            confirm(notices, "This session starts here; its settings are not saved");
        else
            confirm(notices, fmt::format("Future sessions start here (saved with the settings in {})",
                                         context.settingsFile.string()));
    }
    void operator()(const ui::AddBookmark& command) const {
        if (!isThere()) return;
        const planet::CameraPose pose = poseOf(camera.rig->camera, radiusM());
        if (succeeded(notices, addBookmark(camera.bookmarks, command.name, pose),
                      "The bookmark was not added"))
            confirm(notices, fmt::format("Bookmark {} saved in {}", command.name, bookmarksFile().string()));
    }
    void operator()(const ui::RemoveBookmark& command) const {
        if (succeeded(notices, removeBookmark(camera.bookmarks, command.name),
                      "The bookmark was not removed"))
            confirm(notices, fmt::format("Bookmark {} removed", command.name));
    }
    void operator()(const ui::SetSpeedFactor& command) const {
        setSpeed(camera, context.scene, command.factor, notices);
    }
    void operator()(const ui::StartFlight& command) const {
        if (camera.rig)
            succeeded(notices, startFlight(*camera.rig, command.file, settings()),
                      "The flight cannot be followed");
    }
    void operator()(const ui::MoveFlight& command) const {
        if (camera.rig) moveFlight(*camera.rig, command.timeS);
    }
    void operator()(const ui::PauseFlight& command) const {
        if (camera.rig) pauseFlight(*camera.rig, command.paused);
    }
};

}  // namespace

void execute(CameraController& camera, const ui::CameraCommand& command, const CameraContext& context,
             Notices& notices) {
    std::visit(CameraHandler{camera, context, notices}, command);
}

void inspect(CameraController& camera, const Camera& place, const planet::View& lodView,
             const CameraContext& context) {
    if (!camera.beforeInspection)
        camera.beforeInspection =
            BeforeInspection{camera.rig->camera, camera.lodView, camera.lodFrozen,
                             context.replay && context.replay->playing, context.settings.view.camera.mode};
    context.popSide = PopSide::Live;
    placeRig(*camera.rig, place, context.settings.view.camera);
    if (context.replay) {
        context.replay->playing = false;
        return;
    }
    camera.lodFrozen = true;
    if (camera.lodView == lodView) return;
    camera.lodView = lodView;
    camera.lodViewPlaced = true;
    context.stepOnce = true;  // also selects for it while frames are paused
}

void endInspection(CameraController& camera, const CameraContext& context) {
    const std::optional<BeforeInspection> before = std::exchange(camera.beforeInspection, std::nullopt);
    if (!before) return;
    context.popSide = PopSide::Live;
    moveCamera(camera, before->camera, context.settings.view.camera);
    if (before->mode == CameraMode::FollowFlight) goOnWithFlight(*camera.rig, context.settings.view.camera);
    if (context.replay) {
        context.replay->playing = before->replayPlaying;
        return;
    }
    camera.lodView = before->lodView;
    camera.lodViewPlaced = true;
    camera.lodFrozen = before->lodFrozen;
    context.stepOnce = true;
}

void freezeLod(CameraController& camera, bool frozen, PopSide& popSide) {
    camera.lodFrozen = frozen;
    camera.beforeInspection.reset();  // the user takes control from here
    if (!frozen) popSide = PopSide::Live;
}

void moveCamera(CameraController& camera, const Camera& place, CameraSettings& settings) {
    if (camera.rig) placeRig(*camera.rig, place, settings);
}

void glideCamera(CameraController& camera, const Camera& place, const CameraContext& context) {
    CameraSettings& settings = context.settings.view.camera;
    const bool glides =
        context.settings.workspace.preferences.glide && !context.framesPaused && !context.replay;
    if (camera.rig && glides)
        glideRig(*camera.rig, place, settings);
    else
        moveCamera(camera, place, settings);
}

void meetPlanet(CameraController& camera, double radiusM) {
    camera.beforeInspection.reset();
    if (radiusM != camera.radiusM) {
        camera.rig.reset();
        camera.observer.reset();
    }
    camera.radiusM = radiusM;
}

void placeCameras(CameraController& camera, const Scene& scene, const Viewport& viewport,
                  const Settings& settings) {
    if (!camera.rig) {
        const double radiusM = scene.planet->tree().shape.radiusM;
        camera.rig.emplace();
        camera.rig->camera = cameraFromPose(startPose(settings.camera, radiusM), radiusM);
    }
    if (camera.observer || !viewport.observer.shown()) return;
    camera.observer.emplace();
    camera.observer->camera = observerStart(mainView(camera, viewport, settings.view.camera),
                                            groundBelow(scene, camera.rig->camera.eyeM));
}

void moveCameras(CameraController& camera, Scene& scene, const Viewport& viewport, Settings& all,
                 bool replaying, double seconds, Notices& notices) {
    CameraSettings& settings = all.view.camera;
    const Surroundings around = surroundingsOf(scene);
    const KeyInput keys = readKeys();
    const double wheelSteps = viewport.main.pointer.speedNotches + viewport.observer.pointer.speedNotches;
    setSpeed(camera, &scene,
             camera.rig->speedFactor * std::pow(1.5, keys.speedSteps) * std::pow(1.2, wheelSteps), notices);
    const CameraMotion motion = keys.held + motionOfDevices(camera, all.workspace.preferences);
    // The keys control the picture under the pointer.
    const bool observing =
        viewport.observer.shown() && (viewport.observer.pointer.over || !viewport.main.shown());
    planet::Result<void> moved;
    if (!replaying)
        moved = advanceRig(*camera.rig, around, mainView(camera, viewport, settings), viewport.main.pointer,
                           observing ? CameraMotion() : motion, seconds, settings);
    succeeded(notices, moved, "The flight ended");

    if (!viewport.observer.shown()) return;
    camera.observer->speedFactor = camera.rig->speedFactor;
    // It cannot fail, because the observer follows no flight.
    static_cast<void>(advanceRig(*camera.observer, around, observerView(camera, viewport, settings),
                                 viewport.observer.pointer, observing ? motion : CameraMotion(), seconds,
                                 camera.observerControls));
}

std::vector<GamepadButton> readDevices(CameraController& camera, const Window& window) {
    const std::vector<SteeringState> before = std::exchange(camera.devices, readSteeringDevices());
    // Without the focus, the user may be steering in another program.
    camera.isSteered = window.isFocused();
    return camera.isSteered ? pressedButtons(before, camera.devices) : std::vector<GamepadButton>();
}

bool hasDeviceInput(const CameraController& camera, const Window& window) {
    const std::vector<SteeringState> now = readSteeringDevices();
    if (!std::ranges::equal(now, camera.devices, {}, &SteeringState::name, &SteeringState::name)) return true;
    return window.isFocused() && std::ranges::any_of(now, isUsed);
}

void followCamera(CameraController& camera, const Viewport& viewport, const CameraSettings& settings,
                  double passedS) {
    const glm::dvec3 fromM = camera.lodView.eyeM;
    const bool lodViewPlaced = std::exchange(camera.lodViewPlaced, false);
    const bool placed = takeJump(*camera.rig);
    if (!camera.lodFrozen) camera.lodView = mainView(camera, viewport, settings);
    const glm::dvec3& toM = camera.lodView.eyeM;
    camera.jumped = lodViewPlaced ||
                    (toM != fromM && (placed || planet::isCameraJump(fromM, toM, camera.radiusM, passedS)));
}

void announceCamera(CameraController& camera, Scene& scene, const ViewSettings& settings,
                    Recorder* recorder) {
    const planet::PrefetchSettings& prefetch = settings.paging.prefetch;
    // A frozen view does not follow the camera.
    if (prefetch.mode != planet::PrefetchMode::Announced || camera.lodFrozen || !camera.rig) return;
    const auto ahead = takeAnnouncement(*camera.rig, prefetch.horizonS, camera.lodView, camera.radiusM);
    if (!ahead) return;
    scene.planet->announce(*ahead);
    if (recorder) recorder->announced(*scene.planet, *ahead);
}

planet::View mainView(const CameraController& camera, const Viewport& viewport,
                      const CameraSettings& settings) {
    return viewOfPicture(camera.rig->camera, viewport.main, viewport.observer, viewport.pixelRatio, settings);
}

planet::View observerView(const CameraController& camera, const Viewport& viewport,
                          const CameraSettings& settings) {
    return viewOfPicture(camera.observer->camera, viewport.observer, viewport.main, viewport.pixelRatio,
                         settings);
}

bool observerChooses(const Viewport& viewport, const CameraSettings& settings) {
    return viewport.observer.shown() && settings.observerOwnLod;
}

std::size_t observerSelection(const Scene& scene, const Viewport& viewport, const CameraSettings& settings) {
    return observerChooses(viewport, settings) && scene.planet->views().size() > 1 ? 1 : 0;
}

ui::CameraView cameraViewOf(const CameraController& camera, const Scene* scene,
                            const planet::View& renderView, const WindowPreferences& preferences) {
    ui::CameraView view;
    if (scene && camera.rig) {
        view = cameraViewOf(*camera.rig, groundBelow(*scene, camera.rig->camera.eyeM), camera.bookmarks.list,
                            camera.flights);
        view.seaSurfaceM = scene->seaSurfaceM;
    }
    view.lodView = camera.lodView;
    view.renderView = renderView;
    view.lodFrozen = camera.lodFrozen;
    view.inspecting = camera.beforeInspection.has_value();
    view.steering = {camera.devices, preferences.steering, preferences.invertSteering};
    return view;
}

}  // namespace worldy
