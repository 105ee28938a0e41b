#include "app/measure/pops_flight.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "app/base/stopwatch.h"
#include "app/scene/camera_control.h"
#include "app/scene/scene.h"
#include "app/scene/scene_settings.h"
#include "app/settings/camera_text.h"
#include "planet/gl/draw/frame_uniforms.h"

namespace worldy {

namespace {

using planet::PopEvent;
using planet::Result;

planet::View viewAt(const planet::Planet& planet, const FlightPath& path, double timeS, double fovDeg,
                    const PictureSize& size) {
    const double radiusM = planet.tree().shape.radiusM;
    const Camera wanted = cameraFromPose(poseAt(path, timeS), radiusM);
    const Ground ground{radiusM, planet::residentHeightM(planet.tree(), wanted.eyeM)};
    return viewOf(keepInRange(wanted, ground), glm::radians(fovDeg), size.widthPx, size.heightPx);
}

// Makes one frame of elapsedS seconds in which all requested blocks arrive.
Result<void> stepOnTime(planet::Planet& planet, const planet::ViewInput& view, double elapsedS,
                        const std::function<bool()>& goOn) {
    const Stopwatch waited;
    planet.step({&view, 1}, planet::noUpload, elapsedS);
    while (!planet.settled()) {
        if (!goOn()) return planet::cancelled();
        if (waited.elapsedMs() > 1000 * settleTimeoutS) return loadingTimedOut();
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        planet.step({&view, 1}, planet::noUpload, 0);
    }
    return {};
}

Result<void> settleView(planet::Planet& planet, const planet::ViewInput& view,
                        const std::function<bool()>& goOn) {
    const auto settle = [&](double timeoutS) {
        return planet.settle({&view, 1}, planet::noUpload, timeoutS);
    };
    if (settleWhile(settle, goOn)) return {};
    return goOn() ? loadingTimedOut() : planet::cancelled();
}

// Loaded ground may lift the camera, and then the view needs more blocks.
Result<void> settleAtStart(planet::Planet& planet, const std::function<planet::View()>& firstView,
                           const planet::LodSettings& lod, const std::function<bool()>& goOn) {
    constexpr int mostLifts = 5;
    for (int i = 0; i < mostLifts; ++i) {
        const planet::View view = firstView();
        if (const Result<void> settled = settleView(planet, {view, lod, 1}, goOn); !settled) return settled;
        if (firstView() == view) break;
    }
    return {};
}

std::optional<double> seaLevelM(const planet::Planet& planet, const ViewSettings& settings,
                                const planet::View& view, bool software) {
    const planet::gl::RenderSettings render = renderSettingsOf(settings, view, planet.tree());
    return planet::gl::isSeaSurfaceDrawn(render, software) ? std::optional(render.seaLevelM) : std::nullopt;
}

}  // namespace

Result<PopsFlight> flyForPops(planet::Planet& planet, const FlightPath& path, const ViewSettings& settings,
                              const PictureSize& size, double stepS, bool software,
                              const PopsFlightWatch& goOn) {
    const planet::LodSettings lod = lodSettingsOf(settings);
    const double startS = path.keys.front().timeS;
    PopsFlight flown;
    const Result<int> frames = flightViews(path, stepS, mostPopsFrames);
    if (!frames) return tl::unexpected(frames.error());
    flown.frames = *frames;
    const auto firstView = [&] { return viewAt(planet, path, startS, settings.camera.fovDeg, size); };
    if (const Result<void> settled = settleAtStart(planet, firstView, lod, [&] { return goOn(0); }); !settled)
        return tl::unexpected(settled.error());
    const std::optional<double> seaM = seaLevelM(planet, settings, firstView(), software);
    flown.seaSurfaceDrawn = seaM.has_value();
    glm::dvec3 fromM = firstView().eyeM;
    planet::PopMeter meter;
    for (int i = 0; i < flown.frames; ++i) {
        const auto share = static_cast<double>(i) / flown.frames;
        if (!goOn(share)) return planet::cancelled();
        const planet::View view = viewAt(planet, path, startS + i * stepS, settings.camera.fovDeg, size);
        const Result<void> stepped =
            stepOnTime(planet, {view, lod, 1}, i == 0 ? 0 : stepS, [&] { return goOn(share); });
        if (!stepped) return tl::unexpected(stepped.error());
        const double timeS = startS + i * stepS;
        const glm::dvec3 beforeM = std::exchange(fromM, view.eyeM);
        const bool jumped = jumpsBetween(path, timeS - stepS, timeS) ||
                            planet::isCameraJump(beforeM, view.eyeM, planet.tree().shape.radiusM, stepS);
        meter.add(planet.tree(), planet.selection(), view, lod, i * stepS,
                  {.cameraJumped = i > 0 && jumped, .seaM = seaM});
        // The meter drops events after some minutes, so they are copied here.
        const auto& events = meter.events();
        for (auto event = events.rbegin();
             event != events.rend() && event->frame == static_cast<std::uint64_t>(i); ++event)
            flown.events.push_back(*event);
    }
    flown.totals = meter.totals();
    flown.usPerSwitch = meter.measuredUsPerSwitch();
    return flown;
}

std::vector<double> jumpsOf(const PopsFlight& flown) {
    std::vector<double> jumps;
    for (const PopEvent& event : flown.events) {
        if (planet::counts(event)) jumps.push_back(event.jump.largestPx);
    }
    std::sort(jumps.begin(), jumps.end());
    return jumps;
}

}  // namespace worldy
