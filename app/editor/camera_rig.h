// The camera's modes: flying, orbiting a point of the ground, and following a recorded flight. In each mode the camera can
// glide to a place, and be turned about a point that the pointer holds. Mode changes never make the picture jump. No GL and
// no clock; one thread.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "app/flight/announce_flight.h"
#include "app/flight/flight_path.h"
#include "app/scene/camera_control.h"
#include "app/scene/camera_paths.h"
#include "app/scene/scene.h"
#include "app/window/input.h"
#include "planet/base/result.h"
#include "ui/model/editor_view.h"

namespace worldy {

// The planet as the camera needs it.
struct Surroundings {
    std::function<Ground(const glm::dvec3& eyeM)> groundBelow;
    // Returns where a ray hits the drawn surface; none if it hits the sky.
    std::function<std::optional<glm::dvec3>(const glm::dvec3& eyeM, const glm::dvec3& direction)> hit;
};
Surroundings surroundingsOf(const Scene& scene);

struct FollowedFlight {
    std::filesystem::path file;
    FlightPath path;
    double timeS = 0;  // since its start, [0, durationS]; wraps at the end
    bool paused = false;
    // The camera from which the transition to the flight started; none: no transition. The flight waits for
    // it to end.
    std::optional<Camera> from;
    double joinedShare = 0;  // progress of the transition, [0, 1]
};

// A glide to a place.
struct Glide {
    Camera from;
    Camera to;
    double share = 0;  // of its time that has passed, [0, 1)
};

// The point of the ground that the pointer holds while it orbits it.
struct GrabbedPoint {
    glm::dvec3 pointM{0, 0, 0};
    glm::dvec3 direction{0, 0, -1};  // where it stays in the picture, as holding() takes it
};

// The last announcement of a rig to the planet.
struct RigAnnouncement {
    std::optional<FlightAnnouncement> flight{};
    bool isGlide = false;
};

struct CameraRig {
    Camera camera;
    double speedFactor = 1;                  // [minSpeedFactor, maxSpeedFactor]
    CameraMode mode = CameraMode::Fly;       // of the last frame
    std::optional<glm::dvec3> pivotM{};      // Orbit: on the ground; none: found in the next frame
    std::optional<FollowedFlight> flight{};  // kept while another mode is used
    std::optional<Glide> glide{};            // none: the camera does not glide
    std::optional<GrabbedPoint> grab{};      // none: the pointer holds no point
    // True after a jump since takeJump(), during a glide, and during the transition to a flight.
    bool jumped = false;
    RigAnnouncement announced{};
};

// Runs one frame in the mode of the settings. Input from the user ends a glide, and following a flight: settings.mode
// becomes Fly. It also becomes Fly if the flight cannot be read; the Error names the flight.
planet::Result<void> advanceRig(CameraRig& rig, const Surroundings& around, const planet::View& view,
                                const PointerInput& pointer, const CameraMotion& motion, double seconds,
                                CameraSettings& settings);

// Moves the camera without a transition. Leaves a flight; an orbit continues around the new middle of the
// picture.
void placeRig(CameraRig& rig, const Camera& camera, CameraSettings& settings);

// Lets the camera glide to a place in about a second. Leaves a flight; an orbit continues around the new middle of the
// picture.
void glideRig(CameraRig& rig, const Camera& camera, CameraSettings& settings);

// Orbits a point from now on; the camera stays. The point need not be in the middle of the picture.
void orbitPoint(CameraRig& rig, const glm::dvec3& pointM, CameraSettings& settings);

bool takeJump(CameraRig& rig);

// Returns the views of the flight that the camera follows, or of the place that it glides to, for Planet::announce();
// nothing while what was returned last still holds. It is empty if the camera has left its flight. like: has the
// size and the field of view of the picture.
std::optional<std::vector<planet::AnnouncedView>> takeAnnouncement(CameraRig& rig, double horizonS,
                                                                   const planet::View& like, double radiusM);

// Follows a flight from its start.
planet::Result<void> startFlight(CameraRig& rig, const std::filesystem::path& file, CameraSettings& settings);
// Follows the kept flight again from where it was, without a transition; does nothing if there is none.
void goOnWithFlight(CameraRig& rig, CameraSettings& settings);
void moveFlight(CameraRig& rig, double timeS);  // clamped to the flight
void pauseFlight(CameraRig& rig, bool paused);

// Returns the flights that come with Worldy and those in the folder "flights" beside the settings, by name.
std::vector<std::filesystem::path> availableFlights();

// Returns the data of the Camera panel. The spans must outlive it.
ui::CameraView cameraViewOf(const CameraRig& rig, const Ground& ground,
                            std::span<const ui::Bookmark> bookmarks,
                            std::span<const std::filesystem::path> flights);

// Rotates the camera around a point: around its vertical, and up towards it, radians. The camera stays
// between the point's horizon and its zenith.
Camera orbit(const Camera& camera, const glm::dvec3& pivotM, double aroundRad, double upRad);

}  // namespace worldy
