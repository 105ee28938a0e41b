// The ways a camera moves: flying, orbiting a point of the ground, following a recorded flight. Changing from
// one to another never makes the picture jump. No GL and no clock; one thread.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "app/editor/input.h"
#include "app/flight/flight_path.h"
#include "app/scene/camera_control.h"
#include "app/scene/scene.h"
#include "planet/base/result.h"
#include "ui/model/editor_view.h"

namespace worldy {

// What the camera must know of the planet.
struct Surroundings {
    std::function<Ground(const glm::dvec3& eyeM)> groundBelow;
    // Where a ray meets what is drawn; nothing where it goes into the sky.
    std::function<std::optional<glm::dvec3>(const glm::dvec3& eyeM, const glm::dvec3& direction)> hit;
};
Surroundings surroundingsOf(const Scene& scene);

struct FollowedFlight {
    std::filesystem::path file;
    FlightPath path;
    double timeS = 0;  // since its start, [0, durationS]; begins anew at the end
    bool paused = false;
    // On the way from where the camera was to the flight; the flight waits meanwhile.
    std::optional<Camera> from;
    double joinedShare = 0;  // [0, 1]
};

struct CameraRig {
    Camera camera;
    double speedFactor = 1;              // [minSpeedFactor, maxSpeedFactor]
    CameraMode mode = CameraMode::Fly;   // of the last frame
    std::optional<glm::dvec3> pivotM{};  // of Orbit: on the ground; none: what is in the middle next frame
    std::optional<FollowedFlight> flight{};  // also while another mode has left it
    // Whether it was put elsewhere at once since takeJump(), or is on its way to a flight.
    bool jumped = false;
};

// One frame, by the mode that the settings ask for. A touch of the controls leaves a flight: then the
// settings say Fly. The Error names a flight that cannot be read; the settings say Fly then too.
planet::Result<void> advanceRig(CameraRig& rig, const Surroundings& around, const planet::View& view,
                                const PointerInput& pointer, const HeldKeys& keys, double seconds,
                                CameraSettings& settings);

// Puts the camera somewhere at once. Leaves a flight; an orbit goes on about what is then in the middle.
void placeRig(CameraRig& rig, const Camera& camera, CameraSettings& settings);

bool takeJump(CameraRig& rig);

// Follows a flight from its beginning.
planet::Result<void> startFlight(CameraRig& rig, const std::filesystem::path& file, CameraSettings& settings);
void moveFlight(CameraRig& rig, double timeS);  // kept within the flight
void pauseFlight(CameraRig& rig, bool paused);

// The flights that come with Worldy and those in the folder "flights" beside the settings, by name.
std::vector<std::filesystem::path> availableFlights();

// For the camera panel. The spans must outlive it.
ui::CameraView cameraViewOf(const CameraRig& rig, const Ground& ground,
                            std::span<const ui::Bookmark> bookmarks,
                            std::span<const std::filesystem::path> flights);

// Turns the camera about a point: around the vertical there, and up towards it, radians. It never goes under
// the point's horizon nor over its zenith.
Camera orbit(const Camera& camera, const glm::dvec3& pivotM, double aroundRad, double upRad);

// Between two cameras, over the ground: share 0 is from, 1 is to.
Camera blend(const Camera& from, const Camera& to, double share);

}  // namespace worldy
