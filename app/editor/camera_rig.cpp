#include "app/editor/camera_rig.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "app/base/places.h"
#include "app/flight/flight_path_file.h"
#include "app/flight/flight_record.h"
#include "planet/measure/pick.h"

namespace worldy {

namespace {

namespace fs = std::filesystem;

constexpr double joinFlightS = 1.5;
constexpr double glideS = 1;
constexpr double lowestOrbitRad = 0.02;  // above the pivot's horizon
constexpr double nearestOrbitM = 4;

bool touched(const PointerInput& pointer, const CameraMotion& motion) {
    return pointer.dragPx != glm::dvec2(0, 0) || pointer.lookPx != glm::dvec2(0, 0) || pointer.grabs ||
           pointer.wheelNotches != 0 || motion != CameraMotion();
}

void flyFrame(CameraRig& rig, const Surroundings& around, const planet::View& view,
              const PointerInput& pointer, CameraMotion motion, double seconds) {
    const Ground ground = around.groundBelow(rig.camera.eyeM);
    Camera camera = drag(rig.camera, ground, view, pointer.dragPx);
    const double radAPx = 1 / planet::screenScalePx(view);
    camera = look(camera, pointer.lookPx.x * radAPx, -pointer.lookPx.y * radAPx);
    if (pointer.wheelNotches != 0) {
        camera = approach(camera, ground, rayThrough(view, pointer.positionPx), pointer.wheelNotches);
    }
    // A narrow field of view magnifies turns.
    const double turn = std::min(view.horizontalFovRad / glm::radians(60.0), 1.0);
    motion.lookRight *= turn;
    motion.lookUp *= turn;
    camera = steered(camera, ground, motion, rig.speedFactor, seconds);
    rig.camera = keepInRange(camera, around.groundBelow(camera.eyeM));
}

// Returns the point in the picture's middle; if that is sky, the ground below the camera.
glm::dvec3 pivotFor(const Camera& camera, const Surroundings& around) {
    if (const std::optional<glm::dvec3> hit = around.hit(camera.eyeM, -camera.back)) return *hit;
    const Ground ground = around.groundBelow(camera.eyeM);
    return (ground.radiusM + ground.heightM) * glm::normalize(camera.eyeM);
}

// Scales the distance to the pivot; the view direction stays.
Camera dolly(const Camera& camera, const glm::dvec3& pivotM, double factor) {
    const glm::dvec3 offset = camera.eyeM - pivotM;
    const double distanceM = glm::length(offset);
    Camera moved = camera;
    moved.eyeM =
        pivotM + offset * (std::max(distanceM * factor, std::min(nearestOrbitM, distanceM)) / distanceM);
    return levelled(moved);
}

// Keeps the camera above the ground and not too far out. A corrected camera still looks at the same point.
Camera keepOrbitInRange(const Camera& camera, const glm::dvec3& pivotM, const Surroundings& around) {
    Camera kept = keepInRange(camera, around.groundBelow(camera.eyeM));
    const glm::dvec3 before = camera.eyeM - pivotM;
    const glm::dvec3 after = kept.eyeM - pivotM;
    const glm::dvec3 axis = glm::cross(before, after);
    const double sine = glm::length(axis);
    if (kept.eyeM == camera.eyeM || sine == 0) return kept;
    const double angleRad = std::atan2(sine, glm::dot(before, after));
    kept.back = rotated(kept.back, axis / sine, angleRad);
    kept.right = rotated(kept.right, axis / sine, angleRad);
    return levelled(kept);
}

void orbitFrame(CameraRig& rig, const Surroundings& around, const planet::View& view,
                const PointerInput& pointer, const CameraMotion& motion, double seconds) {
    if (!rig.pivotM) rig.pivotM = pivotFor(rig.camera, around);
    if (pointer.lookPx != glm::dvec2(0, 0)) {
        const Ground ground = around.groundBelow(rig.camera.eyeM);
        rig.camera = drag(rig.camera, ground, view, pointer.lookPx);
        rig.pivotM = pivotFor(rig.camera, around);
    }
    // Dragging over the viewport's height turns by 180 degrees.
    const double radAPx = glm::radians(180.0) / std::max(view.heightPx, 1);
    const double keyRad = glm::radians(60.0) * seconds;
    const double turnRad = -pointer.dragPx.x * radAPx + (motion.right + motion.lookRight) * keyRad;
    const double upRad = pointer.dragPx.y * radAPx + (motion.up + motion.lookUp) * keyRad;
    Camera camera = rig.camera;
    if (turnRad != 0 || upRad != 0) camera = orbit(camera, *rig.pivotM, turnRad, upRad);
    const double nearer = pointer.wheelNotches + 6 * motion.forward * rig.speedFactor * seconds;
    if (nearer != 0) camera = dolly(camera, *rig.pivotM, std::pow(0.85, nearer));
    rig.camera = keepOrbitInRange(camera, *rig.pivotM, around);
}

// Orbits the point under the pointer, or moves towards it. The point stays where it is in the picture.
void grabFrame(CameraRig& rig, const Surroundings& around, const planet::View& view,
               const PointerInput& pointer) {
    if (!rig.grab) {
        const auto hit = around.hit(rig.camera.eyeM, rayThrough(view, pointer.positionPx));
        const glm::dvec3 pointM = hit ? *hit : pivotFor(rig.camera, around);
        rig.grab = GrabbedPoint{pointM, directionOf(rig.camera, pointM)};
    }
    rig.pivotM.reset();  // a later orbit turns about the middle of the new picture
    const glm::dvec2 share =
        (pointer.orbitPx + pointer.dollyPx) / static_cast<double>(std::max(view.heightPx, 1));
    if (share == glm::dvec2(0, 0)) return;
    const GrabbedPoint& grab = *rig.grab;
    // The viewport's height turns by 180 degrees, or moves as many notches of the wheel as a zoom needs.
    constexpr double notches = 20;
    Camera camera =
        pointer.orbitPx != glm::dvec2(0, 0)
            ? orbit(rig.camera, grab.pointM, glm::radians(-180.0) * share.x, glm::radians(180.0) * share.y)
            : dolly(rig.camera, grab.pointM, std::pow(0.85, notches * (share.x - share.y)));
    camera = keepInRange(camera, around.groundBelow(camera.eyeM));
    rig.camera = holding(camera, grab.pointM, grab.direction);
}

void glideFrame(CameraRig& rig, const Surroundings& around, double seconds) {
    Glide& glide = *rig.glide;
    rig.jumped = true;
    glide.share = std::min(glide.share + seconds / glideS, 1.0);
    const double radiusM = around.groundBelow(rig.camera.eyeM).radiusM;
    const Camera camera = glideAt(glide.from, glide.to, glide.share, radiusM);
    rig.camera = keepInRange(camera, around.groundBelow(camera.eyeM));
    if (glide.share >= 1) rig.glide.reset();
}

void followFrame(CameraRig& rig, const Surroundings& around, double seconds) {
    FollowedFlight& flight = *rig.flight;
    const double radiusM = around.groundBelow(rig.camera.eyeM).radiusM;
    if (flight.from) {
        rig.jumped = true;
        flight.joinedShare = std::min(flight.joinedShare + seconds / joinFlightS, 1.0);
        if (flight.joinedShare >= 1) flight.from.reset();
    } else if (!flight.paused) {
        const double lengthS = durationS(flight.path);
        const double startS = flight.path.keys.front().timeS + flight.timeS;
        rig.jumped |= jumpsBetween(flight.path, startS, startS + seconds);
        flight.timeS += seconds;
        if (flight.timeS > lengthS) {
            flight.timeS = std::fmod(flight.timeS, lengthS);
            rig.jumped = true;
        }
    }
    const double start = flight.path.keys.front().timeS;
    Camera camera = cameraFromPose(poseAt(flight.path, start + flight.timeS), radiusM);
    if (flight.from) {
        const double t = flight.joinedShare;
        camera = blend(*flight.from, camera, t * t * (3 - 2 * t));
    }
    rig.camera = keepInRange(camera, around.groundBelow(camera.eyeM));
}

// Starts the transition to the flight that the settings name, and loads it if needed.
planet::Result<void> joinFlight(CameraRig& rig, CameraSettings& settings) {
    if (!rig.flight || rig.flight->file != settings.flight) {
        planet::Result<FlightPath> path = loadFlightPath(settings.flight);
        if (!path) return tl::unexpected(path.error());
        rig.flight = FollowedFlight{settings.flight, std::move(*path), 0, false, std::nullopt, 0};
    }
    rig.flight->from = rig.camera;
    rig.flight->joinedShare = 0;
    return {};
}

planet::Result<void> changeMode(CameraRig& rig, CameraSettings& settings) {
    const bool otherFlight =
        settings.mode == CameraMode::FollowFlight && rig.flight && rig.flight->file != settings.flight;
    if (settings.mode == rig.mode && !otherFlight) return {};
    rig.pivotM.reset();
    planet::Result<void> joined;
    if (settings.mode == CameraMode::FollowFlight) joined = joinFlight(rig, settings);
    if (!joined) settings.mode = CameraMode::Fly;
    rig.mode = settings.mode;
    return joined;
}

}  // namespace

Surroundings surroundingsOf(const Scene& scene) {
    return {[&scene](const glm::dvec3& eyeM) { return groundBelow(scene, eyeM); },
            [&scene](const glm::dvec3& eyeM, const glm::dvec3& direction) -> std::optional<glm::dvec3> {
                const auto hit = planet::pickSurface(scene.planet->tree(), scene.planet->selection().draw,
                                                     eyeM, direction);
                return hit ? std::optional(hit->positionM) : std::nullopt;
            }};
}

Camera orbit(const Camera& camera, const glm::dvec3& pivotM, double aroundRad, double upRad) {
    const glm::dvec3 zenith = glm::normalize(pivotM);
    const glm::dvec3 offset = camera.eyeM - pivotM;
    const double distanceM = glm::length(offset);
    if (distanceM == 0) return camera;
    const double elevation = std::asin(std::clamp(glm::dot(offset, zenith) / distanceM, -1.0, 1.0));
    const double wanted = std::clamp(elevation + upRad, std::min(elevation, lowestOrbitRad),
                                     std::max(elevation, glm::radians(90.0)));
    // Right above the pivot every level axis is valid; the camera's own keeps the picture upright.
    glm::dvec3 axis = glm::cross(zenith, offset);
    axis = glm::length(axis) > 1e-6 * distanceM ? glm::normalize(axis) : camera.right;
    const auto turned = [&](const glm::dvec3& vector) {
        return rotated(rotated(vector, axis, -(wanted - elevation)), zenith, aroundRad);
    };
    return levelled({pivotM + turned(offset), turned(camera.right), turned(camera.back)});
}

planet::Result<void> advanceRig(CameraRig& rig, const Surroundings& around, const planet::View& view,
                                const PointerInput& pointer, const CameraMotion& motion, double seconds,
                                CameraSettings& settings) {
    const bool isTouched = touched(pointer, motion);
    if (isTouched || settings.mode != rig.mode) rig.glide.reset();
    if (rig.mode == CameraMode::FollowFlight && settings.mode == rig.mode && isTouched)
        settings.mode = CameraMode::Fly;
    const planet::Result<void> changed = changeMode(rig, settings);
    if (rig.glide) {
        glideFrame(rig, around, seconds);
        return changed;
    }
    if (pointer.grabs) {
        grabFrame(rig, around, view, pointer);
        return changed;
    }
    rig.grab.reset();
    switch (rig.mode) {
        case CameraMode::Fly:
            flyFrame(rig, around, view, pointer, motion, seconds);
            break;
        case CameraMode::Orbit:
            orbitFrame(rig, around, view, pointer, motion, seconds);
            break;
        case CameraMode::FollowFlight:
            followFrame(rig, around, seconds);
            break;
    }
    return changed;
}

void placeRig(CameraRig& rig, const Camera& camera, CameraSettings& settings) {
    rig.camera = camera;
    rig.jumped = true;
    rig.pivotM.reset();
    rig.glide.reset();
    if (settings.mode == CameraMode::FollowFlight) settings.mode = CameraMode::Fly;
}

void glideRig(CameraRig& rig, const Camera& camera, CameraSettings& settings) {
    if (settings.mode == CameraMode::FollowFlight) settings.mode = CameraMode::Fly;
    rig.mode = settings.mode;  // this change of mode does not end the glide
    rig.pivotM.reset();
    rig.glide = Glide{rig.camera, camera, 0};
}

void orbitPoint(CameraRig& rig, const glm::dvec3& pointM, CameraSettings& settings) {
    rig.mode = settings.mode = CameraMode::Orbit;
    rig.pivotM = pointM;
}

planet::Result<void> startFlight(CameraRig& rig, const fs::path& file, CameraSettings& settings) {
    planet::Result<FlightPath> path = loadFlightPath(file);
    if (!path) return tl::unexpected(path.error());
    rig.flight = FollowedFlight{file, std::move(*path), 0, false, rig.camera, 0};
    rig.mode = CameraMode::FollowFlight;
    rig.pivotM.reset();
    rig.glide.reset();
    settings.mode = CameraMode::FollowFlight;
    settings.flight = file.string();
    return {};
}

void goOnWithFlight(CameraRig& rig, CameraSettings& settings) {
    if (!rig.flight) return;
    rig.flight->from.reset();
    rig.mode = settings.mode = CameraMode::FollowFlight;
}

void moveFlight(CameraRig& rig, double timeS) {
    if (!rig.flight) return;
    rig.flight->timeS = std::clamp(timeS, 0.0, durationS(rig.flight->path));
    rig.flight->from.reset();
    rig.jumped = true;
}

bool takeJump(CameraRig& rig) {
    return std::exchange(rig.jumped, false);
}

std::optional<std::vector<planet::AnnouncedView>> takeAnnouncement(CameraRig& rig, double horizonS,
                                                                   const planet::View& like, double radiusM) {
    RigAnnouncement& announced = rig.announced;
    if (rig.glide) {
        if (std::exchange(announced, {{}, true}).isGlide) return std::nullopt;
        planet::View view = viewOf(rig.glide->to, like.horizontalFovRad, like.widthPx, like.heightPx);
        return std::vector<planet::AnnouncedView>{{view, (1 - rig.glide->share) * glideS}};
    }
    const FollowedFlight* flight =
        rig.mode == CameraMode::FollowFlight && rig.flight ? &*rig.flight : nullptr;
    if (!flight || flight->from || flight->paused) {
        const RigAnnouncement before = std::exchange(announced, {});
        if (!before.flight && !before.isGlide) return std::nullopt;
        return std::vector<planet::AnnouncedView>();
    }
    const double timeS = flight->path.keys.front().timeS + flight->timeS;
    if (announced.flight && announced.flight->holds(timeS, horizonS, 1)) return std::nullopt;
    AnnouncedFlight next = announceFlight(flight->path, timeS, 1, horizonS, like, radiusM);
    announced = {next.announcement, false};
    return std::move(next.views);
}

void pauseFlight(CameraRig& rig, bool paused) {
    if (rig.flight) rig.flight->paused = paused;
}

std::vector<fs::path> availableFlights() {
    std::vector<fs::path> flights;
    for (const fs::path& folder : {dataFolder() / "flights", configFolder() / "flights"}) {
        std::error_code status;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, status)) {
            if (entry.path().extension() == ".toml" || isFlightRecord(entry.path()))
                flights.push_back(entry.path());
        }
    }
    std::sort(flights.begin(), flights.end(),
              [](const fs::path& a, const fs::path& b) { return a.filename() < b.filename(); });
    return flights;
}

ui::CameraView cameraViewOf(const CameraRig& rig, const Ground& ground,
                            std::span<const ui::Bookmark> bookmarks, std::span<const fs::path> flights) {
    ui::CameraView view;
    view.pose = poseOf(rig.camera, ground.radiusM);
    view.speedFactor = rig.speedFactor;
    view.bookmarks = bookmarks;
    view.flights = flights;
    if (rig.flight && rig.mode == CameraMode::FollowFlight) {
        const FollowedFlight& flight = *rig.flight;
        view.flight = ui::FlightView{flight.path.name, flight.timeS, durationS(flight.path), flight.paused};
    }
    return view;
}

}  // namespace worldy
